#include "model/class_prior.hpp"

namespace semtrack {

namespace {

// Length, width, height: means and standard deviations over the tracks of the KITTI tracking labels (352 cars, 30
// vans, 11 trucks, 60 pedestrians, 16 cyclists, 7 trams; per track, since a track's size is constant); of cars the mean
// is that of the object benchmark's labels, 0.01 to 0.03 m beside the tracks'. The length of
// a car is held tighter than its spread of 0.45 m: the tail are vans and pick-ups. Misc are trailers and the like.
const ClassPrior kPriors[kObjectClasses] = {
    {Vec3(3.88, 1.63, 1.53), Vec3(0.35, 0.12, 0.13), 0.62, MotionModel::kVehicle, true},      // car
    {Vec3(5.05, 1.93, 2.24), Vec3(0.79, 0.21, 0.44), 0.62, MotionModel::kVehicle, true},      // van
    {Vec3(9.27, 2.57, 3.30), Vec3(2.04, 0.23, 0.45), 0.60, MotionModel::kVehicle, true},      // truck
    {Vec3(0.65, 0.59, 1.69), Vec3(0.21, 0.14, 0.15), 1.00, MotionModel::kPedestrian, false},  // pedestrian
    {Vec3(1.75, 0.53, 1.72), Vec3(0.18, 0.12, 0.12), 0.60, MotionModel::kVehicle, true},      // cyclist
    {Vec3(15.8, 2.34, 3.63), Vec3(4.00, 0.20, 0.20), 0.60, MotionModel::kVehicle, true},      // tram
    {Vec3(2.72, 1.49, 1.79), Vec3(1.61, 0.63, 0.55), 0.60, MotionModel::kVehicle, true},      // misc
};

}  // namespace

const ClassPrior& class_prior(ObjectClass object_class) {
    const auto i = static_cast<int>(object_class);
    return kPriors[i < kObjectClasses ? i : 0];
}

}  // namespace semtrack

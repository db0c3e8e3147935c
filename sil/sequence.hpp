// A drive as the replay sees it, whatever it is stored as: KITTI raw, odometry, tracking, or the rendered street.
#ifndef SEMTRACK_SIL_SEQUENCE_HPP
#define SEMTRACK_SIL_SEQUENCE_HPP

#include <array>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "semtrack/calibration.hpp"
#include "semtrack/image_view.hpp"
#include "semtrack/types.hpp"

namespace semtrack::sil {

/// Bad input or bad usage: "FILE:LINE: what". The program prints it as one line and ends with status 2.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct GreyImage {
    int width{0};
    int height{0};
    std::vector<std::uint8_t> pixels;
    [[nodiscard]] bool empty() const { return pixels.empty(); }
    [[nodiscard]] ImageView view() const {
        return empty() ? ImageView{} : ImageView{pixels.data(), width, height, width};
    }
};

/// A labelled object in one frame, KITTI's conventions: bottom centre in rectified camera 0, rotation_y.
struct Label {
    int frame{0};
    int id{-1};
    std::string type;
    double truncated{0};
    int occluded{0};
    double alpha{0};
    Box2d box{};  ///< pixels of the detection camera of the layout (raw 0039 and tracking labels: camera 2)
    double height{0};
    double width{0};
    double length{0};
    double x{0};
    double y{0};
    double z{0};
    double rotation_y{0};
    Viewpoint viewpoint{};  ///< where a companion file has it
    /// Where a label lacks it, ideal detections derive it from the 3D box.
};

/// Cameras of the drive. Rectified cameras share their orientation: x_a = x_b + shift.
struct DriveCameras {
    Calibration calibration{};               ///< the processed pair; `detection` and `t_d_c` by --detections-camera
    std::array<double, 3> t_c0_c{};          ///< x_c0 = x_c + t_c0_c: from the processed left camera to camera 0
    PinholeCamera label_camera{};            ///< camera in whose pixels Label::box is
    std::array<double, 3> t_label_c{};       ///< x_label = x_c + t_label_c
};

class Sequence {
public:
    virtual ~Sequence() = default;
    [[nodiscard]] virtual const DriveCameras& cameras() const = 0;
    /// First and last frame number that has an image (without images: rows of the poses file).
    [[nodiscard]] virtual int first_frame() const = 0;
    [[nodiscard]] virtual int last_frame() const = 0;
    [[nodiscard]] virtual std::int64_t time_us(int frame) const = 0;
    /// Empty images: the frame was dropped. Throws InputError for a broken file.
    virtual void load(int frame, GreyImage& left, GreyImage& right) = 0;
    [[nodiscard]] virtual const std::vector<Label>& labels() const = 0;
    /// Frames to evaluate objects on; only these.
    [[nodiscard]] virtual const std::vector<int>& labelled_frames() const = 0;
    /// Truth of the ego-motion: pose of rectified camera 0 by frame, in the frame of the file. Empty: no truth.
    [[nodiscard]] virtual const std::map<int, RigidTransform>& ego_truth() const = 0;
    /// Detections that belong to the drive: `--detections labels`. By frame; a frame without entry has no list.
    [[nodiscard]] virtual const std::map<int, std::vector<Detection>>& label_detections() const = 0;
    /// The vehicle's own sensors, simulated, by time: `--vehicle-motion simulated`. Empty: the layout has none.
    [[nodiscard]] virtual std::map<std::int64_t, VehicleMotion> simulated_vehicle_motion() const { return {}; }
};

}  // namespace semtrack::sil

#endif

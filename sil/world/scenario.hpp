// A drive as data: ego motion, road users and their motion, the street, the cameras' faults. Scenarios are found by
// name; a new one is a function that fills this struct and a row in the table of scenario.cpp.
#ifndef SEMTRACK_SIL_WORLD_SCENARIO_HPP
#define SEMTRACK_SIL_WORLD_SCENARIO_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "semtrack/calibration.hpp"
#include "semtrack/types.hpp"
#include "sil/world/model_road_user.hpp"

namespace semtrack::sil::world {

/// Part of a motion programme. After the last phase the speed stays and the path runs straight on.
struct Phase {
    double duration_s{0};
    double acceleration{0};  ///< along the heading, m/s^2; a standing start may go negative (reversing)
    double curvature{0};     ///< of the rear axle's path, 1/m; positive: to the right
};

struct Motion {
    double x{0};  ///< N, m: middle of the box (ego: camera)
    double z{0};
    double heading{0};  ///< from +z (along the street) towards +x, rad
    double speed{0};    ///< signed
    std::vector<Phase> phases{};
};

struct RoadUser {
    int id{0};
    ObjectClass object_class{ObjectClass::kCar};
    double length{3.9};
    double width{1.63};
    double height{1.53};
    Look look{};
    Motion motion{};
};

struct Ego {
    Motion motion{};
    double pitch_amplitude{0.003};  ///< bumps, rad
    double roll_amplitude{0.002};
    double height_amplitude{0.012};  ///< m
};

/// Gap in a row of houses: a side street.
struct Gap {
    double from_z{0};
    double to_z{0};
};

/// A knot of the road's height profile; between knots it is straight, before and after level.
struct HeightKnot {
    double z{0};
    double height{0};  ///< upwards, m
};

struct Street {
    std::uint32_t seed{1};
    double lane_width{3.5};
    int lanes_left{1};          ///< of the ego lane, which lies at x = 0
    double parking_right{2.3};  ///< width of the parking lane; 0: none
    double parking_left{2.3};
    double pavement{2.6};       ///< kerb to garden
    double garden{1.2};         ///< pavement to houses
    double tree_spacing{17.0};  ///< 0: no trees
    std::vector<Gap> gaps_left{};
    std::vector<Gap> gaps_right{};
    std::vector<HeightKnot> profile{};
    double sun{1.02};  ///< share of direct light
    double ambient{0.45};
};

struct ExposureChange {
    int frame{0};  ///< from this frame on
    double gain{1};
};

struct Imaging {
    double noise_sigma{1.6};  ///< grey levels
    double gain{1.0};
    double right_offset{0.0};  ///< grey levels added to the right image
    double right_gain{1.0};
    std::vector<ExposureChange> exposure{};
    std::vector<int> dropped{};  ///< frames without images
    int blind_right_from{-1};    ///< frames [from, to] with a black right image
    int blind_right_to{-1};
    RowOffset row_offset{};        ///< rendered exactly and stated in the calibration
    double row_error_px{0.0};      ///< the right image lies so much lower than the calibration says
    int samples{4};                ///< a pixel: 4 or 8
    double rectification_px{0.55};  ///< residual of the rectification, amplitude (rectify.hpp); 0: none
};

struct DetectorErrors {
    double edge_sigma_px{1.0};
    double edge_sigma_share{0.015};
    double miss{0.03};  ///< large and visible; rises with small size and occlusion
    double viewpoint_wrong{0.04};
    double false_positives{0.03};  ///< per frame
    int every{1};                  ///< a list on every n-th frame only
    bool viewpoints{true};         ///< false: the detector gives none
    double least_height_px{20.0};  ///< lower objects are not detected
};

struct Scenario {
    std::string name;
    std::uint32_t seed{1};
    int frames{60};
    Ego ego{};
    std::vector<RoadUser> users{};
    Street street{};
    Imaging imaging{};
    DetectorErrors detector{};
};

/// Throws InputError for an unknown name.
[[nodiscard]] Scenario find_scenario(const std::string& name);
[[nodiscard]] std::vector<std::string> all_scenario_names();

/// Builders that scenarios share.
/// Parked cars in both parking lanes from z0 to z1, in rows with gaps; ids count on from `first_id`.
void add_parked_cars(const Street& street, double z0, double z1, std::uint32_t seed, int first_id, Scenario& scenario);
[[nodiscard]] RoadUser make_user(int id, ObjectClass object_class, const Motion& motion, std::uint32_t seed);
/// Lateral place of the kerbs and house fronts, N.
[[nodiscard]] double kerb_right(const Street& street);
[[nodiscard]] double kerb_left(const Street& street);

}  // namespace semtrack::sil::world

#endif

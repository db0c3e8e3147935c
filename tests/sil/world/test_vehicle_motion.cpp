#include "sil/world/vehicle_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "world_cases.hpp"

namespace semtrack::sil::world {
namespace {

TEST(SimulatedVehicleMotion, IsTheMotionOfTheScenarioWithTheErrorsThatAreStated) {
    const Scene scene(find_scenario("traffic"), 100);
    const auto rows = vehicle_motion(scene);
    ASSERT_EQ(rows.size(), 100U);
    double noise = 0.0;
    double last_error = 0.0;
    for (int frame = 0; frame < 100; ++frame) {
        const VehicleMotion& m = rows.at(frame * kFrame_us);
        const PathState& ego = scene.ego(frame);
        const double error = m.speed - ego.speed;
        EXPECT_LT(std::fabs(error), 6.0 * (kWheelScale * std::fabs(ego.speed) + kWheelNoise_mps)) << frame;
        EXPECT_LT(std::fabs(m.yaw_rate + ego.turn_rate), 6.0 * (kYawRateBias_radps + kYawRateNoise_radps)) << frame;
        noise += frame > 0 ? (error - last_error) * (error - last_error) / (2.0 * 99.0) : 0.0;
        last_error = error;
    }
    EXPECT_NEAR(std::sqrt(noise), kWheelNoise_mps, 0.3 * kWheelNoise_mps);
}

TEST(SimulatedVehicleMotion, IsTheSameEveryTimeAndAnotherForAnotherSeed) {
    Scenario s = find_scenario("empty");
    const auto first = vehicle_motion(Scene(s, 3));
    EXPECT_EQ(first.at(0).speed, vehicle_motion(Scene(s, 3)).at(0).speed);
    ++s.seed;
    EXPECT_NE(first.at(0).speed, vehicle_motion(Scene(s, 3)).at(0).speed);
}

}  // namespace
}  // namespace semtrack::sil::world

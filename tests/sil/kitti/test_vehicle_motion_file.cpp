#include "sil/kitti/vehicle_motion_file.hpp"

#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

class VehicleMotionFile : public TempFiles {
protected:
    [[nodiscard]] std::string refusal(const std::string& text) const {
        try {
            (void)read_vehicle_motion(write("motion.txt", text));
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }
};

TEST_F(VehicleMotionFile, RowsHaveTheSensorsSigmasUnlessTheyBringTheirOwn) {
    const auto rows =
        read_vehicle_motion(write("motion.txt", "1767268800000001 10.5 -0.1\r\n1767268800100001\t-2 0 0.3 0.02\n\n"));
    ASSERT_EQ(rows.size(), 2U);
    const VehicleMotion& first = rows.at(1767268800000001);
    EXPECT_EQ(first.time_us, 1767268800000001);
    EXPECT_EQ(first.speed, 10.5);
    EXPECT_EQ(first.yaw_rate, -0.1);
    EXPECT_EQ(first.sigma_speed, VehicleMotion{}.sigma_speed);
    EXPECT_EQ(first.sigma_yaw_rate, VehicleMotion{}.sigma_yaw_rate);
    const VehicleMotion& second = rows.at(1767268800100001);
    EXPECT_EQ(second.speed, -2.0);
    EXPECT_EQ(second.sigma_speed, 0.3);
    EXPECT_EQ(second.sigma_yaw_rate, 0.02);
}

TEST_F(VehicleMotionFile, WhatIsNoMotionIsRefusedByLine) {
    for (const char* row :
         {"100000 1", "100000 1 2 3", "100000 1 2 3 4 5", "100000.5 1 2", "x 1 2", "100000 nan 0", "100000 1 inf",
          "0 1 0", "-5 1 0", "100000 1 0 0 0.1", "100000 1 0 0.1 -1", "9999999999999999999 1 0"}) {
        EXPECT_NE(refusal(std::string("0 1 0\n") + row + "\n").find("motion.txt:2"), std::string::npos) << row;
    }
    EXPECT_NE(refusal("").find("motion.txt"), std::string::npos);
}

}  // namespace
}  // namespace semtrack::sil

#include "sil/kitti/calibration_file.hpp"

#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

std::string row(const std::string& name, double fx, double cx, double tx, double ty = 0.0, double tz = 0.0) {
    const auto s = [](double v) { return std::to_string(v) + " "; };
    return name + " " + s(fx) + "0 " + s(cx) + s(tx) + "0 " + s(fx) + "170 " + s(ty) + "0 0 1 " + s(tz) + "\n";
}

class CalibrationFiles : public TempFiles {
protected:
    void expect_refused(const std::string& text, const std::string& where) const {
        EXPECT_REFUSED(read_calibration(write("calib.txt", text), 0, 1, 0), at("calib.txt").string() + where);
    }
};

const std::string kP0 = row("P0:", 700, 600, 0);
const std::string kP1 = row("P1:", 700, 600, -350);

TEST_F(CalibrationFiles, OdometryRowsGiveThePair) {
    const DriveCameras d = read_calibration(write("calib.txt", kP0 + kP1), 0, 1, 0);
    EXPECT_DOUBLE_EQ(d.calibration.left.fx, 700.0);
    EXPECT_DOUBLE_EQ(d.calibration.left.cy, 170.0);
    EXPECT_DOUBLE_EQ(d.calibration.baseline_m, 0.5);
    EXPECT_DOUBLE_EQ(d.calibration.row_offset.per_disparity, 0.0);
    EXPECT_EQ(d.calibration.t_d_c, (std::array<double, 3>{0, 0, 0}));
    EXPECT_DOUBLE_EQ(d.label_camera.cx, 600.0);
}

TEST_F(CalibrationFiles, RawRowsAndForeignRowsAreReadByName) {
    const std::string text = "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\nS_rect_00: 1242 375\n" +
                             row("P_rect_00:", 700, 600, 0) + "R_rect_01: 1 0 0 0 1 0 0 0 1\n" +
                             row("P_rect_01:", 700, 610, -350);
    const DriveCameras d = read_calibration(write("calib.txt", text), 0, 1, 0);
    EXPECT_DOUBLE_EQ(d.calibration.right.cx, 610.0);
    EXPECT_DOUBLE_EQ(d.calibration.baseline_m, 0.5);
}

TEST_F(CalibrationFiles, ShiftsUseAllThreeComponentsOfTheFourthColumn) {
    // x_2 = x_0 + K^-1 P(:,3): z first, then x and y without cx z and cy z.
    const double tz = 0.01;
    const std::string text = kP0 + kP1 + row("P2:", 700, 600, 42 + 600 * tz, 1.4 + 170 * tz, tz) +
                             row("P3:", 700, 600, -308 + 600 * tz, 5.6 + 170 * tz, tz);
    const DriveCameras d = read_calibration(write("calib.txt", text), 2, 3, 0);
    EXPECT_NEAR(d.t_c0_c[0], -0.06, 1e-12);
    EXPECT_NEAR(d.t_c0_c[1], -0.002, 1e-12);
    EXPECT_NEAR(d.t_c0_c[2], -0.01, 1e-12);
    EXPECT_NEAR(d.calibration.t_d_c[0], -0.06, 1e-12);
    EXPECT_NEAR(d.t_label_c[0], 0.0, 1e-12);
    EXPECT_NEAR(d.calibration.baseline_m, 0.5, 1e-12);
    // 6 mm lower on 0.5 m: rows of the right image move by 0.012 of the disparity.
    EXPECT_NEAR(d.calibration.row_offset.per_disparity, 0.012, 1e-12);
    const DriveCameras grey = read_calibration(at("calib.txt"), 0, 1, 2);
    EXPECT_NEAR(grey.calibration.t_d_c[0], 0.06, 1e-12);
    EXPECT_NEAR(grey.t_label_c[0], 0.06, 1e-12);
    EXPECT_NEAR(grey.t_c0_c[0], 0.0, 1e-12);
}

TEST_F(CalibrationFiles, NonsenseIsRefusedByLine) {
    expect_refused(kP0 + row("P1:", 700, 600, 0), ":2: the baseline is zero");
    expect_refused(kP0 + row("P1:", 700, 600, 350), ":2: the baseline has the wrong sign");
    expect_refused(kP0, ":1: no row P1");
    expect_refused("", ":1: no row P0");
    expect_refused(kP0 + "P1: 700 0 600 nan 0 700 170 0 0 0 1 0\n", ":2: 'nan'");
    expect_refused(kP0 + "P1: 700 0 600 -350 0 700 170 0 0 0 1\n", ":2: ");
    expect_refused(kP0 + "P1:\n", ":2: ");
    expect_refused(kP0 + row("P1:", 700.01, 600, -350), ":2: the focal lengths");
    expect_refused(row("P0:", -700, 600, 0) + kP1, ":1: the focal length");
    expect_refused(row("P0:", 0, 600, 0) + kP1, ":1: the focal length");
    expect_refused(kP0 + "P1: 700 3 600 -350 0 700 170 0 0 0 1 0\n", ":2: not the projection");
    expect_refused(kP0 + "P1: 700 0 600 -350 0 700 170 0 0 0 2 0\n", ":2: not the projection");
    expect_refused(kP0 + kP1 + kP0, ":3: a second row");
}

TEST_F(CalibrationFiles, AMissingDetectionCameraIsRefused) {
    EXPECT_REFUSED(read_calibration(write("calib.txt", kP0 + kP1), 0, 1, 2), "no row P2");
    EXPECT_REFUSED(read_calibration(at("none.txt"), 0, 1, 0), "none.txt");
}

TEST_F(CalibrationFiles, DifferentPrincipalPointsAreLegal) {
    const DriveCameras d = read_calibration(write("calib.txt", kP0 + row("P1:", 700, 600.8, -350)), 0, 1, 0);
    EXPECT_DOUBLE_EQ(d.calibration.right.cx - d.calibration.left.cx, 600.8 - 600.0);
}

}  // namespace
}  // namespace semtrack::sil

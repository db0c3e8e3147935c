#include "sil/kitti/drive_files.hpp"

#include <cstdlib>

#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

using Times = std::vector<std::int64_t>;

class DriveFiles : public TempFiles {
protected:
    [[nodiscard]] std::int64_t step(const std::string& a, const std::string& b) const {
        const Times t = read_timestamps(write("timestamps.txt", a + "\n" + b + "\n"));
        return t.at(1) - t.at(0);
    }
    void expect_stamp_refused(const std::string& text, const std::string& where) const {
        EXPECT_REFUSED(read_timestamps(write("timestamps.txt", text)), "timestamps.txt" + where);
    }
};

const std::string kEye = "1 0 0 0 0 1 0 0 0 0 1 0\n";

TEST_F(DriveFiles, StampsCountFromTheEpochInUtc) {
    EXPECT_EQ(read_timestamps(write("t", "1970-01-01 00:00:00\n")), Times{0});
    EXPECT_EQ(read_timestamps(write("t", "2011-09-26 14:15:05.123456789\n")), Times{1317046505123456});
    EXPECT_EQ(read_timestamps(write("t", "2000-02-29 23:59:59.999999999\n")), Times{951868799999999});
}

TEST_F(DriveFiles, StepsAcrossCalendarBordersAreRight) {
    EXPECT_EQ(step("2011-09-26 12:59:59.95", "2011-09-26 13:00:00.05"), 100000);
    EXPECT_EQ(step("2011-09-26 23:59:59.950000000", "2011-09-27 00:00:00.050000000"), 100000);
    EXPECT_EQ(step("2011-09-30 23:59:59.95", "2011-10-01 00:00:00.05"), 100000);
    EXPECT_EQ(step("2011-12-31 23:59:59.95", "2012-01-01 00:00:00.05"), 100000);
    EXPECT_EQ(step("2012-02-28 23:59:59.95", "2012-02-29 00:00:00.05"), 100000);
    EXPECT_EQ(step("2011-02-28 23:59:59.95", "2011-03-01 00:00:00.05"), 100000);
    EXPECT_EQ(step("2011-10-30 01:59:59.95", "2011-10-30 02:00:00.05"), 100000);  // summer time ends in Europe
    EXPECT_EQ(step("2011-03-27 01:59:59.95", "2011-03-27 02:00:00.05"), 100000);
}

TEST_F(DriveFiles, FractionsOfAnyLengthAreCutToMicroseconds) {
    EXPECT_EQ(step("2011-09-26 14:15:05", "2011-09-26 14:15:05.1"), 100000);
    EXPECT_EQ(step("2011-09-26 14:15:05", "2011-09-26 14:15:05.103"), 103000);
    EXPECT_EQ(step("2011-09-26 14:15:05", "2011-09-26 14:15:05.103600"), 103600);
    EXPECT_EQ(step("2011-09-26 14:15:05", "2011-09-26 14:15:05.103600999"), 103600);
    expect_stamp_refused("2011-09-26 14:15:05.1234567890\n", ":1: ");
}

TEST_F(DriveFiles, TheTimeZoneDoesNotMatter) {
    const auto path = write("t", "2011-07-01 00:00:00.5\n");
    ASSERT_EQ(setenv("TZ", "Pacific/Kiritimati", 1), 0);
    const Times far = read_timestamps(path);
    ASSERT_EQ(setenv("TZ", "America/New_York", 1), 0);
    EXPECT_EQ(read_timestamps(path), far);
    ASSERT_EQ(unsetenv("TZ"), 0);
    EXPECT_EQ(far, Times{1309478400500000});
}

TEST_F(DriveFiles, SecondSixtyIsTheNextMinute) {
    EXPECT_EQ(step("2012-06-30 23:59:59.9", "2012-06-30 23:59:60.1"), 200000);
    expect_stamp_refused("2012-06-30 23:59:60.1\n2012-07-01 00:00:00.1\n", ":2: time does not go forward");
}

TEST_F(DriveFiles, StampsThatAreNotLaterAreRefusedByLine) {
    expect_stamp_refused("2011-09-26 14:15:05.1\n2011-09-26 14:15:05.1\n", ":2: ");
    expect_stamp_refused("2011-09-26 14:15:05.1\n2011-09-26 14:15:05.2\n2011-09-26 14:15:05.0\n", ":3: ");
    expect_stamp_refused("2011-09-26 14:15:05.1\n\n2011-09-26 14:15:05.2\n", ":2: ");
}

TEST_F(DriveFiles, WhatIsNoStampIsRefusedByLine) {
    for (const char* bad : {"2011-13-01 00:00:00", "2011-00-01 00:00:00", "2011-02-29 00:00:00", "2011-09-31 00:00:00",
                            "2011-09-26 24:00:00", "2011-09-26 00:60:00", "2011-09-26 00:00:61", "2011/09/26 00:00:00",
                            "2011-9-26 00:00:00", "2011-09-26", "2011-09-26 00:00:00,5", "2011-09-26 00:00:00.5x",
                            "2011-09-26 00:00:-1", "1317046505.1"}) {
        expect_stamp_refused(std::string(bad) + "\n", ":1: ");
    }
}

TEST_F(DriveFiles, SecondsBecomeMicroseconds) {
    EXPECT_EQ(read_times(write("times.txt", "0.000000e+00\n1.036000e-01\n4.3e3\n")), (Times{0, 103600, 4300000000}));
    EXPECT_REFUSED(read_times(write("times.txt", "0\n0\n")), "times.txt:2: ");
    EXPECT_REFUSED(read_times(write("times.txt", "0\n1e300\n")), "times.txt:2: ");
    EXPECT_REFUSED(read_times(write("times.txt", "0 1\n")), "times.txt:1: ");
    EXPECT_REFUSED(read_times(write("times.txt", "0\n\n1\n")), "times.txt:2: ");
}

TEST_F(DriveFiles, SecondsAreExactWhateverTheirSizeAndForm) {
    EXPECT_EQ(read_times(write("times.txt", "-2.5\n-1e-6\n0.0000004\n.0000005\n2e-6\n3.\n4E+0\n")),
              (Times{-2500000, -1, 0, 1, 2, 3000000, 4000000}));
    EXPECT_EQ(read_times(write("times.txt", "4294967295.9\n4294967296.0\n8589934591.100001\n8589934591.10000249999999\n")),
              (Times{4294967295900000, 4294967296000000, 8589934591100001, 8589934591100002}));
    EXPECT_EQ(read_times(write("times.txt", "8.99e12\n")), (Times{8990000000000000000}));
}

TEST_F(DriveFiles, FrameListsMustGrow) {
    EXPECT_EQ(read_frame_list(write("frames.txt", "19\n20\n25\n")), (std::vector<int>{19, 20, 25}));
    EXPECT_REFUSED(read_frame_list(write("frames.txt", "19\n20\n20\n")), "frames.txt:3: ");
    EXPECT_REFUSED(read_frame_list(write("frames.txt", "19\n18\n")), "frames.txt:2: ");
    EXPECT_REFUSED(read_frame_list(write("frames.txt", "-1\n")), "frames.txt:1: ");
    EXPECT_REFUSED(read_frame_list(write("frames.txt", "1.5\n")), "frames.txt:1: ");
    EXPECT_REFUSED(read_frame_list(write("frames.txt", "1\n\n2\n")), "frames.txt:2: ");
}

TEST_F(DriveFiles, PosesBelongToTheirFrames) {
    const auto path = write("poses.txt", kEye + "0 0 1 5 0 1 0 6 -1 0 0 7\n");
    const auto plain = read_poses(path, {});
    ASSERT_EQ(plain.size(), 2U);
    EXPECT_EQ(plain.at(1).t, (std::array<double, 3>{5, 6, 7}));
    EXPECT_EQ(plain.at(1).R, (std::array<double, 9>{0, 0, 1, 0, 1, 0, -1, 0, 0}));
    const auto numbered = read_poses(path, {19, 25});
    EXPECT_EQ(numbered.at(25).t[0], 5.0);
    EXPECT_EQ(numbered.count(0), 0U);
    EXPECT_REFUSED(read_poses(path, {19}), "poses.txt:2: ");
}

TEST_F(DriveFiles, WhatIsNoPoseIsRefusedByLine) {
    EXPECT_REFUSED(read_poses(write("p.txt", kEye + "1 0 0 0 0 1 0 0 0 0 1\n"), {}), "p.txt:2: ");
    EXPECT_REFUSED(read_poses(write("p.txt", kEye + "\n" + kEye), {}), "p.txt:2: ");
    EXPECT_REFUSED(read_poses(write("p.txt", "0 0 0 0 0 0 0 0 0 0 0 0\n"), {}), "p.txt:1: ");
    EXPECT_REFUSED(read_poses(write("p.txt", "-1 0 0 0 0 1 0 0 0 0 1 0\n"), {}), "p.txt:1: ");  // a mirror
    EXPECT_REFUSED(read_poses(write("p.txt", "1 0 0 nan 0 1 0 0 0 0 1 0\n"), {}), "p.txt:1: ");
}

}  // namespace
}  // namespace semtrack::sil

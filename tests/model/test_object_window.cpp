#include "model/object_window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "math/so3.hpp"
#include "math/trig.hpp"
#include "model/bicycle.hpp"

namespace semtrack {
namespace {

ObjectFrame frame_at(std::uint32_t number) {
    ObjectFrame f;
    f.frame = number;
    f.time_us = 100000 * static_cast<std::int64_t>(number);
    return f;
}

TEST(ObjectWindow, KeepsTheNewestFramesDenseAndOlderOnesAStrideApart) {
    auto window = std::make_unique<ObjectWindow>();
    for (std::uint32_t n = 1; n <= 60; ++n) {
        thin_out(*window);
        ASSERT_TRUE(window->frames.try_push_back(frame_at(n)));
    }
    ASSERT_EQ(window->frames.size(), kObjectWindow);
    for (int i = window->frames.size() - kObjectDenseFrames; i + 1 < window->frames.size(); ++i) {
        EXPECT_EQ(window->frames[i + 1].frame - window->frames[i].frame, 1U);
    }
    for (int i = 0; i + kObjectDenseFrames < window->frames.size() - 1; ++i) {
        EXPECT_EQ(window->frames[i + 1].frame - window->frames[i].frame, 4U);
    }
    EXPECT_LE(60U - window->frames[0].frame, static_cast<std::uint32_t>(kEgoHistory));
}

TEST(ObjectWindow, FindsAFrameByItsNumberAndSaysWhenItIsNotThere) {
    auto window = std::make_unique<ObjectWindow>();
    EXPECT_EQ(find_frame(*window, 1), -1);
    ASSERT_TRUE(window->frames.try_push_back(frame_at(3)));
    ASSERT_TRUE(window->frames.try_push_back(frame_at(5)));
    EXPECT_EQ(find_frame(*window, 5), 1);
    EXPECT_EQ(find_frame(*window, 4), -1);
}

TEST(ObjectWindow, RelevellingKeepsPositionAndHeadingInTheWorld) {
    auto window = std::make_unique<ObjectWindow>();
    ObjectFrame f = frame_at(1);
    f.state.p = Vec3(10.0, -3.0, 0.5);
    f.state.theta = 1.2;
    ASSERT_TRUE(window->frames.try_push_back(f));
    const Mat3 R_l_w = so3_exp(Vec3(0.05, -0.03, 0.0));
    relevel(*window, R_l_w);
    const ObjectState& x = window->newest().state;
    EXPECT_NEAR((R_l_w.transpose() * x.p - f.state.p).norm(), 0.0, 1e-12);
    const Vec3 heading_w = R_l_w.transpose() * Vec3(std::cos(x.theta), std::sin(x.theta), 0.0);
    EXPECT_NEAR(std::atan2(heading_w(1), heading_w(0)), 1.2, 2e-3);  // out of the plane it tilts, by the second order
    relevel(*window, Mat3::Identity());
    EXPECT_NEAR(window->newest().state.theta, 1.2, 3e-3);
    EXPECT_NEAR((window->newest().state.p - f.state.p).norm(), 0.0, 1e-12);
}

TEST(ObjectWindow, AnotherChoiceOfAxesMovesNoPointOfTheObject) {
    auto window = std::make_unique<ObjectWindow>();
    ObjectFrame f = frame_at(1);
    f.state.p = Vec3(10.0, -3.0, 0.5);
    f.state.theta = 3.1;
    ASSERT_TRUE(window->frames.try_push_back(f));
    window->landmarks[7].valid = true;
    window->landmarks[7].f_o = Vec3(1.5, 0.7, 0.2);
    const Vec3 before = window->newest().state.T_l_o() * window->landmarks[7].f_o;
    change_object_frame(*window, Vec3(0.4, -0.2, 0.0), 0.3);
    const Vec3 after = window->newest().state.T_l_o() * window->landmarks[7].f_o;
    EXPECT_NEAR((after - before).norm(), 0.0, 1e-12);
    EXPECT_NEAR(window->newest().state.theta, 3.4 - kTwoPi, 1e-12);  // wrapped at pi
}

TEST(Bicycle, DrivesACircleWhoseRadiusIsWheelbaseOverTangentOfTheSteering) {
    ObjectState x;
    x.v = 5.0;
    x.delta = 0.2;
    const double wheelbase = 2.5;
    const double radius = wheelbase / std::tan(0.2);
    const double period = 2.0 * kPi * radius / x.v;
    ObjectState y = x;
    const int steps = 400;
    for (int k = 0; k < steps; ++k) {
        y = bicycle_step(y, wheelbase, period / steps);
    }
    EXPECT_NEAR((y.p - x.p).norm(), 0.0, 0.01);
    EXPECT_NEAR(y.theta, 0.0, 1e-9);
}

TEST(Bicycle, ReversingWithTheSameSteeringRetracesTheArc) {
    ObjectState x;
    x.v = 3.0;
    x.delta = -0.3;
    x.theta = -3.1;
    ObjectState y = bicycle_step(x, 2.6, 0.4);
    y.v = -3.0;
    y = bicycle_step(y, 2.6, 0.4);
    EXPECT_NEAR((y.p - x.p).norm(), 0.0, 1e-12);
    EXPECT_NEAR(y.theta, x.theta, 1e-12);
}

TEST(Bicycle, JacobianMatchesCentralDifferences) {
    int checked = 0;
    for (const double v : {-8.0, 0.0, 0.3, 20.0}) {
        for (const double delta : {-0.5, 0.0, 0.1}) {
            for (const double theta : {-3.1, 0.0, 1.5, 3.1}) {
                ObjectState x;
                x.p = Vec3(3.0, -2.0, 1.0);
                x.theta = theta;
                x.v = v;
                x.delta = delta;
                const Mat6 J = bicycle_jacobian(x, 2.6, 0.4);
                for (int c = 0; c < 6; ++c) {
                    const double h = 1e-6;
                    const auto moved = [&](double d) {
                        ObjectState m = x;
                        if (c < 3) {
                            m.p(c) += d;
                        }
                        if (c == 3) {
                            m.theta += d;
                        }
                        if (c == 4) {
                            m.v += d;
                        }
                        if (c == 5) {
                            m.delta += d;
                        }
                        return bicycle_step(m, 2.6, 0.4);
                    };
                    const ObjectState a = moved(h);
                    const ObjectState b = moved(-h);
                    Vec6 d;
                    d << a.p - b.p, wrap_angle(a.theta - b.theta), a.v - b.v, a.delta - b.delta;
                    EXPECT_LT((J.col(c) - d / (2.0 * h)).norm(), 1e-6) << "column " << c << " v " << v;
                    ++checked;
                }
            }
        }
    }
    EXPECT_EQ(checked, 4 * 3 * 4 * 6);
}

}  // namespace
}  // namespace semtrack

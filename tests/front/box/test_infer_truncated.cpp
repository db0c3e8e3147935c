// Boxes cut by the image border, and boxes that nothing makes: three edges are enough with a heading, two are not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "front/box/infer_box.hpp"
#include "support/frustum_boxes.hpp"

namespace semtrack {
namespace {

BoxInferenceInput clipped_input(const FrustumBox& b) {
    BoxInferenceInput in;
    in.viewpoint = b.view;
    in.size_m = b.size_m;
    in.camera = kFrustumCamera;
    in.R_c_l = b.R_c_l;
    in.width = kFrustumWidth;
    in.height = kFrustumHeight;
    EXPECT_TRUE(clip_box(b.box, kFrustumWidth, kFrustumHeight, in.box));
    return in;
}

/// A random box that only this border cuts.
bool cut_at(int edge, Rng& rng, FrustumBox& b) {
    const double z = between(rng, 3.0, 14.0);
    b.R_c_l = level_camera();
    b.size_m = Vec3(between(rng, 3.2, 5.0), between(rng, 1.5, 2.0), between(rng, 1.4, 3.6));
    b.p_c = Vec3(between(rng, -1.0, 1.0) * z, 1.65 - 0.5 * b.size_m(2), z);
    b.theta = between(rng, -kPi, kPi);
    Box2d in;
    if (!complete(b) || !clip_box(b.box, kFrustumWidth, kFrustumHeight, in)) {
        return false;
    }
    const bool cut[kBoxEdges] = {b.box.left<0.0, b.box.right> kFrustumWidth - 1.0,
                                 b.box.top<0.0, b.box.bottom> kFrustumHeight - 1.0};
    const bool clear[kBoxEdges] = {b.box.left > 3.0, b.box.right<kFrustumWidth - 4.0, b.box.top> 3.0,
                                   b.box.bottom < kFrustumHeight - 4.0};
    bool only = true;
    for (int e = 0; e < kBoxEdges; ++e) {
        only = only && (e == edge ? cut[e] : clear[e]);
    }
    return only;
}

class CutBox : public testing::TestWithParam<int> {};
std::string edge_name(const testing::TestParamInfo<int>& test) {
    return test.param == kLeft ? "Left" : test.param == kRight ? "Right" : test.param == kTop ? "Top" : "Bottom";
}
INSTANTIATE_TEST_SUITE_P(BoxInference, CutBox, testing::Values(int{kLeft}, int{kRight}, int{kTop}, int{kBottom}),
                         edge_name);

TEST_P(CutBox, IsSolvedExactlyFromThreeEdgesAndTheLastKnownHeading) {
    Rng rng(31);
    int solved = 0;
    for (int k = 0; k < 40000 && solved < 200; ++k) {
        FrustumBox b;
        if (!cut_at(GetParam(), rng, b)) {
            continue;
        }
        BoxInferenceInput in = clipped_input(b);
        in.has_theta = true;
        in.theta = b.theta;
        BoxHypotheses out;
        ASSERT_EQ(infer_box(in, out), Status::kOk);
        double best = 1e9;
        for (const BoxHypothesis& h : out) {
            best = std::fmin(best, (h.p_c - b.p_c).norm());
            EXPECT_EQ(h.edges, 0xFU & ~(1U << static_cast<unsigned>(GetParam())));
            EXPECT_EQ(h.theta, b.theta);
        }
        EXPECT_LT(best, 1e-9) << b.p_c(0) << " " << b.p_c(2) << " theta " << b.theta;
        ++solved;
    }
    EXPECT_EQ(solved, 200);
}

TEST_P(CutBox, IsRoughlyPlacedFromThreeEdgesTheClassAndTheSizePriorAlone) {
    Rng rng(32);
    int tried = 0;
    int solved = 0;
    int near = 0;
    for (int k = 0; k < 40000 && tried < 200; ++k) {
        FrustumBox b;
        if (!cut_at(GetParam(), rng, b)) {
            continue;
        }
        ++tried;
        BoxHypotheses out;
        if (infer_box(clipped_input(b), out) != Status::kOk) {
            continue;
        }
        ++solved;
        near += (out[0].p_c - b.p_c).norm() < 0.25 * b.p_c.norm() ? 1 : 0;
        EXPECT_EQ(out[0].edges, 0xFU & ~(1U << static_cast<unsigned>(GetParam())));
    }
    std::printf("edge %d cut: %d of %d placed, %d within a quarter of the distance\n", GetParam(), solved, tried, near);
    EXPECT_EQ(tried, 200);
    EXPECT_GT(solved, 0.95 * tried);
    EXPECT_GT(near, 0.7 * tried);
}

TEST(BoxInference, TwoEdgesAreNotObservableWhicheverTheyAreEvenWithAHeading) {
    FrustumBox b;
    b.R_c_l = level_camera();
    b.size_m = Vec3(3.9, 1.6, 1.5);
    b.p_c = Vec3(2.0, 0.9, 20.0);
    b.theta = 0.4;
    ASSERT_TRUE(complete(b));
    for (int first = 0; first < kBoxEdges; ++first) {
        for (int second = first + 1; second < kBoxEdges; ++second) {
            BoxInferenceInput in = clipped_input(b);
            for (const int edge : {first, second}) {
                (edge == kLeft    ? in.box.left
                 : edge == kRight ? in.box.right
                 : edge == kTop   ? in.box.top
                                  : in.box.bottom) = edge == kLeft || edge == kTop ? 0.0
                                                   : edge == kRight              ? kFrustumWidth - 1.0
                                                                                 : kFrustumHeight - 1.0;
            }
            in.has_theta = true;
            in.theta = b.theta;
            BoxHypotheses out;
            EXPECT_EQ(infer_box(in, out), Status::kNotObservable) << first << second;
            EXPECT_TRUE(out.empty());
        }
    }
}

TEST(BoxInference, ABoxThatNoHeadingMakesIsNotObservable) {
    BoxInferenceInput in;
    in.size_m = Vec3(3.9, 1.6, 1.5);
    in.camera = kFrustumCamera;
    in.R_c_l = level_camera();
    in.width = kFrustumWidth;
    in.height = kFrustumHeight;
    int refused = 0;
    for (int h = -1; h < 8; ++h) {  // a car is at most 2.8 times as wide as high, and at least as wide as 1 : 1
        in.viewpoint = {static_cast<std::int8_t>(h), static_cast<std::int8_t>(h < 0 ? -1 : 1)};
        for (const Box2d& box : {Box2d{300, 180, 900, 220}, Box2d{600, 100, 605, 300}}) {
            in.box = box;
            BoxHypotheses out;
            EXPECT_EQ(infer_box(in, out), Status::kNotObservable) << h;
            EXPECT_TRUE(out.empty());
            ++refused;
        }
    }
    EXPECT_EQ(refused, 18);
}

TEST(BoxInference, APedestrianAtTheSideBorderIsPlacedByTheEdgeThatIsSeen) {
    BoxInferenceInput in;
    in.object_class = ObjectClass::kPedestrian;
    in.size_m = Vec3(0.6, 0.6, 1.7);
    in.camera = kFrustumCamera;
    in.R_c_l = level_camera();
    in.width = kFrustumWidth;
    in.height = kFrustumHeight;
    const double z = 8.0;
    const double x = -0.5 * 0.6 - 609.6 / 721.5 * z + 0.5;  // half a metre of it is inside, its left edge is not
    in.box = {0.0, 172.9 + 721.5 * (0.8 - 1.7) / z, 609.6 + 721.5 * (x + 0.3) / z, 172.9 + 721.5 * 0.8 / z};
    BoxHypotheses out;
    ASSERT_EQ(infer_box(in, out), Status::kOk);
    EXPECT_NEAR(out[0].p_c(0), x, 1e-9);
    EXPECT_NEAR(out[0].p_c(2), z, 1e-9);
    EXPECT_EQ(out[0].edges, 0xFU & ~(1U << kLeft));
    in.box.bottom = kFrustumHeight - 1.0;
    EXPECT_EQ(infer_box(in, out), Status::kNotObservable);  // the height is what gives the depth
}

}  // namespace
}  // namespace semtrack

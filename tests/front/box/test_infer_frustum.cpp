// Box inference over the whole frustum: exactness, what the table's top and bottom vertices would cost, and the list of
// hypotheses without a viewpoint.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "front/box/edge_planes.hpp"
#include "front/box/infer_box.hpp"
#include "support/frustum_boxes.hpp"
#include "support/sweep.hpp"

namespace semtrack {
namespace {

constexpr double kExact_m = 1e-9;
constexpr double kExact_rad = 1e-9;
// Nearer than this to a double root (both roots meet) rounding of the input alone moves the angle by more than 1e-9.
constexpr double kDoubleRoot_rad = 2e-3;
constexpr double kAtDoubleRoot = 1e4;  // there: 1e-5

BoxInferenceInput input_for(const FrustumBox& b) {
    BoxInferenceInput in;
    in.box = b.box;
    in.viewpoint = b.view;
    in.size_m = b.size_m;
    in.camera = kFrustumCamera;
    in.R_c_l = b.R_c_l;
    in.width = kFrustumWidth;
    in.height = kFrustumHeight;
    return in;
}

bool is_pose(const BoxHypothesis& h, const FrustumBox& b, double limit_m, double limit_rad) {
    return (h.p_c - b.p_c).norm() <= limit_m && std::fabs(wrap_angle(h.theta - b.theta)) <= limit_rad;
}

/// Place of the true pose in the list; -1: not there.
int place_of(const BoxHypotheses& list, const FrustumBox& b, double limit_m, double limit_rad) {
    for (int i = 0; i < list.size(); ++i) {
        if (is_pose(list[i], b, limit_m, limit_rad)) {
            return i;
        }
    }
    return -1;
}

/// Distance of the two roots that the box's own corners leave.
double between_roots(const FrustumBox& b) {
    EdgeVertices exact;
    EXPECT_EQ(extreme_vertices(kFrustumCamera, b.T_c_o(), b.size_m, exact), Status::kOk);
    double roots[2] = {0.0, 0.0};
    EXPECT_TRUE(heading_roots(edge_planes(kFrustumCamera, b.R_c_l, b.box, 0xFU, exact, b.size_m), roots));
    return std::fabs(wrap_angle(roots[0] - roots[1]));
}

/// Left and right vertical edges of the box are those of the table; a rolled camera may see a corner of the roof there.
bool upright(const FrustumBox& b) {
    EdgeVertices exact;
    EXPECT_EQ(extreme_vertices(kFrustumCamera, b.T_c_o(), b.size_m, exact), Status::kOk);
    const EdgeVertices& table = edge_vertices(b.view);
    bool same = true;
    for (const std::size_t e : {std::size_t{kLeft}, std::size_t{kRight}}) {
        same = same && exact[e].x == table[e].x && exact[e].y == table[e].y;
    }
    return same;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

class ExactInput : public testing::TestWithParam<bool> {};  // a level camera, and one that pitches and rolls
INSTANTIATE_TEST_SUITE_P(BoxInference, ExactInput, testing::Bool(),
                         [](const auto& test) { return test.param ? "Tilted" : "Level"; });

TEST_P(ExactInput, GivesThePoseToANanometreInEveryClassOverTheFrustum) {
    Rng rng(21);
    int checked[16] = {};
    int total = 0;
    int twins = 0;
    int double_roots = 0;
    int rolled = 0;
    for (int k = 0; k < 40000; ++k) {
        FrustumBox b;
        if (!random_box(rng, GetParam(), b) || !inside_image(b.box)) {
            continue;
        }
        const bool near_double_root = between_roots(b) < kDoubleRoot_rad;
        double_roots += near_double_root ? 1 : 0;
        if (!upright(b)) {
            ++rolled;
            continue;
        }
        BoxHypotheses out;
        ASSERT_EQ(infer_box(input_for(b), out), Status::kOk);
        const double limit = near_double_root ? kAtDoubleRoot : 1.0;
        ASSERT_GE(place_of(out, b, limit * kExact_m, limit * kExact_rad), 0)
            << "class " << int{b.view.horizontal} << ", " << int{b.view.vertical} << " at " << b.p_c(0) << " "
            << b.p_c(1) << " " << b.p_c(2);
        for (const BoxHypothesis& h : out) {  // a second pose is no worse: the same faces, the same box
            EXPECT_LT(h.residual_px, 1e-6);
            EXPECT_EQ(h.viewpoint.horizontal, b.view.horizontal);
            EXPECT_EQ(h.viewpoint.vertical, b.view.vertical);
            EXPECT_EQ(h.edges, 0xFU);
        }
        EXPECT_LE(out.size(), GetParam() ? 3 : 2);  // a rolled camera: rarely also a corner of the roof at the side
        twins += out.size() == 2 ? 1 : 0;
        ++checked[2 * b.view.horizontal + b.view.vertical];
        ++total;
    }
    std::printf(
        "%d boxes, %.1f %% with a second pose of the same box and faces; %d at a double root; left out: %d whose "
        "side is made by a corner of the roof\n",
        total, 100.0 * twins / total, double_roots, rolled);
    EXPECT_GT(total, 25000);
    EXPECT_LT(double_roots, 0.01 * total);
    EXPECT_LT(rolled, GetParam() ? 0.005 * total : 1.0);
    EXPECT_GT(twins, 0.2 * total);
    EXPECT_LT(twins, 0.5 * total);
    for (int c = 0; c < 16; ++c) {
        EXPECT_GT(checked[c], 400) << "class " << c / 2 << ", " << c % 2;
    }
}

/// Pose by Eq. (1)-(2) with given vertices; the root nearer to the truth.
bool pose_with(const FrustumBox& b, const EdgeVertices& vertices, double& off_share, double& off_rad) {
    const EdgePlanes planes = edge_planes(kFrustumCamera, b.R_c_l, b.box, 0xFU, vertices, b.size_m);
    double roots[2] = {0.0, 0.0};
    if (!heading_roots(planes, roots)) {
        return false;
    }
    const bool first = std::fabs(wrap_angle(roots[0] - b.theta)) < std::fabs(wrap_angle(roots[1] - b.theta));
    Vec3 p_c;
    if (!position_at(planes, first ? roots[0] : roots[1], p_c)) {
        return false;
    }
    off_rad = std::fabs(wrap_angle((first ? roots[0] : roots[1]) - b.theta));
    off_share = (p_c - b.p_c).norm() / b.p_c.norm();
    return true;
}

TEST(BoxInference, TheTablesTopAndBottomVerticesWouldCostPositionAndHeadingThatTheExactCornersDoNot) {
    Rng rng(22);
    std::vector<double> shares;
    std::vector<double> angles;
    double worst_product = 0.0;
    int all = 0;
    for (int k = 0; k < 40000; ++k) {
        FrustumBox b;
        if (!random_box(rng, false, b) || !inside_image(b.box) || b.view.horizontal % 2 == 0 ||
            between_roots(b) < kDoubleRoot_rad) {
            continue;
        }
        ++all;
        EdgeVertices exact;
        ASSERT_EQ(extreme_vertices(kFrustumCamera, b.T_c_o(), b.size_m, exact), Status::kOk);
        const EdgeVertices& table = edge_vertices(b.view);
        bool same = true;
        for (const std::size_t e : {std::size_t{kTop}, std::size_t{kBottom}}) {
            same = same && exact[e].x == table[e].x && exact[e].y == table[e].y;
        }
        double share = 0.0;
        double angle = 0.0;
        if (same || !pose_with(b, table, share, angle)) {
            continue;
        }
        shares.push_back(share);
        angles.push_back(angle);
        BoxHypotheses out;
        ASSERT_EQ(infer_box(input_for(b), out), Status::kOk);
        double best = 1e9;
        for (const BoxHypothesis& h : out) {
            best = std::min(best, (h.p_c - b.p_c).norm());
        }
        worst_product = std::max(worst_product, best);
    }
    const double wrong = static_cast<double>(shares.size()) / all;
    const double worst_share = *std::max_element(shares.begin(), shares.end());
    const double worst_deg = 180.0 / kPi * *std::max_element(angles.begin(), angles.end());
    std::printf(
        "table's corner is not the exact one in %.1f %% of %d; then position off by %.2f %% (median), %.1f %% (worst) "
        "of the distance, heading by %.2f deg, %.1f deg; the product: %.1e m\n",
        100.0 * wrong, all, 100.0 * median(shares), 100.0 * worst_share, 180.0 / kPi * median(angles), worst_deg,
        worst_product);
    EXPECT_GT(wrong, 0.15);
    EXPECT_LT(wrong, 0.30);
    EXPECT_GT(median(shares), 0.0005);
    EXPECT_LT(median(shares), 0.02);
    EXPECT_GT(worst_share, 0.03);
    EXPECT_GT(worst_deg, 5.0);
    EXPECT_LT(worst_product, kExact_m);
}

struct Ranks {
    int tried{0};
    int found{0};
    int first{0};
    int first_four{0};
    int longest{0};
};

int class_steps(const Viewpoint& a, const Viewpoint& b) {
    const int d = std::abs(a.horizontal - b.horizontal);
    return std::min(d, 8 - d);
}

/// Without viewpoint; `noise_px` on each edge. True: heading within `limit_rad` and the class that was seen; with noise
/// also its neighbour, as the classes that show one face are narrower than what a pixel turns.
Ranks ranks_without_viewpoint(double noise_px, double limit_rad, bool along) {
    Rng rng(23);
    Ranks out;
    for (int k = 0; k < 12000 / kSweepShare; ++k) {
        FrustumBox b;
        if (!random_box(rng, false, b)) {
            continue;
        }
        if (along) {  // as traffic goes: within 20 degrees of the camera's axis, either way
            b.theta = wrap_angle((rng.below(2) == 0 ? 0.0 : kPi) + between(rng, -0.35, 0.35));
            if (!complete(b)) {
                continue;
            }
        }
        if (!inside_image(b.box) || b.box.bottom - b.box.top < 25.0 || between_roots(b) < kDoubleRoot_rad) {
            continue;
        }
        BoxInferenceInput in = input_for(b);
        in.viewpoint = Viewpoint{};
        in.box.left += noise_px * normal(rng);
        in.box.top += noise_px * normal(rng);
        in.box.right += noise_px * normal(rng);
        in.box.bottom += noise_px * normal(rng);
        BoxHypotheses list;
        ++out.tried;
        if (infer_box(in, list) != Status::kOk) {
            continue;
        }
        int place = -1;
        for (int i = 0; i < list.size() && place < 0; ++i) {
            const double turn = std::fabs(wrap_angle(list[i].theta - b.theta));
            place = turn < limit_rad && class_steps(list[i].viewpoint, b.view) <= (noise_px > 0.0 ? 1 : 0) ? i : -1;
        }
        for (int i = 1; i < list.size(); ++i) {
            EXPECT_LE(list[i - 1].rank_px, list[i].rank_px);
        }
        out.found += place >= 0 ? 1 : 0;
        out.first += place == 0 ? 1 : 0;
        out.first_four += place >= 0 && place < 4 ? 1 : 0;
        out.longest = std::max(out.longest, list.size());
    }
    return out;
}

void show(const char* what, const Ranks& r) {
    std::printf(
        "%s: true pose in the list %.2f %%, first %.1f %%, among the first four %.1f %% of %d; longest list %d\n", what,
        100.0 * r.found / r.tried, 100.0 * r.first / r.tried, 100.0 * r.first_four / r.tried, r.tried, r.longest);
}

TEST(BoxInference, WithoutViewpointTheTruePoseIsInTheListOverTheFrustum) {
    const Ranks any = ranks_without_viewpoint(0.0, 1e-6, false);
    show("exact edges, any heading", any);
    EXPECT_GT(any.tried, 5000 / kSweepShare);
    EXPECT_GT(any.found, 0.999 * any.tried);
    EXPECT_GT(any.first_four, 0.6 * any.tried);
    const Ranks along = ranks_without_viewpoint(0.0, 1e-6, true);
    show("exact edges, along the road", along);
    EXPECT_GT(along.found, 0.999 * along.tried);
    EXPECT_GT(along.first, 0.35 * along.tried);  // one image does not tell front from rear
}

TEST(BoxInference, WithoutViewpointAPixelOfNoiseLeavesTheTrueClassInTheList) {
    const Ranks any = ranks_without_viewpoint(1.0, 0.35, false);
    show("1 px of noise, any heading", any);
    EXPECT_GT(any.tried, 5000 / kSweepShare);
    EXPECT_GT(any.found, 0.93 * any.tried);
    EXPECT_LE(any.longest, kMaxBoxHypotheses);
    const Ranks along = ranks_without_viewpoint(1.0, 0.35, true);
    show("1 px of noise, along the road", along);
    EXPECT_GT(along.found, 0.98 * along.tried);
}

TEST(Viewpoint, FromTheObservationAngleIsTheClassOfTheVisibleFacesOverTheFrustum) {
    Rng rng(24);
    int checked[16] = {};
    for (int k = 0; k < 60000; ++k) {
        FrustumBox b;
        if (!random_box(rng, false, b)) {
            continue;
        }
        const double rotation_y = -(b.theta + 0.5 * kPi);
        const double alpha = rotation_y - atan2_rad(b.p_c(0), b.p_c(2));
        for (const double turns : {0.0, kTwoPi, -kTwoPi}) {  // any branch of the angle
            const Viewpoint v = viewpoint_from_alpha(alpha + turns, b.p_c, b.size_m);
            ASSERT_EQ(v.horizontal, b.view.horizontal) << alpha;
            ASSERT_EQ(v.vertical, b.view.vertical) << alpha;
        }
        ++checked[2 * b.view.horizontal + b.view.vertical];
    }
    for (int c = 0; c < 16; ++c) {
        EXPECT_GT(checked[c], 600) << "class " << c / 2 << ", " << c % 2;
    }
}

TEST(Viewpoint, AtPlusAndMinusPiTheLeftSideIsSeenAndBesideItFrontOrRear) {
    const Vec3 size(3.9, 1.6, 1.5);
    const Vec3 p(0.0, 1.0, 30.0);
    for (const double sign : {1.0, -1.0}) {
        EXPECT_EQ(viewpoint_from_alpha(sign * kPi, p, size).horizontal, 4);
    }
    EXPECT_EQ(viewpoint_from_alpha(kPi - 0.2, p, size).horizontal, 3);
    EXPECT_EQ(viewpoint_from_alpha(-kPi + 0.2, p, size).horizontal, 5);
    EXPECT_EQ(viewpoint_from_alpha(kPi - 0.2, p, size).vertical, viewpoint_from_alpha(-kPi - 0.2, p, size).vertical);
}

}  // namespace
}  // namespace semtrack

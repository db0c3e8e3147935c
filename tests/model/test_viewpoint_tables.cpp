// The sixteen viewpoint tables by brute force over the whole frustum (docs/viewpoints.md).
#include <gtest/gtest.h>

#include <cstdio>

#include "support/frustum_boxes.hpp"

namespace semtrack {
namespace {

constexpr int kClasses = 16;

int class_of(const Viewpoint& v) {
    return 2 * v.horizontal + v.vertical;
}

bool same_corner(const BoxVertex& a, const BoxVertex& b) {
    return a.x == b.x && a.y == b.y;
}

/// Values of the eight projected vertices at one edge, brute force: the smallest or the largest.
double extreme(const FrustumBox& b, int edge) {
    double best = 0.0;
    for (int k = 0; k < 8; ++k) {
        const Vec3 c((k & 1) != 0 ? 0.5 : -0.5, (k & 2) != 0 ? 0.5 : -0.5, (k & 4) != 0 ? 0.5 : -0.5);
        const double value = project(kFrustumCamera, b.T_c_o() * c.cwiseProduct(b.size_m))(edge < kTop ? 0 : 1);
        const bool beyond = edge == kLeft || edge == kTop ? value < best : value > best;
        best = k == 0 || beyond ? value : best;
    }
    return best;
}

double table_value(const FrustumBox& b, int edge) {
    const BoxVertex& vertex = edge_vertices(b.view)[static_cast<std::size_t>(edge)];
    return project(kFrustumCamera, b.T_c_o() * vertex.scaled(b.size_m))(edge < kTop ? 0 : 1);
}

TEST(ViewpointTables, LeftAndRightVerticesMakeTheExtremesInEveryClassOverTheFrustum) {
    Rng rng(11);
    int seen[kClasses] = {};
    double worst_px = 0.0;
    for (int k = 0; k < 60000; ++k) {
        FrustumBox b;
        if (!random_box(rng, false, b) || !inside_image(b.box)) {
            continue;
        }
        ++seen[class_of(b.view)];
        for (const int edge : {int{kLeft}, int{kRight}}) {
            const double off = std::fabs(table_value(b, edge) - extreme(b, edge));
            worst_px = off > worst_px ? off : worst_px;
        }
    }
    EXPECT_LT(worst_px, 1e-9);
    for (int c = 0; c < kClasses; ++c) {
        EXPECT_GT(seen[c], 700) << "class " << c / 2 << ", " << c % 2;
        std::printf("class (%d, %d): %d boxes\n", c / 2, c % 2, seen[c]);
    }
}

TEST(ViewpointTables, LeftAndRightVerticesHoldOnAGridOfPlacesHeadingsAndSizes) {
    int checked = 0;
    double worst_px = 0.0;
    for (const double length : {1.7, 3.9, 9.0}) {
        for (double z = 6.0; z < 80.0; z *= 1.5) {
            for (int i = -8; i <= 8; ++i) {
                for (int k = 0; k < 360; ++k) {
                    FrustumBox b;
                    b.R_c_l = level_camera();
                    b.size_m = Vec3(length, 0.3 * length + 0.3, 1.6);
                    b.p_c = Vec3(0.1 * i * z, 0.9, z);
                    b.theta = (k - 180) * kPi / 180.0 + 1e-3;
                    if (!complete(b)) {
                        continue;
                    }
                    ++checked;
                    for (const int edge : {int{kLeft}, int{kRight}}) {
                        const double off = std::fabs(table_value(b, edge) - extreme(b, edge));
                        worst_px = off > worst_px ? off : worst_px;
                    }
                }
            }
        }
    }
    EXPECT_GT(checked, 100000);
    EXPECT_LT(worst_px, 1e-9);
}

TEST(ViewpointTables, TheNextClassesVerticesDoNotMakeTheExtremes) {  // so the tests above can fail
    Rng rng(12);
    int checked = 0;
    int wrong = 0;
    for (int k = 0; k < 5000; ++k) {
        FrustumBox b;
        if (!random_box(rng, false, b) || b.view.horizontal % 2 == 0) {
            continue;
        }
        ++checked;
        FrustumBox other = b;
        other.view.horizontal = static_cast<std::int8_t>((b.view.horizontal + 2) % 8);
        wrong += std::fabs(table_value(other, kLeft) - extreme(b, kLeft)) > 0.1 ? 1 : 0;
    }
    EXPECT_GT(checked, 2000);
    EXPECT_GT(wrong, 0.98 * checked);
}

TEST(ViewpointTables, TopAndBottomVerticesAreOthersInAQuarterOfTheCasesAndTheExactOnesAreFound) {
    Rng rng(13);
    int off_axis = 0;
    int on_axis = 0;
    int wrong_top = 0;
    int wrong_bottom = 0;
    int wrong_off_axis = 0;
    int wrong_on_axis = 0;
    double exact_worst_px = 0.0;
    double table_worst_px = 0.0;
    for (int k = 0; k < 60000; ++k) {
        FrustumBox b;
        if (!random_box(rng, false, b) || !inside_image(b.box) || b.view.horizontal % 2 == 0) {
            continue;  // one face: either end of it is the nearer one, and the table names one of them
        }
        EdgeVertices exact;
        ASSERT_EQ(extreme_vertices(kFrustumCamera, b.T_c_o(), b.size_m, exact), Status::kOk);
        const EdgeVertices& table = edge_vertices(b.view);
        const bool top = !same_corner(table[kTop], exact[kTop]);
        const bool bottom = !same_corner(table[kBottom], exact[kBottom]);
        wrong_top += top ? 1 : 0;
        wrong_bottom += bottom ? 1 : 0;
        const bool off = std::fabs(b.p_c(0)) > 0.2 * b.p_c(2);
        (off ? off_axis : on_axis) += 1;
        (off ? wrong_off_axis : wrong_on_axis) += top || bottom ? 1 : 0;
        for (const int edge : {int{kTop}, int{kBottom}}) {
            const Vec2 q = project(kFrustumCamera, b.T_c_o() * exact[static_cast<std::size_t>(edge)].scaled(b.size_m));
            const double here = std::fabs(q(1) - extreme(b, edge));
            const double there = std::fabs(table_value(b, edge) - extreme(b, edge));
            exact_worst_px = here > exact_worst_px ? here : exact_worst_px;
            table_worst_px = there > table_worst_px ? there : table_worst_px;
        }
    }
    const int all = off_axis + on_axis;
    std::printf(
        "%d boxes with two sides seen: top vertex is another in %.1f %%, bottom in %.1f %%; either off axis %.1f %%, "
        "near it %.1f %%; table's edge off by %.1f px at most\n",
        all, 100.0 * wrong_top / all, 100.0 * wrong_bottom / all, 100.0 * wrong_off_axis / off_axis,
        100.0 * wrong_on_axis / on_axis, table_worst_px);
    EXPECT_GT(all, 30000);
    EXPECT_EQ(exact_worst_px, 0.0);
    EXPECT_GT(table_worst_px, 2.0);
    EXPECT_GT(wrong_bottom, 0.15 * all);
    EXPECT_LT(wrong_bottom, 0.30 * all);
    EXPECT_LT(wrong_top, 0.30 * all);
    EXPECT_GT(wrong_off_axis * on_axis, 2 * wrong_on_axis * off_axis);
}

}  // namespace
}  // namespace semtrack

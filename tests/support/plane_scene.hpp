// A textured wall and, before it, a textured board, both facing the camera: every match is known exactly.
#ifndef SEMTRACK_TESTS_SUPPORT_PLANE_SCENE_HPP
#define SEMTRACK_TESTS_SUPPORT_PLANE_SCENE_HPP

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "front/match/matcher.hpp"

namespace semtrack {

/// Smooth noise, 0..255, defined everywhere: bilinear lattices of 5 and 13 px.
inline double wall_texture(double x, double y, std::uint32_t seed) {
    const auto lattice = [seed](int i, int j) {
        std::uint32_t h = seed + static_cast<std::uint32_t>(i) * 73856093U + static_cast<std::uint32_t>(j) * 19349663U;
        h = (h ^ (h >> 13U)) * 1274126177U;
        return static_cast<double>((h ^ (h >> 16U)) & 0xFFU);
    };
    const auto noise = [&lattice](double u, double v) {
        const int i = static_cast<int>(std::floor(u));
        const int j = static_cast<int>(std::floor(v));
        const double a = u - i;
        const double b = v - j;
        return (1 - a) * (1 - b) * lattice(i, j) + a * (1 - b) * lattice(i + 1, j) + (1 - a) * b * lattice(i, j + 1) +
               a * b * lattice(i + 1, j + 1);
    };
    return 0.65 * noise(x / 5.0, y / 5.0) + 0.35 * noise(x / 13.0 + 100.0, y / 13.0);
}

struct PlaneScene {
    static constexpr int kWidth = 640;
    static constexpr int kHeight = 240;
    static constexpr double kFocal_px = 700.0;
    static constexpr double kBaseline_m = 0.5;

    double wall_depth_m{20.0};
    bool board{false};  ///< object of slot 0, owner 1, in the columns and rows below (left image, first frame)
    double board_depth_m{10.0};
    int left{220}, right{420}, top{60}, bottom{180};
    double row_offset_px{0.0};  ///< of the right image
    double gain{1.0};           ///< of the left image

    [[nodiscard]] double wall_disparity() const { return kFocal_px * kBaseline_m / wall_depth_m; }
    [[nodiscard]] double board_disparity() const { return kFocal_px * kBaseline_m / board_depth_m; }

    [[nodiscard]] Calibration calibration() const {
        Calibration c;
        c.width = kWidth;
        c.height = kHeight;
        c.left = {kFocal_px, kFocal_px, 320.0, 120.0};
        c.right = c.left;
        c.detection = c.left;
        c.baseline_m = kBaseline_m;
        return c;
    }
};

/// One frame of it: the wall's and the board's image moved by so many px since the first frame.
class PlaneFrame {
public:
    PlaneFrame(const PlaneScene& scene, double wall_u, double wall_v, double board_u)
        : left_(make(scene, wall_u, wall_v, board_u, false)), right_(make(scene, wall_u, wall_v, board_u, true)) {
        mask_left_->width = mask_right_->width = PlaneScene::kWidth;
        mask_left_->height = mask_right_->height = PlaneScene::kHeight;
        for (int v = 0; v < PlaneScene::kHeight; ++v) {
            for (int u = 0; u < PlaneScene::kWidth; ++u) {
                mask_left_->row(v)[u] = on_board(scene, u - board_u, v) ? 1 : 0;
                mask_right_->row(v)[u] = on_board(scene, u - board_u + scene.board_disparity(), v) ? 1 : 0;
            }
        }
    }
    [[nodiscard]] MatcherInput input(const Calibration& calibration, const OwnerPriors& priors, int frame) const {
        MatcherInput in;
        in.left = view(left_);
        in.right = view(right_);
        in.mask_left = mask_left_.get();
        in.mask_right = mask_right_.get();
        in.priors = &priors;
        in.calibration = &calibration;
        in.frame = static_cast<std::uint32_t>(frame);
        return in;
    }

private:
    using Pixels = std::vector<std::uint8_t>;

    static ImageView view(const Pixels& p) {
        return {p.data(), PlaneScene::kWidth, PlaneScene::kHeight, PlaneScene::kWidth};
    }
    static bool on_board(const PlaneScene& s, double u, double v) {
        return s.board && u >= s.left && u < s.right && v >= s.top && v < s.bottom;
    }
    static Pixels make(const PlaneScene& s, double wall_u, double wall_v, double board_u, bool right) {
        Pixels out;
        for (int v = 0; v < PlaneScene::kHeight; ++v) {
            for (int u = 0; u < PlaneScene::kWidth; ++u) {
                const double row = right ? v - s.row_offset_px : v;
                const double on_wall = u - wall_u + (right ? s.wall_disparity() : 0.0);
                const double near = u - board_u + (right ? s.board_disparity() : 0.0);
                const double grey =
                    on_board(s, near, row) ? wall_texture(near, row, 77) : wall_texture(on_wall, row - wall_v, 5);
                const double seen = 20.0 + 0.8 * grey * (right ? 1.0 : s.gain);
                out.push_back(static_cast<std::uint8_t>(seen > 255.0 ? 255.0 : seen));
            }
        }
        return out;
    }

    Pixels left_;
    Pixels right_;
    std::unique_ptr<OwnerMask> mask_left_ = std::make_unique<OwnerMask>();
    std::unique_ptr<OwnerMask> mask_right_ = std::make_unique<OwnerMask>();
};

/// Priors without any knowledge of motion: wall (and board) anywhere between 3 and 300 m.
inline OwnerPriors still_priors(bool board, int budget = 300) {
    OwnerPriors priors{};
    priors[0].active = true;
    priors[0].budget = static_cast<std::int16_t>(budget);
    priors[0].min_depth_m = 3.0;
    priors[0].max_depth_m = 300.0;
    if (board) {
        priors[1] = priors[0];
        priors[1].budget = 60;
    }
    return priors;
}

/// The owner moved sideways so that its image moved by u px.
inline Pose sideways(double u_px, double depth_m) {
    Pose T;
    T.t = Vec3(u_px * depth_m / PlaneScene::kFocal_px, 0.0, 0.0);
    return T;
}

}  // namespace semtrack

#endif

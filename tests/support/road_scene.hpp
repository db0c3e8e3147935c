// A textured road below a camera that drives along it: every match is known exactly.
#ifndef SEMTRACK_TESTS_SUPPORT_ROAD_SCENE_HPP
#define SEMTRACK_TESTS_SUPPORT_ROAD_SCENE_HPP

#include <cstdint>
#include <memory>
#include <vector>

#include "math/camera.hpp"
#include "support/plane_scene.hpp"

namespace semtrack {

struct RoadScene {
    static constexpr double kHeight_m = 1.6;

    [[nodiscard]] static Calibration calibration() { return PlaneScene{}.calibration(); }
    [[nodiscard]] static double depth(double v) {
        return PlaneScene::kFocal_px * kHeight_m / (v - calibration().left.cy);
    }
    [[nodiscard]] static double disparity_px(double v) {
        return PlaneScene::kFocal_px * PlaneScene::kBaseline_m / depth(v);
    }
    /// Grey at a pixel of a camera `side_m` to the right that has driven `forward_m`; above the horizon all is grey.
    [[nodiscard]] static double grey(double u, double v, double side_m, double forward_m) {
        const Calibration c = calibration();
        if (v < c.left.cy + 8.0) {
            return 128.0;
        }
        const double z = depth(v);
        const double x = (u - c.left.cx) / PlaneScene::kFocal_px * z + side_m;
        return 30.0 + 0.75 * wall_texture(x / 0.03, (z + forward_m) / 0.15, 9);
    }
};

/// The pair seen after driving forward_m.
class RoadFrame {
public:
    explicit RoadFrame(double forward_m) {
        for (int v = 0; v < PlaneScene::kHeight; ++v) {
            for (int u = 0; u < PlaneScene::kWidth; ++u) {
                left_.push_back(static_cast<std::uint8_t>(RoadScene::grey(u, v, 0.0, forward_m) + 0.5));
                right_.push_back(
                    static_cast<std::uint8_t>(RoadScene::grey(u, v, PlaneScene::kBaseline_m, forward_m) + 0.5));
            }
        }
        mask_->width = PlaneScene::kWidth;
        mask_->height = PlaneScene::kHeight;
    }
    [[nodiscard]] MatcherInput input(const Calibration& calibration, const OwnerPriors& priors, int frame,
                                     double camera_height_m) const {
        MatcherInput in;
        in.left = {left_.data(), PlaneScene::kWidth, PlaneScene::kHeight, PlaneScene::kWidth};
        in.right = {right_.data(), PlaneScene::kWidth, PlaneScene::kHeight, PlaneScene::kWidth};
        in.mask_left = in.mask_right = mask_.get();
        in.priors = &priors;
        in.calibration = &calibration;
        in.camera_height_m = camera_height_m;
        in.frame = static_cast<std::uint32_t>(frame);
        return in;
    }

private:
    std::vector<std::uint8_t> left_;
    std::vector<std::uint8_t> right_;
    std::unique_ptr<OwnerMask> mask_ = std::make_unique<OwnerMask>();
};

}  // namespace semtrack

#endif

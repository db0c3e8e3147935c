// FAST-9 corners of whole pyramids: the corners, scores and order of FastDetector, computed for 16 neighbouring pixels
// at a time. Bytes, minima and maxima only, so that compilers make one vector instruction of each step on any target.
#ifndef SEMTRACK_FRONT_FEATURE_ORB_CORNERS_HPP
#define SEMTRACK_FRONT_FEATURE_ORB_CORNERS_HPP

#include <array>
#include <cstdint>

#include "front/feature/fast.hpp"
#include "semtrack/capacity.hpp"
#include "semtrack/image_view.hpp"

namespace semtrack {

class OrbCorners {
public:
    /// As FastDetector::detect, with kMargin_px of margin. The image is not larger than the capacity and larger than
    /// 2 kMargin_px each way; threshold 1..254. Cost O(pixels); an image full of corners costs about twice a usual one.
    void detect(const ImageView& image, int threshold, CornerGrid& out);

    static constexpr int kMargin_px = 16;

private:
    /// Where blocks of 16 pixels begin. Adding has no branch.
    struct Blocks {
        std::uint16_t x[kMaxImageWidth / 16];  // not initialised: only the first `count` are read
        int count{0};
        void add_if(bool wanted, int column) {
            x[count] = static_cast<std::uint16_t>(column);
            count += wanted ? 1 : 0;
        }
    };
    struct ScoredRow {
        std::array<std::uint8_t, static_cast<std::size_t>(kMaxImageWidth)> score{};  // 0: no corner
        Blocks blocks{};                                                             // that hold scores
    };
    static void score_row(const ImageView& image, int y, int threshold, ScoredRow& out);
    static void keep_largest(const ScoredRow& above, const ScoredRow& here, const ScoredRow& below, int y,
                             CornerGrid& out);

    std::array<ScoredRow, 3> rows_{};
};

}  // namespace semtrack

#endif

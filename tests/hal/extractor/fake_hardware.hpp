// An extractor as a hardware block would be one: a block that reads the image as it streams by and leaves a list of
// packed words in shared memory, in fixed point and in its own order, and a driver that makes keypoints of the list.
// What a driver for a real block has to do is all here: check, unpack, look up owners, keep the budget, sort.
#ifndef SEMTRACK_TESTS_HAL_EXTRACTOR_FAKE_HARDWARE_HPP
#define SEMTRACK_TESTS_HAL_EXTRACTOR_FAKE_HARDWARE_HPP

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "semtrack/hal/feature_extractor.hpp"

namespace semtrack {

/// One entry of the block's list.
struct HardwareRecord {
    std::uint32_t place{0};     ///< u and v in 1/16 px, 16 bits each
    std::uint32_t strength{0};  ///< 12 bits are used
    Descriptor descriptor{};
};

/// The "silicon": corners of one level by a second difference over 5 x 5 px, the largest of 7 x 7 px, in raster order.
class FakeBlock {
public:
    static constexpr std::size_t kMostRecords = 32768;  // its memory: what comes after is lost
    const std::vector<HardwareRecord>& run(const ImageView& image) {
        records_.clear();
        for (int y = kMargin_px; y < image.height - kMargin_px; ++y) {
            for (int x = kMargin_px; x < image.width - kMargin_px; ++x) {
                const int strength = strength_at(image, x, y);
                if (strength < kLeast || !is_largest(image, x, y, strength) || records_.size() == kMostRecords) {
                    continue;
                }
                HardwareRecord r;
                r.place = static_cast<std::uint32_t>(16 * x) | (static_cast<std::uint32_t>(16 * y) << 16U);
                r.strength = static_cast<std::uint32_t>(strength);
                r.descriptor = describe(image, x, y);
                records_.push_back(r);
            }
        }
        return records_;
    }

private:
    static constexpr int kMargin_px = 16;
    static constexpr int kLeast = 40;

    /// Of the differences along the row and along the column the smaller one: an edge has only one of them.
    static int strength_at(const ImageView& image, int x, int y) {
        const std::uint8_t* row = image.row(y) + x;
        const int across = 2 * row[0] - row[-2] - row[2];
        const int along = 2 * row[0] - image.row(y - 2)[x] - image.row(y + 2)[x];
        const bool corner = (across > 0) == (along > 0);
        return corner ? std::min(std::abs(across), std::abs(along)) : 0;
    }
    static bool is_largest(const ImageView& image, int x, int y, int strength) {
        for (int dy = -3; dy <= 3; ++dy) {
            for (int dx = -3; dx <= 3; ++dx) {
                const bool earlier = dy < 0 || (dy == 0 && dx < 0);
                const int other = strength_at(image, x + dx, y + dy);
                if (other > strength || (earlier && other == strength)) {
                    return false;
                }
            }
        }
        return true;
    }
    static Descriptor describe(const ImageView& image, int x, int y) {
        Descriptor d{};
        for (int bit = 0; bit < 256; ++bit) {
            const int a = image.row(y + bit * 7 % 29 - 14)[x + bit * 11 % 29 - 14];
            const int b = image.row(y + bit * 5 % 27 - 13)[x + bit * 13 % 29 - 14];
            d[static_cast<std::size_t>(bit / 32)] |= (a < b ? 1U : 0U) << static_cast<unsigned>(bit % 32);
        }
        return d;
    }

    std::vector<HardwareRecord> records_;
};

/// The driver.
class FakeHardwareExtractor final : public FeatureExtractor {
public:
    Status extract(const ImageView& image, const OwnerMaskView& mask, const FeatureBudget& budget,
                   Keypoints& out) noexcept override {
        out.clear();
        if (image.empty() || mask.data == nullptr || mask.width != image.width || mask.height != image.height) {
            return Status::kInvalidArgument;
        }
        std::vector<HardwareRecord> list = block_.run(image);
        std::stable_sort(list.begin(), list.end(),
                         [](const HardwareRecord& a, const HardwareRecord& b) { return a.strength > b.strength; });
        FeatureBudget left = budget;
        for (std::size_t o = 0; o < left.size(); ++o) {
            left[o] = std::min<std::int16_t>(left[o], o == 0 ? kMaxBackgroundFeatures : kMaxObjectFeatures);
        }
        std::vector<Keypoint> chosen;
        for (const HardwareRecord& r : list) {
            const Keypoint k = unpacked(r, mask);
            if (k.owner < kMaxOwners && left[k.owner] > 0) {
                --left[k.owner];
                chosen.push_back(k);
            }
        }
        std::sort(chosen.begin(), chosen.end(), [](const Keypoint& a, const Keypoint& b) {
            return std::tie(a.owner, a.v, a.u) < std::tie(b.owner, b.v, b.u);
        });
        for (const Keypoint& k : chosen) {
            if (!out.try_push_back(k)) {
                break;
            }
        }
        return Status::kOk;
    }

private:
    static Keypoint unpacked(const HardwareRecord& r, const OwnerMaskView& mask) {
        Keypoint k;
        k.u = static_cast<float>(r.place & 0xFFFFU) / 16.0F;
        k.v = static_cast<float>(r.place >> 16U) / 16.0F;
        k.owner = mask.at(static_cast<int>(r.place & 0xFFFFU) / 16, static_cast<int>(r.place >> 16U) / 16);
        k.score = static_cast<std::int32_t>(r.strength);
        k.descriptor = r.descriptor;
        return k;
    }

    FakeBlock block_;
};

}  // namespace semtrack

#endif

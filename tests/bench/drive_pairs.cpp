#include <cmath>

#include "math/camera.hpp"
#include "math/pose.hpp"
#include "sil/kitti/kitti_sequence.hpp"
#include "tests/bench/pair_truth.hpp"

namespace semtrack::bench {

namespace {

constexpr int kHalf_px = 5;  // of the patch
constexpr int kMostDisparity_px = 160;
constexpr int kReach_px = 8;  // around the predicted place: the poses are GPS's
constexpr double kLeastCorrelation = 0.85;
constexpr double kLeastLead = 0.03;  // over the best place elsewhere
constexpr double kElsewhere_px = 3.0;
constexpr double kWayBack_px = 1.0;

struct Box {
    int u0{0};
    int u1{0};
    int v0{0};
    int v1{0};
};

bool fits(const ImageView& image, int x, int y) {
    return x >= kHalf_px && y >= kHalf_px && x < image.width - kHalf_px && y < image.height - kHalf_px;
}

/// Of the two patches, -1..1; -1 too where one has no contrast.
double correlation(const ImageView& a, int ax, int ay, const ImageView& b, int bx, int by) {
    std::int64_t sa = 0;
    std::int64_t sb = 0;
    std::int64_t saa = 0;
    std::int64_t sbb = 0;
    std::int64_t sab = 0;
    for (int dy = -kHalf_px; dy <= kHalf_px; ++dy) {
        const std::uint8_t* pa = a.row(ay + dy) + ax;
        const std::uint8_t* pb = b.row(by + dy) + bx;
        for (int dx = -kHalf_px; dx <= kHalf_px; ++dx) {
            sa += pa[dx];
            sb += pb[dx];
            saa += pa[dx] * pa[dx];
            sbb += pb[dx] * pb[dx];
            sab += pa[dx] * pb[dx];
        }
    }
    constexpr std::int64_t kN = (2 * kHalf_px + 1) * (2 * kHalf_px + 1);
    const auto va = static_cast<double>(kN * saa - sa * sa);
    const auto vb = static_cast<double>(kN * sbb - sb * sb);
    return va > 0.0 && vb > 0.0 ? static_cast<double>(kN * sab - sa * sb) / std::sqrt(va * vb) : -1.0;
}

struct Peak {
    int x{0};
    int y{0};
    double value{-1};
    double rival{-1};
};

Peak search(const ImageView& from, int x, int y, const ImageView& to, const Box& box) {
    Peak best;
    for (int pass = 0; pass < 2; ++pass) {
        for (int v = box.v0; v <= box.v1; ++v) {
            for (int u = box.u0; u <= box.u1; ++u) {
                if (!fits(to, u, v)) {
                    continue;
                }
                const double value = correlation(from, x, y, to, u, v);
                if (pass == 0 && value > best.value) {
                    best.x = u;
                    best.y = v;
                    best.value = value;
                }
                if (pass == 1 && std::hypot(u - best.x, v - best.y) > kElsewhere_px && value > best.rival) {
                    best.rival = value;
                }
            }
        }
    }
    return best;
}

bool sure(const Peak& p) {
    return p.value >= kLeastCorrelation && p.value - p.rival >= kLeastLead;
}

class AlignedTruth final : public PairTruth {
public:
    AlignedTruth(const FramePair& pair, const Pose& T_next_now)
        : left_(pair.left.view()),
          right_(pair.right.view()),
          next_(pair.next_left.view()),
          c_(pair.calibration),
          T_next_now_(T_next_now) {}

    [[nodiscard]] std::optional<Point> in_right(double u, double v) const override {
        const int x = static_cast<int>(std::lround(u));
        const int y = static_cast<int>(std::lround(v));
        if (!fits(left_, x, y)) {
            return std::nullopt;
        }
        const int shift = static_cast<int>(std::lround(right_row(c_, v, 0.0) - v));
        const int offset = static_cast<int>(std::lround(c_.left.cx - c_.right.cx));
        const Peak p =
            search(left_, x, y, right_, {x - offset - kMostDisparity_px, x - offset + 1, y + shift - 1, y + shift + 1});
        if (!sure(p)) {
            return std::nullopt;
        }
        const Peak back = search(right_, p.x, p.y, left_, {p.x + offset - 1, p.x + offset + kMostDisparity_px, y, y});
        return std::abs(back.x - x) <= kWayBack_px ? std::optional<Point>(moved(u - x, v - y, p)) : std::nullopt;
    }
    [[nodiscard]] std::optional<Point> in_next(double u, double v) const override {
        const std::optional<Point> right = in_right(u, v);
        const double d = right ? disparity(c_, u, right->u) : 0.0;
        if (d < 0.5) {
            return std::nullopt;
        }
        const Vec3 now = bearing(c_.left, u, v) * depth_from_disparity(c_, d);
        const Vec3 then = T_next_now_ * now;
        if (then(2) < 1.0) {
            return std::nullopt;
        }
        const Vec2 place = project(c_.left, then);
        const int x = static_cast<int>(std::lround(u));
        const int y = static_cast<int>(std::lround(v));
        const Peak p = search(left_, x, y, next_, around(place(0), place(1)));
        if (!sure(p)) {
            return std::nullopt;
        }
        const Peak back = search(next_, p.x, p.y, left_, around(u, v));
        const bool same = std::abs(back.x - x) <= kWayBack_px && std::abs(back.y - y) <= kWayBack_px;
        return same ? std::optional<Point>(moved(u - x, v - y, p)) : std::nullopt;
    }
    [[nodiscard]] bool same_in_right(double u, double v, const Point& right, double tolerance_px) const override {
        const std::optional<Point> truth = in_right(u, v);
        return truth && std::fabs(truth->u - right.u) <= tolerance_px;
    }

private:
    [[nodiscard]] static Box around(double u, double v) {
        const int x = static_cast<int>(std::lround(u));
        const int y = static_cast<int>(std::lround(v));
        return {x - kReach_px, x + kReach_px, y - kReach_px, y + kReach_px};
    }
    [[nodiscard]] static Point moved(double du, double dv, const Peak& p) { return {p.x + du, p.y + dv}; }

    ImageView left_;
    ImageView right_;
    ImageView next_;
    Calibration c_;
    Pose T_next_now_;
};

}  // namespace

std::vector<FramePair> drive_pairs(const std::filesystem::path& kitti, const std::vector<int>& frames) {
    sil::SequenceOptions options;
    options.layout = "raw";
    options.root = kitti / "raw";
    options.sequence = "2011_09_26_drive_0039";
    const auto drive = sil::open_kitti_sequence(options);
    std::vector<FramePair> out;
    for (const int frame : frames) {
        FramePair pair;
        sil::GreyImage unused;
        drive->load(frame, pair.left, pair.right);
        drive->load(frame + 1, pair.next_left, unused);
        pair.calibration = drive->cameras().calibration;
        const Pose now = to_pose(drive->ego_truth().at(frame));
        const Pose next = to_pose(drive->ego_truth().at(frame + 1));
        pair.truth = std::make_unique<AlignedTruth>(pair, next.inverse() * now);
        out.push_back(std::move(pair));
    }
    return out;
}

}  // namespace semtrack::bench

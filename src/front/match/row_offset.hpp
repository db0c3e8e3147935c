// Slowly measured row offset of the right camera beyond the calibration's: dv = a + b (v - cy). Real pairs are off by
// 0.1-0.7 px; a camera that moved shows here first.
#ifndef SEMTRACK_FRONT_MATCH_ROW_OFFSET_HPP
#define SEMTRACK_FRONT_MATCH_ROW_OFFSET_HPP

namespace semtrack {

class RowOffsetFilter {
public:
    void reset() { *this = RowOffsetFilter{}; }
    [[nodiscard]] double at(double v_centred) const { return a_ + b_ * v_centred; }
    [[nodiscard]] double constant() const { return a_; }
    /// One match: rows between its right position and the predicted one. Far off the present estimate: ignored.
    void add(double v_centred, double residual_px) {
        constexpr double kGate_px = 1.0;
        if (!(residual_px < kGate_px) || !(residual_px > -kGate_px)) {
            return;
        }
        const double x = v_centred / kScale_px;
        n_ += 1.0;
        x_ += x;
        xx_ += x * x;
        y_ += residual_px;
        xy_ += x * residual_px;
    }
    /// End of a frame: a step towards the line through the frame's matches.
    void update() {
        constexpr double kGain = 0.1;
        constexpr double kRidge = 20.0;  // matches; a few do not turn the line
        constexpr double kLargest_px = 2.0;
        const double n = n_ + kRidge;
        const double xx = xx_ + kRidge;
        const double determinant = n * xx - x_ * x_;
        if (n_ > 0.0 && determinant > 0.0) {
            a_ += kGain * (xx * y_ - x_ * xy_) / determinant;
            b_ += kGain * (n * xy_ - x_ * y_) / determinant / kScale_px;
            a_ = a_ > kLargest_px ? kLargest_px : a_ < -kLargest_px ? -kLargest_px : a_;
        }
        n_ = x_ = xx_ = y_ = xy_ = 0.0;
    }

private:
    static constexpr double kScale_px = 100.0;
    double a_{0};
    double b_{0};
    double n_{0};
    double x_{0};
    double xx_{0};
    double y_{0};
    double xy_{0};
};

}  // namespace semtrack

#endif

// Rows for the tests of object metrics.
#ifndef SEMTRACK_TESTS_SIL_METRICS_ROWS_HPP
#define SEMTRACK_TESTS_SIL_METRICS_ROWS_HPP

#include "sil/metrics/object_rows.hpp"

namespace semtrack::sil::test {

/// A car whose 2D box, 50 x 50 px, starts at `left`.
inline ObjectRow car(int frame, int id, double left, const Vec3& bottom, double rotation_y = 0.0) {
    ObjectRow o;
    o.frame = frame;
    o.id = id;
    o.type = "Car";
    o.box = {left, 100.0, left + 50.0, 150.0};
    o.size_m = Vec3(4.0, 2.0, 1.5);
    o.bottom_c0 = bottom;
    o.rotation_y = rotation_y;
    o.score = 0.5;
    return o;
}

inline ObjectTruthSet truth_of(std::vector<ObjectRow> labels, std::vector<int> frames) {
    ObjectTruthSet t;
    t.labels = std::move(labels);
    t.frames = std::move(frames);
    return t;
}

}  // namespace semtrack::sil::test

#endif

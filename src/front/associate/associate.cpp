#include "front/associate/associate.hpp"

#include <cmath>

#include "math/camera.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

namespace {

constexpr double kCentreWeight = 0.6;
constexpr double kShapeWeight = 0.4;
constexpr double kOtherClass = 0.85;  // car and van look alike: a step of class costs, but does not forbid
constexpr double kForbidden = 1e6;
constexpr double kBlindShare = 0.2;  // of a pair's worth that does not depend on the agreement of the edges

double class_factor(ObjectClass a, ObjectClass b) {
    return a == b ? 1.0 : may_be_one(a, b) ? kOtherClass : 0.0;
}

double ratio(double a, double b) {
    return a < b ? a / b : b / a;
}

}  // namespace

bool may_be_one(ObjectClass a, ObjectClass b) {
    const auto is_person = [](ObjectClass c) { return c == ObjectClass::kPedestrian || c == ObjectClass::kCyclist; };
    return is_person(a) == is_person(b);
}

double box_similarity(const TrackBox& track, const Detection& detection) {
    const Box2d& a = track.box;
    const Box2d& b = detection.box;
    const double wa = a.right - a.left;
    const double ha = a.bottom - a.top;
    const double wb = b.right - b.left;
    const double hb = b.bottom - b.top;
    if (!(wa > 0.0) || !(ha > 0.0) || !(wb > 0.0) || !(hb > 0.0)) {
        return 0.0;
    }
    // Distance of the centres in units of the mean half extents: 0 equal, 1 half overlapping, 2 touching.
    // A person's width changes with every step: half the height is the least that counts as its width.
    const double across = wa + wb > 0.5 * (ha + hb) ? wa + wb : 0.5 * (ha + hb);
    const double du = (a.left + a.right - b.left - b.right) / across;
    const double dv = (a.top + a.bottom - b.top - b.bottom) / (ha + hb);
    const double distance = std::sqrt(du * du + dv * dv);
    const double centre = distance < 1.0 ? 1.0 - distance : 0.0;
    if (!(centre > 0.0)) {
        return 0.0;
    }
    const double shape = ratio(wa, wb) * ratio(ha, hb);
    return class_factor(track.object_class, detection.object_class) * (kCentreWeight * centre + kShapeWeight * shape);
}

double edge_agreement(const TrackBox& track, const Detection& detection) {
    const Box2d& a = track.box;
    const Box2d& b = detection.box;
    const std::array<double, 4> off{b.left - a.left, b.right - a.right, b.top - a.top, b.bottom - a.bottom};
    double sum = 0.0;
    int edges = 0;
    for (std::size_t e = 0; e < off.size(); ++e) {
        if (track.sigma_px[e] > 0.0) {
            const double r = off[e] / track.sigma_px[e];
            sum += r * r;
            ++edges;
        }
    }
    return edges == 0 ? 1.0 : 1.0 / (1.0 + sum / (kEdgeTolerance * static_cast<double>(edges)));
}

double pair_worth(const TrackBox& track, const Detection& detection) {
    const double above = box_similarity(track, detection) - kLostSimilarity;
    if (!(above > 0.0)) {
        return 0.0;
    }
    return above * (kBlindShare + (1.0 - kBlindShare) * edge_agreement(track, detection));
}

Box2d rotated_box(const Box2d& box, const Mat3& R_cur_prev, const PinholeCamera& camera) {
    const double u = 0.5 * (box.left + box.right);
    const double v = 0.5 * (box.top + box.bottom);
    const Vec3 ray = R_cur_prev * bearing(camera, u, v);
    if (!(ray(2) > kMinDepth_m)) {
        return box;
    }
    const Vec2 moved = project(camera, ray);
    const double du = moved(0) - u;
    const double dv = moved(1) - v;
    return {box.left + du, box.top + dv, box.right + du, box.bottom + dv};
}

// Hungarian method with potentials (shortest augmenting paths), rows and columns from 1; column 0 is the start.
void Associator::augment(int row, int columns) {
    for (int j = 0; j <= columns; ++j) {
        slack_[static_cast<std::size_t>(j)] = 2.0 * kForbidden;
        visited_[static_cast<std::size_t>(j)] = false;
    }
    row_of_column_[0] = row;
    int column = 0;
    for (int step = 0; step <= columns; ++step) {
        visited_[static_cast<std::size_t>(column)] = true;
        const int r = row_of_column_[static_cast<std::size_t>(column)];
        double delta = 4.0 * kForbidden;
        int next = 0;
        for (int j = 1; j <= columns; ++j) {
            const auto i = static_cast<std::size_t>(j);
            if (visited_[i]) {
                continue;
            }
            const double reduced = cost(r, j) - row_potential_[static_cast<std::size_t>(r)] - column_potential_[i];
            if (reduced < slack_[i]) {
                slack_[i] = reduced;
                previous_[i] = column;
            }
            if (slack_[i] < delta) {
                delta = slack_[i];
                next = j;
            }
        }
        for (int j = 0; j <= columns; ++j) {
            const auto i = static_cast<std::size_t>(j);
            if (visited_[i]) {
                row_potential_[static_cast<std::size_t>(row_of_column_[i])] += delta;
                column_potential_[i] -= delta;
            } else {
                slack_[i] -= delta;
            }
        }
        column = next;
        if (row_of_column_[static_cast<std::size_t>(column)] == 0) {
            break;
        }
    }
    for (int step = 0; step <= columns && column != 0; ++step) {
        const int before = previous_[static_cast<std::size_t>(column)];
        row_of_column_[static_cast<std::size_t>(column)] = row_of_column_[static_cast<std::size_t>(before)];
        column = before;
    }
}

void Associator::run(const TrackBoxes& tracks, const DetectionList& list, Assignment& out) {
    const int rows = tracks.size();
    const int detections = list.items.size();
    const int columns = detections + rows;
    for (int& d : out.detection_of_track) {
        d = -1;
    }
    for (bool& used : out.detection_used) {
        used = false;
    }
    for (int j = 0; j <= columns; ++j) {
        row_of_column_[static_cast<std::size_t>(j)] = 0;
        column_potential_[static_cast<std::size_t>(j)] = 0.0;
    }
    for (int r = 1; r <= rows; ++r) {
        row_potential_[static_cast<std::size_t>(r)] = 0.0;
        for (int j = 1; j <= detections; ++j) {
            const double worth = pair_worth(tracks[r - 1], list.items[j - 1]);
            cost(r, j) = worth > 0.0 ? 1.0 - worth : kForbidden;
        }
        for (int j = 1; j <= rows; ++j) {
            cost(r, detections + j) = j == r ? 1.0 : kForbidden;
        }
    }
    row_potential_[0] = 0.0;
    for (int r = 1; r <= rows; ++r) {
        augment(r, columns);
    }
    for (int j = 1; j <= detections; ++j) {
        const int r = row_of_column_[static_cast<std::size_t>(j)];
        if (r == 0 || cost(r, j) >= kForbidden) {
            continue;
        }
        out.detection_of_track[static_cast<std::size_t>(r - 1)] = j - 1;
        out.detection_used[static_cast<std::size_t>(j - 1)] = true;
    }
}

}  // namespace semtrack

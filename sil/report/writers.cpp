#include "sil/report/writers.hpp"

#include <algorithm>
#include <vector>

#include "sil/report/list_table.hpp"

namespace semtrack::sil {

namespace {

std::vector<const TrackedObject*> sorted_by_id(const Output& output) {
    std::vector<const TrackedObject*> out;
    for (const TrackedObject& o : output.objects) {
        out.push_back(&o);
    }
    std::sort(out.begin(), out.end(), [](const TrackedObject* a, const TrackedObject* b) { return a->id < b->id; });
    return out;
}

}  // namespace

ResultWriters::ResultWriters(const std::filesystem::path& dir, const DriveCameras& cameras, CanDialect dialect,
                             bool points)
    : T_v_c_(to_pose(cameras.calibration.T_v_c)),
      T_c_v_(T_v_c_.inverse()),
      t_c0_c_(cameras.t_c0_c),
      dialect_(dialect),
      ego_(dir / "ego.txt"),
      frames_(dir / "frames.txt"),
      ego_csv_(dir / "ego.csv"),
      objects_(dir / "objects.txt"),
      states_(dir / "states.csv"),
      list_(dir / "list.csv"),
      timing_(dir / "timing.csv"),
      can_log_(dir / "can.log") {
    ego_csv_.write(ego_header());
    states_.write(states_header());
    list_.write(list_header());
    timing_.write(timing_header());
    if (points) {
        points_.emplace(dir / "points.csv");
        points_->write(points_header());
    }
}

void ResultWriters::add(int frame, const Output& output, std::uint8_t list_counter, const FrameTiming& timing) {
    add_ego(frame, output);
    add_objects(frame, output);
    list_.write(list_rows(frame, output, dialect_, list_counter));
    if (points_) {
        add_points(frame, output);
    }
    timing_.write(timing_row(frame, timing, output.objects.size(), output.points.size()));
}

void ResultWriters::add_ego(int frame, const Output& output) {
    const Pose T_w_c = to_pose(output.ego.T_w_v) * T_v_c_;
    if (!started_) {
        T_first_w_ = T_w_c.inverse();
        started_ = true;
    }
    ego_.write(pose_row(T_first_w_ * T_w_c));
    frames_.write(std::to_string(frame) + "\n");
    ego_csv_.write(ego_row(frame, output.ego, output.health));
}

void ResultWriters::add_objects(int frame, const Output& output) {
    for (const TrackedObject* o : sorted_by_id(output)) {
        states_.write(states_row(frame, output.ego.time_us, *o));
        if (belongs_in_objects(*o)) {
            objects_.write(objects_row(frame, *o, kitti_place(*o, T_c_v_, t_c0_c_)));
        }
    }
}

void ResultWriters::add_points(int frame, const Output& output) {
    std::array<std::uint32_t, kMaxOwners> id_of_owner{};
    for (const TrackedObject& o : output.objects) {
        id_of_owner[static_cast<std::size_t>(o.slot) + 1U] = o.id;
    }
    for (const SparsePoint& p : output.points) {
        if (!p.has_position || p.owner >= kMaxOwners) {
            continue;
        }
        const std::uint32_t id = id_of_owner[p.owner];
        if (p.owner == 0 || id != 0U) {
            points_->write(points_row(frame, id, p));
        }
    }
}

void ResultWriters::close() {
    for (TextOutput* file : {&ego_, &frames_, &ego_csv_, &objects_, &states_, &list_, &timing_, &can_log_}) {
        file->close();
    }
    if (points_) {
        points_->close();
    }
}

}  // namespace semtrack::sil

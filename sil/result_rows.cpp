#include "sil/result_rows.hpp"

#include <set>
#include <string>

#include "sil/kitti/drive_files.hpp"

namespace semtrack::sil {

namespace fs = std::filesystem;

namespace {

/// A csv file of ours, its fields by the names in its first row.
class Table {
public:
    explicit Table(const fs::path& path) : file_(path, false, ',') {
        if (file_.rows().empty()) {
            file_.refuse_end("has no header");
        }
        for (std::size_t i = 0; i < file_.rows().front().words.size(); ++i) {
            columns_[std::string(file_.rows().front().words[i])] = i;
        }
    }
    [[nodiscard]] std::vector<TextRow> rows() const {
        std::vector<TextRow> out(file_.rows().begin() + 1, file_.rows().end());
        for (const TextRow& row : out) {
            file_.require_words(row, columns_.size(), columns_.size());
        }
        return out;
    }
    [[nodiscard]] std::string_view text(const TextRow& row, const char* name) const { return row.words[column(name)]; }
    [[nodiscard]] double number(const TextRow& row, const char* name) const { return file_.number(row, column(name)); }
    [[nodiscard]] int integer(const TextRow& row, const char* name) const { return file_.integer(row, column(name)); }
    [[nodiscard]] Vec3 three(const TextRow& row, const char* a, const char* b, const char* c) const {
        return {number(row, a), number(row, b), number(row, c)};
    }

private:
    [[nodiscard]] std::size_t column(const char* name) const {
        const auto found = columns_.find(name);
        if (found == columns_.end()) {
            file_.refuse(file_.rows().front(), std::string("has no column ") + name);
        }
        return found->second;
    }
    TextFile file_;
    std::map<std::string, std::size_t> columns_;
};

}  // namespace

std::vector<ObjectRow> read_object_rows(const fs::path& path) {
    const TextFile file(path, false);
    std::vector<ObjectRow> rows;
    std::set<std::pair<int, int>> seen;
    for (const TextRow& text : file.rows()) {
        file.require_words(text, 18, 19);  // 18: without speed, as KITTI's own results
        ObjectRow row;
        row.frame = file.integer(text, 0);
        row.id = file.integer(text, 1);
        row.type = std::string(text.words[2]);
        row.truncated = file.number(text, 3);
        row.occluded = file.integer(text, 4);
        row.box = {file.number(text, 6), file.number(text, 7), file.number(text, 8), file.number(text, 9)};
        row.size_m = Vec3(file.number(text, 12), file.number(text, 11), file.number(text, 10));
        row.bottom_c0 = Vec3(file.number(text, 13), file.number(text, 14), file.number(text, 15));
        row.rotation_y = file.number(text, 16);
        row.score = file.number(text, 17);
        row.speed = text.words.size() > 18 ? file.number(text, 18) : 0.0;
        if (!(row.box.right > row.box.left && row.box.bottom > row.box.top)) {
            file.refuse(text, "a result needs a 2D box (left < right, top < bottom)");
        }
        if (!(row.size_m(0) > 0.0 && row.size_m(1) > 0.0 && row.size_m(2) > 0.0)) {
            file.refuse(text, "a box needs positive sizes");
        }
        if (!seen.insert({row.frame, row.id}).second) {
            file.refuse(text, "the same frame and id twice");
        }
        rows.push_back(row);
    }
    return rows;
}

Trajectory read_trajectory(const fs::path& dir, const std::vector<int>& frames) {
    if (frames.empty()) {
        throw InputError((dir / "frames.txt").string() + ": holds no frames");
    }
    return read_trajectory_file(dir / "ego.txt", frames);
}

Trajectory read_trajectory_file(const fs::path& path, const std::vector<int>& frames) {
    const std::map<int, RigidTransform> poses = read_poses(path, frames);
    if (poses.size() != frames.size()) {
        throw InputError(path.string() + ": has " + std::to_string(poses.size()) + " poses, the results have " +
                         std::to_string(frames.size()));
    }
    Trajectory out;
    for (const auto& [frame, T] : poses) {
        out[frame] = to_pose(T);
    }
    return out;
}

std::map<std::pair<int, int>, double> read_yaw_rates(const fs::path& path) {
    const Table table(path);
    std::map<std::pair<int, int>, double> out;
    for (const TextRow& row : table.rows()) {
        if (!table.text(row, "ObjectId").empty() && !table.text(row, "YawRate").empty()) {
            out[{table.integer(row, "frame"), table.integer(row, "ObjectId")}] = table.number(row, "YawRate");
        }
    }
    return out;
}

std::vector<StateRow> read_state_rows(const fs::path& path) {
    const Table table(path);
    std::vector<StateRow> out;
    for (const TextRow& row : table.rows()) {
        StateRow s;
        s.frame = table.integer(row, "frame");
        s.id = table.integer(row, "id");
        s.measured = table.text(row, "status") == "measured" || table.text(row, "status") == "new";
        s.centre_w = table.three(row, "x", "y", "z");
        s.yaw = table.number(row, "yaw");
        s.speed = table.number(row, "speed");
        s.size_m = table.three(row, "length", "width", "height");
        s.sigma_position = table.three(row, "sigma_x", "sigma_y", "sigma_z");
        s.sigma_yaw = table.number(row, "sigma_yaw");
        s.sigma_speed = table.number(row, "sigma_speed");
        out.push_back(s);
    }
    return out;
}

std::vector<EgoMotionRow> read_ego_motion_rows(const fs::path& path) {
    const Table table(path);
    std::vector<EgoMotionRow> out;
    for (const TextRow& row : table.rows()) {
        if (table.text(row, "speed").empty()) {
            continue;
        }
        EgoMotionRow e;
        e.frame = table.integer(row, "frame");
        e.time_us = static_cast<std::int64_t>(table.number(row, "time_us"));
        e.speed = table.number(row, "speed");
        e.yaw_rate = table.number(row, "yaw_rate");
        e.sigma_speed = table.number(row, "sigma_speed");
        e.sigma_yaw_rate = table.number(row, "sigma_yaw_rate");
        out.push_back(e);
    }
    return out;
}

}  // namespace semtrack::sil

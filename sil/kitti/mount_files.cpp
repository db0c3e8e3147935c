#include "sil/kitti/mount_files.hpp"

#include <string>

#include "sil/kitti/text_file.hpp"

namespace semtrack::sil {

namespace {

const TextRow& row_of(const TextFile& file, const char* name, std::size_t values) {
    for (const TextRow& row : file.rows()) {
        if (row.words[0] == name) {
            file.require_words(row, values + 1, values + 1);
            return row;
        }
    }
    file.refuse_end(std::string("no row ") + name);
}

Mat3 matrix_of(const TextFile& file, const TextRow& row) {
    Mat3 R;
    for (int i = 0; i < 9; ++i) {
        R(i / 3, i % 3) = file.number(row, static_cast<std::size_t>(i + 1));
    }
    return R;
}

}  // namespace

Pose read_sensor_mount(const std::filesystem::path& path) {
    const TextFile file(path, false);
    Pose T;
    T.R = matrix_of(file, row_of(file, "R:", 9));
    const TextRow& move = row_of(file, "T:", 3);
    for (int i = 0; i < 3; ++i) {
        T.t(i) = file.number(move, static_cast<std::size_t>(i + 1));
    }
    return T;
}

Pose read_velodyne_mount(const std::filesystem::path& cam_to_cam, const std::filesystem::path& velo_to_cam) {
    const TextFile cameras(cam_to_cam, false);
    Pose R_rect;
    R_rect.R = matrix_of(cameras, row_of(cameras, "R_rect_00:", 9));
    return R_rect * read_sensor_mount(velo_to_cam);
}

}  // namespace semtrack::sil

#include "sil/result_folder.hpp"

#include <algorithm>
#include <cctype>

#include "sil/report/text_output.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFiles[] = {"ego.txt",    "frames.txt", "ego.csv",    "objects.txt", "states.csv",  "list.csv",
                                  "points.csv", "can.log",    "timing.csv", "stages.csv",  "metrics.json"};
constexpr const char* kPictures = "pictures";
constexpr const char* kWork = ".semtrack-unfinished";

/// Names that PictureWriter gives.
bool is_picture(const fs::path& path) {
    const std::string stem = path.stem().string();
    const bool number =
        !stem.empty() && std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    return path.extension() == ".png" && (number || stem == "birdseye" || stem == "trajectory");
}

void replace_pictures(const fs::path& dir, const fs::path& work) {
    const fs::path target = dir / kPictures;
    std::error_code ignored;
    if (fs::is_directory(target)) {
        std::vector<fs::path> old;
        for (const fs::directory_entry& entry : fs::directory_iterator(target)) {
            if (is_picture(entry.path())) {
                old.push_back(entry.path());
            }
        }
        for (const fs::path& path : old) {
            fs::remove(path);
        }
        fs::remove(target, ignored);  // stays when something foreign is in it
    }
    if (!fs::exists(work / kPictures)) {
        return;
    }
    fs::create_directories(target);
    for (const fs::directory_entry& entry : fs::directory_iterator(work / kPictures)) {
        fs::rename(entry.path(), target / entry.path().filename());
    }
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& dir) : dir_(dir), work_(dir / kWork) {
    std::error_code error;
    const bool existed = fs::exists(dir_, error);
    if (!existed) {
        created_ = fs::create_directories(dir_, error);
    }
    if (error || !fs::is_directory(dir_, error)) {
        throw InputError(dir_.string() + ": cannot be made an output folder");
    }
    fs::remove_all(work_, error);  // of a run that was killed
    fs::create_directory(work_, error);
    try {
        write_file(work_ / "probe", "x");
        fs::remove(work_ / "probe");
    } catch (const std::exception&) {
        fs::remove_all(work_, error);
        throw InputError(dir_.string() + ": cannot be written to");
    }
}

ResultFolder::~ResultFolder() {
    std::error_code ignored;
    fs::remove_all(work_, ignored);
    if (created_ && !committed_) {
        fs::remove(dir_, ignored);
    }
}

void ResultFolder::commit() {
    for (const char* name : kFiles) {
        fs::remove(dir_ / name);
        if (fs::exists(work_ / name)) {
            fs::rename(work_ / name, dir_ / name);
        }
    }
    replace_pictures(dir_, work_);
    committed_ = true;
}

}  // namespace semtrack::sil

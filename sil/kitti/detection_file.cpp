#include "sil/kitti/detection_file.hpp"

#include <algorithm>

#include "model/box_geometry.hpp"
#include "sil/kitti/drive_files.hpp"
#include "sil/kitti/text_file.hpp"

namespace semtrack::sil {

namespace {

constexpr int kMaxFrame = 10000000;
constexpr std::size_t kColumns = 9;
constexpr const char* kNames[kObjectClasses] = {"Car", "Van", "Truck", "Pedestrian", "Cyclist", "Tram", "Misc"};

bool same_edges(const Box2d& a, const Box2d& b) {
    return a.left == b.left && a.top == b.top && a.right == b.right && a.bottom == b.bottom;
}

Detection parse(const TextFile& file, const TextRow& row) {
    Detection d;
    const std::string name(row.words[1]);
    const auto it = std::find(std::begin(kNames), std::end(kNames), name);
    if (it == std::end(kNames)) {
        file.refuse(row, "unknown class " + quoted_word(name));
    }
    d.object_class = static_cast<ObjectClass>(it - std::begin(kNames));
    d.score = file.number(row, 2);
    d.box = {file.number(row, 3), file.number(row, 4), file.number(row, 5), file.number(row, 6)};
    d.viewpoint = parse_viewpoint(file, row, 7);
    return d;
}

}  // namespace

const char* class_name(ObjectClass object_class) {
    return kNames[static_cast<int>(object_class)];
}

bool class_from_name(const std::string& name, ObjectClass& out) {
    for (int i = 0; i < kObjectClasses; ++i) {
        if (name == kNames[i]) {
            out = static_cast<ObjectClass>(i);
            return true;
        }
    }
    if (name == "Person_sitting" || name == "Person") {
        out = ObjectClass::kPedestrian;
        return true;
    }
    return false;
}

void tidy(std::vector<Detection>& list, int width, int height, DetectionCounters& counters) {
    std::vector<Detection> kept;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Detection& d = list[i];
        const bool doubled =
            std::any_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i),
                        [&](const auto& e) { return e.object_class == d.object_class && same_edges(e.box, d.box); });
        Detection clipped = d;
        if (!(d.box.right > d.box.left) || !(d.box.bottom > d.box.top)) {
            ++counters.inverted;
        } else if (!clip_box(d.box, width, height, clipped.box)) {
            ++counters.outside;
        } else if (doubled) {
            ++counters.doubled;
        } else {
            counters.clipped += same_edges(clipped.box, d.box) ? 0 : 1;
            kept.push_back(clipped);
        }
    }
    std::stable_sort(kept.begin(), kept.end(),
                     [](const Detection& a, const Detection& b) { return a.score > b.score; });
    list = std::move(kept);
}

void tidy(std::vector<Detection>& list, int width, int height, int& dropped) {
    DetectionCounters counters;
    tidy(list, width, height, counters);
    dropped += counters.dropped();
}

Detections read_detections(const std::filesystem::path& path, int width, int height) {
    const TextFile file(path, false);
    Detections out;
    for (const TextRow& row : file.rows()) {
        file.require_words(row, kColumns, kColumns);
        const int frame = file.integer(row, 0);
        const bool none = row.words[1] == "none";
        Detection d;
        if (none) {
            for (std::size_t i = 2; i < kColumns; ++i) {
                (void)file.number(row, i);
            }
        } else {
            d = parse(file, row);
        }
        if (frame < 0 || frame > kMaxFrame) {
            ++out.bad_frames;
            continue;
        }
        std::vector<Detection>& list = out.by_frame[frame];
        if (!none) {
            list.push_back(d);
        }
    }
    for (auto& [frame, list] : out.by_frame) {
        tidy(list, width, height, out.counters);
    }
    out.dropped = out.counters.dropped();
    return out;
}

}  // namespace semtrack::sil

#include "sil/kitti/convert_detections.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "model/box_geometry.hpp"
#include "model/class_prior.hpp"
#include "sil/kitti/detection_file.hpp"
#include "sil/kitti/drive_files.hpp"
#include "sil/kitti/label_detections.hpp"
#include "sil/metrics/number_text.hpp"

namespace semtrack::sil {

namespace {

namespace fs = std::filesystem;

constexpr double kMatchingOverlap = 0.5;
constexpr double kNoAlpha = -9.0;  // below: KITTI's "not known" (-10)
constexpr double kCameraHeight_m = 1.65;
constexpr std::size_t kFrameDigits = 6;

using Lists = std::map<int, std::vector<Detection>>;

double squeezed(double score) {
    return score >= 0.0 && score <= 1.0 ? score : 0.5 * (1.0 + score / (1.0 + std::fabs(score)));
}

/// COCO's classes counted from 0, as YOLO's 80 outputs are.
bool class_of_coco(int number, ObjectClass& out) {
    switch (number) {
        case 0:
            out = ObjectClass::kPedestrian;
            return true;
        case 1:
        case 3:  // motorcycle: the nearest class
            out = ObjectClass::kCyclist;
            return true;
        case 2:
            out = ObjectClass::kCar;
            return true;
        case 5:  // bus
        case 7:
            out = ObjectClass::kTruck;
            return true;
        case 6:  // train
            out = ObjectClass::kTram;
            return true;
        default:
            return false;
    }
}

/// Faces seen of a box whose heading is `alpha` against the ray to it. Distance from the 2D box's height.
Viewpoint viewpoint_of_alpha(double alpha, const Box2d& box, const Vec3& size_m, double focal_px) {
    Label l;
    l.length = size_m(0);
    l.width = size_m(1);
    l.height = size_m(2);
    l.y = kCameraHeight_m;
    l.z = std::max(focal_px * size_m(2) / (box.bottom - box.top), size_m(0));
    l.rotation_y = alpha;
    return visible_faces(label_pose(l), size_m);
}

/// Four words from `box` on, and h w l x y z ry from `place` on.
Label label_of(const TextFile& file, const TextRow& row, std::size_t box, std::size_t place) {
    Label l;
    l.box = {file.number(row, box), file.number(row, box + 1), file.number(row, box + 2), file.number(row, box + 3)};
    l.height = file.number(row, place);
    l.width = file.number(row, place + 1);
    l.length = file.number(row, place + 2);
    l.x = file.number(row, place + 3);
    l.y = file.number(row, place + 4);
    l.z = file.number(row, place + 5);
    l.rotation_y = file.number(row, place + 6);
    return l;
}

Viewpoint viewpoint_of_label(const Label& l, ObjectClass object_class, double focal_px) {
    if (!class_prior(object_class).has_heading || l.box.bottom <= l.box.top) {
        return {};
    }
    const bool has_size = l.length > 0.0 && l.width > 0.0 && l.height > 0.0;
    const Vec3 size = has_size ? Vec3(l.length, l.width, l.height) : class_prior(object_class).size_m;
    if (has_size && l.z > size(0)) {
        return visible_faces(label_pose(l), size);
    }
    return l.alpha > kNoAlpha ? viewpoint_of_alpha(l.alpha, l.box, size, focal_px) : Viewpoint{};
}

class Converter {
public:
    explicit Converter(const ConvertOptions& options) : o_(options) {}

    std::string run() {
        if (!o_.labels.empty()) {
            for (const Label& l : read_labels(o_.labels, o_.labels_viewpoints)) {
                labels_[l.frame].push_back(l);
            }
        }
        if (o_.format == "kitti") {
            read_kitti();
        } else if (o_.format == "rrc") {
            read_rrc();
        } else if (o_.format == "pointrcnn") {
            read_pointrcnn();
        } else if (o_.format == "coco") {
            read_coco();
        } else {
            throw InputError("unknown format '" + o_.format + "' (there are kitti, rrc, pointrcnn, coco)");
        }
        return text();
    }

private:
    void add(int frame, ObjectClass object_class, const Box2d& box, double score, Viewpoint viewpoint) {
        last_seen_ = std::max(last_seen_, frame);
        if (score < o_.least_score) {
            return;
        }
        Detection d;
        d.object_class = object_class;
        d.box = box;
        d.score = squeezed(score);
        d.viewpoint = o_.viewpoints ? viewpoint : Viewpoint{};
        lists_[frame].push_back(d);
    }

    void read_kitti_row(const TextFile& file, const TextRow& row, int frame, std::size_t at) {
        last_seen_ = std::max(last_seen_, frame);
        ObjectClass object_class = ObjectClass::kCar;
        const std::string type(row.words.at(at));
        if (type == "DontCare") {
            return;
        }
        if (!class_from_name(type, object_class)) {
            file.refuse(row, "unknown class " + quoted_word(type));
        }
        Label l = label_of(file, row, at + 4, at + 8);
        l.alpha = file.number(row, at + 3);
        const double score = row.words.size() > at + 15 ? file.number(row, at + 15) : 1.0;
        add(frame, object_class, l.box, score, viewpoint_of_label(l, object_class, o_.focal_px));
    }

    void read_kitti() {
        if (!fs::is_directory(o_.in)) {
            const TextFile file(o_.in, false);
            for (const TextRow& row : file.rows()) {
                file.require_words(row, 17, 19);
                read_kitti_row(file, row, file.integer(row, 0), 2);
            }
            return;
        }
        for (const auto& entry : fs::directory_iterator(o_.in)) {
            const std::string stem = entry.path().stem().string();
            if (entry.path().extension() != ".txt" || stem.size() != kFrameDigits ||
                stem.find_first_not_of("0123456789") != std::string::npos) {
                continue;
            }
            const int frame = std::stoi(stem);
            last_seen_ = std::max(last_seen_, frame);
            const TextFile file(entry.path(), false);
            for (const TextRow& row : file.rows()) {
                file.require_words(row, 15, 16);
                read_kitti_row(file, row, frame, 0);
            }
        }
    }

    [[nodiscard]] Viewpoint labelled_viewpoint(int frame, const Box2d& box) const {
        const auto here = labels_.find(frame);
        Viewpoint out;
        double best = kMatchingOverlap;
        if (here != labels_.end()) {
            for (const Label& l : here->second) {
                const double overlap = box_overlap(l.box, box);
                if (overlap >= best && l.type != "DontCare") {
                    best = overlap;
                    out = l.viewpoint;
                }
            }
        }
        return out;
    }

    void read_rrc() {
        ObjectClass fixed_class = ObjectClass::kCar;
        if (!class_from_name(o_.object_class, fixed_class)) {
            throw InputError("unknown class '" + o_.object_class + "'");
        }
        const TextFile file(o_.in, false, ',');
        for (const TextRow& row : file.rows()) {
            file.require_words(row, 6, 7);
            const std::size_t at = row.words.size() - 6U;  // 1 when there is a class
            const int frame = file.integer(row, 0);
            ObjectClass object_class = fixed_class;
            if (at == 1 && !class_of_coco(file.integer(row, 1), object_class)) {
                continue;  // a class that is no road user
            }
            const Box2d box{file.number(row, at + 1), file.number(row, at + 2), file.number(row, at + 3),
                            file.number(row, at + 4)};
            const Viewpoint view = class_prior(object_class).has_heading ? labelled_viewpoint(frame, box) : Viewpoint{};
            add(frame, object_class, box, file.number(row, at + 5), view);
        }
    }

    void read_pointrcnn() {
        const TextFile file(o_.in, false, ',');
        for (const TextRow& row : file.rows()) {
            file.require_words(row, 15, 15);
            const int type = file.integer(row, 1);
            if (type < 1 || type > 3) {
                file.refuse(row, "type is 1 (pedestrian), 2 (car) or 3 (cyclist)");
            }
            const ObjectClass object_class = type == 1   ? ObjectClass::kPedestrian
                                             : type == 2 ? ObjectClass::kCar
                                                         : ObjectClass::kCyclist;
            Label l = label_of(file, row, 2, 7);
            l.alpha = file.number(row, 14);
            add(file.integer(row, 0), object_class, l.box, file.number(row, 6),
                viewpoint_of_label(l, object_class, o_.focal_px));
        }
    }

    [[nodiscard]] static int frame_of_image(const nlohmann::json& id) {
        if (id.is_number_integer()) {
            return id.get<int>();
        }
        const std::string stem = fs::path(id.get<std::string>()).stem().string();
        if (stem.empty() || stem.size() > 10 || stem.find_first_not_of("0123456789") != std::string::npos) {
            throw InputError("image_id '" + stem + "' is no frame number");
        }
        return std::stoi(stem);
    }

    void read_coco() {
        std::ifstream in(o_.in, std::ios::binary);
        if (!in) {
            throw InputError(o_.in.string() + ": cannot be read");
        }
        std::size_t index = 0;
        try {
            for (const nlohmann::json& d : nlohmann::json::parse(in)) {
                ObjectClass object_class = ObjectClass::kCar;
                const int frame = frame_of_image(d.at("image_id"));
                last_seen_ = std::max(last_seen_, frame);
                // COCO's category numbers count from 1; the first nine are YOLO's plus one.
                if (class_of_coco(d.at("category_id").get<int>() - 1, object_class)) {
                    const auto b = d.at("bbox").get<std::vector<double>>();
                    add(frame, object_class, {b.at(0), b.at(1), b.at(0) + b.at(2), b.at(1) + b.at(3)},
                        d.at("score").get<double>(), {});
                }
                ++index;
            }
        } catch (const std::exception& error) {
            throw InputError(o_.in.string() + ": detection " + std::to_string(index) + ": " + error.what());
        }
    }

    [[nodiscard]] std::string text() const {
        std::string out;
        const int first = o_.first.value_or(0);
        const int last = o_.last.value_or(last_seen_);
        for (int frame = first; frame <= last; ++frame) {
            const auto list = lists_.find(frame);
            if (list == lists_.end()) {
                out += std::to_string(frame) + " none 0 0 0 0 0 -1 -1\n";
                continue;
            }
            for (const Detection& d : list->second) {
                out += std::to_string(frame) + " " + class_name(d.object_class);
                for (const double v : {d.score, d.box.left, d.box.top, d.box.right, d.box.bottom}) {
                    out += " ";
                    append_number(out, v);
                }
                out += " " + std::to_string(d.viewpoint.horizontal) + " " + std::to_string(d.viewpoint.vertical) + "\n";
            }
        }
        return out;
    }

    const ConvertOptions& o_;
    std::map<int, std::vector<Label>> labels_;
    Lists lists_;
    int last_seen_{-1};
};

}  // namespace

std::string converted_detections(const ConvertOptions& options) {
    return Converter(options).run();
}

}  // namespace semtrack::sil

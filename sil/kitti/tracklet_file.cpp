#include "sil/kitti/tracklet_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>

#include "math/trig.hpp"
#include "model/box_geometry.hpp"
#include "sil/kitti/label_detections.hpp"
#include "sil/kitti/text_file.hpp"

namespace semtrack::sil {

namespace {

// The file is an archive of one C++ structure: elements nest, the leaves hold one word. So a reader of tags suffices;
// attributes, the prologue and comments without '>' inside are skipped.
struct Tag {
    std::string_view name;
    std::string_view text;  // between the tag before and this one
    bool closing{false};
    int line{1};
};

class TagReader {
public:
    explicit TagReader(const std::filesystem::path& path) : name_(path.string()) {
        std::ifstream in(path, std::ios::binary);
        if (!in) {
            throw InputError(name_ + ": cannot be read");
        }
        text_.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }

    /// false: the end.
    bool next(Tag& tag) {
        const std::string_view all(text_);
        const std::size_t open = all.find('<', at_);
        const std::size_t close = open == std::string_view::npos ? open : all.find('>', open);
        if (close == std::string_view::npos) {
            return false;
        }
        tag.text = trimmed(all.substr(at_, open - at_));
        for (std::size_t i = at_; i < open; ++i) {
            line_ += all[i] == '\n' ? 1 : 0;
        }
        std::string_view body = all.substr(open + 1, close - open - 1);
        tag.closing = !body.empty() && body[0] == '/';
        body.remove_prefix(tag.closing ? 1 : 0);
        tag.name = body.substr(0, body.find_first_of(" \t\r\n"));
        tag.line = line_;
        for (const char c : body) {
            line_ += c == '\n' ? 1 : 0;
        }
        at_ = close + 1;
        return true;
    }

    [[noreturn]] void refuse(const Tag& tag, const std::string& what) const {
        throw InputError(name_ + ":" + std::to_string(tag.line) + ": " + what);
    }
    [[nodiscard]] double number(const Tag& tag) const {
        double value = 0.0;
        const char* end = tag.text.data() + tag.text.size();
        const auto [stop, error] = std::from_chars(tag.text.data(), end, value);
        if (error != std::errc{} || stop != end || !std::isfinite(value)) {
            refuse(tag, quoted_word(tag.text) + " is not a finite number");
        }
        return value;
    }

private:
    static std::string_view trimmed(std::string_view s) {
        const std::size_t first = s.find_first_not_of(" \t\r\n");
        return first == std::string_view::npos ? std::string_view{}
                                               : s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1);
    }
    std::string name_;
    std::string text_;
    std::size_t at_{0};
    int line_{1};
};

using Fields = std::map<std::string, double, std::less<>>;

double field(const Fields& fields, std::string_view name, const TagReader& file, const Tag& tag) {
    const auto it = fields.find(name);
    if (it == fields.end()) {
        file.refuse(tag, "no <" + std::string(name) + "> before this end");
    }
    return it->second;
}

/// Box in the scanner's frame (z up, bottom centre, rz about z) -> label in rectified camera 0.
Label label_of(const Fields& tracklet, const Fields& pose, const Pose& T_c0_velo, const TagReader& file,
               const Tag& tag) {
    Label l;
    l.height = field(tracklet, "h", file, tag);
    l.width = field(tracklet, "w", file, tag);
    l.length = field(tracklet, "l", file, tag);
    if (!(l.height > 0.0) || !(l.width > 0.0) || !(l.length > 0.0)) {
        file.refuse(tag, "a box needs positive sizes");
    }
    const double tx = field(pose, "tx", file, tag);
    const double ty = field(pose, "ty", file, tag);
    const double tz = field(pose, "tz", file, tag);
    const Vec3 bottom = T_c0_velo * Vec3(tx, ty, tz);
    const SinCos rz = sin_cos(field(pose, "rz", file, tag));
    const Vec3 heading = T_c0_velo.R * Vec3(rz.cos, rz.sin, 0.0);
    l.x = bottom(0);
    l.y = bottom(1);
    l.z = bottom(2);
    l.rotation_y = atan2_rad(-heading(2), heading(0));
    l.alpha = wrap_angle(l.rotation_y - atan2_rad(l.x, l.z));
    const auto occlusion = pose.find("occlusion");
    const double level = occlusion == pose.end() ? 3.0 : occlusion->second;
    l.occluded = level >= 0.0 && level <= 2.0 ? static_cast<int>(level) : 3;
    return l;
}

/// false: not in the picture.
bool add_box(Label& l, const DriveCameras& cameras) {
    Pose T = label_pose(l);
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        T.t(i) += cameras.t_label_c[k] - cameras.t_c0_c[k];
    }
    Box2d whole;
    if (projected_box(cameras.label_camera, T, Vec3(l.length, l.width, l.height), whole) != Status::kOk ||
        !clip_box(whole, cameras.calibration.width, cameras.calibration.height, l.box)) {
        return false;
    }
    const double area = (whole.right - whole.left) * (whole.bottom - whole.top);
    l.truncated = 1.0 - (l.box.right - l.box.left) * (l.box.bottom - l.box.top) / area;
    return true;
}

}  // namespace

std::vector<Label> read_tracklets(const std::filesystem::path& path, const Pose& T_c0_velo,
                                  const DriveCameras& cameras) {
    TagReader file(path);
    std::vector<Label> labels;
    std::vector<std::string> open;  // boost_serialization / tracklets / item / poses / item / leaf
    Fields tracklet;
    Fields pose;
    std::string type;
    int id = -1;
    int frame = 0;
    Tag tag;
    while (file.next(tag)) {
        if (tag.name.empty() || tag.name[0] == '?' || tag.name[0] == '!') {
            continue;
        }
        if (!tag.closing) {
            open.emplace_back(tag.name);
            if (tag.name == "item" && open.size() == 3) {
                tracklet.clear();
                ++id;
            } else if (tag.name == "item" && open.size() == 5) {
                pose.clear();
            } else if (tag.name == "poses" && open.size() == 4) {
                frame = static_cast<int>(field(tracklet, "first_frame", file, tag));
            }
            continue;
        }
        if (open.empty() || open.back() != tag.name) {
            file.refuse(tag, "the end of " + quoted_word(tag.name) + " without its begin");
        }
        if (tag.name == "objectType") {
            type = std::string(tag.text);
        } else if (open.size() == 4 && !tag.text.empty()) {
            tracklet[std::string(tag.name)] = file.number(tag);
        } else if (open.size() == 6 && !tag.text.empty()) {
            pose[std::string(tag.name)] = file.number(tag);
        } else if (open.size() == 5 && tag.name == "item") {
            Label l = label_of(tracklet, pose, T_c0_velo, file, tag);
            l.frame = frame++;
            l.id = id;
            l.type = type;
            if (add_box(l, cameras)) {
                labels.push_back(std::move(l));
            }
        }
        open.pop_back();
    }
    if (!open.empty()) {
        file.refuse(tag, "the file ends inside " + quoted_word(open.back()));
    }
    return labels;
}

}  // namespace semtrack::sil

#include "sil/world/world_sequence.hpp"

namespace semtrack::sil {

namespace {

world::Scene make_scene(const std::string& name, const WorldOptions& options) {
    if (options.frames < 0) {
        throw InputError("scenario '" + name + "': number of frames below 0");
    }
    const world::Scenario scenario = world::find_scenario(name);
    return world::Scene(scenario, options.frames > 0 ? options.frames : scenario.frames);
}

bool is_dropped(const world::Scenario& scenario, int frame) {
    for (const int f : scenario.imaging.dropped) {
        if (f == frame) {
            return true;
        }
    }
    return false;
}

}  // namespace

struct WorldSequence::Seen {
    std::vector<Label> labels{};
    std::map<int, std::vector<Detection>> detections{};
    std::vector<world::ObjectTruth> objects{};
};

std::vector<std::string> scenario_names() {
    return world::all_scenario_names();
}

WorldSequence::WorldSequence(const std::string& scenario, const WorldOptions& options)
    : options_(options), scene_(make_scene(scenario, options)) {
    cameras_.calibration = world::world_calibration(scene_.scenario());
    cameras_.label_camera = cameras_.calibration.left;
    for (int frame = 0; frame < scene_.frames(); ++frame) {
        frames_.push_back(frame);
        ego_[frame] = world::ego_truth(scene_, frame);
    }
}

void WorldSequence::render(int frame, GreyImage& left, GreyImage& right) const {
    if (frame < 0 || frame >= scene_.frames()) {
        throw InputError("scenario '" + name() + "': there is no frame " + std::to_string(frame));
    }
    world::Renderer(scene_, cameras_.calibration).render(frame, left, right, options_.threads);
}

const WorldSequence::Seen& WorldSequence::seen() const {
    if (seen_) {
        return *seen_;
    }
    const auto out = std::make_shared<Seen>();
    const world::Scenario& scenario = scene_.scenario();
    const world::Renderer renderer(scene_, cameras_.calibration);
    const auto mode = options_.ideal ? world::DetectorMode::kIdeal : world::DetectorMode::kRealistic;
    for (const int frame : frames_) {
        const std::vector<world::Silhouette> silhouettes = renderer.silhouettes(frame, options_.threads);
        for (std::size_t k = 0; k < silhouettes.size(); ++k) {
            out->objects.push_back(world::object_truth(scene_, k, frame));
            if (!world::is_labelled(silhouettes[k])) {
                continue;
            }
            out->labels.push_back(world::make_label(scene_, cameras_.calibration, k, frame, silhouettes[k]));
        }
        if (is_dropped(scenario, frame) || frame % scenario.detector.every != 0) {
            continue;
        }
        out->detections[frame] = world::detect(scene_, cameras_.calibration, frame, silhouettes, mode);
    }
    seen_ = out;
    return *seen_;
}

const std::vector<Label>& WorldSequence::labels() const {
    return seen().labels;
}
const std::map<int, std::vector<Detection>>& WorldSequence::label_detections() const {
    return seen().detections;
}
const std::vector<world::ObjectTruth>& WorldSequence::object_truth() const {
    return seen().objects;
}

}  // namespace semtrack::sil

// usage: semtrack-budget-scene street FILE FRAMES     the rendered street, from where cars are in view
//        semtrack-budget-scene load FILE FRAMES OBJECTS    the load that fills the capacities
#include <cstdio>
#include <cstdlib>
#include <string>

#include "budget/load_scene.hpp"
#include "sil/world/world_sequence.hpp"

namespace {

using namespace semtrack;

constexpr int kFirst = 8;  // cars are in view

bool street(const std::string& file, int frames) {
    sil::WorldOptions options;
    options.frames = kFirst + frames;
    const sil::WorldSequence world("street", options);
    board::SceneWriter scene(world.cameras().calibration, frames);
    for (int frame = kFirst; frame < kFirst + frames; ++frame) {
        const auto list = world.label_detections().find(frame);
        sil::GreyImage left;
        sil::GreyImage right;
        world.render(frame, left, right);
        scene.frame(world.time_us(frame), list == world.label_detections().end() ? nullptr : &list->second, left.view(),
                    right.view());
    }
    return scene.save(file);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string kind = argc > 1 ? argv[1] : "";
    if (kind == "street" && argc == 4) {
        return street(argv[2], std::atoi(argv[3])) ? 0 : 1;
    }
    if (kind == "load" && argc == 5) {
        return budget::make_load_scene(std::atoi(argv[4]), std::atoi(argv[3])).save(argv[2]) ? 0 : 1;
    }
    (void)std::fputs("usage: semtrack-budget-scene street FILE FRAMES | load FILE FRAMES OBJECTS\n", stderr);
    return 2;
}

// usage: semtrack-board-scene FILE    renders the board's scene into FILE.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "board/scene_writer.hpp"
#include "sil/world/world_sequence.hpp"

namespace {

using namespace semtrack;

constexpr int kFrames = 6;
constexpr int kFirst = 8;   // cars are in view
constexpr int kLeft = 320;  // the window that is cut out of the rendered image, px
constexpr int kTop = 120;
constexpr int kWidth = 608;
constexpr int kHeight = 192;

/// The window of a rendered image.
ImageView window_of(const sil::GreyImage& image) {
    const ImageView whole = image.view();
    return {whole.row(kTop) + kLeft, kWidth, kHeight, whole.stride};
}

/// The detection as a detector on the window would give it; false: outside.
bool moved_into_window(Detection& d) {
    d.box.left = std::max(d.box.left - kLeft, 0.0);
    d.box.right = std::min(d.box.right - kLeft, kWidth - 1.0);
    d.box.top = std::max(d.box.top - kTop, 0.0);
    d.box.bottom = std::min(d.box.bottom - kTop, kHeight - 1.0);
    return d.box.right - d.box.left > 4.0 && d.box.bottom - d.box.top > 4.0;
}

void put_frame(board::SceneWriter& scene, const sil::WorldSequence& world, int frame) {
    std::vector<Detection> inside;
    const auto list = world.label_detections().find(frame);
    const bool answered = list != world.label_detections().end();
    if (answered) {
        for (Detection d : list->second) {
            if (moved_into_window(d)) {
                inside.push_back(d);
            }
        }
    }
    sil::GreyImage left;
    sil::GreyImage right;
    world.render(frame, left, right);
    scene.frame(world.time_us(frame), answered ? &inside : nullptr, window_of(left), window_of(right));
}

int make(const std::string& file) {
    sil::WorldOptions options;
    options.frames = kFirst + kFrames;
    const sil::WorldSequence world("street", options);
    Calibration c = world.cameras().calibration;
    c.width = kWidth;
    c.height = kHeight;
    for (PinholeCamera* camera : {&c.left, &c.right, &c.detection}) {
        camera->cx -= kLeft;
        camera->cy -= kTop;
    }
    board::SceneWriter scene(c, kFrames);
    for (int frame = kFirst; frame < kFirst + kFrames; ++frame) {
        put_frame(scene, world, frame);
    }
    return scene.save(file) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        (void)std::fputs("usage: semtrack-board-scene FILE\n", stderr);
        return 2;
    }
    return make(argv[1]);
}

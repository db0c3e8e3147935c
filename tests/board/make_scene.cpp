// usage: semtrack-board-scene FILE    renders the board's scene into FILE.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "board/scene.hpp"
#include "sil/world/world_sequence.hpp"

namespace {

using namespace semtrack;

constexpr int kFrames = 6;
constexpr int kFirst = 8;   // cars are in view
constexpr int kLeft = 320;  // the window that is cut out of the rendered image, px
constexpr int kTop = 120;
constexpr int kWidth = 608;
constexpr int kHeight = 192;

class Block {
public:
    void word(std::uint64_t value) {
        for (unsigned shift = 0; shift < 64U; shift += 8U) {
            bytes_.push_back(static_cast<std::uint8_t>(value >> shift));
        }
    }
    void number(double value) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        word(bits);
    }
    void image(const sil::GreyImage& image) {
        for (int y = 0; y < kHeight; ++y) {
            const std::uint8_t* const row = image.view().row(kTop + y) + kLeft;
            bytes_.insert(bytes_.end(), row, row + kWidth);
        }
        while (bytes_.size() % 8U != 0U) {
            bytes_.push_back(0);
        }
    }
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

/// The detection as a detector on the window would give it; false: outside.
bool moved_into_window(Detection& d) {
    d.box.left = std::max(d.box.left - kLeft, 0.0);
    d.box.right = std::min(d.box.right - kLeft, kWidth - 1.0);
    d.box.top = std::max(d.box.top - kTop, 0.0);
    d.box.bottom = std::min(d.box.bottom - kTop, kHeight - 1.0);
    return d.box.right - d.box.left > 4.0 && d.box.bottom - d.box.top > 4.0;
}

void put_frame(Block& block, const sil::WorldSequence& world, int frame) {
    block.word(static_cast<std::uint64_t>(world.time_us(frame)));
    std::vector<Detection> inside;
    const auto list = world.label_detections().find(frame);
    if (list != world.label_detections().end()) {
        for (Detection d : list->second) {
            if (moved_into_window(d)) {
                inside.push_back(d);
            }
        }
    }
    block.word(list == world.label_detections().end() ? ~0ULL : inside.size());
    for (const Detection& d : inside) {
        for (const double edge : {d.box.left, d.box.top, d.box.right, d.box.bottom}) {
            block.number(edge);
        }
        block.word(static_cast<std::uint64_t>(d.object_class));
        block.word(static_cast<std::uint8_t>(d.viewpoint.horizontal));
        block.word(static_cast<std::uint8_t>(d.viewpoint.vertical));
        block.number(d.score);
    }
    sil::GreyImage left;
    sil::GreyImage right;
    world.render(frame, left, right);
    block.image(left);
    block.image(right);
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
    Block block;
    block.word(board::kMagic);
    block.word(kFrames);
    block.word(kWidth);
    block.word(kHeight);
    board::each_value(c, [&block](double x) { block.number(x); });
    for (int frame = kFirst; frame < kFirst + kFrames; ++frame) {
        put_frame(block, world, frame);
    }
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(block.bytes().data()), static_cast<std::streamsize>(block.bytes().size()));
    return out.flush() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        (void)std::fputs("usage: semtrack-board-scene FILE\n", stderr);
        return 2;
    }
    return make(argv[1]);
}

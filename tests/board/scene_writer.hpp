// Writes the block of bytes that scene.hpp reads.
#ifndef SEMTRACK_TESTS_BOARD_SCENE_WRITER_HPP
#define SEMTRACK_TESTS_BOARD_SCENE_WRITER_HPP

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "board/scene.hpp"

namespace semtrack::board {

class SceneWriter {
public:
    SceneWriter(Calibration calibration, int frames) {
        word(kMagic);
        word(static_cast<std::uint64_t>(frames));
        word(static_cast<std::uint64_t>(calibration.width));
        word(static_cast<std::uint64_t>(calibration.height));
        each_value(calibration, [this](double x) { number(x); });
    }

    /// detections: null: the detector did not answer. Both images have the calibration's size.
    void frame(std::int64_t time_us, const std::vector<Detection>* detections, const ImageView& left,
               const ImageView& right) {
        word(static_cast<std::uint64_t>(time_us));
        word(detections == nullptr ? ~0ULL : detections->size());
        for (const Detection& d : detections == nullptr ? std::vector<Detection>{} : *detections) {
            for (const double edge : {d.box.left, d.box.top, d.box.right, d.box.bottom}) {
                number(edge);
            }
            word(static_cast<std::uint64_t>(d.object_class));
            word(static_cast<std::uint8_t>(d.viewpoint.horizontal));
            word(static_cast<std::uint8_t>(d.viewpoint.vertical));
            number(d.score);
        }
        image(left);
        image(right);
    }
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }
    [[nodiscard]] bool save(const std::string& file) const {
        std::ofstream out(file, std::ios::binary);
        out.write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
        return static_cast<bool>(out.flush());
    }

private:
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
    void image(const ImageView& view) {
        for (int y = 0; y < view.height; ++y) {
            bytes_.insert(bytes_.end(), view.row(y), view.row(y) + view.width);
        }
        while (bytes_.size() % 8U != 0U) {
            bytes_.push_back(0);
        }
    }

    std::vector<std::uint8_t> bytes_{};
};

}  // namespace semtrack::board

#endif

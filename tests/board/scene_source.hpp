// A scene in memory as a cycle's sources.
#ifndef SEMTRACK_TESTS_BOARD_SCENE_SOURCE_HPP
#define SEMTRACK_TESTS_BOARD_SCENE_SOURCE_HPP

#include "board/scene.hpp"

namespace semtrack::board {

class SceneSource final : public StereoSource, public DetectionSource {
public:
    explicit SceneSource(SceneReader& reader) : reader_(reader) {}

    SourceResult next(StereoFrame& frame) noexcept override {
        return reader_.next(frame, list_, has_list_) ? SourceResult::kOk : SourceResult::kEnd;
    }
    SourceResult poll(std::int64_t, StaticVector<DetectionList, kMaxDetectionLists>& lists) noexcept override {
        lists.clear();
        return has_list_ && lists.try_push_back(list_) ? SourceResult::kOk : SourceResult::kNone;
    }

private:
    SceneReader& reader_;
    DetectionList list_{};
    bool has_list_{false};
};

}  // namespace semtrack::board

#endif

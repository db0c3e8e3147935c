// Every bound of the library, each with its reason. Changing one changes kTrackerMebibytes and kWorkerKibibytes, nothing else.
#ifndef SEMTRACK_CAPACITY_HPP
#define SEMTRACK_CAPACITY_HPP

#include <cstddef>

#ifdef SEMTRACK_CAPACITY_SMALL
#define SEMTRACK_CAPACITIES small_capacities
#else
#define SEMTRACK_CAPACITIES default_capacities
#endif

namespace semtrack {

#ifdef SEMTRACK_CAPACITY_SMALL
// For a small controller with a coarser camera: CMake's SEMTRACK_CAPACITY=small.
inline constexpr int kMaxImageWidth = 640;
inline constexpr int kMaxImageHeight = 256;
inline constexpr int kMaxObjects = 8;
inline constexpr int kMaxDetections = 24;
inline constexpr int kMaxBackgroundFeatures = 256;
inline constexpr int kMaxObjectFeatures = 64;
inline constexpr std::size_t kTrackerMebibytes = 2;
inline constexpr std::size_t kWorkerKibibytes = 448;
#else
inline constexpr int kMaxImageWidth = 1248;         // KITTI 1242, padded to a multiple of 32
inline constexpr int kMaxImageHeight = 384;         // KITTI 375, padded to a multiple of 32
inline constexpr int kMaxObjects = 32;              // tracks alive at once
inline constexpr int kMaxDetections = 64;           // per list; the highest scores are kept
inline constexpr int kMaxBackgroundFeatures = 512;  // paper, experiments: 500 (background)
inline constexpr int kMaxObjectFeatures = 128;      // paper, experiments: 100 (object)
inline constexpr std::size_t kTrackerMebibytes = 7;
inline constexpr std::size_t kWorkerKibibytes = 768;
#endif
inline constexpr int kMaxOwners = kMaxObjects + 1;  // owner 0 is the background, owner k the track in slot k - 1
inline constexpr int kMaxFeatures = kMaxBackgroundFeatures + kMaxObjects * kMaxObjectFeatures;
inline constexpr int kEgoWindow = 11;         // keyframes; measured better than the paper's 10
inline constexpr int kObjectWindow = 12;      // 5 dense frames, then every fourth; beats 4, equals 24
inline constexpr int kObjectDenseFrames = 5;  // must cover kMaxDetectionDelay
inline constexpr int kObjectFrameStride = 4;  // distance of the older frames of an object's window
inline constexpr int kEgoHistory = 48;        // frames whose pose can still be asked for
inline constexpr int kMaxDetectionDelay = 3;  // frames; older lists are counted and dropped
inline constexpr int kMaxDetectionLists = kMaxDetectionDelay + 1;  // lists handed over in one cycle

static_assert(kObjectDenseFrames > kMaxDetectionDelay, "a late list must find its frame in the window");
static_assert(kEgoHistory >= kObjectDenseFrames + kObjectFrameStride * (kObjectWindow - kObjectDenseFrames) + 1,
              "every frame of an object's window needs its ego pose");

}  // namespace semtrack

#endif

// cv::ORB just as it comes: what the library's own extractor is measured against, in quality and in time. Uses the
// heap; not for the ECU. The extractor for the tracker (owners, cells) is opencv_extractor.hpp.
#ifndef SEMTRACK_HAL_OPENCV_PLAIN_ORB_HPP
#define SEMTRACK_HAL_OPENCV_PLAIN_ORB_HPP

#include <memory>

#include "semtrack/hal/feature_extractor.hpp"

namespace semtrack {

class PlainOrb {
public:
    /// The strongest `features` of the image on `levels` of scale 1.2; FAST threshold in grey levels. OpenCV is told to
    /// use one thread (process-wide).
    PlainOrb(int features, int levels, int threshold);
    ~PlainOrb();
    PlainOrb(const PlainOrb&) = delete;
    PlainOrb& operator=(const PlainOrb&) = delete;

    /// cv::ORB::detectAndCompute and nothing else: this is what is timed.
    void run(const ImageView& image);
    /// What the last run found, sorted by v, then u, as owner 0.
    [[nodiscard]] std::unique_ptr<Keypoints> keypoints() const;

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace semtrack

#endif

// cv::ORB (OpenCV core and features2d) as a FeatureExtractor: the reference for the library's own extractor. Uses the
// heap; not for the ECU.
#ifndef SEMTRACK_HAL_OPENCV_EXTRACTOR_HPP
#define SEMTRACK_HAL_OPENCV_EXTRACTOR_HPP

#include <memory>

#include "semtrack/hal/feature_extractor.hpp"

namespace semtrack {

class OpenCvExtractor final : public FeatureExtractor {
public:
    /// levels of scale 1.2; FAST threshold in grey levels. OpenCV is told to use one thread (process-wide).
    explicit OpenCvExtractor(int levels = 8, int threshold = 10);
    ~OpenCvExtractor();
    OpenCvExtractor(const OpenCvExtractor&) = delete;
    OpenCvExtractor& operator=(const OpenCvExtractor&) = delete;

    /// See FeatureExtractor. Corners are detected everywhere, spread over cells within each owner by their Harris
    /// response, and only the chosen ones are described. Images too small for cv::ORB have no features.
    Status extract(const ImageView& image, const OwnerMaskView& mask, const FeatureBudget& budget,
                   Keypoints& out) noexcept override;

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

}  // namespace semtrack

#endif

// Covariances of the object's cost terms, one set for all drives; docs/weights.md says what each was set by.
#ifndef SEMTRACK_ESTIMATE_OBJECT_OBJECT_WEIGHTS_HPP
#define SEMTRACK_ESTIMATE_OBJECT_OBJECT_WEIGHTS_HPP

#include "estimate/factor/motion.hpp"
#include "model/class_prior.hpp"

namespace semtrack {

inline constexpr double kEdgeHuber = 2.5;          // sigmas; a detector's edges have heavy tails
inline constexpr double kFeatureHuber = 2.5;       // sigmas of one observation (2 or 3 values)
inline constexpr double kFeatureCull = 6.0;        // sigmas: beyond, the feature is not on the object
inline constexpr double kFeatureSigmaScale = 1.5;  // car bodies mirror and bend: noisier than the background

/// Of each dimension, that no number of boxes tells better than: edges are drawn too tight or too wide all along.
inline constexpr double kSizeFloor = 0.04;

/// Prior of the steering angle: a curvature of 0.05 / m at a wheelbase of 2.6 m.
inline constexpr double kSteeringSigma_rad = 0.13;
/// Prior of the speed at the oldest frame: any road user.
inline constexpr double kSpeedSigma = 15.0;
/// Weak hold of the oldest frame's pose where nothing else determines it.
inline constexpr double kAnchorPosition_m = 10.0;
inline constexpr double kAnchorHeading_rad = 1.0;

/// Across the ego's own step, 3 % of it as a random walk: given poses of a GPS/IMU point up to 1.5 degrees beside the
/// camera's path.
inline constexpr double kEgoAcross = 0.03;
/// 0.04 m and 0.01 rad a frame at 10 Hz; acceleration of 2.5 m/s^2 as a random walk over a frame.
inline constexpr MotionNoise kVehicleNoise{0.126, 0.10, 0.03, 3.0, 0.10, kEgoAcross};
/// Pedestrians turn at will and change their speed within a step.
inline constexpr MotionNoise kPedestrianNoise{0.126, 0.10, 1.0, 0.8, 0.10, kEgoAcross};
/// A standing object: 0.01 m a frame (ego error), a heading that stays.
inline constexpr MotionNoise kStandingNoise{0.04, 0.05, 0.01, 0.05, 0.05, kEgoAcross};

/// A side that the detector's class names is seen at least under this angle less; far off the class is wrong.
inline constexpr double kViewSigma_rad = 0.05;
inline constexpr double kViewCauchy = 2.0;

/// Of a standing object's heading, that no number of frames tells better than.
inline constexpr double kHeadingFloor_rad = 0.03;
/// It is held by so much at least once it has stood for kHeadingHoldFrames: seen from straight ahead or behind, the
/// edges leave 0.15 rad open, and within that nothing may turn it.
inline constexpr double kHeadingHold_rad = 0.1;
inline constexpr int kHeadingHoldFrames = 32;
/// What the heading gains in variance with each frame in which the object moves: it turns.
inline constexpr double kHeadingTurned_rad = 0.1;

/// Standing is kept while the moving model explains the window only so much better (difference of |r|^2).
inline constexpr double kStandingGain = 6.0;
inline constexpr double kStandingGainKeep = 16.0;
/// A faster object is not taken for standing whatever the costs say.
inline constexpr double kStandingMaxSpeed = 2.5;
inline constexpr double kStandingMaxSpeedKeep = 5.0;  // one box cut by a nearer car is a speed of 3 m/s at 30 m
/// A vehicle that has stood starts to move once so many frames with a box say so: as it leaves the image, features of
/// what is behind or beside it would make it dart off. Slower than a walk it may move as it likes: that is how a car
/// whose place was wrong comes to the right one.
inline constexpr int kStartFrames = 3;
inline constexpr double kRestSpeed = 1.0;  // m/s

}  // namespace semtrack

#endif

// OpenCV's headers, without the warnings that they make under this project's options.
#ifndef SEMTRACK_HAL_OPENCV_OPENCV_HEADERS_HPP
#define SEMTRACK_HAL_OPENCV_OPENCV_HEADERS_HPP

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#endif
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#endif

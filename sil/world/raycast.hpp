// Which surface every sample of one image row sees.
//
// A convex polyhedron is the common part of half spaces n x <= d. For a ray from the camera with z = 1 each plane is
// met at inverse depth q = (n . ray) / d', linear in the pixel: planes that the camera lies outside of give an upper
// bound of q, the others a lower bound. So a row's span of samples that hit comes from linear inequalities, and the
// visible face is the one with the smallest q among the first kind; no division per sample. The nearest thing has the
// largest q.
#ifndef SEMTRACK_SIL_WORLD_RAYCAST_HPP
#define SEMTRACK_SIL_WORLD_RAYCAST_HPP

#include <array>
#include <cstdint>
#include <vector>

#include "math/pose.hpp"
#include "semtrack/calibration.hpp"
#include "sil/world/model_piece.hpp"

namespace semtrack::sil::world {

inline constexpr int kMaxSamples = 8;
inline constexpr double kFar_m = 500.0;

/// One image as the renderer needs it: row v shows the ray ((u - cx) / fx, row_scale (v - row_cy) , 1).
struct View {
    Pose T_n_c{};
    int width{0};
    int height{0};
    double fx{1};
    double cx{0};
    double row_cy{0};
    double row_scale{1};
    int samples{4};
    [[nodiscard]] double ray_x(double u) const { return (u - cx) / fx; }
    [[nodiscard]] double ray_y(double v) const { return row_scale * (v - row_cy); }
};

/// Places of the samples in a pixel, relative to its centre: as many columns and rows as samples (rooks), so that
/// nearly vertical and nearly horizontal edges move in steps of 1/samples pixel.
struct SampleGrid {
    std::array<double, kMaxSamples> du{};
    std::array<double, kMaxSamples> dv{};
};
[[nodiscard]] SampleGrid sample_grid(int samples);

/// A linear function of the ray: a x + b y + c.
struct Linear {
    double a{0};
    double b{0};
    double c{0};
    [[nodiscard]] double at(double x, double y) const { return a * x + b * y + c; }
};

/// What shading needs of a face; its index is the sample's id. Id 0 is the sky.
struct Shade {
    Surface surface{};
    Linear s{};  ///< texture coordinate s = s(ray) / q + s0
    Linear t{};
    double s0{0};
    double t0{0};
    Linear q{};
    float direct{0};     ///< share of the sun on a flat face
    float skylight{1};   ///< share of the ambient light
    bool ground{false};  ///< flat: shadows fall on it
    int owner{-1};       ///< road user's index; -1: background
    const Piece* ellipsoid{nullptr};
};

/// A piece prepared for one view.
struct Target {
    struct Plane {
        Linear q{};
        std::uint32_t id{0};
    };
    std::vector<Plane> fronts{};
    std::vector<Linear> backs{};
    const Piece* ellipsoid{nullptr};
    Vec3 origin{Vec3::Zero()};  ///< ellipsoid: camera in the unit sphere's coordinates
    Mat3 to_sphere{Mat3::Identity()};
    std::uint32_t id{0};
    int row0{0};
    int row1{-1};  ///< rows that can see it
    double u0{0};
    double u1{-1};
};

/// Adds the piece's faces to `shades` and returns what to trace; no rows if the view cannot see it.
[[nodiscard]] Target prepare(const View& view, const Piece& piece, int owner, std::vector<Shade>& shades);

/// Samples of one row: for each of the pixel's samples a line of width pixels.
struct RowSamples {
    int width{0};
    std::array<std::vector<float>, kMaxSamples> q{};
    std::array<std::vector<std::uint32_t>, kMaxSamples> id{};
    void resize(int w, int samples);
    void clear(int samples);
};

/// Columns [first, last] that a trace may have touched.
struct Span {
    int first{1 << 30};
    int last{-1};
    void add(int from, int to) {
        first = from < first ? from : first;
        last = to > last ? to : last;
    }
};

/// Keeps the nearer of what is there and the target. Returns the touched span over all samples.
Span trace_row(const View& view, const SampleGrid& grid, const Target& target, int row, RowSamples& out);

}  // namespace semtrack::sil::world

#endif

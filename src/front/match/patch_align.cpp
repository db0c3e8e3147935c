#include "front/match/patch_align.hpp"

#include <cmath>

namespace semtrack {

namespace {

constexpr int kIterations = 12;
constexpr float kSettled_px = 0.02F;
constexpr float kMinTexture = 300.0F;  // sum of squared gradients over the patch: below, noise decides
constexpr int kSource = kPatch + 2;    // with one more pixel around for gradients

int floor_int(float x) {
    const int i = static_cast<int>(x);
    return x < static_cast<float>(i) ? i - 1 : i;
}

/// Bilinear sample of the reference patch at offset (x, y) from its middle; inside by contract.
float sample_reference(const ReferencePatch& reference, float x, float y) {
    constexpr float kMiddle = static_cast<float>(kReference / 2);
    const float fx = x + kMiddle;
    const float fy = y + kMiddle;
    int ix = floor_int(fx);
    int iy = floor_int(fy);
    ix = ix < 0 ? 0 : ix > kReference - 2 ? kReference - 2 : ix;
    iy = iy < 0 ? 0 : iy > kReference - 2 ? kReference - 2 : iy;
    const float ax = fx - static_cast<float>(ix);
    const float ay = fy - static_cast<float>(iy);
    const std::uint8_t* p = reference.data() + iy * kReference + ix;
    const float top = static_cast<float>(p[0]) + ax * static_cast<float>(p[1] - p[0]);
    const float bottom = static_cast<float>(p[kReference]) + ax * static_cast<float>(p[kReference + 1] - p[kReference]);
    return top + ay * (bottom - top);
}

}  // namespace

bool take_reference(const ImageView& image, float u, float v, ReferencePatch& out) {
    constexpr int kHalf = kReference / 2;
    const int x0 = floor_int(u) - kHalf;
    const int y0 = floor_int(v) - kHalf;
    if (x0 < 0 || y0 < 0 || x0 + kReference + 1 > image.width || y0 + kReference + 1 > image.height) {
        return false;
    }
    // Weights in 1/64 px: integers, so that the stored patch is the same everywhere.
    const int ax = static_cast<int>((u - static_cast<float>(floor_int(u))) * 64.0F + 0.5F);
    const int ay = static_cast<int>((v - static_cast<float>(floor_int(v))) * 64.0F + 0.5F);
    for (int r = 0; r < kReference; ++r) {
        const std::uint8_t* a = image.row(y0 + r) + x0;
        const std::uint8_t* b = image.row(y0 + r + 1) + x0;
        for (int c = 0; c < kReference; ++c) {
            const int top = a[c] * (64 - ax) + a[c + 1] * ax;
            const int bottom = b[c] * (64 - ax) + b[c + 1] * ax;
            out[static_cast<std::size_t>(r * kReference + c)] =
                static_cast<std::uint8_t>((top * (64 - ay) + bottom * ay + 2048) >> 12);
        }
    }
    return true;
}

bool PatchTemplate::build(const ReferencePatch& reference, float scale) {
    float source[kSource * kSource];
    const float inverse = 1.0F / scale;
    for (int r = 0; r < kSource; ++r) {
        const float y = static_cast<float>(r - kSource / 2) * inverse;
        for (int c = 0; c < kSource; ++c) {
            source[r * kSource + c] = sample_reference(reference, static_cast<float>(c - kSource / 2) * inverse, y);
        }
    }
    float mean = 0.0F;
    float mean_u = 0.0F;
    float mean_v = 0.0F;
    std::size_t i = 0;
    for (int r = 0; r < kPatch; ++r) {
        for (int c = 0; c < kPatch; ++c, ++i) {
            const float* p = source + (r + 1) * kSource + c + 1;
            value_[i] = p[0];
            gu_[i] = 0.5F * (p[1] - p[-1]);
            gv_[i] = 0.5F * (p[kSource] - p[-kSource]);
            mean += value_[i];
            mean_u += gu_[i];
            mean_v += gv_[i];
        }
    }
    constexpr float kShare = 1.0F / static_cast<float>(kPixels);
    mean *= kShare;
    mean_u *= kShare;
    mean_v *= kShare;
    norm_ = huu_ = huv_ = hvv_ = 0.0F;
    for (std::size_t k = 0; k < kPixels; ++k) {
        value_[k] -= mean;
        gu_[k] -= mean_u;
        gv_[k] -= mean_v;
        norm_ += value_[k] * value_[k];
        huu_ += gu_[k] * gu_[k];
        huv_ += gu_[k] * gv_[k];
        hvv_ += gv_[k] * gv_[k];
    }
    norm_ = std::sqrt(norm_);
    return huu_ + hvv_ > kMinTexture && norm_ > 1.0F;
}

bool PatchTemplate::residual(const ImageView& image, float u, float v, float& bu, float& bv, float& ncc) const {
    const int x0 = floor_int(u) - kPatchHalf;
    const int y0 = floor_int(v) - kPatchHalf;
    if (x0 < 0 || y0 < 0 || x0 + kPatch + 1 > image.width || y0 + kPatch + 1 > image.height) {
        return false;
    }
    const float ax = u - static_cast<float>(floor_int(u));
    const float ay = v - static_cast<float>(floor_int(v));
    const float w00 = (1.0F - ax) * (1.0F - ay);
    const float w01 = ax * (1.0F - ay);
    const float w10 = (1.0F - ax) * ay;
    const float w11 = ax * ay;
    float sample[kPixels];
    float mean = 0.0F;
    std::size_t i = 0;
    for (int r = 0; r < kPatch; ++r) {
        const std::uint8_t* a = image.row(y0 + r) + x0;
        const std::uint8_t* b = image.row(y0 + r + 1) + x0;
        for (int c = 0; c < kPatch; ++c, ++i) {
            sample[i] = w00 * static_cast<float>(a[c]) + w01 * static_cast<float>(a[c + 1]) +
                        w10 * static_cast<float>(b[c]) + w11 * static_cast<float>(b[c + 1]);
            mean += sample[i];
        }
    }
    mean *= 1.0F / static_cast<float>(kPixels);
    bu = bv = 0.0F;
    float dot = 0.0F;
    float square = 0.0F;
    for (std::size_t k = 0; k < kPixels; ++k) {
        const float s = sample[k] - mean;
        const float e = s - value_[k];
        bu += gu_[k] * e;
        bv += gv_[k] * e;
        dot += s * value_[k];
        square += s * s;
    }
    ncc = square > 1.0F ? dot / (std::sqrt(square) * norm_) : 0.0F;
    return true;
}

bool PatchTemplate::align(const ImageView& image, float max_shift_px, float& u, float& v, float& ncc) const {
    const float determinant = huu_ * hvv_ - huv_ * huv_;
    if (!(determinant > 1e-3F * huu_ * hvv_) || !(determinant > 1.0F)) {
        return false;
    }
    const float inverse = 1.0F / determinant;
    const float u0 = u;
    const float v0 = v;
    for (int k = 0; k < kIterations; ++k) {
        float bu = 0.0F;
        float bv = 0.0F;
        if (!residual(image, u, v, bu, bv, ncc)) {
            return false;
        }
        const float du = inverse * (hvv_ * bu - huv_ * bv);
        const float dv = inverse * (huu_ * bv - huv_ * bu);
        u -= du;
        v -= dv;
        const float su = u - u0;
        const float sv = v - v0;
        if (!(su * su + sv * sv < max_shift_px * max_shift_px)) {
            return false;
        }
        if (du * du + dv * dv < kSettled_px * kSettled_px) {
            return true;
        }
    }
    return false;
}

bool PatchTemplate::align_row(const ImageView& image, float max_shift_px, float& u, float v, float& ncc) const {
    if (!(huu_ > 0.5F * kMinTexture)) {
        return false;
    }
    const float u0 = u;
    for (int k = 0; k < kIterations; ++k) {
        float bu = 0.0F;
        float bv = 0.0F;
        if (!residual(image, u, v, bu, bv, ncc)) {
            return false;
        }
        const float du = bu / huu_;
        u -= du;
        const float su = u - u0;
        if (!(su * su < max_shift_px * max_shift_px)) {
            return false;
        }
        if (du * du < kSettled_px * kSettled_px) {
            return true;
        }
    }
    return false;
}

}  // namespace semtrack

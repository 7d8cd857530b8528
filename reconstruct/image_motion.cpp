#include "reconstruct/image_motion.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

/// An image at half size, with a 1 2 1 blur along both axes: 64 grey levels for each of the eight
/// pixels of a pair that make up one of its own.
struct HalfImage {
    int width = 0;
    int height = 0;
    const std::uint16_t* pixels = nullptr;

    const std::uint16_t* row(int y) const { return pixels + std::ptrdiff_t(y) * width; }
};

void sumPairRow(const StripeImages& images, int pair, int y, int half_width, std::uint16_t* out) {
    for (int x = 0; x < half_width; ++x) out[x] = 0;
    for (int dy = 0; dy < 2; ++dy) {
        const std::uint8_t* p = images.patternRow(pair, 2 * y + dy);
        const std::uint8_t* c = images.complementRow(pair, 2 * y + dy);
        for (int x = 0; x < half_width; ++x) {
            out[x] = std::uint16_t(out[x] + p[2 * x] + p[2 * x + 1] + c[2 * x] + c[2 * x + 1]);
        }
    }
}

HalfImage blurredHalf(const StripeImages& images, int pair, ImageMotionScratch& scratch,
                      std::vector<std::uint16_t>& out) {
    const int width = images.width / 2;
    const int height = images.height / 2;
    std::vector<std::uint16_t>& halved = scratch.halved;
    halved.resize(std::size_t(width) * height);
    out.resize(halved.size());
    scratch.row.resize(width);
    for (int y = 0; y < height; ++y) {
        std::uint16_t* sums = scratch.row.data();
        sumPairRow(images, pair, y, width, sums);
        std::uint16_t* blurred = halved.data() + std::size_t(y) * width;
        blurred[0] = std::uint16_t(4 * sums[0]);
        blurred[width - 1] = std::uint16_t(4 * sums[width - 1]);
        for (int x = 1; x + 1 < width; ++x) {
            blurred[x] = std::uint16_t(sums[x - 1] + 2 * sums[x] + sums[x + 1]);
        }
    }
    for (int y = 0; y < height; ++y) {
        const std::uint16_t* above = halved.data() + std::size_t(std::max(y - 1, 0)) * width;
        const std::uint16_t* here = halved.data() + std::size_t(y) * width;
        const std::uint16_t* below =
            halved.data() + std::size_t(std::min(y + 1, height - 1)) * width;
        std::uint16_t* blurred = out.data() + std::size_t(y) * width;
        for (int x = 0; x < width; ++x) {
            blurred[x] = std::uint16_t(above[x] + 2 * here[x] + below[x]);
        }
    }
    return {width, height, out.data()};
}

/// Which pixels of the half image show the measured surface.
void findSurface(const VertexGrid& grid, int width, int height, std::vector<std::uint8_t>& on) {
    on.assign(std::size_t(width) * height, 0);
    for (int code = 1; code < grid.codes; ++code) {
        for (int column = 0; column < 2 * width; ++column) {
            const std::size_t i = grid.index(code, column);
            if (grid.cell[i] != Cell::measured) continue;
            // Stripe edges lie a few pixels apart: each stands for the rows around it.
            const int row = int(grid.y[i] * 0.5f);
            for (int y = std::max(row - 1, 0); y <= std::min(row + 1, height - 1); ++y) {
                on[std::size_t(y) * width + column / 2] = 1;
            }
        }
    }
}

/// The unknowns of a registration, in pixels of the half image:
/// current(motion(p)) = gain · reference(p) + offset.
struct Registration {
    ImageMotion motion;
    float gain = 1;
    float offset = 0;
};

class Registrar {
public:
    Registrar(const HalfImage& reference, const HalfImage& current,
              const std::vector<std::uint8_t>& on_surface, const ImagePoint& middle)
        : reference_(reference), current_(current), on_surface_(on_surface), middle_(middle) {}

    /// Gauss–Newton steps from `state`; false where the images do not determine a motion.
    bool refine(Registration& state) const {
        constexpr int kSteps = 3;
        float scale = 0;
        for (int step = 0; step < kSteps; ++step) {
            if (!improve(state, scale)) return false;
            const ImageMotion& m = state.motion;
            if (std::fabs(m.column) > kLargestShift || std::fabs(m.y) > kLargestShift ||
                std::fabs(m.turn) > kLargestTurn || std::fabs(m.scale) > kLargestTurn) {
                return false;
            }
        }
        return true;
    }

private:
    static constexpr float kLargestShift = 8;     // px of the half image
    static constexpr float kLargestTurn = 0.02f;  // rad; the same for the scale
    static constexpr int kSpacing = 3;   // of the pixels that are used, in rows and columns
    static constexpr float kCut = 3.0f;  // mean absolute residuals
    using Equations = NormalEquations<float, 6>;

    /// One step. `scale`, the mean absolute residual of the step before, sets the robust weights;
    /// 0 weighs all pixels alike.
    bool improve(Registration& state, float& scale) const {
        Equations equations;
        double residuals = 0;
        int count = 0;
        for (int y = 1; y + 1 < reference_.height; y += kSpacing) {
            // Sums of one row are added to the total, so that single precision suffices.
            Equations row_equations;
            for (int x = 1 + y / kSpacing % kSpacing; x + 1 < reference_.width; x += kSpacing) {
                if (!on_surface_[std::size_t(y) * reference_.width + x]) continue;
                Equations::Vector row;
                float residual;
                if (!observe(state, x, y, row, residual)) continue;
                float weight = 1;
                if (scale > 0) {
                    const float u = residual / (kCut * scale);
                    const float bell = 1 - u * u;
                    weight = bell > 0 ? bell * bell : 0.0f;
                }
                residuals += std::fabs(residual);
                ++count;
                row_equations.add(row, -residual, weight);
            }
            equations.add(row_equations);
        }
        constexpr int kFewest = 500;
        if (count < kFewest) return false;
        Equations::Vector step{};
        if (!equations.solve(step)) return false;
        state.motion.column += step[0];
        state.motion.y += step[1];
        state.motion.turn += step[2] * kPerLever;
        state.motion.scale += step[3] * kPerLever;
        state.gain += step[4];
        state.offset += step[5];
        scale = float(residuals / count);
        return true;
    }

    /// The residual at a pixel of the reference, and its change with the unknowns; false where the
    /// pixel leaves the image.
    bool observe(const Registration& state, int x, int y, Equations::Vector& row,
                 float& residual) const {
        const ImageMotion& m = state.motion;
        const float lever_x = float(x) - middle_.column;
        const float lever_y = float(y) - middle_.y;
        const float px = float(x) + m.column + m.scale * lever_x - m.turn * lever_y;
        const float py = float(y) + m.y + m.scale * lever_y + m.turn * lever_x;
        if (!(px >= 0) || !(py >= 0)) return false;
        const int ix = int(px);
        const int iy = int(py);
        if (ix + 1 >= current_.width || iy + 1 >= current_.height) return false;
        const float fx = px - float(ix);
        const float fy = py - float(iy);
        const std::uint16_t* upper = current_.row(iy) + ix;
        const std::uint16_t* lower = current_.row(iy + 1) + ix;
        const float top = float(upper[0]) + fx * float(upper[1] - upper[0]);
        const float bottom = float(lower[0]) + fx * float(lower[1] - lower[0]);
        const float value = kUnit * (top + fy * (bottom - top));

        const std::uint16_t* here = reference_.row(y) + x;
        const float level = kUnit * float(here[0]);
        const float gradient_x = 0.5f * kUnit * float(here[1] - here[-1]) * state.gain;
        const float gradient_y =
            0.5f * kUnit * float(here[reference_.width] - here[-reference_.width]) * state.gain;
        residual = value - state.gain * level - state.offset;
        row = {gradient_x,
               gradient_y,
               kPerLever * (gradient_y * lever_x - gradient_x * lever_y),
               kPerLever * (gradient_x * lever_x + gradient_y * lever_y),
               -level,
               -1.0f};
        return true;
    }

    // Bring the unknowns' coefficients to similar size.
    static constexpr float kPerLever = 1.0f / 64;
    // Brings levels near 0 … 1, where all unknowns have similar weight.
    static constexpr float kUnit = 1.0f / (8 * 16 * 255);

    const HalfImage& reference_;
    const HalfImage& current_;
    const std::vector<std::uint8_t>& on_surface_;
    ImagePoint middle_;  // px of the half image
};

}  // namespace

std::array<ImageMotion, kMaxBits> estimateImageMotion(const StripeImages& images,
                                                      const VertexGrid& grid,
                                                      const ImagePoint& middle,
                                                      ImageMotionScratch& scratch) {
    std::array<ImageMotion, kMaxBits> motions{};
    const HalfImage reference = blurredHalf(images, images.bits - 1, scratch, scratch.reference);
    findSurface(grid, reference.width, reference.height, scratch.on_surface);
    // The middle of a half image's pixel lies half a pixel further on.
    const ImagePoint half_middle{0.5f * middle.column - 0.25f, 0.5f * middle.y - 0.25f};
    Registration state;
    // From the pair next in time to the reference to the first: each starts where the one after
    // it ended.
    for (int pair = images.bits - 2; pair >= 0; --pair) {
        const HalfImage current = blurredHalf(images, pair, scratch, scratch.current);
        if (!Registrar(reference, current, scratch.on_surface, half_middle).refine(state)) {
            state = {};
            continue;
        }
        const ImageMotion& m = state.motion;
        motions[pair] = {2 * m.column, 2 * m.y, m.turn, m.scale};
    }
    return motions;
}

}  // namespace facescan

#include "reconstruct/image_motion.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/kernels/kernels.h"
#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

constexpr int kBlurredRows = 3;  // that one of a half image's rows is made of

/// One of the half images.
struct HalfImage {
    HalfImage(const HalfImages& halves, int pair)
        : width(halves.width), height(halves.height), pixels(halves.row(pair, 0)) {}

    int width;
    int height;
    const std::uint16_t* pixels;

    const std::uint16_t* row(int y) const { return pixels + std::ptrdiff_t(y) * width; }
};

/// The pixels of a half image that are registered lie so far apart in rows and columns.
constexpr int kSpacing = 3;
// Brings levels near 0 … 1, where all unknowns have similar weight.
constexpr float kUnit = 1.0f / (8 * 16 * 255);

/// Picks the pixels that show the measured surface.
void pickPixels(const HalfImage& reference, const VertexGrid& grid, const ImagePoint& middle,
                ImageMotionScratch& scratch) {
    const int across = reference.width / kSpacing;
    const int down = reference.height / kSpacing;
    scratch.on_surface.assign(std::size_t(across) * down, 0);
    for (int code = 1; code < grid.codes; ++code) {
        for (int n = 0; n < across; ++n) {
            const std::size_t i = grid.index(code, 2 * (kSpacing * n + 1));
            if (grid.cell[i] != Cell::measured) continue;
            // Stripe edges lie a few pixels apart: each stands for the rows around it.
            const int row = int(grid.y[i] * 0.5f) / kSpacing;
            if (row < down) scratch.on_surface[std::size_t(row) * across + n] = 1;
        }
    }

    for (std::vector<float>* plane : {&scratch.level, &scratch.gradient_x, &scratch.gradient_y,
                                      &scratch.lever_x, &scratch.lever_y}) {
        plane->clear();
    }
    for (int row = 0; row < down; ++row) {
        const int y = kSpacing * row + 1;
        if (y + 1 >= reference.height) break;
        for (int n = 0; n < across; ++n) {
            const int x = kSpacing * n + 1;
            if (!scratch.on_surface[std::size_t(row) * across + n]) continue;
            if (x + 1 >= reference.width) break;
            const std::uint16_t* here = reference.row(y) + x;
            const int dy = here[reference.width] - here[-reference.width];
            scratch.level.push_back(kUnit * float(here[0]));
            scratch.gradient_x.push_back(0.5f * kUnit * float(here[1] - here[-1]));
            scratch.gradient_y.push_back(0.5f * kUnit * float(dy));
            scratch.lever_x.push_back(float(x) - middle.column);
            scratch.lever_y.push_back(float(y) - middle.y);
        }
    }
    scratch.pixels = int(scratch.level.size());
    // What fills up the last group has no gradient and no level, and so no say.
    const int padded = (scratch.pixels + kSumLanes - 1) / kSumLanes * kSumLanes;
    for (std::vector<float>* plane : {&scratch.level, &scratch.gradient_x, &scratch.gradient_y,
                                      &scratch.lever_x, &scratch.lever_y}) {
        plane->resize(padded, 0.0f);
    }
    for (std::vector<float>* plane : {&scratch.part_x, &scratch.part_y, &scratch.weight}) {
        plane->resize(padded);
    }
    for (auto* plane : {&scratch.x, &scratch.y}) plane->resize(padded);
    for (auto& plane : scratch.warped) plane.resize(padded);
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
    Registrar(const HalfImage& current, const ImagePoint& middle, ImageMotionScratch& scratch)
        : current_(current), middle_(middle), scratch_(scratch) {}

    /// Gauss–Newton steps from `state`; false where the images do not determine a motion.
    bool refine(Registration& state) const {
        constexpr int kSteps = 4;
        constexpr float kSettled = 0.002f;  // px of the half image
        float scale = 0;
        for (int step = 0; step < kSteps; ++step) {
            const ImageMotion before = state.motion;
            if (!improve(state, scale)) return false;
            const ImageMotion& m = state.motion;
            if (std::fabs(m.column) > kLargestShift || std::fabs(m.y) > kLargestShift ||
                std::fabs(m.turn) > kLargestTurn || std::fabs(m.scale) > kLargestTurn) {
                return false;
            }
            // The first step is without robust weights.
            const bool settled = std::fabs(m.column - before.column) < kSettled &&
                                 std::fabs(m.y - before.y) < kSettled;
            if (step > 0 && settled) break;
        }
        return true;
    }

private:
    static constexpr float kLargestShift = 8;     // px of the half image
    static constexpr float kLargestTurn = 0.02f;  // rad; the same for the scale
    static constexpr float kCut = 3.0f;           // mean absolute residuals
    // Brings the unknowns' coefficients to similar size.
    static constexpr float kPerLever = 1.0f / 64;

    /// One step. `scale`, the mean absolute residual of the step before, sets the robust weights;
    /// 0 weighs all pixels alike.
    bool improve(Registration& state, float& scale) const {
        const float inside = warp(state.motion);
        constexpr float kFewest = 500;
        if (inside < kFewest) return false;

        SixSums sums;
        kernels().sumRegistration(pixels(), warped(),
                                  {.unit = kUnit,
                                   .gain = state.gain,
                                   .offset = state.offset,
                                   .per_lever = kPerLever,
                                   .inverse_cutoff = scale > 0 ? 1 / (kCut * scale) : 0.0f},
                                  sums);
        NormalEquations<float, 6> equations;
        equations.addSums(sums.products, sums.right);
        std::array<float, 6> step{};
        if (!equations.solve(step)) return false;
        state.motion.column += step[0];
        state.motion.y += step[1];
        state.motion.turn += step[2] * kPerLever;
        state.motion.scale += step[3] * kPerLever;
        state.gain += step[4];
        state.offset += step[5];
        scale = sums.residuals / inside;
        return true;
    }

    /// Looks up the current image where the motion takes the pixels. @returns how many stay inside
    float warp(const ImageMotion& m) const {
        kernels().warpPixels(pixels(),
                             {.x = m.column,
                              .y = m.y,
                              .turn = m.turn,
                              .scale = m.scale,
                              .middle_x = middle_.column,
                              .middle_y = middle_.y,
                              .last_x = float(current_.width - 1),
                              .last_y = float(current_.height - 1)},
                             warped());
        const int padded = int(scratch_.level.size());
        for (int i = scratch_.pixels; i < padded; ++i) scratch_.weight[i] = 0;
        int inside = 0;
        for (int i = 0; i < padded; ++i) {
            const std::uint16_t* upper = current_.row(scratch_.y[i]) + scratch_.x[i];
            const std::uint16_t* lower = upper + current_.width;
            scratch_.warped[0][i] = upper[0];
            scratch_.warped[1][i] = upper[1];
            scratch_.warped[2][i] = lower[0];
            scratch_.warped[3][i] = lower[1];
            inside += scratch_.weight[i] > 0;
        }
        return float(inside);
    }

    RegistrationPixels pixels() const {
        return {int(scratch_.level.size()), scratch_.level.data(),   scratch_.gradient_x.data(),
                scratch_.gradient_y.data(), scratch_.lever_x.data(), scratch_.lever_y.data()};
    }
    WarpedPixels warped() const {
        return {scratch_.x.data(),
                scratch_.y.data(),
                scratch_.part_x.data(),
                scratch_.part_y.data(),
                scratch_.weight.data(),
                {scratch_.warped[0].data(), scratch_.warped[1].data(), scratch_.warped[2].data(),
                 scratch_.warped[3].data()}};
    }

    const HalfImage& current_;
    ImagePoint middle_;  // px of the half image
    ImageMotionScratch& scratch_;
};

}  // namespace

void beginHalfImages(const StripeImages& images, HalfImages& halves) {
    halves.width = images.width / 2;
    halves.height = images.height / 2;
    halves.pairs = images.bits;
    halves.pixels.resize(std::size_t(halves.width) * halves.height * halves.pairs);
    halves.scratch.resize(std::size_t(halves.width) * kBlurredRows * halves.pairs);
}

void addRow(const StripeImages& images, int pair, int y, HalfImages& halves) {
    const int last = halves.height - 1;
    const auto halved = [&](int row) {
        const int slot = kBlurredRows * pair + std::clamp(row, 0, last) % kBlurredRows;
        return halves.scratch.data() + std::size_t(slot) * halves.width;
    };
    const auto blur = [&](int row) {
        kernels().blurRows(
            {halved(row - 1), halved(row), halved(row + 1)}, halves.width,
            halves.pixels.data() + (std::size_t(pair) * halves.height + row) * halves.width);
    };
    kernels().halveRows({images.patternRow(pair, 2 * y), images.patternRow(pair, 2 * y + 1),
                         images.complementRow(pair, 2 * y), images.complementRow(pair, 2 * y + 1)},
                        halves.width, halved(y));
    if (y > 0) blur(y - 1);
    if (y == last) blur(y);
}

std::array<ImageMotion, kMaxBits> estimateImageMotion(const HalfImages& halves,
                                                      const VertexGrid& grid,
                                                      const ImagePoint& middle,
                                                      ImageMotionScratch& scratch) {
    std::array<ImageMotion, kMaxBits> motions{};
    const int finest = halves.pairs - 1;
    // The middle of a half image's pixel lies half a pixel further on.
    const ImagePoint half_middle{0.5f * middle.column - 0.25f, 0.5f * middle.y - 0.25f};
    pickPixels(HalfImage(halves, finest), grid, half_middle, scratch);
    Registration state;
    // From the pair next in time to the reference to the first: each starts where the one after
    // it ended.
    for (int pair = finest - 1; pair >= 0; --pair) {
        const HalfImage current(halves, pair);
        if (!Registrar(current, half_middle, scratch).refine(state)) {
            state = {};
            continue;
        }
        const ImageMotion& m = state.motion;
        motions[pair] = {2 * m.column, 2 * m.y, m.turn, m.scale};
    }
    return motions;
}

}  // namespace facescan

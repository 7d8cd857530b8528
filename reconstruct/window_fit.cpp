#include "reconstruct/window_fit.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/normal_equations.h"

namespace facescan {
namespace {

constexpr int kTerms = 6;  // 1, v, u, v u, u², v²: v along the codes, u along the columns
constexpr int kMaxRows = 7;
constexpr int kLanes = 4;

/// Four numbers side by side: sums run in four lanes, in an order that no compiler changes.
using Lanes [[gnu::vector_size(kLanes * sizeof(float))]] = float;

/// A row of a window, padded with cells of no weight.
using Row = std::array<Lanes, 4>;

float total(const Lanes& lanes) {
    return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}
Lanes largerOf(const Lanes& a, const Lanes& b) {
    return a > b ? a : b;
}

/// The places of a window's columns, scaled to −1 … 1, and their powers.
struct ColumnPowers {
    std::array<Row, 5> power{};

    explicit ColumnPowers(const Window& window) {
        for (int x = 0; x <= 2 * window.half_columns; ++x) {
            const float u = float(x - window.half_columns) / float(window.half_columns);
            float power_of_u = 1;
            for (Row& row : power) {
                row[x / kLanes][x % kLanes] = power_of_u;
                power_of_u *= u;
            }
        }
    }
};

const ColumnPowers& columnPowers(int window) {
    static const std::array<ColumnPowers, kWindows.size()> table{
        ColumnPowers(kWindows[0]), ColumnPowers(kWindows[1]), ColumnPowers(kWindows[2])};
    return table[window];
}

std::vector<float> computeFixedWeights(const Window& window) {
    NormalEquations<double, kTerms> equations;
    std::vector<std::array<double, kTerms>> rows;
    for (int c = -window.half_codes; c <= window.half_codes; ++c) {
        for (int x = -window.half_columns; x <= window.half_columns; ++x) {
            const double v = double(c) / window.half_codes;
            const double u = double(x) / window.half_columns;
            rows.push_back({1, v, u, v * u, u * u, v * v});
            equations.add(rows.back(), 0, 1);
        }
    }
    // The value in the middle is linear in the data: solve for each cell's unit impulse.
    std::vector<float> weights;
    for (const auto& row : rows) {
        NormalEquations<double, kTerms> impulse = equations;
        impulse.addRight(row, 1);
        std::array<double, kTerms> solution{};
        impulse.solve(solution);
        weights.push_back(float(solution[0]));
    }
    return weights;
}

/// Sums of weight · uⁿ and of weight · uⁿ · value over a row of a window.
struct Moments {
    std::array<float, 5> weights;
    std::array<float, 3> values;
};

using Equations = NormalEquations<float, kTerms>;

/// Adds the equations of all cells of a row at the place v.
void addRow(const Moments& m, float v, Equations& equations) {
    const auto& w = m.weights;
    const auto& b = m.values;
    const float v2 = v * v;
    // Products of the terms 1, v, u, v u, u², v², the lower triangle row by row.
    equations.addSums(
        {{{w[0]},
          {v * w[0], v2 * w[0]},
          {w[1], v * w[1], w[2]},
          {v * w[1], v2 * w[1], v * w[2], v2 * w[2]},
          {w[2], v * w[2], w[3], v * w[3], w[4]},
          {v2 * w[0], v2 * v * w[0], v2 * w[1], v2 * v * w[1], v2 * w[2], v2 * v2 * w[0]}}},
        {b[0], v * b[0], b[1], v * b[1], b[2], v2 * b[0]});
}

/// The measured cells of a window, and a quadratic through them.
class WindowFit {
public:
    WindowFit(const VertexGrid& grid, int window, int code, int column, int half_codes)
        : powers_(columnPowers(window)), half_codes_(half_codes) {
        const Window& shape = kWindows[window];
        y0_ = grid.y[grid.index(code, column)];
        code_scale_ = 1.0f / float(shape.half_codes);
        for (int r = 0; r < rows(); ++r) {
            value_[r] = {};
            present_[r] = {};
            const int c = code + r - half_codes;
            if (c < 1 || c >= grid.codes) continue;
            const int first = std::max(column - shape.half_columns, 0);
            const int last = std::min(column + shape.half_columns, grid.columns - 1);
            for (int x = first; x <= last; ++x) {
                const std::size_t n = grid.index(c, x);
                if (grid.cell[n] != Cell::measured) continue;
                const int place = x - column + shape.half_columns;
                value_[r][place / kLanes][place % kLanes] = grid.y[n] - y0_;
                present_[r][place / kLanes][place % kLanes] = 1;
                ++count_;
            }
        }
        for (int r = 0; r < rows(); ++r) weight_[r] = present_[r];
    }

    int count() const { return count_; }

    bool solve() {
        Equations equations;
        for (int r = 0; r < rows(); ++r) addRow(momentsOf(r), codePlace(r), equations);
        for (int term = 1; term < kTerms; ++term) equations.damp(term, 1e-4f);
        return equations.solve(solution_);
    }

    /// Sets the weights by the residuals. @returns the largest residual
    float reweigh(float cutoff) {
        const float inverse = 1 / cutoff;
        Lanes largest{};
        Lanes support{};
        for (int r = 0; r < rows(); ++r) {
            const float v = codePlace(r);
            const float c0 = solution_[0] + v * (solution_[1] + v * solution_[5]);
            const float c1 = solution_[2] + v * solution_[3];
            const float c2 = solution_[4];
            for (std::size_t k = 0; k < value_[r].size(); ++k) {
                const Lanes& u = powers_.power[1][k];
                const Lanes residual = (value_[r][k] - (c0 + u * (c1 + u * c2))) * present_[r][k];
                const Lanes scaled = residual * inverse;
                const Lanes bell = largerOf(1 - scaled * scaled, Lanes{});
                weight_[r][k] = bell * bell * present_[r][k];
                support += weight_[r][k];
                largest = largerOf(largest, largerOf(residual, -residual));
            }
        }
        support_ = total(support);
        return std::max({largest[0], largest[1], largest[2], largest[3]});
    }

    float support() const { return support_; }
    float correction() const { return solution_[0]; }
    float y() const { return y0_ + solution_[0]; }

private:
    int rows() const { return 2 * half_codes_ + 1; }
    float codePlace(int row) const { return float(row - half_codes_) * code_scale_; }

    Moments momentsOf(int r) const {
        std::array<Lanes, 5> weights{};
        std::array<Lanes, 3> values{};
        for (std::size_t k = 0; k < value_[r].size(); ++k) {
            const Lanes& w = weight_[r][k];
            const Lanes wv = w * value_[r][k];
            for (int n = 0; n < 5; ++n) weights[n] += w * powers_.power[n][k];
            for (int n = 0; n < 3; ++n) values[n] += wv * powers_.power[n][k];
        }
        Moments moments;
        for (int n = 0; n < 5; ++n) moments.weights[n] = total(weights[n]);
        for (int n = 0; n < 3; ++n) moments.values[n] = total(values[n]);
        return moments;
    }

    const ColumnPowers& powers_;
    int half_codes_;
    float code_scale_ = 1;
    float y0_ = 0;
    int count_ = 0;
    float support_ = 0;
    std::array<Row, kMaxRows> value_;
    std::array<Row, kMaxRows> weight_;
    std::array<Row, kMaxRows> present_;
    std::array<float, kTerms> solution_{};
};

}  // namespace

const std::vector<float>& fixedWeights(int window) {
    static const std::array<std::vector<float>, kWindows.size()> table{
        computeFixedWeights(kWindows[0]), computeFixedWeights(kWindows[1]),
        computeFixedWeights(kWindows[2])};
    return table[window];
}

RobustFit robustFit(const VertexGrid& grid, int window, int code, int column, float cutoff,
                    int half_codes) {
    const int fewest = half_codes > 0 ? 8 : 5;
    const RobustFit inconsistent{grid.y[grid.index(code, column)], false};
    WindowFit fit(grid, window, code, column, half_codes);
    if (fit.count() < fewest) return inconsistent;
    for (const float shrink : {4.0f, 2.0f, 1.0f}) {
        if (!fit.solve()) return inconsistent;
        const float largest = fit.reweigh(shrink * cutoff);
        if (shrink == 4.0f && largest < 0.5f * cutoff) return {fit.y(), true};
    }
    if (fit.support() < float(fewest) || std::fabs(fit.correction()) >= cutoff) {
        return inconsistent;
    }
    return {fit.y(), true};
}

}  // namespace facescan

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facescan {

/// What a cell of the vertex grid holds.
enum class Cell : std::uint8_t {
    empty,
    measured,
    end,     ///< measured, but where the surface ends and a pixel shows what is behind it too
    filled,  ///< no edge was seen here; the place follows the surrounding surface
};

/// The columns of a row outside which all its cells are empty: first … end − 1.
struct Extent {
    int first = 0;
    int end = 0;
};

/// The stripe edges of a scan: one cell for each edge code and each image line across the stripes
/// (a "column"). Row c holds the edge between the stripes c − 1 and c; row 0 stays empty. Dense
/// planes of codes × columns cells, row after row, so that neighbours are known without search.
/// Where a cell is empty, the other planes hold anything.
struct VertexGrid {
    int codes = 0;
    int columns = 0;
    std::vector<Extent> extent;  ///< by code
    std::vector<Cell> cell;
    std::vector<float> y;  ///< where the edge crosses the column, px in the stripe image

    // The light around the edge, in the frames of its own pair.
    std::vector<float> contrast;    ///< steepness of P − C along y, grey levels per px; 0: filled
    std::vector<float> gradient_x;  ///< relative change of P + C per px along the columns' axis
    std::vector<float> gradient_y;  ///< … along y
    std::vector<float> drift_gain;  ///< how far the edge moves along y for a relative change of the
                                    ///< brightness from pattern to complement, px

    /// Quads that no surface spans although their corners are there, by their first cell.
    std::vector<std::uint32_t> gaps;

    std::vector<float> scratch;  ///< of the size of `y` where a stage needs the old and the new

    std::size_t index(int code, int column) const { return std::size_t(code) * columns + column; }
    std::size_t size() const { return std::size_t(codes) * columns; }

    /// The planes hold so many more than cells: what reads a few cells on from the last one stays
    /// inside.
    static constexpr int kBeyond = 16;

    /// Makes all cells empty.
    void reset(int code_count, int column_count) {
        codes = code_count;
        columns = column_count;
        extent.assign(codes, {columns, 0});
        cell.assign(size() + kBeyond, Cell::empty);
        gaps.clear();
        for (std::vector<float>* plane :
             {&y, &contrast, &gradient_x, &gradient_y, &drift_gain, &scratch}) {
            plane->resize(size() + kBeyond);
        }
    }
};

/// Flags, by cell, where a grid is measured; readable as far beyond the last cell as its planes.
inline void markMeasured(const VertexGrid& grid, std::vector<std::uint8_t>& measured) {
    measured.resize(grid.size() + VertexGrid::kBeyond);
    for (std::size_t i = 0; i < grid.size(); ++i) measured[i] = grid.cell[i] == Cell::measured;
}

}  // namespace facescan

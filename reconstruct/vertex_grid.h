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

/// The light around a stripe edge, in the frames of its own pair.
struct EdgeLight {
    float contrast = 0;    ///< steepness of pattern − complement along y, grey levels per px
    float sense = 1;       ///< 1 where the pattern gets brighter with y, −1 where darker
    float brightness = 0;  ///< pattern + complement, grey levels: the scene as if evenly lit
    float gradient_x = 0;  ///< relative change of the brightness per px along the columns' axis
    float gradient_y = 0;  ///< … along y
};

/// The stripe edges of a scan: one cell for each edge code and each image line across the stripes
/// (a "column"). Row c holds the edge between the stripes c − 1 and c; row 0 stays empty. Dense
/// arrays of codes × columns cells, row after row, so that neighbours are known without search.
struct VertexGrid {
    int codes = 0;
    int columns = 0;
    std::vector<Cell> cell;
    std::vector<float> y;  ///< where the edge crosses the column, px in the stripe image
    std::vector<EdgeLight> light;
    std::vector<float> scratch;  ///< of the size of `y` where a stage needs the old and the new
    std::vector<Cell> scratch_cell;

    std::size_t index(int code, int column) const { return std::size_t(code) * columns + column; }
    std::size_t size() const { return std::size_t(codes) * columns; }

    /// Makes all cells empty.
    void reset(int code_count, int column_count) {
        codes = code_count;
        columns = column_count;
        cell.assign(size(), Cell::empty);
        y.assign(size(), 0.0f);
        light.assign(size(), {});
    }
};

}  // namespace facescan

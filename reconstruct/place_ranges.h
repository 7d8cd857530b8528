#pragma once

#include <cstddef>
#include <vector>

namespace facescan {

/// Between which places of a column the edge of each code can lie, where the surface is in the
/// measurement range. Neighbouring columns share one range.
class PlaceRanges {
public:
    static constexpr int kColumns = 32;

    struct Range {
        float first;  ///< px
        float last;
    };

    /// No edge is out of range.
    void clear() { ranges_.clear(); }
    /// All ranges of `codes` codes and `columns` columns, to be set through at().
    void resize(int codes, int columns) {
        blocks_ = blocksOf(columns);
        ranges_.assign(std::size_t(codes) * blocks_, {});
    }
    static int blocksOf(int columns) { return (columns + kColumns - 1) / kColumns; }

    Range& at(int code, int block) { return ranges_[std::size_t(code) * blocks_ + block]; }

    /// Whether an edge between the rows y and y + 1 can be in range.
    bool mayHold(int code, int column, int y) const {
        if (ranges_.empty()) return true;
        const Range& range = ranges_[std::size_t(code) * blocks_ + column / kColumns];
        return !(float(y + 1) < range.first || float(y) > range.last);
    }

private:
    int blocks_ = 0;
    std::vector<Range> ranges_;
};

}  // namespace facescan

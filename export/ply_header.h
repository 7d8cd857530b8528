#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace facescan {

/// Where a PLY file by the bundle format ("mesh.ply") keeps what.
struct PlyHeader {
    static constexpr std::size_t kAbsent = SIZE_MAX;

    std::size_t size = 0;  ///< bytes; the vertices begin here
    std::string texture_file;
    std::uint64_t vertices = 0;    ///< as the file claims
    std::uint64_t faces = 0;       ///< as the file claims
    std::size_t vertex_bytes = 0;  ///< from one vertex to the next
    std::array<std::size_t, 9>
        field;  ///< byte offset of Vertex' members; kAbsent only for nx ny nz

    bool hasNormals() const {
        return field[3] != kAbsent && field[4] != kAbsent && field[5] != kAbsent;
    }
};

/// Reads the header at the beginning of a file's bytes. Throws std::runtime_error with the cause.
PlyHeader parsePlyHeader(std::string_view bytes);

}  // namespace facescan

#include "export/read_mesh.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

#include "export/ply_header.h"
#include "export/png.h"

namespace facescan {
namespace fs = std::filesystem;

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as in the file");

constexpr std::size_t kFaceBytes = 1 + sizeof(Triangle);

[[noreturn]] void fail(const std::string& cause) {
    throw std::runtime_error(cause);
}

std::string readFile(const fs::path& file) {
    // A pipe or a device might never end.
    if (!fs::exists(file)) fail("no such file");
    if (!fs::is_regular_file(file)) fail("not a regular file");
    std::ifstream stream(file, std::ios::binary);
    const std::uintmax_t size = stream ? fs::file_size(file) : 0;
    std::string bytes;
    if (size > bytes.max_size()) fail("too large for the memory of this machine");
    bytes.resize(std::size_t(size));
    stream.read(bytes.data(), std::streamsize(bytes.size()));
    if (!stream) fail("cannot be read");
    return bytes;
}

/// Holds the sizes that the header claims against the size that the file has.
void checkSize(const PlyHeader& header, std::size_t file_size) {
    std::uint64_t left = file_size - header.size;
    if (header.vertices > left / header.vertex_bytes) {
        fail("too short for the " + std::to_string(header.vertices) + " vertices of its header");
    }
    left -= header.vertices * header.vertex_bytes;
    if (header.faces > left / kFaceBytes) {
        fail("too short for the " + std::to_string(header.faces) + " triangles of its header");
    }
    left -= header.faces * kFaceBytes;
    if (left != 0) fail(std::to_string(left) + " bytes after the last triangle");
}

Vertex parseVertex(const char* bytes, const PlyHeader& header, std::size_t index) {
    std::array<float, 9> values{};
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (header.field[k] == PlyHeader::kAbsent) continue;
        std::memcpy(&values[k], bytes + header.field[k], sizeof(float));
        if (!std::isfinite(values[k])) {
            fail("vertex " + std::to_string(index) + " has a number that is not finite");
        }
    }
    const auto vertex = std::bit_cast<Vertex>(values);
    if (vertex.quality < 0 || vertex.quality > 1) {
        fail("vertex " + std::to_string(index) + " has a quality of " +
             std::to_string(vertex.quality) + "; 0 to 1 expected");
    }
    return vertex;
}

Triangle parseTriangle(const char* bytes, std::size_t vertices, std::size_t index) {
    if (bytes[0] != 3) {
        fail("face " + std::to_string(index) + " has " +
             std::to_string(static_cast<unsigned char>(bytes[0])) + " corners; triangles expected");
    }
    Triangle triangle;
    std::memcpy(triangle.data(), bytes + 1, sizeof(Triangle));
    for (const std::uint32_t vertex : triangle) {
        if (vertex >= vertices) {
            fail("triangle " + std::to_string(index) + " names vertex " + std::to_string(vertex) +
                 " of " + std::to_string(vertices));
        }
    }
    return triangle;
}

Mesh parseMesh(std::string_view bytes, const PlyHeader& header) {
    checkSize(header, bytes.size());
    // Of a file that is in memory: no number is too large for it.
    const auto vertices = std::size_t(header.vertices);
    const auto faces = std::size_t(header.faces);
    Mesh mesh;
    mesh.vertices.reserve(vertices);
    mesh.triangles.reserve(faces);
    const char* cursor = bytes.data() + header.size;
    for (std::size_t k = 0; k < vertices; ++k, cursor += header.vertex_bytes) {
        mesh.vertices.push_back(parseVertex(cursor, header, k));
    }
    for (std::size_t k = 0; k < faces; ++k, cursor += kFaceBytes) {
        mesh.triangles.push_back(parseTriangle(cursor, vertices, k));
    }
    return mesh;
}

/// The mean of the normals of a vertex' faces, weighted by their areas.
void computeNormals(Mesh& mesh) {
    for (Vertex& v : mesh.vertices) v.nx = v.ny = v.nz = 0;
    for (const Triangle& triangle : mesh.triangles) {
        const Vertex& a = mesh.vertices[triangle[0]];
        const Vertex& b = mesh.vertices[triangle[1]];
        const Vertex& c = mesh.vertices[triangle[2]];
        const float ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const float vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
        for (const std::uint32_t corner : triangle) {
            Vertex& vertex = mesh.vertices[corner];
            vertex.nx += uy * vz - uz * vy;
            vertex.ny += uz * vx - ux * vz;
            vertex.nz += ux * vy - uy * vx;
        }
    }
    for (Vertex& v : mesh.vertices) {
        const float length = std::sqrt(v.nx * v.nx + v.ny * v.ny + v.nz * v.nz);
        const bool usable = length > 0 && std::isfinite(length);
        v.nx = usable ? v.nx / length : 0;
        v.ny = usable ? v.ny / length : 0;
        v.nz = usable ? v.nz / length : -1;  // towards the camera
    }
}

/// Runs a step whose errors are causes without a path, and puts the path in front.
template <typename Step>
auto named(const fs::path& file, Step step) {
    try {
        return step();
    } catch (const std::exception& error) {
        throw ReadError(file.string() + ": " + error.what());
    }
}

}  // namespace

TexturedMesh readMesh(const fs::path& file) {
    TexturedMesh result;
    const PlyHeader header = named(file, [&] {
        const std::string bytes = readFile(file);
        PlyHeader parsed = parsePlyHeader(bytes);
        result.mesh = parseMesh(bytes, parsed);
        return parsed;
    });
    if (!header.hasNormals()) computeNormals(result.mesh);

    const fs::path texture_file = file.parent_path() / header.texture_file;
    result.texture = named(texture_file, [&] { return parseGreyPng(readFile(texture_file)); });
    return result;
}

}  // namespace facescan

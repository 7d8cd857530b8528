// Own text, not Assimp's, the only OBJ writer in Debian 12: that one takes 30 times as long for a
// face, cannot state units and axes, and brings 10 MB of library for formats nobody asked for.
#include "export/obj.h"

#include <charconv>
#include <concepts>

namespace facescan {
namespace {

template <typename Number>
void append(std::string& out, Number value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), value).ptr;
    out.append(digits, end);
}

template <std::same_as<float>... Floats>
void appendLine(std::string& out, std::string_view keyword, Floats... values) {
    out += keyword;
    ((out += ' ', append(out, values)), ...);
    out += '\n';
}

/// A corner: position, texture coordinate and normal, numbered alike, from 1.
void appendCorner(std::string& out, std::uint32_t vertex) {
    const std::uint64_t number = std::uint64_t(vertex) + 1;
    out += ' ';
    for (const char* separator : {"/", "/", ""}) {
        append(out, number);
        out += separator;
    }
}

}  // namespace

void formatObj(const Mesh& mesh, std::string_view material_file, std::string& out) {
    out =
        "# made by facescan\n"
        "# units: mm\n"
        "# axes: X right, Y down, Z away from the camera, which is at the origin\n"
        "mtllib ";
    out += material_file;
    out += "\no face\n";
    for (const Vertex& v : mesh.vertices) appendLine(out, "v", v.x, v.y, v.z);
    for (const Vertex& v : mesh.vertices) appendLine(out, "vt", v.s, v.t);
    for (const Vertex& v : mesh.vertices) appendLine(out, "vn", v.nx, v.ny, v.nz);
    out += "usemtl face\n";
    for (const Triangle& triangle : mesh.triangles) {
        out += 'f';
        for (const std::uint32_t vertex : triangle) appendCorner(out, vertex);
        out += '\n';
    }
}

std::string formatMtl(std::string_view texture_file) {
    return "# made by facescan\n"
           "newmtl face\n"
           "Ka 1 1 1\n"
           "Kd 1 1 1\n"
           "Ks 0 0 0\n"
           "illum 1\n"
           "map_Kd " +
           std::string(texture_file) + "\n";
}

std::string objFileStem(std::string_view stem) {
    std::string safe(stem);
    for (char& c : safe) {
        const bool control_or_space = static_cast<unsigned char>(c) <= ' ' || c == '\x7f';
        if (control_or_space || c == '#' || c == '\\' || c == '"') c = '_';
    }
    if (safe.starts_with('-')) safe.front() = '_';
    return safe;
}

}  // namespace facescan

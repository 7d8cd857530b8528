#include "export/mesh_format.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "export/glb.h"
#include "export/obj.h"
#include "export/ply.h"
#include "export/png.h"
#include "export/stl.h"

namespace facescan {
namespace fs = std::filesystem;

namespace {

constexpr std::array kNames = {"ply", "obj", "stl", "glb"};

bool equalIgnoringCase(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
    return std::ranges::equal(a, b, {}, lower, lower);
}

std::string texturePng(const GreyImage& texture) {
    std::string png;
    formatPng(view(texture), png);
    return png;
}

// Each returns the files of one mesh, the one that names the others last.

std::vector<FileContent> plyFiles(const fs::path& file, const Mesh& mesh,
                                  const GreyImage& texture) {
    std::vector<FileContent> files(2);
    files[0] = {file.parent_path() / kPlyTextureName, texturePng(texture)};
    files[1].path = file;
    formatPly(mesh, files[1].bytes);
    return files;
}

std::vector<FileContent> objFiles(const fs::path& file, const Mesh& mesh,
                                  const GreyImage& texture) {
    const std::string stem = objFileStem(file.stem().string());
    const std::string material_name = stem + ".mtl";
    const std::string texture_name = stem + ".png";
    std::vector<FileContent> files(3);
    files[0] = {file.parent_path() / texture_name, texturePng(texture)};
    files[1] = {file.parent_path() / material_name, formatMtl(texture_name)};
    files[2].path = file;
    formatObj(mesh, material_name, files[2].bytes);
    return files;
}

std::vector<FileContent> stlFiles(const fs::path& file, const Mesh& mesh) {
    std::vector<FileContent> files(1);
    files[0].path = file;
    formatStl(mesh, files[0].bytes);
    return files;
}

std::vector<FileContent> glbFiles(const fs::path& file, const Mesh& mesh,
                                  const GreyImage& texture) {
    std::vector<FileContent> files(1);
    files[0].path = file;
    formatGlb(mesh, texturePng(texture), files[0].bytes);
    return files;
}

std::vector<FileContent> formatFiles(const fs::path& file, const Mesh& mesh,
                                     const GreyImage& texture, MeshFormat format) {
    switch (format) {
        case MeshFormat::ply:
            return plyFiles(file, mesh, texture);
        case MeshFormat::obj:
            return objFiles(file, mesh, texture);
        case MeshFormat::stl:
            return stlFiles(file, mesh);
        case MeshFormat::glb:
            return glbFiles(file, mesh, texture);
    }
    return {};
}

}  // namespace

const char* name(MeshFormat format) {
    return kNames[std::size_t(format)];
}

std::optional<MeshFormat> parseMeshFormat(std::string_view name) {
    for (std::size_t k = 0; k < kNames.size(); ++k) {
        if (equalIgnoringCase(name, kNames[k])) return MeshFormat(k);
    }
    return std::nullopt;
}

std::optional<MeshFormat> meshFormatOf(const fs::path& file) {
    const std::string extension = file.extension().string();
    return extension.empty() ? std::nullopt : parseMeshFormat(extension.substr(1));
}

void writeMesh(const fs::path& file, const Mesh& mesh, const GreyImage& texture, MeshFormat format,
               Durability durability) {
    std::vector<FileContent> files;
    try {
        files = formatFiles(file, mesh, texture, format);
    } catch (const std::exception& error) {
        throw WriteError("cannot write " + file.string() + ": " + error.what());
    }
    writeFiles(files, durability);
}

}  // namespace facescan

#include "cli/scan_files.h"

#include <algorithm>

#include "export/glb.h"
#include "export/obj.h"
#include "export/ply.h"
#include "export/png.h"
#include "export/stl.h"

namespace facescan {
namespace fs = std::filesystem;
namespace {

/// Every name that a replay gives to a file.
constexpr const char* kNames[] = {kMeshName,  "mesh.obj",    "mesh.mtl",    "mesh.stl",
                                  "mesh.glb", "texture.png", "preview.png", kReportName};

}  // namespace

std::string& ScanFiles::add(const char* name) {
    if (count_ == files_.size()) files_.emplace_back();
    FileContent& file = files_[count_++];
    file.path = name;
    return file.bytes;
}

std::string& ScanFiles::addPng(const char* name, const ImageView& image) {
    std::string& bytes = add(name);
    png_.format(image, bytes);
    return bytes;
}

void ScanFiles::addMesh(const Reconstruction& result, std::span<const MeshFormat> formats) {
    const auto wanted = [&](MeshFormat format) {
        return std::ranges::find(formats, format) != formats.end();
    };
    const Mesh& mesh = result.mesh;
    addPng(kPlyTextureName, view(result.texture));
    if (mesh.triangles.empty()) return;

    if (wanted(MeshFormat::glb)) {
        std::string& glb = add("mesh.glb");
        formatGlb(mesh, files_[count_ - 2].bytes, glb);
    }
    if (wanted(MeshFormat::obj)) {
        add("mesh.mtl") = formatMtl(kPlyTextureName);
        formatObj(mesh, "mesh.mtl", add("mesh.obj"));
    }
    if (wanted(MeshFormat::stl)) formatStl(mesh, add("mesh.stl"));
    formatPly(mesh, add(kMeshName));
}

std::vector<std::string> ScanFiles::names() const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < count_; ++k) names.push_back(files_[k].path.filename().string());
    return names;
}

std::vector<std::size_t> ScanFiles::sizes() const {
    std::vector<std::size_t> sizes;
    for (std::size_t k = 0; k < count_; ++k) sizes.push_back(files_[k].bytes.size());
    return sizes;
}

void ScanFiles::write(const fs::path& folder, Durability durability) {
    const std::vector<std::string> written = names();
    for (std::size_t k = 0; k < count_; ++k) files_[k].path = folder / written[k];
    std::vector<fs::path> obsolete;
    for (const char* name : kNames) {
        if (std::ranges::find(written, name) == written.end()) obsolete.push_back(folder / name);
    }
    writeFiles(std::span(files_).first(count_), durability, obsolete);
}

}  // namespace facescan

#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "export/atomic_file.h"
#include "export/mesh_format.h"
#include "export/png.h"
#include "reconstruct/reconstruct.h"

namespace facescan {

inline constexpr const char* kMeshName = "mesh.ply";
inline constexpr const char* kReportName = "report.json";

/// The results of one scan on their way into its folder. Their memory is used again for the next.
class ScanFiles {
public:
    /// Forgets the files of the scan before.
    void clear() { count_ = 0; }

    /// Begins a file. @returns its bytes, to be overwritten; valid until the next add()
    std::string& add(const char* name);

    /// Adds a picture. @returns its bytes, as add() does
    std::string& addPng(const char* name, const ImageView& image);

    /// Adds texture.png, and if there is a mesh, mesh.ply and the further formats.
    void addMesh(const Reconstruction& result, std::span<const MeshFormat> formats);

    std::vector<std::string> names() const;
    std::vector<std::size_t> sizes() const;  ///< bytes, in the order of names()

    /// Writes them: all or none, the last one last. Files of earlier results that are not among
    /// them are removed, so that a folder never mixes two scans, and never shows a report but of
    /// what stands there: writeFiles(). @throws WriteError
    void write(const std::filesystem::path& folder, Durability durability);

private:
    std::vector<FileContent> files_;  ///< the first count_ are this scan's
    std::size_t count_ = 0;
    PngEncoder png_;
};

}  // namespace facescan

/// thesis_replay BUNDLE OUT_DIR [--no-shift]: replays a scan through the thesis' pipeline. Writes
/// mesh.ply and texture.png into OUT_DIR, which exists.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>

#include "capture/bundle.h"
#include "export/mesh_format.h"
#include "thesis/thesis_pipeline.h"

using namespace facescan;

int main(int argc, char** argv) {
    const bool shift = argc == 3;
    if (!shift && !(argc == 4 && std::string_view(argv[3]) == "--no-shift")) {
        std::fprintf(stderr, "usage: thesis_replay BUNDLE OUT_DIR [--no-shift]\n");
        return 64;
    }
    try {
        const ScanBundle bundle = readBundle(argv[1]);
        const thesis::Result result =
            thesis::reconstruct(bundle.frames.view(), bundle.description, {.shift_frames = shift});
        writeMesh(std::filesystem::path(argv[2]) / "mesh.ply", result.mesh, result.texture,
                  MeshFormat::ply, Durability::buffered);
        for (const int rows : result.shifts_px) std::printf("%d ", rows);
        std::printf("\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "thesis_replay: %s\n", error.what());
        return 1;
    }
    return 0;
}

/// hash_scans BUNDLE...: reconstructs each scan, twice in the same memory, and prints a line for
/// it: the name, and hashes of the mesh, the texture and the numbers of the report.
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <type_traits>

#include "capture/bundle.h"
#include "reconstruct/reconstruct.h"

using namespace facescan;

namespace {

/// FNV-1a, 64 bits.
class Hash {
public:
    template <typename T>
    void addAll(const T* values, std::size_t count) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> ||
                      std::is_same_v<T, Vertex>);
        const auto* bytes = reinterpret_cast<const unsigned char*>(values);
        for (std::size_t i = 0; i < count * sizeof(T); ++i) {
            state_ = (state_ ^ bytes[i]) * 0x100000001b3;
        }
    }

    template <typename... T>
    void add(const T&... values) {
        (addAll(&values, 1), ...);
    }

    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0xcbf29ce484222325;
};

std::uint64_t hashOf(const Mesh& mesh) {
    Hash hash;
    hash.addAll(mesh.vertices.data(), mesh.vertices.size());
    hash.addAll(mesh.triangles.data(), mesh.triangles.size());
    return hash.value();
}

std::uint64_t hashOf(const GreyImage& image) {
    Hash hash;
    hash.add(image.width, image.height);
    hash.addAll(image.pixels.data(), image.pixels.size());
    return hash.value();
}

/// Field by field: a report has padding.
std::uint64_t hashOf(const Report& r) {
    Hash hash;
    hash.add(r.edges_found, r.edges_decoded, r.vertices_rejected, r.vertices_measured,
             r.vertices_filled, r.triangles, r.holes_found, r.holes_filled);
    hash.add(r.coverage, r.lit_share, r.saturated_share, r.modulation_median, r.noise_mm,
             r.motion_max_px, r.motion_max_mm);
    for (const PairMotion& pair : r.motion) hash.add(pair.dx_px, pair.dy_px, pair.shift_mm);
    hash.add(r.verdict, r.reason);
    return hash.value();
}

void printHashes(const std::filesystem::path& folder) {
    const ScanBundle bundle = readBundle(folder);
    Workspace workspace;
    Reconstruction result;
    for (int time = 0; time < 2; ++time) {
        reconstruct(bundle.frames.view(), bundle.description, {}, workspace, result);
        std::printf("%s mesh %016" PRIx64 " texture %016" PRIx64 " report %016" PRIx64 "\n",
                    folder.filename().c_str(), hashOf(result.mesh), hashOf(result.texture),
                    hashOf(result.report));
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        for (int i = 1; i < argc; ++i) printHashes(argv[i]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "hash_scans: %s\n", error.what());
        return 1;
    }
    return argc > 1 ? 0 : 64;
}

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "bench/scans.h"
#include "bench/work.h"
#include "export/atomic_file.h"
#include "export/ply.h"
#include "export/png.h"
#include "reconstruct/reconstruct.h"

namespace facescan::bench {
namespace {

namespace fs = std::filesystem;

const Reconstruction& reconstructedFace() {
    static const Reconstruction result = [] {
        const ScanBundle& scan = faceScan();
        Workspace workspace;
        Reconstruction made;
        reconstruct(scan.frames.view(), scan.description, {}, workspace, made);
        return made;
    }();
    return result;
}

/// Files have the pixels of the scan, and bytes of their own.
Work workOn(std::size_t bytes) {
    return {double(bytes), workOf(faceScan().description).pixels};
}

void formatsPly(benchmark::State& state) {
    const Mesh& mesh = reconstructedFace().mesh;
    std::string file;
    for (auto _ : state) {
        formatPly(mesh, file);
        benchmark::DoNotOptimize(file.data());
    }
    report(workOn(file.size()), state);
}
BENCHMARK(formatsPly)->Name("export/ply");

/// Bytes are those of the pixels.
void formatsPng(benchmark::State& state) {
    const GreyImage& texture = reconstructedFace().texture;
    PngEncoder encoder;
    std::string file;
    for (auto _ : state) {
        encoder.format(view(texture), file);
        benchmark::DoNotOptimize(file.data());
    }
    report(workOn(texture.pixels.size()), state);
}
BENCHMARK(formatsPng)->Name("export/png");

/// Both files into the file system, not waiting for the disk.
void writesFiles(benchmark::State& state) {
    const fs::path folder =
        fs::temp_directory_path() / ("facescan-bench-" + std::to_string(::getpid()));
    fs::create_directory(folder);
    std::vector<FileContent> files{{folder / "texture.png", {}}, {folder / "mesh.ply", {}}};
    formatPng(view(reconstructedFace().texture), files[0].bytes);
    formatPly(reconstructedFace().mesh, files[1].bytes);
    for (auto _ : state) writeFiles(files, Durability::buffered);
    fs::remove_all(folder);
    report(workOn(files[0].bytes.size() + files[1].bytes.size()), state);
}
BENCHMARK(writesFiles)->Name("export/write");

}  // namespace
}  // namespace facescan::bench

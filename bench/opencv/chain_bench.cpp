#include <benchmark/benchmark.h>

#include "bench/laps.h"
#include "bench/opencv/chain.h"
#include "bench/scans.h"
#include "bench/work.h"

namespace facescan::bench {
namespace {

/// Frames in memory to mesh.
void assemble(const opencv::Input& input, const ScanDescription& scan, Laps& laps,
              opencv::GridMesh& mesh) {
    laps.begin();
    const cv::Mat codes = opencv::decode(input);
    laps.finished(0);
    const cv::Mat smoothed = opencv::smooth(codes);
    laps.finished(1);
    const cv::Mat points = opencv::calibrate(smoothed, scan);
    laps.finished(2);
    opencv::tessellate(points, mesh);
    laps.finished(3);
    opencv::addNormals(mesh);
    laps.finished(4);
    laps.end();
}

/// In one thread, after a first time that takes the mesh's memory. The steps have the names of the
/// stages that they stand against.
void assembles(benchmark::State& state) {
    cv::setNumThreads(1);
    const std::vector<std::string> steps{"decode", "smooth", "calibrate", "tessellate", "normals"};
    const ScanBundle& scan = faceScan();
    const opencv::Input input = opencv::inputOf(scan);
    opencv::GridMesh mesh;
    Laps first(steps);
    assemble(input, scan.description, first, mesh);
    if (mesh.triangles.size() < 100'000) return state.SkipWithError("OpenCV made no surface");

    Laps laps(steps);
    for (auto _ : state) assemble(input, scan.description, laps, mesh);
    laps.report(state);
    report(workOf(scan.description), state);
}
BENCHMARK(assembles)->Name("opencv/face");

}  // namespace
}  // namespace facescan::bench

#include "bench/kernels/kernel_subject.h"

namespace facescan::bench {
namespace {

constexpr int kQuads = kRowLength;

QuadRows quadRows(KernelRows& rows) {
    return {rows.points(0, 3), rows.points(1, 4), rows.floats(0, 2),
            rows.floats(4, 6), rows.flags(),      rows.flags()};
}

TriangleRows triangleRows(KernelRows& rows) {
    return {rows.points(-1, 1), rows.points(-1, 1)};
}

KernelCall cutQuads(KernelRows& rows) {
    const QuadRows quads = quadRows(rows);
    const QuadCuts cuts{rows.flags(),
                        rows.flags(),
                        rows.flags(),
                        rows.room<float>(),
                        rows.room<float>(),
                        rows.room<std::int32_t>(),
                        rows.room<std::int32_t>()};
    return [=](const Kernels& kernel) { kernel.cutQuads(quads, 1, kQuads, cuts); };
}

KernelCall markShort(KernelRows& rows) {
    const float* longest = rows.floats(0, 5);
    auto* flags = rows.flags();
    return [=](const Kernels& kernel) { kernel.markShort(longest, 4, kQuads, flags); };
}

KernelCall triangleNormals(KernelRows& rows) {
    const QuadRows quads = quadRows(rows);
    const QuadFlags flags{rows.flags(), rows.flags(), rows.flags()};
    const TriangleRows normals = triangleRows(rows);
    return [=](const Kernels& kernel) { kernel.triangleNormals(quads, flags, kQuads, normals); };
}

KernelCall vertexNormals(KernelRows& rows) {
    const auto side = [&]() -> VertexCorners::Side {
        const TriangleRows normals = triangleRows(rows);
        return {normals.first, normals.second, rows.flags()};
    };
    const VertexCorners corners{side(), side()};
    const PointRow normals = rows.points(0, 0);
    return [=](const Kernels& kernel) { kernel.vertexNormals(corners, -1, kQuads, normals); };
}

constexpr KernelSubject kSubjects[] = {{"cutQuads", kQuads, cutQuads},
                                       {"markShort", kQuads, markShort},
                                       {"triangleNormals", kQuads, triangleNormals},
                                       {"vertexNormals", kQuads, vertexNormals}};

}  // namespace

std::span<const KernelSubject> quadKernels() {
    return kSubjects;
}

}  // namespace facescan::bench

#pragma once

#include "reconstruct/kernels/edges.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/links.h"
#include "reconstruct/kernels/motion.h"
#include "reconstruct/kernels/pixels.h"
#include "reconstruct/kernels/points.h"
#include "reconstruct/kernels/quads.h"
#include "reconstruct/kernels/windows.h"

namespace facescan {

/// The table of one form.
template <typename Lanes>
constexpr Kernels kernelsOf() {
    return {
        .startRow = startRow<Lanes>,
        .addPairs = addPairs<Lanes>,
        .finishRow = finishRow<Lanes>,
        .classifyEdges = classifyEdges<Lanes>,
        .gatherEdges = gatherEdges<Lanes>,
        .locateEdges = locateEdges<Lanes>,
        .layEdges = layEdges<Lanes>,
        .linkNeighbours = linkNeighbours<Lanes>,
        .rejectUnsupported = rejectUnsupported<Lanes>,
        .deviceRow = deviceRow<Lanes>,
        .polynomialRow = polynomialRow<Lanes>,
        .markInRange = markInRange<Lanes>,
        .referencePlanes = referencePlanes<Lanes>,
        .compensateRow = compensateRow<Lanes>,
        .correctBias = correctBias<Lanes>,
        .sumAlignment = sumAlignment<Lanes>,
        .warpPixels = warpPixels<Lanes>,
        .sumRegistration = sumRegistration<Lanes>,
        .halveRows = halveRows<Lanes>,
        .blurRows = blurRows<Lanes>,
        .cutQuads = cutQuads<Lanes>,
        .measureWidths = measureWidths<Lanes>,
        .markShort = markShort<Lanes>,
        .triangleNormals = triangleNormals<Lanes>,
        .vertexNormals = vertexNormals<Lanes>,
        .vertexQuality = vertexQuality<Lanes>,
        .markRegular = markRegular<Lanes>,
        .chooseWindows = chooseWindows<Lanes>,
        .keepCommon = keepCommon<Lanes>,
        .keepSurrounded = keepSurrounded<Lanes>,
        .filterRow = filterRow<Lanes>,
        .fitWindows = fitWindows<Lanes>,
    };
}

}  // namespace facescan

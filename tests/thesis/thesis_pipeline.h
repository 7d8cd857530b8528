#pragma once

#include <vector>

#include "reconstruct/frame_stack.h"
#include "reconstruct/image.h"
#include "reconstruct/mesh.h"
#include "reconstruct/scan.h"
#include "thesis/filter.h"

/// The pipeline of M. Roa Villescas, "3D face reconstruction using structured light on a hand-held
/// device", TU Eindhoven 2013, chapter 3: a reference to measure facescan against. Plain and slow
/// on purpose. It knows the nouns of reconstruct/ and none of its stages.
namespace facescan::thesis {

struct Options {
    bool shift_frames = true;  ///< motion compensation
    int max_shift_px = 8;      ///< between consecutive pairs
    double min_modulation = 6.0 / 255;
    double border_px = 4;
    LineLimits line{};
    double max_edge_ratio = 7;
    double gamma = 1 / 2.2;
};

struct Result {
    Mesh mesh;
    GreyImage texture;
    std::vector<int> shifts_px;  ///< by pair: how far its frames were moved along the code's axis
};

/// Conditions as for facescan::reconstruct().
Result reconstruct(const FrameStackView& frames, const ScanDescription& scan,
                   const Options& options = {});

}  // namespace facescan::thesis

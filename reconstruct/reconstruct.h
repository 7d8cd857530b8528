#pragma once

#include "reconstruct/frame_stack.h"
#include "reconstruct/image.h"
#include "reconstruct/mesh.h"
#include "reconstruct/options.h"
#include "reconstruct/report.h"
#include "reconstruct/scan.h"
#include "reconstruct/stage.h"
#include "reconstruct/workspace.h"

namespace facescan {

/// The result of a scan. Its buffers are reused when it is passed to reconstruct() again.
struct Reconstruction {
    Mesh mesh;          ///< empty where the report's verdict is `repeat` for want of a surface
    GreyImage texture;  ///< covers `ScanDescription::image`, a pixel for a pixel
    Report report;
};

/// Turns the frames of one scan into a textured mesh in millimetres.
///
/// @param frames     at least scan.first_frame + scan.pattern.frameCount() frames
/// @param scan       its image rectangle lies inside the frames and is at least 16 × 16
/// @param workspace  scratch memory; after the first scan of a size nothing is allocated
/// @param result     overwritten
/// @param observer   told when each stage is done, for timing; reconstruction has no clock
///
/// A scene that cannot be reconstructed is no error: the mesh is empty, and the report's verdict
/// and reason say why.
void reconstruct(const FrameStackView& frames, const ScanDescription& scan, const Options& options,
                 Workspace& workspace, Reconstruction& result, StageObserver* observer = nullptr);

/// The same, byte for byte, while frames are still being captured: each is worked on as it arrives,
/// so that less remains after the last one.
class IncrementalReconstruction {
public:
    /// @param frames     where the frames will be; their pixels are not read before take()
    /// @param scan       stays as it is until the scan is finished
    /// @param workspace  serves this scan alone until then
    IncrementalReconstruction(const FrameStackView& frames, const ScanDescription& scan,
                              const Options& options, Workspace& workspace);

    /// The frame `index` of the stack is there and stays as it is. In any order; frames that carry
    /// no pattern have no effect.
    void take(int index);

    /// All frames are there. Those that have not been taken are now.
    void finish(Reconstruction& result, StageObserver* observer = nullptr);

private:
    FrameStackView frames_;
    const ScanDescription& scan_;
    Options options_;
    Workspace& work_;
};

}  // namespace facescan

#pragma once

namespace facescan {

/// The stages of a reconstruction, in the order in which they run.
enum class Stage {
    preprocess,
    decode,
    texture,
    filter,
    motion,
    smooth,
    calibrate,
    fill,
    tessellate,
    normals,
    mesh,
    quality,
};
inline constexpr int kStageCount = int(Stage::quality) + 1;

/// The stage's name as reports print it: lower case, one word.
const char* name(Stage stage);

/// Told about the progress of a reconstruction, on the thread that runs it.
class StageObserver {
public:
    virtual ~StageObserver() = default;
    virtual void finished(Stage stage) = 0;
};

}  // namespace facescan

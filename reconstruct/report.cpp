#include "reconstruct/report.h"

namespace facescan {

const char* describe(Verdict verdict, Reason reason) {
    if (verdict == Verdict::good) return "Good scan.";
    switch (reason) {
        case Reason::none:
            return "Usable scan.";
        case Reason::dark:
            return "Too dark: no projector light reaches the camera. Uncover the lens, check the "
                   "projector, hold the scanner 30 to 50 cm from the face.";
        case Reason::over_exposed:
            return "Over-exposed: most of the picture is white. Lower the exposure or the room "
                   "light.";
        case Reason::no_pattern:
            return "No stripes found on a surface. Point the scanner at the face and hold it 30 "
                   "to 50 cm away.";
        case Reason::too_little_surface:
            return "Only little of the face was seen. Centre the face and hold the scanner 30 to "
                   "50 cm away.";
        case Reason::low_contrast:
            return "The stripes are faint. Dim the room light or move closer.";
        case Reason::moved:
            return "The face moved during the scan. Hold still and scan again.";
        case Reason::noisy:
            return "The picture is noisy. Raise the exposure or dim the room light.";
        case Reason::gaps:
            return "Parts of the face are missing. Turn the face to the scanner and clear hair and "
                   "hands away.";
    }
    return "";
}

}  // namespace facescan

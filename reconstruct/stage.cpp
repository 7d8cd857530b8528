#include "reconstruct/stage.h"

namespace facescan {

const char* name(Stage stage) {
    switch (stage) {
        case Stage::preprocess:
            return "preprocess";
        case Stage::decode:
            return "decode";
        case Stage::texture:
            return "texture";
        case Stage::motion:
            return "motion";
        case Stage::calibrate:
            return "calibrate";
        case Stage::filter:
            return "filter";
        case Stage::smooth:
            return "smooth";
        case Stage::fill:
            return "fill";
        case Stage::tessellate:
            return "tessellate";
        case Stage::normals:
            return "normals";
        case Stage::mesh:
            return "mesh";
        case Stage::quality:
            return "quality";
    }
    return "";
}

}  // namespace facescan

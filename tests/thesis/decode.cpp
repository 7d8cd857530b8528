#include "thesis/decode.h"

#include <algorithm>
#include <cstdlib>

#include "reconstruct/pattern.h"

namespace facescan::thesis {

CodeImage decodePixels(const std::vector<Image>& normalised, const Image& modulation,
                       double min_modulation) {
    CodeImage result{modulation.width, modulation.height, {}};
    for (std::size_t i = 0; i < modulation.values.size(); ++i) {
        std::uint32_t codeword = 0;
        for (const Image& pair : normalised) codeword = 2 * codeword + (pair.values[i] > 0);
        const bool lit = modulation.values[i] >= min_modulation;
        result.codes.push_back(lit ? int(grayStripe(codeword)) : kNoCode);
    }
    return result;
}

std::vector<Transition> transitions(const CodeImage& codes) {
    std::vector<Transition> found;
    for (int x = 0; x < codes.width; ++x) {
        for (int y = 0; y + 1 < codes.height; ++y) {
            const int above = codes.at(x, y);
            const int below = codes.at(x, y + 1);
            if (above == kNoCode || below == kNoCode || std::abs(above - below) != 1) continue;
            found.push_back({{double(x), y + 0.5}, std::max(above, below)});
        }
    }
    return found;
}

}  // namespace facescan::thesis

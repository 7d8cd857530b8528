#include "thesis/frame_shift.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "thesis/stripe_images.h"

namespace facescan::thesis {

namespace {

double meanAbsoluteDifference(const std::vector<double>& from, const std::vector<double>& to,
                              int d) {
    double sum = 0;
    int count = 0;
    for (int i = std::max(0, -d); i < int(from.size()) - std::max(0, d); ++i) {
        sum += std::abs(to[i + d] - from[i]);
        ++count;
    }
    return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<double> profile(const Image& image) {
    std::vector<double> rows(image.height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) rows[y] += image.at(x, y);
        rows[y] /= image.width;
    }
    return rows;
}

int displacement(const std::vector<double>& from, const std::vector<double>& to, int reach) {
    int best = 0;
    double smallest = meanAbsoluteDifference(from, to, 0);
    for (int distance = 1; distance <= reach; ++distance) {
        for (const int d : {-distance, distance}) {
            const double difference = meanAbsoluteDifference(from, to, d);
            if (difference < smallest) {
                smallest = difference;
                best = d;
            }
        }
    }
    return best;
}

std::vector<int> shiftsToFinestPair(const std::vector<FramePair>& pairs, int reach) {
    std::vector<int> shifts(pairs.size(), 0);
    for (int pair = int(pairs.size()) - 2; pair >= 0; --pair) {
        const int step = displacement(profile(evenlyLit(pairs[pair])),
                                      profile(evenlyLit(pairs[pair + 1])), reach);
        shifts[pair] = shifts[pair + 1] + step;
    }
    return shifts;
}

Image movedDown(const Image& image, int rows) {
    Image moved(image.width, image.height);
    for (int y = 0; y < image.height; ++y) {
        const int source = std::clamp(y - rows, 0, image.height - 1);
        for (int x = 0; x < image.width; ++x) moved.at(x, y) = image.at(x, source);
    }
    return moved;
}

}  // namespace facescan::thesis

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "export/atomic_file.h"
#include "reconstruct/image.h"

namespace facescan {

/// 8-bit pixels, not owned: rows from the top, without padding, `channels` bytes a pixel.
struct ImageView {
    const std::uint8_t* pixels = nullptr;
    int width = 0;
    int height = 0;
    int channels = 1;  ///< 1 grey, 3 RGB, 4 RGBA (not premultiplied)
};

inline ImageView view(const GreyImage& image) {
    return {image.pixels.data(), image.width, image.height, 1};
}

/// What the picture shows, which decides how it is compressed.
enum class PngContent {
    photograph,  ///< no two places alike, such as the texture
    drawing,     ///< flat areas and repetitions, such as a rendered mesh on its background
};

/// Overwrites `out` with a PNG file. Same pixels, same bytes; no time stamp, no gamma.
/// Throws std::runtime_error where the image is empty or larger than PNG allows.
void formatPng(const ImageView& image, PngContent content, std::string& out);

/// Writes a PNG file, whole or not at all; throws WriteError.
void writePng(const std::filesystem::path& file, const ImageView& image,
              PngContent content = PngContent::drawing, Durability durability = Durability::synced);

/// Reads the bytes of a PNG file that holds 8-bit grey (or less, widened to it), at most
/// 8192 × 8192. Throws std::runtime_error with the cause. Takes no more memory than the bytes can
/// stand for.
GreyImage parseGreyPng(std::string_view bytes);

}  // namespace facescan

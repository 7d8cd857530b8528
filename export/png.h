#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/atomic_file.h"
#include "reconstruct/image.h"

struct libdeflate_compressor;

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

/// Makes PNG files one after the other. All but the first of a size take hardly any memory anew.
class PngEncoder {
public:
    PngEncoder();

    /// Overwrites `out` with a PNG file. Same pixels, same bytes; no time stamp, no gamma.
    /// Throws std::runtime_error where the image is empty or larger than PNG allows.
    void format(const ImageView& image, std::string& out);

private:
    struct FreeCompressor {
        void operator()(libdeflate_compressor* compressor) const;
    };
    using Compressor = std::unique_ptr<libdeflate_compressor, FreeCompressor>;

    std::span<const std::uint8_t> compress();

    Compressor compressor_;
    std::vector<std::uint8_t> filtered_;
    std::vector<std::uint8_t> compressed_;
};

/// The same for a single file.
void formatPng(const ImageView& image, std::string& out);

/// Writes a PNG file, whole or not at all; throws WriteError.
void writePng(const std::filesystem::path& file, const ImageView& image,
              Durability durability = Durability::synced);

/// Reads the bytes of a PNG file that holds 8-bit grey (or less, widened to it), at most
/// 8192 × 8192. Throws std::runtime_error with the cause. Takes no more memory than the bytes can
/// stand for.
GreyImage parseGreyPng(std::string_view bytes);

}  // namespace facescan

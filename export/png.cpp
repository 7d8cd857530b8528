#include "export/png.h"

#include <libdeflate.h>
#include <png.h>

#include <csetjmp>
#include <cstddef>
#include <new>
#include <span>
#include <stdexcept>

namespace facescan {
namespace {

/// The output and the error of libpng, reached through its callbacks.
struct Sink {
    std::string& out;
    std::string error;
};

// libpng is C: an exception must not pass through it, and its errors arrive by longjmp. So no
// object with a destructor may be born between setjmp and the last call to libpng.

void onError(png_structp png, png_const_charp message) {
    static_cast<Sink*>(png_get_error_ptr(png))->error = message;
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onWrite(png_structp png, png_bytep bytes, std::size_t count) {
    bool stored = true;
    try {
        static_cast<Sink*>(png_get_io_ptr(png))->out.append(reinterpret_cast<char*>(bytes), count);
    } catch (const std::exception&) {
        stored = false;
    }
    if (!stored) png_error(png, "out of memory");
}

void onFlush(png_structp) {}

struct PngWriter {
    explicit PngWriter(Sink& sink)
        : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, onError, onWarning)),
          info(png ? png_create_info_struct(png) : nullptr) {}
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    png_structp png;
    png_infop info;
};

int colourType(int channels) {
    switch (channels) {
        case 1:
            return PNG_COLOR_TYPE_GRAY;
        case 3:
            return PNG_COLOR_TYPE_RGB;
        case 4:
            return PNG_COLOR_TYPE_RGB_ALPHA;
        default:
            throw std::invalid_argument("PNG: an image of " + std::to_string(channels) +
                                        " channels; 1, 3 or 4 expected");
    }
}

/// Of libdeflate. Measured on one core: a texture of 480 × 754 takes 1.5 ms at level 1, and twice
/// as long at level 2, which saves 2 %; a preview of 1280 × 960 takes 15 ms, and saves 6 % at
/// level 4.
constexpr int kLevel = 1;

/// What the filter Up leaves of each row: its difference from the one above. On textures it does
/// better than the others of PNG, and no search for the best of a row is worth its time.
void filterUp(const ImageView& image, std::vector<std::uint8_t>& out) {
    const std::size_t row_bytes = std::size_t(image.width) * image.channels;
    out.resize((row_bytes + 1) * image.height);
    const std::vector<std::uint8_t> nothing(row_bytes);
    const std::uint8_t* above = nothing.data();
    std::uint8_t* filtered = out.data();
    for (int y = 0; y < image.height; ++y) {
        const std::uint8_t* row = image.pixels + y * row_bytes;
        *filtered++ = PNG_FILTER_VALUE_UP;
        for (std::size_t x = 0; x < row_bytes; ++x) filtered[x] = std::uint8_t(row[x] - above[x]);
        filtered += row_bytes;
        above = row;
    }
}

/// Writes the file around the compressed rows. False after an error, which the writer's sink then
/// holds.
bool writeChunks(PngWriter& writer, Sink& sink, const ImageView& image, int colour,
                 std::span<const std::uint8_t> compressed) {
    if (writer.info == nullptr) {
        sink.error = "out of memory";
        return false;
    }
    const png_structp png = writer.png;
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, &sink, onWrite, onFlush);
    png_set_IHDR(png, writer.info, png_uint_32(image.width), png_uint_32(image.height), 8, colour,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, writer.info);
    png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), compressed.data(),
                    compressed.size());
    png_write_chunk(png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
    return true;
}

constexpr std::uint32_t kMaxSide = 8192;       // px, of a camera's frame by the bundle format
constexpr std::uint64_t kMaxExpansion = 1032;  // bytes that deflate makes of one

/// libpng's simplified reader, which reports errors without longjmp.
struct PngReader {
    PngReader() { image.version = PNG_IMAGE_VERSION; }
    ~PngReader() { png_image_free(&image); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    png_image image{};
};

}  // namespace

void PngEncoder::FreeCompressor::operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
}

PngEncoder::PngEncoder() : compressor_(libdeflate_alloc_compressor(kLevel)) {
    if (!compressor_) throw std::bad_alloc();
}

std::span<const std::uint8_t> PngEncoder::compress() {
    compressed_.resize(libdeflate_zlib_compress_bound(compressor_.get(), filtered_.size()));
    const std::size_t size =
        libdeflate_zlib_compress(compressor_.get(), filtered_.data(), filtered_.size(),
                                 compressed_.data(), compressed_.size());
    return std::span(compressed_).first(size);
}

void PngEncoder::format(const ImageView& image, std::string& out) {
    const int colour = colourType(image.channels);
    if (image.width < 1 || image.height < 1) throw std::invalid_argument("PNG: the image is empty");
    filterUp(image, filtered_);
    out.clear();
    Sink sink{out, {}};
    PngWriter writer(sink);
    if (!writeChunks(writer, sink, image, colour, compress()))
        throw std::runtime_error("PNG: " + sink.error);
}

void formatPng(const ImageView& image, std::string& out) {
    PngEncoder().format(image, out);
}

void writePng(const std::filesystem::path& file, const ImageView& image, Durability durability) {
    FileContent png{file, {}};
    try {
        formatPng(image, png.bytes);
    } catch (const std::exception& error) {
        throw WriteError("cannot write " + file.string() + ": " + error.what());
    }
    writeFiles(std::span(&png, 1), durability);
}

GreyImage parseGreyPng(std::string_view bytes) {
    PngReader reader;
    png_image& image = reader.image;
    if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) {
        throw std::runtime_error(image.message);
    }
    if (image.format != PNG_FORMAT_GRAY) throw std::runtime_error("8-bit grey pixels expected");
    const std::string size = std::to_string(image.width) + " × " + std::to_string(image.height);
    if (image.width > kMaxSide || image.height > kMaxSide) {
        throw std::runtime_error(size + " pixels; at most 8192 × 8192 expected");
    }
    const std::size_t pixels = std::size_t(image.width) * image.height;
    if (pixels > bytes.size() * kMaxExpansion) {
        throw std::runtime_error("too short for " + size + " pixels");
    }
    GreyImage grey{int(image.width), int(image.height), std::vector<std::uint8_t>(pixels)};
    if (!png_image_finish_read(&image, nullptr, grey.pixels.data(), 0, nullptr)) {
        throw std::runtime_error(image.message);
    }
    return grey;
}

}  // namespace facescan

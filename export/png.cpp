#include "export/png.h"

#include <png.h>
#include <zlib.h>

#include <csetjmp>
#include <cstddef>
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

void chooseCompression(png_structp png, PngContent content) {
    if (content == PngContent::drawing) {
        // Measured on a picture of 1280 × 720: level 6 and the best filter for each row take three
        // times as long and save nothing.
        png_set_compression_level(png, 3);
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
        return;
    }
    // Measured on textures: 2.4 ms for 480 × 754. To search for repetitions (level 1) takes twice
    // as long and finds none, once a filter has removed what neighbours share. Of the filters only
    // Paeth leaves less than Average, 15 %, and takes 1.8 times as long.
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, Z_HUFFMAN_ONLY);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_AVG);
}

/// False after an error, which the writer's sink then holds.
bool encode(PngWriter& writer, Sink& sink, const ImageView& image, int colour, PngContent content) {
    if (writer.info == nullptr) {
        sink.error = "out of memory";
        return false;
    }
    const png_structp png = writer.png;
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, &sink, onWrite, onFlush);
    png_set_IHDR(png, writer.info, png_uint_32(image.width), png_uint_32(image.height), 8, colour,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    chooseCompression(png, content);
    png_set_compression_buffer_size(png, 1 << 16);
    png_write_info(png, writer.info);
    const std::size_t row_bytes = std::size_t(image.width) * image.channels;
    for (int y = 0; y < image.height; ++y) png_write_row(png, image.pixels + y * row_bytes);
    png_write_end(png, writer.info);
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

void formatPng(const ImageView& image, PngContent content, std::string& out) {
    const int colour = colourType(image.channels);
    if (image.width < 1 || image.height < 1) throw std::invalid_argument("PNG: the image is empty");
    out.clear();
    Sink sink{out, {}};
    PngWriter writer(sink);
    if (!encode(writer, sink, image, colour, content))
        throw std::runtime_error("PNG: " + sink.error);
}

void writePng(const std::filesystem::path& file, const ImageView& image, PngContent content,
              Durability durability) {
    FileContent png{file, {}};
    try {
        formatPng(image, content, png.bytes);
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

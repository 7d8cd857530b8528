#include "sim/npz.h"

#include <zip.h>

#include <cstddef>
#include <memory>
#include <stdexcept>

namespace facescan::sim {

namespace {

std::string npyHeader(const char* type, const NpzWriter::Shape& shape) {
    std::string text = std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (";
    for (const std::size_t extent : shape) text += std::to_string(extent) + ",";
    text += "), }";
    // Magic, version and length take 10 bytes; the whole header is a multiple of 64.
    const std::size_t padding = 63 - (10 + text.size()) % 64;
    text += std::string(padding, ' ') + "\n";
    const std::size_t length = text.size();
    return std::string("\x93NUMPY\x01", 7) + '\0' + char(length & 0xff) + char(length >> 8) + text;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw std::runtime_error(path.string() + ": cannot write: " + reason);
}

}  // namespace

void NpzWriter::addBytes(const std::string& name, const char* type, const Shape& shape,
                         std::span<const std::byte> bytes) {
    std::string member = npyHeader(type, shape);
    member.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    members_.push_back({name + ".npy", std::move(member)});
}

void NpzWriter::add(const std::string& name, const Shape& shape, std::span<const float> values) {
    addBytes(name, "<f4", shape, std::as_bytes(values));
}

void NpzWriter::add(const std::string& name, const Shape& shape,
                    std::span<const std::uint32_t> values) {
    addBytes(name, "<u4", shape, std::as_bytes(values));
}

void NpzWriter::add(const std::string& name, const Shape& shape,
                    std::span<const std::uint8_t> values) {
    addBytes(name, "|u1", shape, std::as_bytes(values));
}

void NpzWriter::addFlags(const std::string& name, const Shape& shape,
                         std::span<const std::uint8_t> values) {
    addBytes(name, "|b1", shape, std::as_bytes(values));
}

void NpzWriter::write(const std::filesystem::path& path) const {
    int code = 0;
    zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (!archive) {
        zip_error_t error;
        zip_error_init_with_code(&error, code);
        const std::string reason = zip_error_strerror(&error);
        zip_error_fini(&error);
        fail(path, reason);
    }
    std::unique_ptr<zip_t, void (*)(zip_t*)> owner(archive, zip_discard);
    for (const Member& member : members_) {
        zip_source_t* source =
            zip_source_buffer(archive, member.bytes.data(), member.bytes.size(), 0);
        const zip_int64_t index =
            source ? zip_file_add(archive, member.name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
        if (index < 0) {
            zip_source_free(source);
            fail(path, zip_strerror(archive));
        }
        constexpr int kFast = 1;
        zip_set_file_compression(archive, zip_uint64_t(index), ZIP_CM_DEFLATE, kFast);
        // A fixed time, so that the same arrays give the same bytes.
        zip_file_set_dostime(archive, zip_uint64_t(index), 0, (1 << 5) | 1, 0);
    }
    // libzip writes a temporary file and renames it.
    if (zip_close(archive) != 0) fail(path, zip_strerror(archive));
    static_cast<void>(owner.release());
}

}  // namespace facescan::sim

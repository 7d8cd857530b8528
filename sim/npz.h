#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace facescan::sim {

/// Writes arrays into one file that NumPy's load() opens: a zip of .npy members.
/// Source: the .npy format, version 1.0 (numpy.lib.format).
class NpzWriter {
public:
    using Shape = std::vector<std::size_t>;

    void add(const std::string& name, const Shape& shape, std::span<const float> values);
    void add(const std::string& name, const Shape& shape, std::span<const std::uint32_t> values);
    void add(const std::string& name, const Shape& shape, std::span<const std::uint8_t> values);
    void addFlags(const std::string& name, const Shape& shape,
                  std::span<const std::uint8_t> values);

    /// Writes the whole file or none. Throws std::runtime_error.
    void write(const std::filesystem::path& path) const;

private:
    struct Member {
        std::string name;
        std::string bytes;
    };
    void addBytes(const std::string& name, const char* type, const Shape& shape,
                  std::span<const std::byte> bytes);

    std::vector<Member> members_;
};

}  // namespace facescan::sim

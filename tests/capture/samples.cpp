#include "capture/samples.h"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

namespace facescan::test {
namespace fs = std::filesystem;

TempFolder::TempFolder() {
    std::string name = (fs::temp_directory_path() / "facescan-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder: " + name);
    path_ = name;
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

Unprivileged::Unprivileged() : was_root_(::geteuid() == 0) {
    constexpr uid_t kNobody = 65534;
    if (was_root_ && ::seteuid(kNobody) != 0) throw std::runtime_error("cannot become nobody");
}

Unprivileged::~Unprivileged() {
    if (was_root_ && ::seteuid(0) != 0) std::abort();
}

void writeFile(const fs::path& path, std::string_view text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

void writeFile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    writeFile(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

std::string readFile(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::string> namesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::uint32_t slowCrc(std::span<const std::uint8_t> bytes) {
    std::uint32_t crc = 0xffffffff;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

void putNumber(std::span<std::uint8_t> bytes, std::size_t offset, std::size_t size,
               std::uint64_t value) {
    for (std::size_t i = 0; i < size; ++i) bytes[offset + i] = std::uint8_t(value >> (8 * i));
}

void renewHeaderCrc(std::span<std::uint8_t> header) {
    putNumber(header, 60, 4, slowCrc(header.first(60)));
}

FramesHeaderBytes sampleHeader() {
    FramesHeaderBytes header{};
    const std::string_view magic = "FSCANBIN";
    std::copy(magic.begin(), magic.end(), header.begin());
    putNumber(header, 8, 2, 1);
    putNumber(header, 10, 2, 64);
    putNumber(header, 12, 4, 0x59455247);
    putNumber(header, 16, 4, 8);
    putNumber(header, 20, 4, 18);
    putNumber(header, 24, 4, 16);
    putNumber(header, 28, 4, 20);
    putNumber(header, 32, 8, 1735689600123456789);
    putNumber(header, 40, 8, 16666667);
    putNumber(header, 48, 4, slowCrc(samplePixels()));
    renewHeaderCrc(header);
    return header;
}

Bytes samplePixels() {
    return makeFrames(8, 18, 16, 20).pixels;
}

Bytes sampleFramesFile() {
    return framesFile(sampleHeader(), samplePixels());
}

Bytes framesFile(const FramesHeaderBytes& header, const Bytes& pixels) {
    Bytes file(header.size() + pixels.size());
    std::copy(pixels.begin(), pixels.end(), std::copy(header.begin(), header.end(), file.begin()));
    return file;
}

std::string sampleXml() {
    return R"(<?xml version="1.0" encoding="UTF-8"?>
<facescan version="1">
  <frames file="frames.bin" first="0" count="8"/>
  <image x="1" y="0" width="17" height="16"/>
  <pattern type="gray" bits="4" axis="y" order="interleaved"/>
  <calibration model="polynomial" degree="1" units="mm">
    <input name="x" offset="8.5" scale="9"/>
    <input name="y" offset="7.5" scale="-8"/>
    <input name="code" offset="8" scale="8"/>
    <output name="X">0.5 -1 2e1 3</output>
    <output name="Y">1 2 3 4</output>
    <output name="Z">400 0 0 1e-3</output>
    <range min="300" max="520"/>
  </calibration>
</facescan>
)";
}

std::string sampleXmlWith(std::string_view part, std::string_view replacement) {
    std::string xml = sampleXml();
    const std::size_t at = xml.find(part);
    if (at == xml.npos) throw std::logic_error("the sample has no " + std::string(part));
    return xml.replace(at, part.size(), replacement);
}

fs::path writeSampleBundle(const TempFolder& folder) {
    const fs::path bundle = folder / "bundle";
    fs::create_directory(bundle);
    writeFile(bundle / "frames.bin", sampleFramesFile());
    writeFile(bundle / "scan.xml", sampleXml());
    return bundle;
}

ScanDescription sampleDescription() {
    ScanDescription scan;
    scan.first_frame = 0;
    scan.image = {1, 0, 17, 16};
    scan.pattern = {4, CodeAxis::y, FrameOrder::interleaved};
    scan.calibration.degree = 1;
    scan.calibration.x = {8.5, 9};
    scan.calibration.y = {7.5, -8};
    scan.calibration.code = {8, 8};
    scan.calibration.coefficients = {{{0.5, -1, 20, 3}, {1, 2, 3, 4}, {400, 0, 0, 0.001}}};
    scan.calibration.range_min_mm = 300;
    scan.calibration.range_max_mm = 520;
    return scan;
}

FrameStack makeFrames(int count, int width, int height, int row_stride, unsigned seed) {
    FrameStack frames{
        .pixels = {}, .count = count, .width = width, .height = height, .row_stride = row_stride};
    std::mt19937 random(seed);
    frames.pixels.resize(std::size_t(count) * std::size_t(height) * std::size_t(row_stride));
    for (std::uint8_t& pixel : frames.pixels) pixel = std::uint8_t(random());
    return frames;
}

void expectSame(const ScanDescription& actual, const ScanDescription& expected) {
    EXPECT_EQ(actual.first_frame, expected.first_frame);
    EXPECT_EQ(actual.image, expected.image);
    EXPECT_EQ(actual.pattern, expected.pattern);
    const Calibration& a = actual.calibration;
    const Calibration& e = expected.calibration;
    EXPECT_EQ(a.degree, e.degree);
    for (const auto input : {&Calibration::x, &Calibration::y, &Calibration::code}) {
        EXPECT_EQ((a.*input).offset, (e.*input).offset);
        EXPECT_EQ((a.*input).scale, (e.*input).scale);
    }
    EXPECT_EQ(a.coefficients, e.coefficients);
    EXPECT_EQ(a.range_min_mm, e.range_min_mm);
    EXPECT_EQ(a.range_max_mm, e.range_max_mm);
}

void expectSame(const FrameStack& actual, const FrameStack& expected) {
    EXPECT_EQ(actual.count, expected.count);
    EXPECT_EQ(actual.width, expected.width);
    EXPECT_EQ(actual.height, expected.height);
    EXPECT_EQ(actual.row_stride, expected.row_stride);
    EXPECT_TRUE(actual.pixels == expected.pixels) << "the pixels differ";
}

}  // namespace facescan::test

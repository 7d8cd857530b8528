#include "capture/scan_xml.h"

#include <libdeflate.h>
#include <tinyxml2.h>

#include <span>
#include <vector>

#include "capture/bundle_error.h"
#include "capture/frames_header.h"
#include "capture/numbers.h"
#include "capture/xml_node.h"

namespace facescan {
namespace {

constexpr int kMaxDegree = 5;

// In the order of the enumerators.
constexpr const char* kAxes[] = {"x", "y"};
constexpr const char* kOrders[] = {"interleaved", "grouped"};

constexpr const char* kInputs[] = {"x", "y", "code"};
constexpr const char* kOutputs[] = {"X", "Y", "Z"};

std::string readPlainFileName(const XmlNode& node) {
    const std::string name(node.attribute("file"));
    const bool plain = !name.empty() && name != "." && name.find("..") == name.npos &&
                       name.find_first_of("/\\") == name.npos;
    if (!plain) node.failAttribute("file", "a plain file name, without separators and \"..\"");
    return name;
}

Rect readImage(const XmlNode& node) {
    return {.x = node.wholeNumber("x", 0, kMaxSide - kMinSide),
            .y = node.wholeNumber("y", 0, kMaxSide - kMinSide),
            .width = node.wholeNumber("width", kMinSide, kMaxSide),
            .height = node.wholeNumber("height", kMinSide, kMaxSide)};
}

Pattern readPattern(const XmlNode& node) {
    node.require("type", "gray");
    return {.bits = node.wholeNumber("bits", kMinBits, kMaxBits),
            .axis = CodeAxis(node.choice("axis", kAxes)),
            .order = FrameOrder(node.choice("order", kOrders))};
}

/// The index of the first pattern frame; their number must agree with the pattern.
int readFirstFrame(const XmlNode& node, const Pattern& pattern) {
    const int first = node.wholeNumber("first", 0, kMaxFrames);
    if (node.wholeNumber("count", 0, kMaxFrames) != pattern.frameCount())
        node.failAttribute("count", std::to_string(pattern.frameCount()) + ", twice the bits");
    return first;
}

NormalisedInput readInput(const XmlNode& node) {
    const NormalisedInput input{.offset = node.decimal("offset"), .scale = node.decimal("scale")};
    if (input.scale == 0) node.failAttribute("scale", "a number that is not zero");
    return input;
}

void readRange(const XmlNode& node, Calibration& calibration) {
    calibration.range_min_mm = node.decimal("min");
    calibration.range_max_mm = node.decimal("max");
    if (!(calibration.range_min_mm < calibration.range_max_mm))
        node.failAttribute("max", "more than min");
}

Calibration readCalibration(const XmlNode& node) {
    node.require("model", "polynomial");
    node.require("units", "mm");
    Calibration calibration;
    calibration.degree = node.wholeNumber("degree", 1, kMaxDegree);

    const std::vector<XmlNode> inputs = node.children("input", kInputs);
    calibration.x = readInput(inputs[0]);
    calibration.y = readInput(inputs[1]);
    calibration.code = readInput(inputs[2]);

    const std::vector<XmlNode> outputs = node.children("output", kOutputs);
    const auto terms = std::size_t(polynomialTerms(calibration.degree));
    for (std::size_t i = 0; i < outputs.size(); ++i)
        calibration.coefficients[i] = outputs[i].decimals(terms);

    readRange(node.child("range"), calibration);
    return calibration;
}

/// A tag's attribute, with a space before it.
std::string attribute(const char* name, const std::string& value) {
    return " " + std::string(name) + "=\"" + value + "\"";
}
std::string attribute(const char* name, int value) {
    return attribute(name, std::to_string(value));
}
std::string attribute(const char* name, double value) {
    return attribute(name, formatDecimal(value));
}

std::string formatFrames(const ScanDescription& description) {
    return "  <frames" + attribute("file", kFramesFileName) +
           attribute("first", description.first_frame) +
           attribute("count", description.pattern.frameCount()) + "/>\n";
}

std::string formatImage(const Rect& image) {
    return "  <image" + attribute("x", image.x) + attribute("y", image.y) +
           attribute("width", image.width) + attribute("height", image.height) + "/>\n";
}

std::string formatPattern(const Pattern& pattern) {
    return "  <pattern" + attribute("type", "gray") + attribute("bits", pattern.bits) +
           attribute("axis", kAxes[int(pattern.axis)]) +
           attribute("order", kOrders[int(pattern.order)]) + "/>\n";
}

std::string formatInput(const char* name, const NormalisedInput& input) {
    return "    <input" + attribute("name", name) + attribute("offset", input.offset) +
           attribute("scale", input.scale) + "/>\n";
}

std::string formatOutput(const char* name, std::span<const double> coefficients) {
    constexpr std::size_t kNumbersPerLine = 4;
    std::string text = "    <output" + attribute("name", name) + ">";
    for (std::size_t n = 0; n < coefficients.size(); ++n) {
        text += n % kNumbersPerLine == 0 ? "\n      " : " ";
        text += formatDecimal(coefficients[n]);
    }
    return text + "\n    </output>\n";
}

std::string formatCalibration(const Calibration& calibration) {
    std::string text = "  <calibration" + attribute("model", "polynomial") +
                       attribute("degree", calibration.degree) + attribute("units", "mm") + ">\n";
    text += formatInput("x", calibration.x);
    text += formatInput("y", calibration.y);
    text += formatInput("code", calibration.code);
    for (std::size_t i = 0; i < calibration.coefficients.size(); ++i)
        text += formatOutput(kOutputs[i], calibration.coefficients[i]);
    text += "    <range" + attribute("min", calibration.range_min_mm) +
            attribute("max", calibration.range_max_mm) + "/>\n";
    return text + "  </calibration>\n";
}

}  // namespace

ScanDocument parseScanXml(std::string_view document, const std::string& file) {
    tinyxml2::XMLDocument storage;
    const XmlNode root = parseXml(document, file, "facescan", storage);
    root.require("version", "1");
    const XmlNode frames = root.child("frames");

    ScanDocument scan;
    scan.crc = libdeflate_crc32(0, document.data(), document.size());
    scan.frames_file = readPlainFileName(frames);
    scan.description.image = readImage(root.child("image"));
    scan.description.pattern = readPattern(root.child("pattern"));
    scan.description.first_frame = readFirstFrame(frames, scan.description.pattern);
    scan.description.calibration = readCalibration(root.child("calibration"));
    return scan;
}

ScanDocument readScanXml(ByteSource& source) {
    if (source.size() > kMaxScanXmlBytes)
        throw BundleError(source.name(), "file size", std::to_string(source.size()) + " bytes",
                          "at most " + std::to_string(kMaxScanXmlBytes));
    std::vector<std::uint8_t> bytes(std::size_t(source.size()));
    source.read(bytes);
    return parseScanXml({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, source.name());
}

std::string formatScanXml(const ScanDescription& description) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<facescan version=\"1\">\n";
    text += formatFrames(description);
    text += formatImage(description.image);
    text += formatPattern(description.pattern);
    text += formatCalibration(description.calibration);
    return text + "</facescan>\n";
}

}  // namespace facescan

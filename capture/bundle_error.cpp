#include "capture/bundle_error.h"

#include <utility>

namespace facescan {
namespace {

constexpr std::size_t kLongestQuote = 40;  // characters of the file that a message repeats

bool isControl(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

constexpr char kDigits[] = "0123456789abcdef";

std::string hexEscape(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
}

/// A path as it is, except what would break the line.
std::string onOneLine(std::string_view path) {
    std::string line;
    for (const char c : path) {
        if (isControl(c))
            line += hexEscape(c);
        else
            line += c;
    }
    return line;
}

std::string message(const std::string& file, const std::string& field, const std::string& found,
                    const std::string& expected, int line) {
    std::string text = onOneLine(file);
    if (line > 0) text.append(":").append(std::to_string(line));
    return text + ": " + field + " is " + found + ", expected " + expected;
}

}  // namespace

BundleError::BundleError(std::string file, std::string field, std::string found,
                         std::string expected, int line)
    : std::runtime_error(message(file, field, found, expected, line)),
      file_(std::move(file)),
      field_(std::move(field)),
      found_(std::move(found)),
      expected_(std::move(expected)),
      line_(line) {}

std::string inQuotes(std::string_view text) {
    std::string quote = "\"";
    for (const char c : text.substr(0, kLongestQuote)) {
        const bool plain = c >= 0x20 && c < 0x7f && c != '"';
        if (plain)
            quote += c;
        else
            quote += hexEscape(c);
    }
    return quote + (text.size() > kLongestQuote ? "...\"" : "\"");
}

std::string hexWord(std::uint32_t value) {
    std::string word = "0x";
    for (int shift = 28; shift >= 0; shift -= 4) word += kDigits[value >> shift & 15];
    return word;
}

}  // namespace facescan

#include "export/ply_header.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace facescan {
namespace {

constexpr std::size_t kMaxHeaderBytes = 64 * 1024;
constexpr std::size_t kMaxQuoted = 40;

/// Vertex' members in their order.
constexpr std::array kFields = {"x", "y", "z", "nx", "ny", "nz", "s", "t", "quality"};
constexpr std::size_t kFirstNormal = 3;
constexpr std::size_t kLastNormal = 5;

using Words = std::vector<std::string>;

[[noreturn]] void fail(const std::string& cause) {
    throw std::runtime_error(cause);
}

/// Text of the file as a message may show it: short and printable.
std::string quoted(std::string_view text) {
    std::string shown(text.substr(0, kMaxQuoted));
    std::ranges::replace_if(
        shown, [](char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + shown + (text.size() > kMaxQuoted ? "…'" : "'");
}

Words split(const std::string& line) {
    std::istringstream stream(line);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

std::uint64_t parseCount(const std::string& word) {
    std::uint64_t count = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, count);
    if (error != std::errc() || stop != end) fail("a count is " + quoted(word));
    return count;
}

std::size_t scalarBytes(const std::string& type) {
    struct Scalar {
        const char* name;
        const char* alias;
        std::size_t bytes;
    };
    static constexpr Scalar kScalars[] = {
        {"char", "int8", 1},     {"uchar", "uint8", 1},    {"short", "int16", 2},
        {"ushort", "uint16", 2}, {"int", "int32", 4},      {"uint", "uint32", 4},
        {"float", "float32", 4}, {"double", "float64", 8},
    };
    for (const Scalar& scalar : kScalars) {
        if (type == scalar.name || type == scalar.alias) return scalar.bytes;
    }
    fail("a property has the type " + quoted(type));
}

bool isFloat(const std::string& type) {
    return type == "float" || type == "float32";
}

/// Takes the header line by line; the element that the last `element` line began is current.
class HeaderParser {
public:
    HeaderParser() { header_.field.fill(PlyHeader::kAbsent); }

    void take(const std::string& line) {
        const Words words = split(line);
        if (words.empty()) fail("the header has an empty line");
        const std::string& keyword = words[0];
        if (keyword == "comment" || keyword == "obj_info") return takeComment(words);
        if (keyword == "format" && words.size() == 3) return takeFormat(words);
        if (keyword == "element" && words.size() == 3) return takeElement(words);
        if (keyword == "property" && words.size() == 3) return takeProperty(words[1], words[2]);
        if (keyword == "property" && words.size() == 5) return takeList(words);
        fail("the header has the line " + quoted(line));
    }

    PlyHeader finish() {
        if (!format_seen_) fail("the header has no format");
        if (element_ != "face") fail("the header has no faces");
        if (!list_seen_) fail("the faces have no vertex_indices");
        for (std::size_t k = 0; k < kFields.size(); ++k) {
            const bool normal = k >= kFirstNormal && k <= kLastNormal;
            if (!normal && header_.field[k] == PlyHeader::kAbsent) {
                fail("the vertices have no property " + quoted(kFields[k]));
            }
        }
        if (header_.texture_file.empty()) fail("the header has no comment TextureFile");
        return header_;
    }

private:
    void takeComment(const Words& words) {
        if (words.size() < 2 || words[1] != "TextureFile") return;
        // One word, and a plain name: what the file says must not lead out of its folder.
        const bool plain = words.size() == 3 && words[2] != "." && words[2] != ".." &&
                           words[2].find_first_of("/\\") == std::string::npos;
        if (!plain) fail("TextureFile is not the plain name of a file");
        header_.texture_file = words[2];
    }

    void takeFormat(const Words& words) {
        if (words[1] != "binary_little_endian" || words[2] != "1.0") {
            fail("the format is " + quoted(words[1] + " " + words[2]) +
                 "; binary_little_endian 1.0 expected");
        }
        format_seen_ = true;
    }

    void takeElement(const Words& words) {
        const std::string expected = element_.empty() ? "vertex" : "face";
        if (words[1] != expected || element_ == "face") {
            fail("the header has the element " + quoted(words[1]) +
                 "; vertex and then face expected");
        }
        element_ = expected;
        (element_ == "vertex" ? header_.vertices : header_.faces) = parseCount(words[2]);
    }

    void takeProperty(const std::string& type, const std::string& name) {
        if (element_ != "vertex") fail("the property " + quoted(name) + " is not one of vertices");
        if (!names_.insert(name).second) fail("the property " + quoted(name) + " stands twice");
        const auto field = std::ranges::find(kFields, name);
        if (field != kFields.end()) {
            if (!isFloat(type)) fail("the property " + quoted(name) + " is not float");
            header_.field[std::size_t(field - kFields.begin())] = header_.vertex_bytes;
        }
        header_.vertex_bytes += scalarBytes(type);
    }

    void takeList(const Words& words) {
        const bool expected = element_ == "face" && !list_seen_ && words[1] == "list" &&
                              scalarBytes(words[2]) == 1 && scalarBytes(words[3]) == 4 &&
                              !isFloat(words[3]) && words[4] == "vertex_indices";
        if (!expected) fail("a list other than the faces' `list uchar uint vertex_indices`");
        list_seen_ = true;
    }

    PlyHeader header_;
    std::set<std::string, std::less<>> names_;
    std::string element_;
    bool format_seen_ = false;
    bool list_seen_ = false;
};

/// Takes the next line, without its end, off the front of `rest`.
std::string takeLine(std::string_view& rest) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) fail("the header has no end");
    std::string line(rest.substr(0, end));
    if (line.ends_with('\r')) line.pop_back();
    rest.remove_prefix(end + 1);
    return line;
}

}  // namespace

PlyHeader parsePlyHeader(std::string_view bytes) {
    std::string_view rest = bytes.substr(0, kMaxHeaderBytes);
    if (!rest.starts_with("ply") || takeLine(rest) != "ply") {
        fail("not a PLY file; only PLY meshes by facescan's format are read");
    }
    HeaderParser parser;
    for (std::string line = takeLine(rest); line != "end_header"; line = takeLine(rest)) {
        parser.take(line);
    }
    PlyHeader header = parser.finish();
    header.size = std::size_t(rest.data() - bytes.data());
    return header;
}

}  // namespace facescan

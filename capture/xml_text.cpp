#include "capture/xml_text.h"

#include <utf8cpp/utf8.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>

#include "capture/bundle_error.h"

namespace facescan {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr std::string_view kWhiteSpace = " \t\r\n";
constexpr int kMaxAttributes = 256;
constexpr std::size_t kLongestReference = 12;  // &#x0010ffff;

bool isXmlCharacter(std::uint32_t c) {
    return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c < 0xd800) ||
           (c >= 0xe000 && c < 0xfffe) || (c >= 0x10000 && c < 0x110000);
}

/// Whether `name` stands for a character between "&" and ";".
bool isReference(std::string_view name) {
    if (!name.starts_with('#'))
        return name == "lt" || name == "gt" || name == "amp" || name == "quot" || name == "apos";
    const bool hex = name.starts_with("#x");
    const char* const begin = name.data() + (hex ? 2 : 1);
    const char* const end = name.data() + name.size();
    std::uint32_t character = 0;
    const auto [stop, error] = std::from_chars(begin, end, character, hex ? 16 : 10);
    return error == std::errc{} && stop == end && isXmlCharacter(character);
}

bool sameIgnoringCase(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char p, char q) { return lower(p) == lower(q); });
}

/// The value of `encoding` in the text of an XML declaration; empty where it has none.
std::string_view declaredEncoding(std::string_view declaration) {
    const std::size_t key = declaration.find("encoding");
    const std::size_t open = declaration.find_first_of("\"'", key);
    if (key == declaration.npos || open == declaration.npos) return {};
    const std::string_view value = declaration.substr(open + 1);
    return value.substr(0, value.find(declaration[open]));
}

/// One walk over the document, which it takes piece by piece.
class PlainCopy {
public:
    PlainCopy(std::string_view document, const std::string& file)
        : document_(document), file_(file), rest_(document) {
        if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
        beginning_ = rest_.data();
    }

    std::string make() {
        checkCharacters();
        while (!rest_.empty()) copyPiece();
        return std::move(plain_);
    }

private:
    void copyPiece() {
        if (rest_.front() != '<')
            copy(rest_.substr(0, rest_.find('<')));
        else if (rest_.starts_with("<!--"))
            drop(take("<!--", "-->"));
        else if (rest_.starts_with("<![CDATA["))
            escape(take("<![CDATA[", "]]>"));
        else if (rest_.starts_with("<!"))
            fail(rest_, "markup", inQuotes(rest_), "no DTD and no declaration of an entity");
        else if (atDeclaration())
            dropDeclaration();
        else if (rest_.starts_with("<?"))
            drop(take("<?", "?>"));
        else
            copy(tag());
    }

    bool atDeclaration() const {
        return rest_.starts_with("<?xml") && rest_.substr(5, 1).find_first_of(kWhiteSpace) == 0;
    }

    void checkCharacters() const {
        const auto from = [&](const char* place) {
            return document_.substr(std::size_t(place - document_.data()));
        };
        const char* const end = document_.data() + document_.size();
        const std::string_view invalid = from(utf8::find_invalid(document_.data(), end));
        if (!invalid.empty())
            fail(invalid, "text", "not UTF-8 at " + inQuotes(invalid.substr(0, 4)), "UTF-8");
        const std::string_view forbidden = from(std::find_if(
            document_.data(), end, [](unsigned char c) { return !isXmlCharacter(c); }));
        if (!forbidden.empty())
            fail(forbidden, "text", "interrupted by " + inQuotes(forbidden.substr(0, 1)),
                 "characters that XML allows");
    }

    void dropDeclaration() {
        if (rest_.data() != beginning_)
            fail(rest_, "XML declaration", "inside the document", "nothing before it");
        const std::string_view declaration = take("<?xml", "?>");
        const std::string_view encoding = declaredEncoding(declaration);
        const auto is = [&](std::string_view name) { return sameIgnoringCase(encoding, name); };
        // ASCII is UTF-8 too.
        if (!(encoding.empty() || is("UTF-8") || is("UTF8") || is("US-ASCII") || is("ASCII")))
            fail(declaration, "encoding", inQuotes(encoding), "UTF-8");
        drop(declaration);
    }

    /// Takes a piece off the document and returns what stands between its brackets.
    std::string_view take(std::string_view open, std::string_view close) {
        const std::size_t end = rest_.find(close, open.size());
        if (end == rest_.npos)
            fail(rest_, "markup", inQuotes(rest_) + " without end", inQuotes(close));
        const std::string_view content = rest_.substr(open.size(), end - open.size());
        rest_.remove_prefix(end + close.size());
        return content;
    }

    /// The tag at which the document stands, brackets included.
    std::string_view tag() const {
        char quote = 0;
        int attributes = 0;
        for (std::size_t i = 1; i < rest_.size() && rest_[i] != '<'; ++i) {
            const char c = rest_[i];
            if (quote != 0) {
                if (c == quote) quote = 0;
            } else if (c == '>') {
                return rest_.substr(0, i + 1);
            } else if (c == '"' || c == '\'') {
                quote = c;
                if (++attributes > kMaxAttributes)
                    fail(rest_, "number of attributes", "beyond measure",
                         "at most " + std::to_string(kMaxAttributes) + " in an element");
            }
        }
        fail(rest_, "markup", inQuotes(rest_) + " without end", inQuotes(">"));
    }

    void copy(std::string_view piece) {
        for (std::size_t i = piece.find('&'); i != piece.npos; i = piece.find('&', i + 1)) {
            const std::string_view start = piece.substr(i, kLongestReference);
            const std::size_t end = start.find(';');
            if (end == start.npos || !isReference(start.substr(1, end - 1)))
                fail(piece.substr(i), "reference", inQuotes(start.substr(0, end)),
                     "a character that XML allows, or &lt; &gt; &amp; &quot; &apos;");
        }
        plain_ += piece;
        rest_.remove_prefix(piece.size());
    }

    void drop(std::string_view content) {
        plain_.append(std::size_t(std::count(content.begin(), content.end(), '\n')), '\n');
    }

    void escape(std::string_view content) {
        for (const char c : content) {
            if (c == '&')
                plain_ += "&amp;";
            else if (c == '<')
                plain_ += "&lt;";
            else
                plain_ += c;
        }
    }

    /// Complains about a place of the document.
    [[noreturn]] void fail(std::string_view place, const char* field, const std::string& found,
                           const std::string& expected) const {
        const auto lines_before = std::count(document_.data(), place.data(), '\n');
        throw BundleError(file_, field, found, expected, int(lines_before) + 1);
    }

    std::string_view document_;
    const std::string& file_;
    std::string_view rest_;
    const char* beginning_;
    std::string plain_;
};

}  // namespace

std::string plainXml(std::string_view document, const std::string& file) {
    return PlainCopy(document, file).make();
}

}  // namespace facescan

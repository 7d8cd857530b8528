#include "capture/xml_node.h"

#include <tinyxml2.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "capture/bundle_error.h"
#include "capture/numbers.h"
#include "capture/xml_text.h"

namespace facescan {
namespace {

constexpr const char* kWhiteSpace = " \t\r\n";

/// The element's own text; child elements separate its parts.
std::string ownText(const tinyxml2::XMLElement& element) {
    std::string text;
    for (const tinyxml2::XMLNode* node = element.FirstChild(); node; node = node->NextSibling())
        text += node->ToText() ? node->Value() : " ";
    return text;
}

std::vector<std::string_view> splitAtWhiteSpace(std::string_view text) {
    std::vector<std::string_view> words;
    std::size_t begin = text.find_first_not_of(kWhiteSpace);
    while (begin != text.npos) {
        const std::size_t end = std::min(text.find_first_of(kWhiteSpace, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(kWhiteSpace, end);
    }
    return words;
}

std::string enumerate(std::span<const char* const> words) {
    std::string list = words.front();
    for (const char* const word : words.subspan(1)) list += std::string(" or ") + word;
    return list;
}

}  // namespace

XmlNode XmlNode::child(const char* tag) const {
    const tinyxml2::XMLElement* const only = element_->FirstChildElement(tag);
    const std::string field = "<" + std::string(tag) + ">";
    const std::string expected = "exactly once in <" + name_ + ">";
    if (!only) fail(field, "missing", expected);
    const XmlNode node(*only, tag, *file_);
    if (only->NextSiblingElement(tag)) node.fail(field, "repeated", expected);
    return node;
}

std::vector<XmlNode> XmlNode::children(const char* tag, std::span<const char* const> names) const {
    std::vector<const tinyxml2::XMLElement*> found(names.size());
    const auto describe = [&](std::size_t i) { return std::string(tag) + " " + names[i]; };
    for (auto* e = element_->FirstChildElement(tag); e; e = e->NextSiblingElement(tag)) {
        const XmlNode node(*e, tag, *file_);
        const std::size_t i = node.choice("name", names);
        if (std::exchange(found[i], e)) node.fail(describe(i), "repeated", "exactly once");
    }
    std::vector<XmlNode> nodes;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!found[i]) fail(describe(i), "missing", "exactly once in <" + name_ + ">");
        nodes.emplace_back(*found[i], describe(i), *file_);
    }
    return nodes;
}

std::string_view XmlNode::attribute(const char* attribute_name) const {
    const char* const value = element_->Attribute(attribute_name);
    if (!value) fail(name_ + " " + attribute_name, "missing", "a value");
    return value;
}

int XmlNode::wholeNumber(const char* attribute_name, int min, int max) const {
    const std::optional<int> value = parseWholeNumber<int>(attribute(attribute_name));
    if (!value || *value < min || *value > max)
        failAttribute(attribute_name,
                      "a whole number from " + std::to_string(min) + " to " + std::to_string(max));
    return *value;
}

double XmlNode::decimal(const char* attribute_name) const {
    const std::optional<double> value = parseDecimal(attribute(attribute_name));
    if (!value) failAttribute(attribute_name, "a finite decimal number");
    return *value;
}

std::size_t XmlNode::choice(const char* attribute_name, std::span<const char* const> words) const {
    const auto word = std::find(words.begin(), words.end(), attribute(attribute_name));
    if (word == words.end()) failAttribute(attribute_name, enumerate(words));
    return std::size_t(word - words.begin());
}

void XmlNode::require(const char* attribute_name, const char* value) const {
    choice(attribute_name, {&value, 1});
}

std::vector<double> XmlNode::decimals(std::size_t count) const {
    const std::string text = ownText(*element_);
    const std::vector<std::string_view> words = splitAtWhiteSpace(text);
    if (words.size() != count)
        fail(name_, std::to_string(words.size()) + " numbers", std::to_string(count));
    std::vector<double> numbers;
    numbers.reserve(count);
    for (const std::string_view word : words) {
        const std::optional<double> number = parseDecimal(word);
        if (!number)
            fail(name_ + " number " + std::to_string(numbers.size() + 1), inQuotes(word),
                 "a finite decimal number");
        numbers.push_back(*number);
    }
    return numbers;
}

void XmlNode::failAttribute(const char* attribute_name, const std::string& expected) const {
    fail(name_ + " " + attribute_name, inQuotes(attribute(attribute_name)), expected);
}

void XmlNode::fail(const std::string& field, const std::string& found,
                   const std::string& expected) const {
    throw BundleError(*file_, field, found, expected, element_->GetLineNum());
}

XmlNode parseXml(std::string_view document, const std::string& file, const char* tag,
                 tinyxml2::XMLDocument& storage) {
    const std::string plain = plainXml(document, file);
    if (storage.Parse(plain.data(), plain.size()) != tinyxml2::XML_SUCCESS)
        throw BundleError(file, "document", std::string("malformed (") + storage.ErrorName() + ")",
                          "well-formed XML", storage.ErrorLineNum());
    const tinyxml2::XMLElement* const root = storage.RootElement();
    const std::string expected = "<" + std::string(tag) + ">, and nothing beside it";
    if (!root || storage.FirstChild() != storage.LastChild())
        throw BundleError(file, "root element", "not alone", expected);
    if (root->Name() != std::string_view(tag))
        throw BundleError(file, "root element", inQuotes(root->Name()), expected,
                          root->GetLineNum());
    return {*root, tag, file};
}

}  // namespace facescan

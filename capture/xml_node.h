#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace facescan {

/// An element that is read strictly: what is asked for is there, exactly once, and of the right
/// form, or a BundleError names the element and the attribute. What is not asked for is ignored.
class XmlNode {
public:
    /// @param name  the element in messages: "range", "input x"
    /// @param file  the document's path, for messages; it must outlive the node
    XmlNode(const tinyxml2::XMLElement& element, std::string name, const std::string& file)
        : element_(&element), name_(std::move(name)), file_(&file) {}

    /// The one child element `tag`.
    XmlNode child(const char* tag) const;

    /// The child elements `tag`, told apart by their attribute `name`: one for each of `names`, in
    /// that order, and no others.
    std::vector<XmlNode> children(const char* tag, std::span<const char* const> names) const;

    /// The attribute's value, which must be there.
    std::string_view attribute(const char* attribute_name) const;
    int wholeNumber(const char* attribute_name, int min, int max) const;
    double decimal(const char* attribute_name) const;

    /// The index of the attribute's value among the `words` that it may be.
    std::size_t choice(const char* attribute_name, std::span<const char* const> words) const;

    /// The attribute has the one value that it may have.
    void require(const char* attribute_name, const char* value) const;

    /// The element's text: `count` decimal numbers, separated by white space.
    std::vector<double> decimals(std::size_t count) const;

    /// Complains about the value of an attribute, or that it is missing.
    [[noreturn]] void failAttribute(const char* attribute_name, const std::string& expected) const;

private:
    [[noreturn]] void fail(const std::string& field, const std::string& found,
                           const std::string& expected) const;

    const tinyxml2::XMLElement* element_;
    std::string name_;
    const std::string* file_;
};

/// Parses a document into `storage` and returns its root element, which must be `tag`.
/// @throws BundleError where the document is not well-formed, or plainXml() refuses it
XmlNode parseXml(std::string_view document, const std::string& file, const char* tag,
                 tinyxml2::XMLDocument& storage);

}  // namespace facescan

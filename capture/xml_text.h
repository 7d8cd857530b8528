#pragma once

#include <string>
#include <string_view>

namespace facescan {

/// Brings an XML document into the plain form that tinyxml2 reads exactly: tags and text, lines as
/// they were. Comments, processing instructions and the declaration are dropped, CDATA sections
/// become text.
///
/// It refuses what tinyxml2 would let pass or choke on: bytes that are not UTF-8 and characters
/// that XML does not allow, DTDs, entities other than the five of XML, a zero character reference
/// (a text would silently end there), and more attributes than an element needs (they are compared
/// pairwise).
///
/// @param file  the document's path, for messages
/// @throws BundleError
std::string plainXml(std::string_view document, const std::string& file);

}  // namespace facescan

#include "capture/xml_text.h"

#include <gtest/gtest.h>

#include "capture/samples.h"

namespace facescan {
namespace {

using namespace test;

std::string plain(std::string_view document) {
    return plainXml(document, "scan.xml");
}

BundleError errorOf(std::string_view document) {
    return bundleErrorOf([&] { plain(document); });
}

TEST(PlainXml, LeavesTagsAndTextAsTheyAre) {
    const std::string document = "<a b='>' c=\"'&lt;\">\r\n\t1 &amp; 2 &#65;<d/></a>\n";
    EXPECT_EQ(plain(document), document);
    EXPECT_EQ(plain(""), "");
}

TEST(PlainXml, DropsCommentsAndInstructionsButNotTheirLines) {
    EXPECT_EQ(plain("<?xml version='1.0'\n?>\n<!--a\n\nb--><a>1<!-- <x> & -- -->2<?p <y>?>3</a>"),
              "\n\n\n\n<a>123</a>");
    EXPECT_EQ(plain("<!----><?p?><a/>"), "<a/>");
}

TEST(PlainXml, DropsAByteOrderMark) {
    EXPECT_EQ(plain("\xef\xbb\xbf<?xml version='1.0'?><a/>"), "<a/>");
}

TEST(PlainXml, TurnsCdataIntoText) {
    EXPECT_EQ(plain("<a><![CDATA[1 < 2 & ]3]]>\n<![CDATA[]]></a>"), "<a>1 &lt; 2 &amp; ]3\n</a>");
}

TEST(PlainXml, TakesEveryReferenceToACharacterOfXml) {
    for (const char* reference :
         {"&lt;", "&gt;", "&amp;", "&quot;", "&apos;", "&#9;", "&#10;", "&#xD;", "&#x20;",
          "&#xd7ff;", "&#xE000;", "&#xFFFD;", "&#x10000;", "&#x0010ffff;"})
        EXPECT_EQ(plain(reference), reference);
}

TEST(PlainXml, RefusesOtherReferences) {
    for (const char* reference : {"&",
                                  "&;",
                                  "&lt",
                                  "& lt;",
                                  "&nbsp;",
                                  "&LT;",
                                  "&#;",
                                  "&#x;",
                                  "&#0;",
                                  "&#x0;",
                                  "&#8;",
                                  "&#x1f;",
                                  "&#xd800;",
                                  "&#xDFFF;",
                                  "&#xfffe;",
                                  "&#xFFFF;",
                                  "&#x110000;",
                                  "&#-65;",
                                  "&#65 ;",
                                  "&#X41;",
                                  "&#6a;",
                                  "&#99999999999;",
                                  "&#000000000000065;"}) {
        const BundleError error = errorOf("<a>\n" + std::string(reference) + "</a>");
        EXPECT_EQ(error.field(), "reference") << reference;
        EXPECT_EQ(error.line(), 2);
        EXPECT_THROW(plain("<a b='" + std::string(reference) + "'/>"), BundleError) << reference;
    }
}

TEST(PlainXml, RefusesDtdsAndDeclarationsOfEntities) {
    for (const char* markup :
         {"<!DOCTYPE facescan>", "<!DOCTYPE a [<!ENTITY b 'c'>]>", "<!ENTITY b 'c'>", "<!>"}) {
        const BundleError error = errorOf("<?xml version='1.0'?>\n" + std::string(markup) + "<a/>");
        EXPECT_EQ(error.field(), "markup") << markup;
        EXPECT_EQ(error.expected(), "no DTD and no declaration of an entity");
        EXPECT_EQ(error.line(), 2);
    }
}

TEST(PlainXml, TakesADoctypeInACommentOrCdataForWhatItIs) {
    EXPECT_EQ(plain("<!-- <!DOCTYPE a> --><a><![CDATA[<!ENTITY>]]></a>"), "<a>&lt;!ENTITY></a>");
}

TEST(PlainXml, RefusesMarkupWithoutEnd) {
    for (const char* markup : {"<!-- a", "<!-->", "<![CDATA[ a ]]", "<?a", "<a", "<a b='",
                               "<a b='>", "<a <b>", "<a b='<'>", "</a", "<"}) {
        const BundleError error = errorOf("<x>\n" + std::string(markup));
        EXPECT_EQ(error.field(), "markup") << markup;
        EXPECT_EQ(error.found(), inQuotes(markup) + " without end");
        EXPECT_EQ(error.line(), 2);
    }
}

TEST(PlainXml, TakesEveryNameOfAnEncodingThatIsUtf8) {
    for (const char* declaration :
         {"<?xml version='1.0'?>", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>",
          "<?xml version='1.0' encoding='utf-8' standalone='yes'?>",
          "<?xml version='1.0' encoding = 'utf8' ?>", "<?xml version='1.0' encoding='ASCII'?>",
          "<?xml version='1.0' encoding='us-ascii'?>", "<?xml version='1.0' encoding?>",
          "<?xml\tversion='1.0' ?>"})
        EXPECT_EQ(plain(std::string(declaration) + "<a/>"), "<a/>") << declaration;
}

TEST(PlainXml, RefusesOtherEncodings) {
    const BundleError error = errorOf("<?xml version='1.0' encoding='ISO-8859-1'?><a/>");
    EXPECT_STREQ(error.what(), "scan.xml:1: encoding is \"ISO-8859-1\", expected UTF-8");
    for (const char* name : {"UTF-16", "UTF-7", "utf-88", "UTF", "Z", "@tf-8", "[tf-8"})
        EXPECT_EQ(errorOf("<?xml encoding=\"" + std::string(name) + "\"?>").found(),
                  inQuotes(name));
}

TEST(PlainXml, RefusesADeclarationThatDoesNotComeFirst) {
    EXPECT_EQ(errorOf("\n<?xml version='1.0'?><a/>").field(), "XML declaration");
    EXPECT_EQ(errorOf("<a><?xml version='1.0'?></a>").field(), "XML declaration");
}

TEST(PlainXml, KnowsAnInstructionWhoseNameBeginsWithXml) {
    EXPECT_EQ(plain("<a/><?xml-stylesheet href='a'?><?xmlx?>"), "<a/>");
}

TEST(PlainXml, RefusesBytesThatAreNotUtf8) {
    for (const char* bytes : {"\xff", "\x80", "\xc0\xaf", "\xe9t\xe9", "\xed\xa0\x80",
                              "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80", "\xe2\x82"}) {
        const BundleError error = errorOf("<a>\n\n" + std::string(bytes) + "</a>");
        EXPECT_EQ(error.field(), "text") << inQuotes(bytes);
        EXPECT_EQ(error.expected(), "UTF-8");
        EXPECT_EQ(error.line(), 3);
    }
    EXPECT_EQ(plain("<a>\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80</a>"),
              "<a>\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80</a>");
}

TEST(PlainXml, RefusesUtf16) {
    using namespace std::string_view_literals;
    EXPECT_EQ(errorOf("\xff\xfe<\0a\0/\0>\0"sv).expected(), "UTF-8");
    EXPECT_EQ(errorOf("<\0a\0/\0>\0"sv).found(), "interrupted by \"\\x00\"");
}

TEST(PlainXml, RefusesControlCharacters) {
    for (char c = 0; c < 0x20; ++c) {
        const std::string document = "<a>\n" + std::string(1, c) + "</a>";
        if (c == '\t' || c == '\n' || c == '\r')
            EXPECT_EQ(plain(document), document);
        else
            EXPECT_EQ(errorOf(document).found(), "interrupted by " + inQuotes({&c, 1}));
    }
}

TEST(PlainXml, BoundsTheAttributesOfAnElement) {
    std::string attributes;
    for (int i = 0; i < 256; ++i) attributes += " a" + std::to_string(i) + "='x'";
    EXPECT_NO_THROW(plain("<a" + attributes + "/><b" + attributes + "/>"));
    EXPECT_EQ(errorOf("<a" + attributes + " b=''/>").field(), "number of attributes");
}

}  // namespace
}  // namespace facescan

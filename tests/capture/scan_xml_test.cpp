#include "capture/scan_xml.h"

#include <gtest/gtest.h>

#include <locale>

#include "capture/samples.h"

namespace facescan {
namespace {

using namespace test;

ScanDocument parse(std::string_view document) {
    return parseScanXml(document, "scan.xml");
}

TEST(ScanXml, IsRead) {
    const ScanDocument scan = parse(sampleXml());
    EXPECT_EQ(scan.frames_file, "frames.bin");
    expectSame(scan.description, sampleDescription());
}

TEST(ScanXml, IsReadAsItIsWritten) {
    const std::string text = formatScanXml(sampleDescription());
    expectSame(parse(text).description, sampleDescription());
    EXPECT_EQ(parse(text).frames_file, "frames.bin");
}

struct Edit {
    const char* part;         ///< of the sample
    const char* replacement;  ///< its new text
};

void PrintTo(const Edit& edit, std::ostream* out) {
    *out << edit.part << " -> " << edit.replacement;
}

class ScanXmlVariant : public testing::TestWithParam<Edit> {};

TEST_P(ScanXmlVariant, MeansTheSame) {
    expectSame(parse(sampleXmlWith(GetParam().part, GetParam().replacement)).description,
               sampleDescription());
}

INSTANTIATE_TEST_SUITE_P(
    Unknown, ScanXmlVariant,
    testing::Values(Edit{"<frames ", "<device serial='7'/><frames "},
                    Edit{"<frames ", "<more><frames count='x'/><image/></more><frames "},
                    Edit{"<frames ", "some text <frames "},
                    Edit{"<frames ", "<frames exposure='8.3' "},
                    Edit{"bits=\"4\"", "bits=\"4\" Bits=\"5\" xmlns:p=\"urn:p\" p:bits=\"5\""},
                    Edit{"<range ", "<temperature>36.6</temperature><range "},
                    Edit{"0.5 -1 2e1 3", "0.5 -1<note>9</note>2e1 3"},
                    Edit{"2 3 4</output>", "2 3<note/> <note/>4</output>"},
                    Edit{"version=\"1\"", "version=\"1\" minor=\"7\""}));

INSTANTIATE_TEST_SUITE_P(
    Style, ScanXmlVariant,
    testing::Values(Edit{"first=\"0\" count=\"8\"", "count='8'\n\tfirst = \"0\""},
                    Edit{"count=\"8\"/>", "count=\"8\"></frames >"},
                    Edit{"count=\"8\"/>", "count=\"&#x38;\"/>"}, Edit{"bits=\"4\"", "bits=\"+4\""},
                    Edit{"bits=\"4\"", "bits=\"04\""},
                    Edit{"0.5 -1 2e1 3", "\n\t.5\r\n -1.0E+00 +20.\t3 \n"},
                    Edit{"0.5 -1 2e1 3", "<![CDATA[0.5 -1]]> <![CDATA[2e1 ]]>3"},
                    Edit{"0.5 -1 2e1 3", "0.<!-- half -->5 -1 <?p?><!--\n--> 20 3"},
                    Edit{"scale=\"9\"", "scale=\"0.9e1\""},
                    Edit{"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", ""},
                    Edit{"</facescan>", "</facescan><!-- end --><?end?>\n\n"}));

TEST(ScanXml, MayHaveItsElementsInAnyOrder) {
    std::string xml = sampleXml();
    const auto take = [&](std::string_view from, std::string_view to) {
        const std::size_t begin = xml.find(from);
        const std::size_t end = xml.find(to, begin) + to.size();
        const std::string part = xml.substr(begin, end - begin);
        xml.erase(begin, part.size());
        return part;
    };
    const std::string frames = take("<frames", "/>");
    const std::string input = take("<input", "/>");
    const std::string output = take("<output name=\"X\"", "</output>");
    const std::string range = take("<range", "/>");
    const std::string calibration = take("<calibration", "units=\"mm\">");
    xml.insert(xml.find("<image"), calibration + range + output);
    xml.insert(xml.find("<image"), take("<input name=\"y\"", "</calibration>").insert(0, input));
    xml.insert(xml.find("</facescan>"), frames);
    expectSame(parse(xml).description, sampleDescription());
}

TEST(ScanXml, NamesOtherFramesFiles) {
    for (const char* name : {"a", ".hidden", "scan 7.bin", "frames.", "\xc3\xa9t\xc3\xa9.bin"})
        EXPECT_EQ(parse(sampleXmlWith("frames.bin", name)).frames_file, name);
}

TEST(ScanXml, ReportsTheLineOfAFlawAlsoBehindCommentsAndInstructions) {
    const auto lineOf = [](const std::string& xml) {
        return bundleErrorOf([&] { parse(xml); }).line();
    };
    EXPECT_EQ(lineOf(sampleXmlWith("max=\"520\"", "max=\"x\"")), 13);
    EXPECT_EQ(lineOf(sampleXmlWith("max=\"520\"", "max=\"x\"").insert(38, "<!--\n\n--><?a\n?>")),
              16);
    EXPECT_EQ(lineOf(sampleXmlWith("<image", "<frames/><image")), 3);
    EXPECT_EQ(lineOf(sampleXmlWith("</calibration>", "")), 6);
}

TEST(ScanXml, TakesTheLimitsOfEveryPatternAndDegree) {
    for (int bits = 4; bits <= 12; ++bits)
        for (int degree = 1; degree <= 5; ++degree) {
            ScanDescription scan = sampleDescription();
            scan.first_frame = 1024;
            scan.image = {8176, 8176, 8192, 16};
            scan.pattern = {bits, CodeAxis::x, FrameOrder::grouped};
            scan.calibration.degree = degree;
            const int terms[] = {4, 10, 20, 35, 56};
            for (auto& output : scan.calibration.coefficients)
                output.assign(std::size_t(terms[degree - 1]), 1.0 / 3);
            expectSame(parse(formatScanXml(scan)).description, scan);
        }
}

TEST(ScanXml, CutAnywhereIsRefused) {
    const std::string xml = sampleXml();
    const std::size_t end = xml.rfind('>');
    for (std::size_t size = 0; size <= end; ++size)
        EXPECT_THROW(parse(xml.substr(0, size)), BundleError) << size << " bytes";
}

TEST(ScanXml, EmptyOrBlankIsRefused) {
    for (const char* text : {"", " \n", "\xef\xbb\xbf", "<!-- a -->", "<?xml version='1.0'?>"})
        EXPECT_EQ(bundleErrorOf([&] { parse(text); }).field(), "document") << text;
}

TEST(ScanXml, OfAnotherKindIsRefused) {
    EXPECT_STREQ(bundleErrorOf([] { parse("\n<svg/>"); }).what(),
                 "scan.xml:2: root element is \"svg\", expected <facescan>, and nothing beside it");
    EXPECT_EQ(bundleErrorOf([] { parse("\xff\xd8\xff\xe0 a JPEG"); }).field(), "text");
    EXPECT_EQ(bundleErrorOf([] { parse("{\"facescan\": 1}"); }).field(), "document");
    EXPECT_EQ(bundleErrorOf([] { parse("<!-- -->text<!-- -->\n<a"); }).field(), "markup");
}

TEST(ScanXml, NestedDeepIsRefusedWithoutOverflowOfTheStack) {
    const auto nested = [](int depth) {
        std::string open, close;
        for (int i = 0; i < depth; ++i) {
            open += "<a>";
            close += "</a>";
        }
        return sampleXmlWith("<image ", open + close + "<image ");
    };
    EXPECT_NO_THROW(parse(nested(50)));
    EXPECT_EQ(bundleErrorOf([&] { parse(nested(10000)); }).field(), "document");
    EXPECT_EQ(bundleErrorOf([&] { parse(std::string(1 << 20, '<')); }).field(), "markup");
}

TEST(ScanXml, UpToTheLargestSizeIsReadAndBeyondIsRefusedUnread) {
    std::string xml = sampleXml();
    xml.append(kMaxScanXmlBytes - xml.size(), '\n');
    const auto read = [&] {
        MemorySource source("scan.xml",
                            {reinterpret_cast<const std::uint8_t*>(xml.data()), xml.size()});
        return readScanXml(source);
    };
    expectSame(read().description, sampleDescription());
    xml += '\n';
    EXPECT_STREQ(bundleErrorOf(read).what(),
                 "scan.xml: file size is 1048577 bytes, expected at most 1048576");
}

/// Groups of digits and a decimal comma, as in German.
class CommaPunctuation : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

TEST(ScanXml, DoesNotDependOnTheGlobalLocale) {
    const std::string before = formatScanXml(sampleDescription());
    const std::locale old = std::locale::global(std::locale(std::locale(), new CommaPunctuation));
    const ScanDescription read = parse(sampleXml()).description;
    const std::string after = formatScanXml(sampleDescription());
    std::locale::global(old);
    expectSame(read, sampleDescription());
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace facescan

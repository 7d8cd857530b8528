#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/samples.h"
#include "capture/scan_xml.h"

// One broken rule of scan.xml after the other, element by element, and the line that names it.

namespace facescan {
namespace {

using testing::HasSubstr;
using namespace test;

struct Edit {
    const char* part;         ///< of the sample
    const char* replacement;  ///< its new text
    const char* complaint;
};

void PrintTo(const Edit& edit, std::ostream* out) {
    *out << edit.part << " -> " << edit.replacement;
}

class ScanXmlFlaw : public testing::TestWithParam<Edit> {};

TEST_P(ScanXmlFlaw, IsRefusedByName) {
    EXPECT_THAT(bundleErrorOf([] {
                    parseScanXml(sampleXmlWith(GetParam().part, GetParam().replacement),
                                 "scan.xml");
                }).what(),
                HasSubstr(": " + std::string(GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(
    Root, ScanXmlFlaw,
    testing::Values(
        Edit{"version=\"1\">", "version=\"2\">", R"(facescan version is "2", expected 1)"},
        Edit{"version=\"1\">", "version=\"01\">", R"(facescan version is "01", expected 1)"},
        Edit{"facescan version=\"1\"", "facescan", "facescan version is missing, expected a value"},
        Edit{"</facescan>", "</facescan><facescan version=\"1\"/>", "root element is not alone"},
        Edit{"<facescan", "text<facescan", "root element is not alone"},
        Edit{"</facescan>", "</facescan>text", "document is malformed (XML_ERROR_"},
        Edit{"</facescan>", "", "document is malformed (XML_ERROR_"},
        Edit{"</calibration>", "", "document is malformed (XML_ERROR_"},
        Edit{"bits=\"4\"", "bits=\"4\" bits=\"4\"", "document is malformed (XML_ERROR_"},
        Edit{"bits=\"4\"", "bits=4", "document is malformed (XML_ERROR_"},
        Edit{"<image ", "<!DOCTYPE a><image ", "markup is \"<!DOCTYPE a><image "},
        Edit{"count=\"8\"", "count=\"8&#0;\"", "reference is \"&#0\""}));

INSTANTIATE_TEST_SUITE_P(
    Frames, ScanXmlFlaw,
    testing::Values(
        Edit{"<frames ", "<Frames ", "<frames> is missing, expected exactly once in <facescan>"},
        Edit{"<image ", "<frames/><image ", "<frames> is repeated, expected exactly once"},
        Edit{"file=\"frames.bin\" ", "", "frames file is missing"},
        Edit{"\"frames.bin\"", "\"\"", "frames file is \"\", expected a plain file name"},
        Edit{"\"frames.bin\"", "\"../frames.bin\"", "frames file is \"../frames.bin\", expected"},
        Edit{"\"frames.bin\"", "\"..\"", "frames file is \"..\", expected"},
        Edit{"\"frames.bin\"", "\"a..b\"", "frames file is \"a..b\", expected"},
        Edit{"\"frames.bin\"", "\".\"", "frames file is \".\", expected"},
        Edit{"\"frames.bin\"", "\"/etc/passwd\"", "frames file is \"/etc/passwd\", expected"},
        Edit{"\"frames.bin\"", "\"a/b\"", "frames file is \"a/b\", expected"},
        Edit{"\"frames.bin\"", "\"a\\b\"", "frames file is \"a\\b\", expected"},
        Edit{"\"frames.bin\"", "\"&#x2f;a\"", "frames file is \"/a\", expected"},
        Edit{"first=\"0\" ", "", "frames first is missing"},
        Edit{"first=\"0\"", "first=\"-1\"",
             "frames first is \"-1\", expected a whole number from 0 to 1024"},
        Edit{"first=\"0\"", "first=\"1025\"", "frames first is \"1025\", expected"},
        Edit{"first=\"0\"", "first=\"4294967296\"", "frames first is \"4294967296\", expected"},
        Edit{"first=\"0\"", "first=\"\"", "frames first is \"\", expected"},
        Edit{"count=\"8\"", "", "frames count is missing"},
        Edit{"count=\"8\"", "count=\"7\"", "frames count is \"7\", expected 8, twice the bits"},
        Edit{"count=\"8\"", "count=\"9\"", "frames count is \"9\", expected 8, twice the bits"},
        Edit{"count=\"8\"", "count=\"8.0\"", "frames count is \"8.0\", expected a whole number"},
        Edit{"count=\"8\"", "count=\" 8\"", "frames count is \" 8\", expected a whole number"},
        Edit{"count=\"8\"", "count=\"8x\"", "frames count is \"8x\", expected a whole number"},
        Edit{"count=\"8\"", "count=\"0x8\"", "frames count is \"0x8\", expected a whole number"}));

INSTANTIATE_TEST_SUITE_P(
    Image, ScanXmlFlaw,
    testing::Values(Edit{"<image ", "<picture ", "<image> is missing"},
                    Edit{"<pattern ", "<image/><pattern ", "<image> is repeated"},
                    Edit{"x=\"1\" ", "", "image x is missing"},
                    Edit{"y=\"0\" ", "", "image y is missing"},
                    Edit{"width=\"17\" ", "", "image width is missing"},
                    Edit{"height=\"16\"", "", "image height is missing"},
                    Edit{"x=\"1\"", "x=\"-1\"",
                         "image x is \"-1\", expected a whole number from 0 to 8176"},
                    Edit{"x=\"1\"", "x=\"8177\"", "image x is \"8177\", expected"},
                    Edit{"y=\"0\"", "y=\"-1\"", "image y is \"-1\", expected"},
                    Edit{"y=\"0\"", "y=\"2147483647\"", "image y is \"2147483647\", expected"},
                    Edit{"width=\"17\"", "width=\"15\"",
                         "image width is \"15\", expected a whole number from 16 to 8192"},
                    Edit{"width=\"17\"", "width=\"8193\"", "image width is \"8193\", expected"},
                    Edit{"height=\"16\"", "height=\"15\"", "image height is \"15\", expected"},
                    Edit{"height=\"16\"", "height=\"8193\"", "image height is \"8193\", expected"},
                    Edit{"height=\"16\"", "height=\"1e2\"", "image height is \"1e2\", expected"}));

INSTANTIATE_TEST_SUITE_P(
    PatternElement, ScanXmlFlaw,
    testing::Values(Edit{"<pattern ", "<patterns ", "<pattern> is missing"},
                    Edit{"<image ", "<pattern/><image ", "<pattern> is repeated"},
                    Edit{"type=\"gray\" ", "", "pattern type is missing"},
                    Edit{"\"gray\"", "\"Gray\"", "pattern type is \"Gray\", expected gray"},
                    Edit{"bits=\"4\" ", "", "pattern bits is missing"},
                    Edit{"bits=\"4\"", "bits=\"3\"",
                         "pattern bits is \"3\", expected a whole number from 4 to "},
                    Edit{"bits=\"4\"", "bits=\"13\"", "pattern bits is \"13\", expected"},
                    Edit{"bits=\"4\"", "bits=\"5\"",
                         "frames count is \"8\", expected 10, twice the bits"},
                    Edit{"axis=\"y\" ", "", "pattern axis is missing"},
                    Edit{"axis=\"y\"", "axis=\"z\"", "pattern axis is \"z\", expected x or y"},
                    Edit{"axis=\"y\"", "axis=\"Y\"", "pattern axis is \"Y\", expected x or y"},
                    Edit{"axis=\"y\"", "axis=\"\"", "pattern axis is \"\", expected x or y"},
                    Edit{"order=\"interleaved\"", "", "pattern order is missing"},
                    Edit{"\"interleaved\"", "\"mixed\"",
                         "pattern order is \"mixed\", expected interleaved or grouped"}));

INSTANTIATE_TEST_SUITE_P(
    CalibrationElement, ScanXmlFlaw,
    testing::Values(Edit{"<image ", "<calibration/><image ", "<calibration> is repeated"},
                    Edit{"model=\"polynomial\" ", "", "calibration model is missing"},
                    Edit{"\"polynomial\"", "\"pinhole\"",
                         "calibration model is \"pinhole\", expected polynomial"},
                    Edit{"units=\"mm\"", "", "calibration units is missing"},
                    Edit{"units=\"mm\"", "units=\"m\"", "calibration units is \"m\", expected mm"},
                    Edit{"degree=\"1\" ", "", "calibration degree is missing"},
                    Edit{"degree=\"1\"", "degree=\"0\"",
                         "calibration degree is \"0\", expected a whole number from 1 to 5"},
                    Edit{"degree=\"1\"", "degree=\"6\"", "calibration degree is \"6\", expected"},
                    Edit{"degree=\"1\"", "degree=\"1.0\"",
                         "calibration degree is \"1.0\", expected"},
                    Edit{"degree=\"1\"", "degree=\"2\"", "output X is 4 numbers, expected 10"}));

INSTANTIATE_TEST_SUITE_P(
    Input, ScanXmlFlaw,
    testing::Values(
        Edit{"<input name=\"x\"", "<in name=\"x\"",
             "input x is missing, expected exactly once in <calibration>"},
        Edit{"<input name=\"code\"", "<in name=\"code\"", "input code is missing"},
        Edit{"name=\"y\" offset", "name=\"x\" offset",
             "input x is repeated, expected exactly once"},
        Edit{"name=\"y\" offset", "name=\"z\" offset",
             "input name is \"z\", expected x or y or code"},
        Edit{"name=\"y\" offset", "offset", "input name is missing"},
        Edit{"offset=\"8.5\" ", "", "input x offset is missing"},
        Edit{"scale=\"9\"", "", "input x scale is missing"},
        Edit{"offset=\"8.5\"", "offset=\"8,5\"",
             "input x offset is \"8,5\", expected a finite decimal number"},
        Edit{"offset=\"8.5\"", "offset=\"nan\"", "input x offset is \"nan\", expected"},
        Edit{"offset=\"8.5\"", "offset=\"inf\"", "input x offset is \"inf\", expected"},
        Edit{"offset=\"8.5\"", "offset=\"0x1p3\"", "input x offset is \"0x1p3\", expected"},
        Edit{"offset=\"8.5\"", "offset=\"8.5 \"", "input x offset is \"8.5 \", expected"},
        Edit{"scale=\"9\"", "scale=\"0\"",
             "input x scale is \"0\", expected a number that is not zero"},
        Edit{"scale=\"-8\"", "scale=\"-0.0\"", "input y scale is \"-0.0\", expected a number that"},
        Edit{"scale=\"8\"", "scale=\"1e999\"",
             "input code scale is \"1e999\", expected a finite"}));

INSTANTIATE_TEST_SUITE_P(
    Output, ScanXmlFlaw,
    testing::Values(Edit{"<output name=\"Z\"", "<output name=\"W\"",
                         "output name is \"W\", expected X or Y or Z"},
                    Edit{"<output name=\"Z\"", "<output name=\"Y\"", "output Y is repeated"},
                    Edit{"<output name=\"Z\">400 0 0 1e-3</output>", "", "output Z is missing"},
                    Edit{"0.5 -1 2e1 3", "", "output X is 0 numbers, expected 4"},
                    Edit{"0.5 -1 2e1 3", "0.5 -1 2e1", "output X is 3 numbers, expected 4"},
                    Edit{"1 2 3 4", "1 2 3 4 5", "output Y is 5 numbers, expected 4"},
                    Edit{"1 2 3 4", "1, 2, 3, 4",
                         "output Y number 1 is \"1,\", expected a finite decimal"},
                    Edit{"1e-3", "1e-3mm", "output Z number 4 is \"1e-3mm\", expected"},
                    Edit{"1e-3", "nan", "output Z number 4 is \"nan\", expected"},
                    Edit{"1e-3", "-inf", "output Z number 4 is \"-inf\", expected"},
                    Edit{"1e-3", "0x1", "output Z number 4 is \"0x1\", expected"},
                    Edit{"1e-3", "1e400", "output Z number 4 is \"1e400\", expected"}));

INSTANTIATE_TEST_SUITE_P(
    Range, ScanXmlFlaw,
    testing::Values(
        Edit{"<range ", "<reach ", "<range> is missing, expected exactly once in <calibration>"},
        Edit{"<range ", "<range/><range ", "<range> is repeated"},
        Edit{"min=\"300\" ", "", "range min is missing"},
        Edit{"max=\"520\"", "", "range max is missing"},
        Edit{"min=\"300\"", "min=\"NaN\"", "range min is \"NaN\", expected a finite"},
        Edit{"max=\"520\"", "max=\"300\"", "range max is \"300\", expected more than min"},
        Edit{"max=\"520\"", "max=\"-520\"", "range max is \"-520\", expected more than min"}));

}  // namespace
}  // namespace facescan

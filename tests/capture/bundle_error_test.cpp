#include "capture/bundle_error.h"

#include <gtest/gtest.h>

namespace facescan {
namespace {

TEST(BundleError, IsOneLineWithFileFieldFoundAndExpected) {
    const BundleError error("scan7/frames.bin", "width", "15", "16 to 8192");
    EXPECT_STREQ(error.what(), "scan7/frames.bin: width is 15, expected 16 to 8192");
    EXPECT_EQ(error.file(), "scan7/frames.bin");
    EXPECT_EQ(error.field(), "width");
    EXPECT_EQ(error.found(), "15");
    EXPECT_EQ(error.expected(), "16 to 8192");
    EXPECT_EQ(error.line(), 0);
}

TEST(BundleError, NamesTheLineOfATextFile) {
    const BundleError error("scan.xml", "range max", "\"200\"", "more than min", 12);
    EXPECT_STREQ(error.what(), "scan.xml:12: range max is \"200\", expected more than min");
    EXPECT_EQ(error.line(), 12);
}

TEST(BundleError, StaysOneLineWhateverThePathHolds) {
    const BundleError error("a\nb\x7f\xc3\xa9", "file", "missing", "a file");
    EXPECT_STREQ(error.what(), "a\\x0ab\\x7f\xc3\xa9: file is missing, expected a file");
}

TEST(InQuotes, ShowsTextInQuotes) {
    EXPECT_EQ(inQuotes(""), "\"\"");
    EXPECT_EQ(inQuotes(" 16 "), "\" 16 \"");
}

TEST(InQuotes, EscapesWhatATerminalWouldActOn) {
    EXPECT_EQ(inQuotes("a\"\n\x1b[2J\x7f\xff~"), "\"a\\x22\\x0a\\x1b[2J\\x7f\\xff~\"");
}

TEST(InQuotes, ShortensLongText) {
    EXPECT_EQ(inQuotes(std::string(40, 'x')), "\"" + std::string(40, 'x') + "\"");
    EXPECT_EQ(inQuotes(std::string(41, 'x')), "\"" + std::string(40, 'x') + "...\"");
}

TEST(HexWord, HasEightDigits) {
    EXPECT_EQ(hexWord(0), "0x00000000");
    EXPECT_EQ(hexWord(0x59455247), "0x59455247");
    EXPECT_EQ(hexWord(0xfedcba98), "0xfedcba98");
}

}  // namespace
}  // namespace facescan

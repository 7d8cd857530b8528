#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>

#include "capture/samples.h"
#include "capture/scan_xml.h"

namespace facescan {
namespace {

using namespace test;

/// A process in a country with a decimal comma. Where no such locale is installed, one is made
/// from the sources of the C library's locales.
class DecimalComma : public testing::Test {
protected:
    void SetUp() override {
        if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) {
            const std::string make = "localedef -i de_DE -f UTF-8 '" +
                                     (folder_ / "de_DE.UTF-8").string() + "' >/dev/null 2>&1";
            ::setenv("LOCPATH", folder_.path().c_str(), 1);
            if (std::system(make.c_str()) != 0 || !std::setlocale(LC_ALL, "de_DE.UTF-8"))
                GTEST_SKIP() << "no locale with a decimal comma: install locales";
        }
        ASSERT_STREQ(std::localeconv()->decimal_point, ",");
    }

    void TearDown() override {
        std::setlocale(LC_ALL, "C");
        ::unsetenv("LOCPATH");
    }

    TempFolder folder_;
};

TEST_F(DecimalComma, DoesNotChangeHowADocumentIsReadAndWritten) {
    expectSame(parseScanXml(sampleXml(), "scan.xml").description, sampleDescription());
    EXPECT_THROW(parseScanXml(sampleXmlWith("8.5", "8,5"), "scan.xml"), BundleError);

    const std::string text = formatScanXml(sampleDescription());
    EXPECT_NE(text.find("offset=\"8.5\""), text.npos) << text;
    EXPECT_EQ(text.find(','), text.npos) << text;
}

}  // namespace
}  // namespace facescan

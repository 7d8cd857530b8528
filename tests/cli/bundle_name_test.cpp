#include "cli/bundle_name.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace facescan {
namespace {

namespace fs = std::filesystem;

TEST(BundleName, IsTheLastComponent) {
    EXPECT_EQ(bundleName("scans/anna"), "anna");
    EXPECT_EQ(bundleName("anna"), "anna");
    EXPECT_EQ(bundleName("/anna.bundle"), "anna.bundle");
}

TEST(BundleName, HasNoSlashesBehindIt) {
    EXPECT_EQ(bundleName("scans/anna/"), "anna");
    EXPECT_EQ(bundleName("scans/anna//"), "anna");
    EXPECT_EQ(bundleName("scans/anna/."), "anna");
    EXPECT_EQ(bundleName("scans/anna/x/.."), "anna");
}

TEST(BundleName, OfDotsIsThatOfTheFolder) {
    const fs::path here = fs::canonical(fs::current_path());
    EXPECT_EQ(bundleName("."), here.filename());
    EXPECT_EQ(bundleName("./"), here.filename());
    EXPECT_EQ(bundleName(".."), here.parent_path().filename());
}

TEST(BundleName, OfTheRootIsSomethingToWriteTo) {
    EXPECT_EQ(bundleName("/"), "scan");
}

}  // namespace
}  // namespace facescan

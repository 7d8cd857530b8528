#include "cli/replay_plan.h"

#include <gtest/gtest.h>

#include "cli/errors.h"

namespace facescan {
namespace {

TEST(ReplayPlan, PutsASingleBundleIntoTheFolderItself) {
    const ReplayPlan plan({"scans/anna"}, "out", ResultFolder::itself);
    EXPECT_EQ(plan.job(0).bundle, "scans/anna");
    EXPECT_EQ(plan.job(0).folder, "out");
}

TEST(ReplayPlan, NamesFoldersByTheBundle) {
    const ReplayPlan plan({"a/anna", "b/bert/"}, "out", ResultFolder::by_name);
    ASSERT_EQ(plan.size(), 2u);
    EXPECT_EQ(plan.job(0).folder, "out/anna");
    EXPECT_EQ(plan.job(1).folder, "out/bert");
}

TEST(ReplayPlan, KeepsPaths) {
    const ReplayPlan plan({"a/scan", "./b//scan/", "scan/."}, "out", ResultFolder::by_path);
    EXPECT_EQ(plan.job(0).folder, "out/a/scan");
    EXPECT_EQ(plan.job(1).folder, "out/b/scan");
    EXPECT_EQ(plan.job(2).folder, "out/scan");
}

TEST(ReplayPlan, RefusesTwoOfOneFolder) {
    EXPECT_THROW(ReplayPlan({"a/anna", "bert", "b/anna/"}, "out", ResultFolder::by_name),
                 CommandError);
    EXPECT_THROW(ReplayPlan({"a/anna", "bert", "a/./anna"}, "out", ResultFolder::by_path),
                 CommandError);
}

TEST(ReplayPlan, RefusesToLeaveTheOutputFolder) {
    for (const char* bundle : {"../anna", "a/../../anna", "/anna", "..", ""})
        EXPECT_THROW(ReplayPlan({bundle}, "out", ResultFolder::by_path), CommandError) << bundle;
}

}  // namespace
}  // namespace facescan

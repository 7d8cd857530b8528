#include "cli/replay_scan.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "reconstruct/allocations.h"

namespace facescan {
namespace {

namespace fs = std::filesystem;

TEST(Replayer, TakesNoLargeMemoryAfterTheFirstScan) {
    const fs::path root = fs::path(testing::TempDir()) / "facescan_replayer";
    ReplaySettings settings;
    settings.preview = false;
    settings.durability = Durability::buffered;
    OutputFolders folders;
    Replayer replayer(settings, folders);
    const fs::path bundle = TEST_DATA_DIR "/face_still";
    EXPECT_EQ(replayer.replay({bundle, root / "a"}, bundle).error, "");

    const long before = test::allocations().bytes;
    const ReplayOutcome outcome = replayer.replay({bundle, root / "b"}, bundle);
    const long taken = test::allocations().bytes - before;
    fs::remove_all(root);
    EXPECT_EQ(outcome.error, "");
    EXPECT_LT(taken, 256 * 1024);  // paths, scan.xml, the report; frames alone are 5.9 MB
}

}  // namespace
}  // namespace facescan

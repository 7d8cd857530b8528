#include "capture/io_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <system_error>

#include "capture/bundle.h"
#include "capture/samples.h"

namespace facescan {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace test;

void writeSample(const std::filesystem::path& target) {
    writeBundle(target, sampleDescription(), makeFrames(8, 18, 16, 20).view());
}

struct FaultCase {
    Call call;
    int error;
};

class FaultOfACall : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultOfACall, AtAnyStepOfWritingLeavesNothingBehind) {
    const TempFolder folder;
    int faults = 0;
    for (int nth = 1;; ++nth) {
        const FaultyCall faulty(GetParam().call, nth, GetParam().error);
        try {
            writeSample(folder / "scan");
        } catch (const std::system_error& error) {
            EXPECT_EQ(error.code().value(), GetParam().error);
            EXPECT_THAT(error.what(), HasSubstr((folder / "scan").string()));
            EXPECT_THAT(error.what(), HasSubstr(": cannot "));
            EXPECT_THAT(namesIn(folder.path()), IsEmpty()) << "at call " << nth;
        }
        if (!faulty.happened()) break;
        ++faults;
    }
    EXPECT_GT(faults, 0);
    EXPECT_THAT(namesIn(folder.path()), ElementsAre("scan"));
    EXPECT_NO_THROW(readBundle(folder / "scan"));
}

INSTANTIATE_TEST_SUITE_P(WriteBundle, FaultOfACall,
                         testing::Values(FaultCase{Call::open, EMFILE},
                                         FaultCase{Call::write, ENOSPC},
                                         FaultCase{Call::write, EIO}, FaultCase{Call::fsync, EIO},
                                         FaultCase{Call::mkdir, EROFS},
                                         FaultCase{Call::rename, EIO}));

class FaultOfAReadingCall : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultOfAReadingCall, AtAnyStepIsOneErrorAndNoScan) {
    const TempFolder folder;
    writeSample(folder / "scan");
    int faults = 0;
    for (int nth = 1;; ++nth) {
        const FaultyCall faulty(GetParam().call, nth, GetParam().error);
        ScanBundle bundle;
        bundle.frames = makeFrames(1, 16, 16, 16);
        try {
            readBundle(folder / "scan", bundle);
        } catch (const BundleError& error) {
            EXPECT_THAT(error.what(), HasSubstr("file is unreadable ("));
            expectSame(bundle.frames, FrameStack{});
        }
        if (!faulty.happened()) break;
        ++faults;
    }
    EXPECT_GE(faults, 2) << "one for each file";
}

INSTANTIATE_TEST_SUITE_P(ReadBundle, FaultOfAReadingCall,
                         testing::Values(FaultCase{Call::open, EACCES},
                                         FaultCase{Call::fstat, EOVERFLOW},
                                         FaultCase{Call::read, EIO}));

TEST(Interrupts, AreWaitedOut) {
    const TempFolder folder;
    for (int nth = 1; nth <= 3; ++nth) {
        const std::filesystem::path scan = folder / ("scan" + std::to_string(nth));
        {
            const FaultyCall interrupted(Call::write, nth, EINTR);
            writeSample(scan);
            EXPECT_TRUE(interrupted.happened());
        }
        const FaultyCall interrupted(Call::read, nth, EINTR);
        expectSame(readBundle(scan).frames, makeFrames(8, 18, 16, 20));
        EXPECT_TRUE(interrupted.happened());
    }
}

TEST(ShortReadsAndWrites, AreContinued) {
    const TempFolder folder;
    const ShortTransfers shortly(7);
    writeSample(folder / "scan");
    expectSame(readBundle(folder / "scan").frames, makeFrames(8, 18, 16, 20));
}

}  // namespace
}  // namespace facescan

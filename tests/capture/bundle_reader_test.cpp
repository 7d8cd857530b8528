#include "capture/bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "capture/frames_file.h"
#include "capture/samples.h"

namespace facescan {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace test;
namespace fs = std::filesystem;

std::string errorOfReading(const fs::path& bundle) {
    return bundleErrorOf([&] { readBundle(bundle); }).what();
}

TEST(BundleReader, ReadsASoundBundle) {
    const TempFolder folder;
    const ScanBundle bundle = readBundle(writeSampleBundle(folder));
    expectSame(bundle.description, sampleDescription());
    expectSame(bundle.frames, makeFrames(8, 18, 16, 20));
    EXPECT_EQ(bundle.timing, (CaptureTiming{1735689600123456789, 16666667}));
}

TEST(BundleReader, ReadsTheGoldenBundle) {
    const ScanBundle bundle = readBundle(TEST_DATA_DIR "/bundle_golden");

    const ScanDescription& scan = bundle.description;
    EXPECT_EQ(scan.first_frame, 1);
    EXPECT_EQ(scan.image, (Rect{1, 0, 17, 16}));
    EXPECT_EQ(scan.pattern, (Pattern{4, CodeAxis::x, FrameOrder::grouped}));
    const Calibration& calibration = scan.calibration;
    EXPECT_EQ(calibration.degree, 2);
    EXPECT_EQ(calibration.x.offset, 8.5);
    EXPECT_EQ(calibration.x.scale, -9);
    EXPECT_EQ(calibration.y.offset, 7.5);
    EXPECT_EQ(calibration.code.scale, 8);
    EXPECT_THAT(calibration.coefficients[0], ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
    EXPECT_THAT(calibration.coefficients[1],
                ElementsAre(1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6e-3, 7e-3, 8e-3, 9e-3, 10e-3));
    EXPECT_THAT(calibration.coefficients[2],
                ElementsAre(400, -1.5, 2.25, -3.125, 0.4, 50, 0.5, -6, 0, 0));
    EXPECT_EQ(calibration.range_min_mm, 300);
    EXPECT_EQ(calibration.range_max_mm, 520);

    EXPECT_EQ(bundle.timing, (CaptureTiming{1735689600123456789, 16666667}));
    const FrameStackView frames = bundle.frames.view();
    ASSERT_EQ(frames.count, 10);
    ASSERT_EQ(frames.width, 18);
    ASSERT_EQ(frames.height, 16);
    ASSERT_EQ(frames.row_stride, 20);
    for (int f = 0; f < 10; ++f)
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 20; ++x)
                ASSERT_EQ(int(frames.frame(f)[y * 20 + x]),
                          x < 18 ? (37 * f + 11 * y + 5 * x) % 256 : 0xee);
}

TEST(BundleReader, ReadsTheRecordedBundles) {
    if (!fs::exists(SHARED_DATA_DIR)) GTEST_SKIP() << "no recordings at " SHARED_DATA_DIR;
    int bundles = 0;
    ScanBundle bundle;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(SHARED_DATA_DIR)) {
        if (entry.path().filename() != "scan.xml") continue;
        ASSERT_NO_THROW(readBundle(entry.path().parent_path(), bundle)) << entry.path();
        const FrameStack& frames = bundle.frames;
        EXPECT_EQ(frames.pixels.size(),
                  fs::file_size(entry.path().parent_path() / "frames.bin") - kFramesHeaderBytes);
        EXPECT_LE(bundle.description.pattern.frameCount(), frames.count);
        ++bundles;
    }
    if (bundles == 0) GTEST_SKIP() << "no recordings in " SHARED_DATA_DIR;
}

TEST(BundleReader, UsesTheMemoryOfTheBundleBefore) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    ScanBundle bundle = readBundle(path);
    const std::uint8_t* const memory = bundle.frames.pixels.data();
    bundle.frames.pixels[100] ^= 1;
    readBundle(path, bundle);
    EXPECT_EQ(bundle.frames.pixels.data(), memory);
    expectSame(bundle.frames, makeFrames(8, 18, 16, 20));
}

TEST(BundleReader, LeavesNoScanInABundleThatItCannotRead) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    ScanBundle bundle = readBundle(path);
    writeFile(path / "scan.xml", sampleXmlWith("520", "x"));
    EXPECT_THROW(readBundle(path, bundle), BundleError);
    expectSame(bundle.frames, FrameStack{});
    EXPECT_EQ(bundle.timing, CaptureTiming{});
    EXPECT_THAT(bundle.description.calibration.coefficients[0], IsEmpty());
}

TEST(BundleReader, ReadsTheFileThatTheDocumentNames) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    fs::rename(path / "frames.bin", path / "other frames");
    writeFile(path / "scan.xml", sampleXmlWith("frames.bin", "other frames"));
    EXPECT_NO_THROW(readBundle(path));
}

TEST(BundleFingerprint, IsThatOfTheBundleRead) {
    const TempFolder folder;
    const fs::path bundle = writeSampleBundle(folder);
    const std::string xml = sampleXml();
    const FramesHeaderBytes header = sampleHeader();
    const BundleFingerprint expected = {
        slowCrc({reinterpret_cast<const std::uint8_t*>(xml.data()), xml.size()}),
        slowCrc(std::span(header).first(60))};
    EXPECT_EQ(readBundle(bundle).fingerprint, expected);
    EXPECT_EQ(readBundleFingerprint(bundle), expected);
}

TEST(BundleFingerprint, ChangesWithTheDocumentAndWithThePixels) {
    const TempFolder folder;
    const fs::path bundle = writeSampleBundle(folder);
    const BundleFingerprint before = readBundleFingerprint(bundle);
    writeFile(bundle / "scan.xml", sampleXml() + "\n");
    const BundleFingerprint other_document = readBundleFingerprint(bundle);
    EXPECT_NE(other_document, before);
    Bytes file = sampleFramesFile();
    putNumber(file, 48, 4, 7);  // the CRC of other pixels
    renewHeaderCrc(file);
    writeFile(bundle / "frames.bin", file);
    EXPECT_NE(readBundleFingerprint(bundle), other_document);
}

TEST(BundleFingerprint, IsNotThatOfABrokenBundle) {
    const TempFolder folder;
    const fs::path bundle = writeSampleBundle(folder);
    fs::resize_file(bundle / "frames.bin", 100);
    EXPECT_EQ(bundleErrorOf([&] { readBundleFingerprint(bundle); }).what(), errorOfReading(bundle));
}

TEST(ExpectBundle, SaysNothingAboutWhatIsNotThere) {
    const TempFolder folder;
    expectBundle(folder / "missing");
    const fs::path bundle = writeSampleBundle(folder);
    expectBundle(bundle);
    readBundle(bundle);
}

TEST(BundleReader, MayBeGivenASlashAtTheEnd) {
    const TempFolder folder;
    EXPECT_NO_THROW(readBundle(writeSampleBundle(folder) / ""));
}

TEST(BundleReader, RejectsAFramesFileCutInItsHeaderOrAnywhere) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    const Bytes file = sampleFramesFile();
    for (std::size_t i = 0; i < 64 + 100; ++i) {
        const std::size_t size = i < 64 ? i : 64 + (i - 64) * (file.size() - 64) / 100;
        writeFile(path / "frames.bin", std::span(file).first(size));
        EXPECT_THAT(errorOfReading(path),
                    HasSubstr("bundle/frames.bin: file size is " + std::to_string(size)));
    }
}

TEST(BundleReader, RejectsAClaimOfManyPixelsByTheSizeOfTheFile) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    Bytes file = sampleFramesFile();
    putNumber(file, 16, 4, 1024);
    putNumber(file, 20, 4, 8192);
    putNumber(file, 24, 4, 8192);
    putNumber(file, 28, 4, 16384);
    renewHeaderCrc(std::span(file).first(64));
    writeFile(path / "frames.bin", file);
    EXPECT_THAT(errorOfReading(path),
                HasSubstr("file size is 2624 bytes, expected 137438953536 bytes"));
}

TEST(BundleReader, RejectsMissingPieces) {
    const TempFolder folder;
    EXPECT_THAT(
        errorOfReading(folder / "nothing"),
        EndsWith("nothing/scan.xml: file is missing, expected a regular file that can be read"));
    const fs::path path = writeSampleBundle(folder);
    fs::remove(path / "frames.bin");
    EXPECT_THAT(errorOfReading(path), HasSubstr("bundle/frames.bin: file is missing"));
    EXPECT_THAT(errorOfReading(path / "scan.xml"),
                HasSubstr("scan.xml/scan.xml: file is unreadable (Not a directory)"));
}

TEST(BundleReader, RejectsAPipeOrFolderInPlaceOfAFile) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    fs::remove(path / "frames.bin");
    ASSERT_EQ(::mkfifo((path / "frames.bin").c_str(), 0600), 0);
    EXPECT_THAT(errorOfReading(path), HasSubstr("frames.bin: file is a pipe"));
    fs::remove(path / "scan.xml");
    fs::create_directory(path / "scan.xml");
    EXPECT_THAT(errorOfReading(path), HasSubstr("scan.xml: file is a folder"));
}

TEST(BundleReader, RejectsAHugeDocumentUnread) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    fs::resize_file(path / "scan.xml", std::uintmax_t(1) << 40);
    EXPECT_THAT(errorOfReading(path),
                HasSubstr("scan.xml: file size is 1099511627776 bytes, expected at most 1048576"));
}

struct Edit {
    const char* part;
    const char* replacement;
    const char* complaint = "";
};

void PrintTo(const Edit& edit, std::ostream* out) {
    *out << edit.replacement;
}

class BundleWithinItsFrames : public testing::TestWithParam<Edit> {};

TEST_P(BundleWithinItsFrames, IsRead) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    writeFile(path / "scan.xml", sampleXmlWith(GetParam().part, GetParam().replacement));
    EXPECT_NO_THROW(readBundle(path));
}

constexpr const char* kImage = "x=\"1\" y=\"0\" width=\"17\" height=\"16\"";

INSTANTIATE_TEST_SUITE_P(BundleReader, BundleWithinItsFrames,
                         testing::Values(Edit{kImage, "x=\"0\" y=\"0\" width=\"18\" height=\"16\""},
                                         Edit{kImage, "x=\"0\" y=\"0\" width=\"16\" height=\"16\""},
                                         Edit{kImage,
                                              "x=\"2\" y=\"0\" width=\"16\" height=\"16\""}));

class BundleBeyondItsFrames : public testing::TestWithParam<Edit> {};

TEST_P(BundleBeyondItsFrames, IsRejected) {
    const TempFolder folder;
    const fs::path path = writeSampleBundle(folder);
    writeFile(path / "scan.xml", sampleXmlWith(GetParam().part, GetParam().replacement));
    EXPECT_THAT(errorOfReading(path),
                EndsWith("bundle/scan.xml: " + std::string(GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(
    BundleReader, BundleBeyondItsFrames,
    testing::Values(
        Edit{kImage, "x=\"2\" y=\"0\" width=\"17\" height=\"16\"",
             "image is 17x16 at (2, 0), expected a part of the 18x16 frame"},
        Edit{kImage, "x=\"0\" y=\"0\" width=\"19\" height=\"16\"",
             "image is 19x16 at (0, 0), expected a part of the 18x16 frame"},
        Edit{kImage, "x=\"0\" y=\"1\" width=\"18\" height=\"16\"",
             "image is 18x16 at (0, 1), expected a part of the 18x16 frame"},
        Edit{kImage, "x=\"0\" y=\"0\" width=\"18\" height=\"17\"",
             "image is 18x17 at (0, 0), expected a part of the 18x16 frame"},
        Edit{kImage, "x=\"8176\" y=\"8176\" width=\"8192\" height=\"8192\"",
             "image is 8192x8192 at (8176, 8176), expected a part of the 18x16 frame"},
        Edit{"first=\"0\"", "first=\"1\"",
             "frames first + count is 9, expected at most 8, the number of frames in the file"},
        Edit{"first=\"0\"", "first=\"1024\"",
             "frames first + count is 1032, expected at most 8, the number of frames in the "
             "file"}));

TEST(BundleReader, TakesThePatternFramesFromTheMiddleOfTheFile) {
    const TempFolder folder;
    const fs::path path = folder / "scan";
    ScanDescription scan = sampleDescription();
    scan.first_frame = 3;
    writeBundle(path, scan, makeFrames(11, 18, 16, 18).view());
    EXPECT_EQ(readBundle(path).description.first_frame, 3);
    EXPECT_EQ(readBundle(path).frames.count, 11);
    scan.first_frame = 4;
    EXPECT_THROW(writeBundle(folder / "b", scan, makeFrames(11, 18, 16, 18).view()), BundleError);
}

}  // namespace
}  // namespace facescan

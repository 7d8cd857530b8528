#include "reconstruct/report.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace facescan {
namespace {

constexpr Reason kReasons[] = {Reason::none,
                               Reason::dark,
                               Reason::over_exposed,
                               Reason::no_pattern,
                               Reason::too_little_surface,
                               Reason::low_contrast,
                               Reason::moved,
                               Reason::noisy};

void expectSentences(const std::string& text) {
    ASSERT_FALSE(text.empty());
    EXPECT_TRUE(std::isupper(static_cast<unsigned char>(text.front()))) << text;
    EXPECT_EQ(text.back(), '.') << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(Report, DescribesEveryVerdictInASentence) {
    for (const Verdict verdict : {Verdict::good, Verdict::usable, Verdict::repeat}) {
        for (const Reason reason : kReasons) expectSentences(describe(verdict, reason));
    }
}

TEST(Report, TellsTheReasonsApart) {
    std::set<std::string> sentences;
    for (const Reason reason : kReasons) {
        if (reason != Reason::none) sentences.insert(describe(Verdict::repeat, reason));
    }
    EXPECT_EQ(sentences.size(), std::size(kReasons) - 1);
}

TEST(Report, AsksForARepetitionUnlessFilledIn) {
    const Report report;
    EXPECT_EQ(report.verdict, Verdict::repeat);
    EXPECT_EQ(report.reason, Reason::no_pattern);
}

}  // namespace
}  // namespace facescan

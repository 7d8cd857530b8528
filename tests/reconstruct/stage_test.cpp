#include "reconstruct/stage.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace facescan {
namespace {

TEST(Stage, HasANameOfItsOwn) {
    std::set<std::string> names;
    for (int stage = 0; stage < kStageCount; ++stage) names.insert(name(Stage(stage)));
    EXPECT_EQ(names.size(), std::size_t(kStageCount));
}

TEST(Stage, IsNamedByOneWordInLowerCase) {
    for (int stage = 0; stage < kStageCount; ++stage) {
        const std::string text = name(Stage(stage));
        EXPECT_FALSE(text.empty());
        EXPECT_EQ(text.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace facescan

#include "cli/stage_options.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace facescan {
namespace {

/// Stands for a value of any type.
struct Anything {
    template <typename T>
    operator T() const;  // NOLINT(google-explicit-constructor): it has to convert by itself
};

/// The number of fields of an aggregate: as many as it can be initialised with.
template <typename Aggregate, typename... Values>
consteval std::size_t fieldCount(Values... values) {
    if constexpr (requires { Aggregate{values..., Anything{}}; })
        return fieldCount<Aggregate>(values..., Anything{});
    else
        return sizeof...(values);
}

TEST(StageOptions, EveryFieldOfOptionsCanBeSet) {
    EXPECT_EQ(stageOptions().size(), fieldCount<Options>());
    EXPECT_EQ(toJson(Options{}).size(), fieldCount<Options>());
}

TEST(StageOptions, NumbersHaveARangeThatHoldsTheirDefault) {
    const Options defaults;
    for (const StageOption& option : stageOptions()) {
        if (std::holds_alternative<bool Options::*>(option.field)) continue;
        const double value =
            std::visit([&](auto field) { return double(defaults.*field); }, option.field);
        EXPECT_LT(option.min, option.max) << option.name;
        EXPECT_GE(value, option.min) << option.name;
        EXPECT_LE(value, option.max) << option.name;
        EXPECT_STRNE(option.unit, "") << option.name;
    }
}

TEST(StageOptions, EachSaysWhatItIsFor) {
    for (const StageOption& option : stageOptions()) EXPECT_STRNE(option.help, "") << option.name;
}

TEST(StageOptions, AreParsedIntoTheirFields) {
    CLI::App app;
    Options options;
    addStageOptions(app, options);
    app.parse("--min-modulation 9 --gamma 0.5 --no-smooth --fill-holes");
    EXPECT_EQ(options.min_modulation, 9);
    EXPECT_EQ(options.gamma, 0.5);
    EXPECT_FALSE(options.smooth);
    EXPECT_TRUE(options.fill_holes);
    EXPECT_EQ(options.max_hole_mm, Options{}.max_hole_mm);
}

TEST(StageOptions, ValuesOutsideTheRangeAreRefused) {
    for (const char* line : {"--gamma 0", "--gamma 1.01", "--gamma nan", "--gamma 0x1",
                             "--end-columns 9", "--end-columns 1.5", "--max-hole-mm x"}) {
        CLI::App app;
        Options options;
        addStageOptions(app, options);
        EXPECT_THROW(app.parse(line), CLI::ValidationError) << line;
    }
}

}  // namespace
}  // namespace facescan

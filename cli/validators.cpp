#include "cli/validators.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "capture/numbers.h"

namespace facescan {

CLI::Validator numberFrom(double min, double max) {
    const auto complaint = [min, max](const std::string& text) -> std::string {
        const std::optional<double> value = parseDecimal(text);
        if (value && *value >= min && *value <= max) return {};
        return fmt::format("{} is not a number from {} to {}", text, min, max);
    };
    return CLI::Validator(complaint, "");
}

CLI::Validator wholeNumberFrom(int min, int max) {
    const auto complaint = [min, max](const std::string& text) -> std::string {
        const std::optional<int> value = parseWholeNumber<int>(text);
        if (value && *value >= min && *value <= max) return {};
        return fmt::format("{} is not a whole number from {} to {}", text, min, max);
    };
    return CLI::Validator(complaint, "");
}

CLI::Validator oneOf(std::vector<std::string> words) {
    const auto complaint = [words = std::move(words)](const std::string& text) -> std::string {
        if (std::ranges::find(words, text) != words.end()) return {};
        return fmt::format("{} is not one of {}", text, fmt::join(words, ", "));
    };
    return CLI::Validator(complaint, "");
}

}  // namespace facescan

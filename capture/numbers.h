#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

// Numbers as text, the same in every locale.

namespace facescan {

namespace detail {

/// All of `text` as a number; a plus sign may lead.
template <typename Number>
std::optional<Number> parseNumber(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    const char* const end = text.data() + text.size();
    Number value{};
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

}  // namespace detail

/// All of `text` as a whole number in decimal digits; nothing where it is not one or does not fit.
template <std::integral Whole>
std::optional<Whole> parseWholeNumber(std::string_view text) {
    return detail::parseNumber<Whole>(text);
}

/// All of `text` as a decimal number, an exponent allowed; nothing where it is not one, not finite
/// or beyond the range of a double.
inline std::optional<double> parseDecimal(std::string_view text) {
    const std::optional<double> value = detail::parseNumber<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

/// The shortest text that parseDecimal() turns into `value` again.
inline std::string formatDecimal(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace facescan

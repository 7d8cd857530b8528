#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace facescan {

/// A scan bundle breaks a rule of its format.
///
/// what() is one line: "<file>[:<line>]: <field> is <found>, expected <expected>".
class BundleError : public std::runtime_error {
public:
    /// @param file      path of the file with the flaw
    /// @param field     the thing that is wrong, in the words of the format: "row stride"
    /// @param found     its value; text that comes from the file goes through inQuotes()
    /// @param expected  what the format asks for, or what to do
    /// @param line      line of the file, from 1; 0 where the file has no lines
    BundleError(std::string file, std::string field, std::string found, std::string expected,
                int line = 0);

    const std::string& file() const { return file_; }
    const std::string& field() const { return field_; }
    const std::string& found() const { return found_; }
    const std::string& expected() const { return expected_; }
    int line() const { return line_; }

private:
    std::string file_;
    std::string field_;
    std::string found_;
    std::string expected_;
    int line_;
};

/// `text` in double quotes, fit for a message: control characters, quotes and bytes that are not
/// ASCII become \xNN, and a long text is shortened.
std::string inQuotes(std::string_view text);

/// `value` for a message: 0x and eight digits.
std::string hexWord(std::uint32_t value);

}  // namespace facescan

#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace facescan {

/// The look of --help: an option and its unit, then what it does, in lines that fit a terminal, and
/// its default in brackets.
class HelpFormat : public CLI::Formatter {
public:
    HelpFormat() {
        column_width(kOptionColumns);
        label("SUBCOMMAND", "VERB");
    }

    std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
    std::string make_description(const CLI::App* app) const override;

private:
    static constexpr std::size_t kOptionColumns = 32;
    static constexpr std::size_t kTextColumns = 66;
};

}  // namespace facescan

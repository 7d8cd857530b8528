#include "cli/help_format.h"

#include <sstream>

namespace facescan {
namespace {

/// The words of a text on lines of at most `columns`.
std::string wrapped(const std::string& text, std::size_t columns) {
    std::istringstream words(text);
    std::string lines;
    std::size_t used = 0;
    for (std::string word; words >> word; used += word.size()) {
        const bool fits = used + 1 + word.size() <= columns;
        if (!lines.empty()) lines += fits ? ' ' : '\n';
        used = fits ? used + 1 : 0;
        lines += word;
    }
    return lines;
}

}  // namespace

std::string HelpFormat::make_option_name(const CLI::Option* option, bool is_positional) const {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    // How CLI11 notes that --no-smooth stands for --smooth=false.
    const std::string negation = "{false}";
    if (const std::size_t at = name.find(negation); at != std::string::npos)
        name.erase(at, negation.size());
    return name;
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
    const std::string unit = option->get_type_name();
    return unit.empty() ? "" : ' ' + unit;
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
    std::string text = option->get_description();
    if (const std::string value = option->get_default_str(); !value.empty())
        text += " [" + value + ']';
    return wrapped(text, kTextColumns);
}

std::string HelpFormat::make_description(const CLI::App* app) const {
    return app->get_description() + '\n';
}

}  // namespace facescan

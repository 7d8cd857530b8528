#include "cli/bundle_list.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>

#include "cli/errors.h"

namespace facescan {
namespace {

[[noreturn]] void fail(const std::string& name) {
    throw CommandError(EX_NOINPUT,
                       "cannot read " + name + ": " + std::generic_category().message(errno));
}

std::string readAll(std::FILE* stream, const std::string& name) {
    constexpr std::size_t kChunkBytes = 1 << 16;
    std::string text;
    for (std::size_t count = kChunkBytes; count > 0;) {
        const std::size_t size = text.size();
        text.resize(size + kChunkBytes);
        count = std::fread(text.data() + size, 1, kChunkBytes, stream);
        text.resize(size + count);
    }
    if (std::ferror(stream) != 0) fail(name);
    return text;
}

std::string readFile(const std::filesystem::path& file) {
    if (file == "-") return readAll(stdin, "standard input");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rbe"),
                                                                 std::fclose);
    if (!stream) fail(file.string());
    return readAll(stream.get(), file.string());
}

}  // namespace

std::vector<std::string> readBundleList(const std::filesystem::path& file) {
    const std::string text = readFile(file);
    const char end = text.find('\0') == text.npos ? '\n' : '\0';
    std::vector<std::string> paths;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view path = rest.substr(0, rest.find(end));
        if (!path.empty()) paths.emplace_back(path);
        rest.remove_prefix(std::min(rest.size(), path.size() + 1));
    }
    return paths;
}

}  // namespace facescan

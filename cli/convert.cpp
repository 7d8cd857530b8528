#include "cli/convert.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "cli/errors.h"
#include "export/mesh_format.h"
#include "export/read_mesh.h"

namespace facescan {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExamples = R"(Examples:
  facescan convert anna/mesh.ply anna.glb
      metres, Y up, with its texture inside
  facescan convert anna/mesh.ply print/anna.stl
  facescan convert anna/mesh.ply anna.obj
      and anna.mtl and anna.png beside it)";

struct ConvertArguments {
    fs::path mesh;
    fs::path out;
};

int convert(const ConvertArguments& arguments) {
    const std::optional<MeshFormat> format = meshFormatOf(arguments.out);
    if (!format)
        throw CommandError(EX_USAGE, arguments.out.string() +
                                         ": name a file that ends in .ply, .obj, .stl or .glb");
    std::error_code ignored;
    if (!fs::exists(arguments.mesh, ignored))
        throw CommandError(EX_NOINPUT, arguments.mesh.string() + ": no such file");
    const TexturedMesh read = readMesh(arguments.mesh);
    writeMesh(arguments.out, read.mesh, read.texture, *format);
    return EX_OK;
}

}  // namespace

Verb addConvert(CLI::App& app) {
    auto arguments = std::make_shared<ConvertArguments>();
    CLI::App* command = app.add_subcommand("convert", "Bring a mesh into another file format");
    command->add_option("MESH", arguments->mesh, "a mesh.ply of facescan, its texture beside it")
        ->required()
        ->type_name("");
    command->add_option("OUT", arguments->out, "file that ends in .ply, .obj, .stl or .glb")
        ->required()
        ->type_name("");
    command->footer(kExamples);
    return {command, [arguments] { return convert(*arguments); }};
}

}  // namespace facescan

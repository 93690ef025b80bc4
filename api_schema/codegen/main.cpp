/// Generates C++, docs and embedded texts from api_schema at build time:
///
///   seedmesh_codegen params <name>.schema.json <folder>      <folder>/<name>.h, _unused.h and .cpp
///   seedmesh_codegen reference <name>.schema.json <folder>   <folder>/<name>.md
///   seedmesh_codegen embed <api_schema> <folder>             <folder>/embedded.cpp and openapi.json
///
/// Exit status: 0, 1 for an error in a schema (the message names its position), 2 for wrong arguments.
#include <fstream>
#include <iostream>
#include <span>

#include "api_schema/codegen/emit.h"

namespace {

using codegen::SchemaError;
namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw SchemaError(path.string() + ": cannot be written");
}

void run(const std::string& task, const fs::path& source, const fs::path& folder) {
  if (task == "params") {
    const codegen::Unit unit = codegen::load_unit(source);
    write_file(folder / (unit.name + ".h"), codegen::emit_header(unit));
    write_file(folder / (unit.name + "_unused.h"), codegen::emit_unused_header(unit));
    write_file(folder / (unit.name + ".cpp"), codegen::emit_source(unit));
  } else if (task == "reference") {
    const codegen::Unit unit = codegen::load_unit(source);
    write_file(folder / (unit.name + ".md"), codegen::emit_reference(unit));
  } else if (task == "embed") {
    write_file(folder / "embedded.cpp", codegen::emit_embedded(source));
    write_file(folder / "openapi.json", codegen::openapi_with_components(source).dump(2) + "\n");
  } else {
    throw SchemaError("unknown task " + task);
  }
}

}  // namespace

int main(int count, char** words) {
  const std::span<char*> arguments(words, static_cast<std::size_t>(count));
  if (arguments.size() != 4) {
    std::cerr << "usage: seedmesh_codegen params|reference|embed <source> <folder>\n";
    return 2;
  }
  try {
    run(arguments[1], arguments[2], arguments[3]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}

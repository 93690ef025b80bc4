#include <algorithm>
#include <map>

#include "api_schema/codegen/emit.h"
#include "core/schema/forms.h"

namespace codegen {
namespace {

namespace fs = std::filesystem;

constexpr const char* schema_ending = ".schema.json";

std::vector<fs::path> files_in(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().string().ends_with(ending)) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::string schema_name(const fs::path& path) {
  const std::string file = path.filename().string();
  return file.substr(0, file.size() - std::string(schema_ending).size());
}

/// The schemas that the service answers: all except common.schema.json, which is resolved into the others.
std::vector<fs::path> served_schemas(const fs::path& folder) {
  std::vector<fs::path> files = files_in(folder, schema_ending);
  std::erase_if(files, [](const fs::path& file) { return schema_name(file) == "common"; });
  return files;
}

std::string row(const std::string& name, const std::string& text) {
  return "    {" + quoted(name) + ",\n     " + quoted(text) + "},\n";
}

void check_preset(const Schema& preset, const std::string& name, const std::string& generator,
                  const fs::path& file) {
  const auto refuse = [&](const std::string& what) { throw SchemaError(file.string() + ": " + what); };
  if (!seedmesh::schema::forms::preset_name.accepts(name))
    refuse("the name of a preset has to consist of lower-case letters, digits, - and _");
  for (const char* key : {"title", "description", "generator"}) {
    if (!preset.contains(key) || !preset[key].is_string())
      refuse(std::string("a preset needs the text ") + key);
  }
  if (preset["generator"] != generator) refuse("the generator differs from the name of the folder");
  if (!preset.contains("parameters")) refuse("a preset needs parameters");
  if (!preset.contains("tags") || !preset["tags"].is_array())
    refuse("a preset needs a list of tags, which may be empty");
}

std::string preset_rows(const fs::path& folder) {
  std::map<std::string, std::string> rows;
  std::vector<fs::path> folders;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_directory()) folders.push_back(entry.path());
    }
  }
  for (const fs::path& each : folders) {
    for (const fs::path& file : files_in(each, ".json")) {
      const std::string name = file.stem().string();
      const Schema preset = load_json(file);
      check_preset(preset, name, each.filename().string(), file);
      if (!rows.emplace(name, row(name, preset.dump())).second)
        throw SchemaError(file.string() + ": another preset has the same name");
    }
  }
  std::string text;
  for (const auto& [name, line] : rows) text += line;
  return text;
}

/// The table `name`. A last, empty element keeps the array valid without rows; the span excludes it.
std::string table(const std::string& name, const std::string& rows) {
  return "constexpr EmbeddedText " + name + "_rows[] = {\n" + rows + "    {\"\", \"\"},\n};\n\n";
}

std::string accessor(const std::string& name) {
  return "std::span<const EmbeddedText> embedded_" + name + "() {\n  return std::span(" + name +
         "_rows).first(std::size(" + name + "_rows) - 1);\n}\n\n";
}

/// Turns {"$ref": "lsystem.schema.json"} into a reference to a component.
void link_components(Schema& node) {
  if (node.is_object() && node.contains("$ref")) {
    const auto reference = node["$ref"].get<std::string>();
    if (reference.ends_with(schema_ending)) node["$ref"] = "#/components/schemas/" + schema_name(reference);
  }
  if (!node.is_structured()) return;
  for (Schema& child : node) link_components(child);
}

}  // namespace

Schema openapi_with_components(const fs::path& folder) {
  Schema document = load_json(folder / "openapi.json");
  link_components(document);
  for (const fs::path& file : served_schemas(folder)) {
    Schema schema = resolve(file);
    schema.erase("$schema");
    document["components"]["schemas"][schema_name(file)] = std::move(schema);
  }
  // The schema of a request allows any parameters; the document names those of each generator.
  Schema& schemas = document["components"]["schemas"];
  schemas["request"]["properties"]["parameters"] = {{"$ref", "#/components/schemas/parameters"}};
  schemas["request"]["properties"]["output"] = {{"$ref", "#/components/schemas/output"}};
  return document;
}

std::string emit_embedded(const fs::path& folder) {
  std::string schemas;
  for (const fs::path& file : served_schemas(folder)) schemas += row(schema_name(file), resolve(file).dump());
  std::string text =
      "// Made from api_schema. Do not edit.\n"
      "#include \"core/schema/embedded.h\"\n\n#include <iterator>\n\n"
      "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n\n"
      "namespace seedmesh {\nnamespace {\n\n";
  text += table("schemas", schemas) + table("presets", preset_rows(folder / "presets"));
  // With the length, because compilers count the characters of long constant texts only up to a limit.
  text += "constexpr char openapi_characters[] =\n    " + quoted(openapi_with_components(folder).dump()) +
          ";\n\n";
  text += "constexpr std::string_view openapi_text{openapi_characters, sizeof(openapi_characters) - 1};\n\n";
  text += "}  // namespace\n\n" + accessor("schemas") + accessor("presets");
  text += "std::string_view embedded_openapi() { return openapi_text; }\n\n";
  return text + "}  // namespace seedmesh\n";
}

}  // namespace codegen

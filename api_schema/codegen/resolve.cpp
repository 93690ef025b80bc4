#include <fstream>

#include "api_schema/codegen/schema.h"

namespace codegen {
namespace {

constexpr int deepest = 64;  ///< nested references; more are a cycle

bool is_annotation(const std::string& key) {
  return key == "title" || key == "description" || key == "default" || key == "examples" ||
         key.starts_with("x-");
}

Schema resolved(const Schema& node, const std::filesystem::path& file, Marks marks, int depth);

/// The target of a reference: a file and a node in it.
struct Target {
  std::filesystem::path file;
  std::string pointer;
};

Target target_of(const std::string& reference, const std::filesystem::path& file) {
  const std::size_t hash = reference.find('#');
  const std::string name = reference.substr(0, hash);
  return {name.empty() ? file : file.parent_path() / name,
          hash == std::string::npos ? "" : reference.substr(hash + 1)};
}

/// The node that a $ref names. Annotations beside the $ref replace those of the node. Draft 7 ignores other keywords
/// beside a $ref and 2020-12 does not, so that they are errors here.
Schema follow(const Schema& node, const std::filesystem::path& file, Marks marks, int depth) {
  const auto reference = node.at("$ref").get<std::string>();
  if (depth == deepest) throw SchemaError(file.string() + ": $ref " + reference + " is part of a cycle");
  const Target target = target_of(reference, file);
  const Schema whole = load_json(target.file);
  const Schema::json_pointer pointer(target.pointer);
  if (!whole.contains(pointer))
    throw SchemaError(file.string() + ": $ref " + reference + " names nothing that exists");
  Schema result = resolved(whole.at(pointer), target.file, marks, depth + 1);
  result.erase("$schema");
  for (const auto& [key, value] : node.items()) {
    if (key == "$ref") continue;
    if (!is_annotation(key)) throw SchemaError(file.string() + ": " + key + " beside $ref " + reference);
    result[key] = resolved(value, file, marks, depth);
  }
  if (marks == Marks::keep && target.pointer.empty()) {
    result["x-params"] = target.file.filename().string().substr(0, target.file.filename().string().find('.'));
  }
  return result;
}

Schema resolved(const Schema& node, const std::filesystem::path& file, Marks marks, int depth) {
  if (node.is_object() && node.contains("$ref")) return follow(node, file, marks, depth);
  if (!node.is_structured()) return node;
  Schema result = node.is_array() ? Schema::array() : Schema::object();
  if (node.is_array()) {
    for (const Schema& item : node) result.push_back(resolved(item, file, marks, depth));
  } else {
    for (const auto& [key, value] : node.items()) {
      if (key != "$defs") result[key] = resolved(value, file, marks, depth);
    }
  }
  return result;
}

}  // namespace

Schema load_json(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw SchemaError(path.string() + ": cannot be read");
  try {
    return Schema::parse(file);
  } catch (const Schema::exception& error) {
    throw SchemaError(path.string() + ": " + error.what());
  }
}

Schema resolve(const std::filesystem::path& path, Marks marks) {
  return resolved(load_json(path), path, marks, 0);
}

}  // namespace codegen

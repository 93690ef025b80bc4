/// The generated function children_of(), which finds all requests inside parameters.
#include "api_schema/codegen/emit.h"
#include "core/schema/json.h"

namespace codegen {
namespace {

bool is_child(const Schema& schema) { return schema.value("x-widget", "") == "request"; }

/// Whether values of the schema can contain a request.
bool holds_child(const Schema& node) {
  if (node.is_object() && is_child(node)) return true;
  if (!node.is_structured()) return false;
  for (const Schema& part : node) {
    if (holds_child(part)) return true;
  }
  return false;
}

std::string indented(int depth) { return std::string(static_cast<std::size_t>(depth) * 2, ' '); }

/// A value that the generated code visits: the C++ expressions of the value and of its pointer. The latter begins
/// with a string literal.
struct Step {
  std::string value;
  std::string pointer;
  int depth = 1;

  std::string name(const char* word) const { return word + std::to_string(depth); }

  Step member(const std::string& key, const std::string& cpp) const {
    const std::string token = quoted(seedmesh::pointer_token(key));
    Step step{value + "." + cpp, pointer, depth};
    if (step.pointer.back() == '"') {
      step.pointer.pop_back();
      step.pointer += token.substr(1);
    } else {
      step.pointer += " + " + token;
    }
    return step;
  }
  Step inside(std::string reached, const std::string& token) const {
    return {std::move(reached), token.empty() ? pointer : pointer + " + " + token, depth + 1};
  }
};

std::string walk(const Type& type, const Step& at);

std::string walk_members(const Type& type, const Step& at) {
  std::string text;
  for (const Member& member : type.members) {
    if (!holds_child(member.type.schema)) continue;
    Step step = at.member(member.name, member.cpp_name);
    if (!member.optional) {
      text += walk(member.type, step);
      continue;
    }
    const std::string held = step.value;
    step = step.inside("(*" + held + ")", "");
    text +=
        indented(at.depth) + "if (" + held + ") {\n" + walk(member.type, step) + indented(at.depth) + "}\n";
  }
  return text;
}

std::string walk_entries(const Type& type, const Step& at) {
  const std::string lead = indented(at.depth);
  if (type.kind == Kind::map) {
    const std::string key = at.name("key"), entry = at.name("entry");
    return lead + "for (auto& [" + key + ", " + entry + "] : " + at.value + ") {\n" +
           walk(type.parts[0], at.inside(entry, "pointer_token(" + key + ")")) + lead + "}\n";
  }
  const std::string i = at.name("i");
  return lead + "for (std::size_t " + i + " = 0; " + i + " < " + at.value + ".size(); ++" + i + ") {\n" +
         walk(type.parts[0],
              at.inside(at.value + "[" + i + "]", "std::string(\"/\") + std::to_string(" + i + ")")) +
         lead + "}\n";
}

std::string walk_variant(const Type& type, const Step& at) {
  std::string text;
  for (std::size_t i = 0; i < type.parts.size(); ++i) {
    if (!holds_child(type.parts[i].schema)) continue;
    const std::string part = at.name("part");
    text += indented(at.depth) + "if (auto* " + part + " = std::get_if<" + std::to_string(i) + ">(&" +
            at.value + ")) {\n" + walk(type.parts[i], at.inside("(*" + part + ")", "")) + indented(at.depth) +
            "}\n";
  }
  return text;
}

std::string walk(const Type& type, const Step& at) {
  switch (type.kind) {
    case Kind::child:
      return indented(at.depth) + "locations.push_back({" + at.pointer + ", &" + at.value + "});\n";
    case Kind::structure:
    case Kind::shorthand:
      return walk_members(type, at);
    case Kind::list:
    case Kind::map:
      return walk_entries(type, at);
    case Kind::variant:
      return walk_variant(type, at);
    case Kind::params:
      return indented(at.depth) + "for (ChildLocation& inner : children_of(" + at.value +
             ")) locations.push_back({" + at.pointer + " + inner.pointer, inner.child});\n";
    default:
      return "";
  }
}

}  // namespace

bool has_children(const Unit& unit) { return holds_child(unit.root.schema); }

std::string emit_children(const Unit& unit) {
  if (!has_children(unit)) return "";
  return "std::vector<ChildLocation> children_of(" + unit.root.cpp +
         "& params) {\n  std::vector<ChildLocation> locations;\n" + walk(unit.root, {"params", "\"\"", 1}) +
         "  return locations;\n}\n\n";
}

}  // namespace codegen

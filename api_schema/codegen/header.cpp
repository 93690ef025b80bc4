#include <set>

#include "api_schema/codegen/emit.h"

namespace codegen {
namespace {

/// Range and unit of a number, for a comment: " [0 to 1, m]".
std::string facts(const Schema& schema) {
  const std::string range = range_text(schema);
  const std::string unit = schema.value("x-unit", "");
  if (range.empty() && unit.empty()) return "";
  return " [" + range + (range.empty() || unit.empty() ? "" : ", ") + unit + "]";
}

std::string comment(const Schema& schema, const std::string& lead) {
  const std::string text = schema.value("description", schema.value("title", "")) + facts(schema);
  return wrapped(text, lead + "/// ");
}

std::string declare_choice(const Type& type) {
  std::string words;
  for (const Schema& word : type.schema["enum"])
    words += (words.empty() ? "" : ", ") + enumerator(word.get<std::string>());
  return comment(type.schema, "") + "enum class " + type.cpp + " { " + words + " };\n" +
         "std::string_view text_of(" + type.cpp + " choice);\n\n";
}

std::string declare_member(const Member& member) {
  const Type& type = member.type;
  std::string line =
      "  " + (member.optional ? "std::optional<" + type.cpp + ">" : type.cpp) + " " + member.cpp_name;
  const bool scalar = type.kind == Kind::flag || type.kind == Kind::number || type.kind == Kind::integer ||
                      type.kind == Kind::seed || type.kind == Kind::choice;
  std::string value;
  if (type.schema.contains("default")) value = initializer(type, type.schema["default"]);
  if (value.empty() && scalar && !member.optional) value = "{}";
  // Every member has an initializer, so that designated ones may leave members out without a warning.
  line += value.empty() ? " = {}" : " = " + value;
  return comment(type.schema, "  ") + line + ";\n";
}

/// Structures inside the params are declared before it (a nested type's defaults cannot be used inside the
/// class around it) and get their short name there: LsystemAngle is LsystemParams::Angle.
std::string short_names(const Unit& unit, const Type& structure) {
  if (structure.cpp != unit.root.cpp) return "";
  std::string lines;
  for (const Type& type : unit.declared) {
    if (type.cpp == structure.cpp) continue;
    lines += "  using " + type.cpp.substr(unit.prefix.size()) + " = " + type.cpp + ";\n";
  }
  return lines.empty() ? "" : lines + "\n";
}

std::string declare_structure(const Unit& unit, const Type& type) {
  std::string text = comment(type.schema, "") + "struct " + type.cpp + " {\n" + short_names(unit, type);
  for (const Member& member : type.members) {
    if (member.type.kind != Kind::free) text += declare_member(member);
  }
  return text + "\n  friend bool operator==(const " + type.cpp + "&, const " + type.cpp +
         "&) = default;\n};\n\n";
}

void add_includes(const Type& type, std::set<std::string>& standard, std::set<std::string>& own) {
  if (type.cpp.starts_with("std::array")) standard.insert("array");
  if (type.cpp.starts_with("std::vector")) standard.insert("vector");
  if (type.cpp.starts_with("std::map")) standard.insert({"map", "string"});
  if (type.cpp.starts_with("std::variant")) standard.insert("variant");
  if (type.kind == Kind::text) standard.insert("string");
  if (type.kind == Kind::integer || type.kind == Kind::seed) standard.insert("cstdint");
  if (type.kind == Kind::color) own.insert("core/schema/color.h");
  if (type.kind == Kind::child) own.insert("core/schema/child.h");
  if (type.kind == Kind::geojson) own.insert("core/schema/geojson.h");
  if (type.kind == Kind::params) own.insert("generated/params/" + type.json_name + ".h");
  for (const Type& part : type.parts) add_includes(part, standard, own);
  for (const Member& member : type.members) {
    if (member.optional) standard.insert("optional");
    add_includes(member.type, standard, own);
  }
}

}  // namespace

std::string emit_header(const Unit& unit) {
  std::set<std::string> standard = {"string_view"};
  std::set<std::string> own = {"core/schema/issue_list.h", "core/schema/json.h"};
  add_includes(unit.root, standard, own);
  if (has_children(unit)) standard.insert("vector");

  std::string text =
      "#pragma once\n// Made from api_schema/" + unit.name + ".schema.json. Do not edit: edit the schema.\n";
  for (const std::string& name : standard) text += "#include <" + name + ">\n";
  text += "\n";
  for (const std::string& name : own) text += "#include \"" + name + "\"\n";
  text += "\nnamespace seedmesh {\n\n";
  for (const Type& type : unit.declared) {
    text += type.kind == Kind::choice ? declare_choice(type) : declare_structure(unit, type);
  }
  const std::string& params = unit.root.cpp;
  text +=
      "/// Reads and checks `json`, the value at `pointer` of the request. Adds every error; a member with "
      "an\n"
      "/// error, or without a value, keeps its default.\n";
  text +=
      params + " read_" + unit.name + "(const Json& json, std::string_view pointer, IssueList& issues);\n\n";
  text +=
      "/// The canonical form, without defaults. Equal params give equal JSON, and reading it gives equal "
      "params.\n";
  text += "Json write_" + unit.name + "(const " + params + "& params);\n\n";
  if (has_children(unit)) {
    text += "/// The inner requests, each with its pointer, in the order of the schema.\n";
    text += "std::vector<ChildLocation> children_of(" + params + "& params);\n\n";
  }
  return text + "}  // namespace seedmesh\n";
}

}  // namespace codegen

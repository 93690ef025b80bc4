#include <algorithm>
#include <vector>

#include "api_schema/codegen/emit.h"
#include "core/schema/forms.h"

namespace codegen {
namespace {

std::string code(const std::string& text) { return "`" + text + "`"; }

/// "number", "list of texts", "one of `tubes`, `lines`".
std::string type_text(const Type& type) {
  switch (type.kind) {
    case Kind::flag:
      return "`true` or `false`";
    case Kind::number:
      return "number";
    case Kind::integer:
      return "integer";
    case Kind::seed:
      return "integer or text of digits";
    case Kind::color:
      return "colour `#rrggbb`";
    case Kind::text:
      return type.schema.contains("x-grammar") ? type.schema["x-grammar"].get<std::string>() : "text";
    case Kind::list:
      return "list of: " + type_text(type.parts[0]);
    case Kind::map:
      return "object of: " + type_text(type.parts[0]);
    case Kind::structure:
      return "object";
    case Kind::params:
      return "[" + type.json_name + "](" + type.json_name + ".md)";
    case Kind::shorthand:
      return "number or object";
    case Kind::child:
      return "request";
    case Kind::geojson:
      return "GeoJSON";
    case Kind::free:
      return "object";
    case Kind::choice: {
      std::string words;
      for (const Schema& word : type.schema["enum"])
        words += (words.empty() ? "" : ", ") + code(word.get<std::string>());
      return "one of " + words;
    }
    case Kind::variant: {
      std::string words;
      for (const Type& part : type.parts) words += (words.empty() ? "" : " or ") + type_text(part);
      return words;
    }
  }
  return "";
}

std::string facts(const Member& member) {
  const Schema& schema = member.type.schema;
  const Schema& range = member.type.kind == Kind::shorthand ? member.type.parts[0].schema : schema;
  std::string text = type_text(member.type);
  if (const std::string words = range_text(range); !words.empty()) text += ", " + words;
  if (schema.contains("x-unit")) text += ", in " + schema["x-unit"].get<std::string>();
  if (member.required) text += "; **required**";
  if (schema.contains("default")) text += "; default " + code(schema["default"].dump());
  for (std::size_t i = 0; i < member.applies_when.size(); ++i)
    text += (i == 0 ? "; used if " : ", and if ") + member.applies_when[i].words;
  return text;
}

/// The structure inside a type whose members are documented too, or null.
const Type* inner(const Type& type) {
  if (type.kind == Kind::shorthand) return &type.parts[1];
  if (type.kind == Kind::structure) return &type;
  for (const Type& part : type.parts) {
    if (const Type* found = inner(part)) return found;
  }
  return nullptr;
}

std::string member_rows(const Type& structure, const std::string& path) {
  std::string rows;
  for (const Member& member : structure.members) {
    rows += "| " + code(path + member.name) + " | " + facts(member) + " | " +
            member.type.schema.value("description", "") + " |\n";
    if (const Type* more = inner(member.type)) rows += member_rows(*more, path + member.name + ".");
  }
  return rows;
}

std::string section(const Member& member) {
  const Schema& schema = member.type.schema;
  std::string text = "### " + code(member.name) + "\n\n" + schema["title"].get<std::string>() + ": " +
                     facts(member) + ".\n\n" + schema["description"].get<std::string>() + "\n\n";
  if (const Type* more = inner(member.type)) {
    const std::string path = member.type.kind == Kind::list ? member.name + "[]." : member.name + ".";
    text += "| member | value | meaning |\n| --- | --- | --- |\n" + member_rows(*more, path) + "\n";
  }
  for (const Schema& example : schema.value("examples", Schema::array())) {
    text += "```json\n\"" + member.name + "\": " + example.dump() + "\n```\n\n";
  }
  return text;
}

}  // namespace

std::string emit_reference(const Unit& unit) {
  const Schema& schema = unit.root.schema;
  std::string text = "# " + schema["title"].get<std::string>() + "\n\n" +
                     schema["description"].get<std::string>() + "\n\nMade from `api_schema/" + unit.name +
                     ".schema.json`.\n\n";
  std::vector<std::string> groups;
  for (const Member& member : unit.root.members) {
    const std::string group = member.type.schema.value("x-group", "");
    if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  }
  for (const std::string& group : groups) {
    if (!group.empty()) text += "## " + group + "\n\n";
    for (const Member& member : unit.root.members) {
      if (member.type.schema.value("x-group", "") == group) text += section(member);
    }
  }
  text.pop_back();  // one line end is enough for the file
  return text;
}

}  // namespace codegen

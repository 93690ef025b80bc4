#include "api_schema/codegen/emit.h"

#include <cctype>

#include "core/schema/forms.h"

namespace codegen {
namespace {

std::string indented(int depth) { return std::string(static_cast<std::size_t>(depth) * 2, ' '); }

/// One designated initializer after another.
class Rule {
 public:
  void add(const char* field, const Schema& schema, const char* keyword) {
    if (schema.contains(keyword)) set(field, schema[keyword].dump());
  }
  void set(const char* field, const std::string& value) {
    text_ += (text_.empty() ? "." : ", .") + std::string(field) + " = " + value;
  }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

std::string form_of(const Schema& pattern) {
  return "&forms::" + std::string(seedmesh::schema::find_form(pattern.get<std::string>())->name);
}

std::string rule_of(const Type& type) {
  const Schema& schema = type.schema;
  Rule rule;
  if (type.kind == Kind::text) {
    rule.add("least", schema, "minLength");
    rule.add("most", schema, "maxLength");
    if (schema.contains("pattern")) rule.set("form", form_of(schema["pattern"]));
  } else if (type.kind == Kind::list) {
    rule.add("least", schema, "minItems");
    rule.add("most", schema, "maxItems");
  } else if (type.kind == Kind::map) {
    rule.add("least", schema, "minProperties");
    rule.add("most", schema, "maxProperties");
    if (schema.contains("propertyNames")) rule.set("names", form_of(schema["propertyNames"]["pattern"]));
  } else {
    rule.add("minimum", schema, "minimum");
    rule.add("maximum", schema, "maximum");
    rule.add("above", schema, "exclusiveMinimum");
  }
  return rule.text();
}

/// The title of a schema inside a sentence: "Ring" gives "ring".
std::string in_a_sentence(const Type& type) {
  auto title = type.schema.value("title", "list");
  title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
  return title;
}

std::string read_entries(const Type& type, const std::string& location, const std::string& target, int depth);
std::string read_variant(const Type& type, const std::string& location, const std::string& target, int depth);
std::string read_shorthand(const Type& type, const std::string& location, const std::string& target,
                           int depth);

/// The statement that reads the value at `location` into `target`, without indentation and line end.
std::string read_statement(const Type& type, const std::string& location, const std::string& target,
                           int depth) {
  const std::string both = "(" + location + ", " + target + ");";
  const std::string with_rule = "(" + location + ", " + rule_of(type) + ", " + target + ");";
  switch (type.kind) {
    case Kind::flag:
      return "read_flag" + both;
    case Kind::number:
      return "read_number" + with_rule;
    case Kind::integer:
      return "read_integer" + with_rule;
    case Kind::text:
      return "read_text" + with_rule;
    case Kind::color:
      return "read_color" + both;
    case Kind::seed:
      return "read_seed" + both;
    case Kind::choice:
      return "read_choice(" + location + ", " + words_name(type) + ", " + target + ");";
    case Kind::structure:
      return "read" + both;
    case Kind::free:
      return "read_free_object(" + location + ");";
    case Kind::child:
      return "read_child" + both;
    case Kind::geojson:
      return "read_geojson" + both;
    case Kind::params:
      return target + " = read_" + type.json_name + "(" + location + ".value(), " + location +
             ".pointer(), " + location + ".issue_list());";
    case Kind::list:
    case Kind::map:
      return read_entries(type, location, target, depth);
    case Kind::variant:
      return read_variant(type, location, target, depth);
    case Kind::shorthand:
      return read_shorthand(type, location, target, depth);
  }
  return "";
}

std::string read_entries(const Type& type, const std::string& location, const std::string& target,
                         int depth) {
  const Type& entry = type.parts[0];
  const std::string name = type.kind == Kind::list ? "read_list" : "read_map";
  const bool nested = location.starts_with("entry");  // its names must not hide those of the outer entry
  const std::string at = nested ? location + "_in" : "entry";
  const std::string value = "value" + at.substr(std::string("entry").size());
  const bool has_inner = entry.kind == Kind::list && entry.parts[0].kind == Kind::list;
  const std::string unless_flat = type.kind == Kind::list && has_inner && !nested
                                      ? "if (check_nesting(" + location + ", " +
                                            quoted(in_a_sentence(entry)) + ", " +
                                            quoted(in_a_sentence(entry.parts[0])) + ")) "
                                      : "";
  return unless_flat + name + "(" + location + ", " + rule_of(type) + ", " + target +
         ", [](const Location& " + at + ", " + entry.cpp + "& " + value + ") {\n" + indented(depth + 1) +
         read_statement(entry, at, value, depth + 1) + "\n" + indented(depth) + "});";
}

struct JsonType {
  std::string kind;  ///< of JsonKind
  std::string words;
};

JsonType json_type(const Type& type) {
  switch (type.kind) {
    case Kind::flag:
      return {"flag", "true or false"};
    case Kind::number:
    case Kind::integer:
      return {"number", "a number"};
    case Kind::list:
      return {"list", "a list"};
    case Kind::map:
    case Kind::structure:
    case Kind::params:
    case Kind::child:
    case Kind::geojson:
    case Kind::free:
      return {"object", "an object"};
    default:
      return {"text", "a text"};
  }
}

/// The alternatives that are no choice, for messages: "an integer from 16 to 4096".
std::string beside_choice(const Type& variant) {
  std::string text;
  for (const Type& part : variant.parts) {
    if (part.kind == Kind::choice) continue;
    const bool is_number = part.kind == Kind::number || part.kind == Kind::integer;
    const bool has_range = part.schema.contains("minimum") && part.schema.contains("maximum");
    const std::string words = part.kind == Kind::integer ? "an integer" : json_type(part).words;
    text += (text.empty() ? "" : " or ") + words +
            (is_number && has_range ? " from " + range_text(part.schema) : "");
  }
  return text;
}

/// All alternatives, for messages: "an integer from 16 to 4096 or none".
std::string alternatives(const Type& variant) {
  std::string text = beside_choice(variant);
  for (const Type& part : variant.parts) {
    if (part.kind != Kind::choice) continue;
    std::string words;
    for (const Schema& word : part.schema["enum"])
      words += (words.empty() ? "" : ", ") + word.get<std::string>();
    text +=
        (text.empty() ? "" : " or ") + std::string(part.schema["enum"].size() > 1 ? "one of " : "") + words;
  }
  return text;
}

/// The statement that reads one of the alternatives.
std::string read_alternative(const Type& variant, std::size_t index, const std::string& location,
                             const std::string& target, int depth) {
  const Type& part = variant.parts[index];
  const std::string own = target + ".emplace<" + std::to_string(index) + ">()";
  if (part.kind != Kind::choice) return read_statement(part, location, own, depth);
  return "read_choice(" + location + ", " + words_name(part) + ", " + own + ", " +
         quoted(beside_choice(variant)) + ");";
}

std::string read_variant(const Type& type, const std::string& location, const std::string& target,
                         int depth) {
  std::string text = "switch (" + location + ".kind()) {\n";
  for (std::size_t i = 0; i < type.parts.size(); ++i) {
    const Type& part = type.parts[i];
    text += indented(depth + 1) + "case JsonKind::" + json_type(part).kind + ":\n" + indented(depth + 2) +
            read_alternative(type, i, location, target, depth + 2) + "\n" + indented(depth + 2) + "break;\n";
  }
  return text + indented(depth + 1) + "default:\n" + indented(depth + 2) + location + ".expected(\"" +
         alternatives(type) + "\");\n" + indented(depth) + "}";
}

std::string read_shorthand(const Type& type, const std::string& location, const std::string& target,
                           int depth) {
  const Schema& members = type.schema["x-short"];
  const std::string first = target + "." + members[0].get<std::string>();
  std::string text = "if (" + location + ".kind() == JsonKind::number) {\n" + indented(depth + 1) +
                     read_statement(type.parts[0], location, first, depth + 1) + "\n";
  for (std::size_t i = 1; i < members.size(); ++i) {
    text += indented(depth + 1) + target + "." + members[i].get<std::string>() + " = " + first + ";\n";
  }
  return text + indented(depth) + "} else if (" + location + ".kind() == JsonKind::object) {\n" +
         indented(depth + 1) + "read(" + location + ", " + target + ");\n" + indented(depth) + "} else {\n" +
         indented(depth + 1) + location + ".expected(\"a number or an object\");\n" + indented(depth) + "}";
}

std::string reader_of(const Type& type) {
  std::string known, required, body;
  for (const Member& member : type.members) {
    known += (known.empty() ? "" : ", ") + quoted(member.name);
    if (member.required) required += (required.empty() ? "" : ", ") + quoted(member.name);
    const std::string target = "out." + member.cpp_name + (member.optional ? ".emplace()" : "");
    body += "  if (const auto at = location.member(" + quoted(member.name) + ")) {\n    " +
            read_statement(member.type, "(*at)", target, 2) + "\n  }\n";
  }
  return "void read(const Location& location, " + type.cpp +
         "& out) {\n  static constexpr std::string_view known[] = {" + known +
         "};\n  if (!check_members(location, known, {" + required + "})) return;\n" + body + "}\n\n";
}

/// The name of an entry inside of `value`, which may contain the name of the entry around it.
std::string inner_entry(const std::string& value) {
  const std::size_t from = value.rfind("entry");
  if (from == std::string::npos) return "entry";
  const std::size_t to = value.find_first_not_of("entry_i", from);
  return value.substr(from, to == std::string::npos ? to : to - from) + "_in";
}

/// The expression of the Json of `value`.
std::string write_expression(const Type& type, const std::string& value) {
  switch (type.kind) {
    case Kind::color:
      return "Json(text_of(" + value + "))";
    case Kind::choice:
      return "Json(std::string(text_of(" + value + ")))";
    case Kind::seed:
      return "write_seed(" + value + ")";
    case Kind::child:
      return "write_child(" + value + ")";
    case Kind::geojson:
      return "write_geojson(" + value + ")";
    case Kind::structure:
    case Kind::shorthand:
      return "write(" + value + ")";
    case Kind::params:
      return "write_" + type.json_name + "(" + value + ")";
    case Kind::list:
    case Kind::map: {
      const std::string entry = inner_entry(value);
      return std::string(type.kind == Kind::list ? "write_list(" : "write_map(") + value + ", [](const " +
             type.parts[0].cpp + "& " + entry + ") { return " + write_expression(type.parts[0], entry) +
             "; })";
    }
    case Kind::variant: {
      std::string text;
      for (std::size_t i = 0; i + 1 < type.parts.size(); ++i) {
        const std::string index = std::to_string(i);
        text += value + ".index() == " + index + " ? " +
                write_expression(type.parts[i], "std::get<" + index + ">(" + value + ")") + " : ";
      }
      const std::string last = std::to_string(type.parts.size() - 1);
      return "(" + text + write_expression(type.parts.back(), "std::get<" + last + ">(" + value + ")") + ")";
    }
    default:
      return "Json(" + value + ")";
  }
}

/// The statement that writes a structure as one number where both mean the same.
std::string write_short(const Type& type) {
  const Schema& members = type.schema["x-short"];
  const std::string first = members[0].get<std::string>();
  std::string condition;
  for (const Member& member : type.members) {
    bool is_short = false;
    for (const Schema& name : members) is_short |= name == member.name;
    if (member.name == first) continue;
    condition += (condition.empty() ? "" : " && ") + ("value." + member.cpp_name) +
                 " == " + (is_short ? "value." + first : "plain." + member.cpp_name);
  }
  return "  if (" + (condition.empty() ? "true" : condition) + ") return Json(value." + first + ");\n";
}

std::string writer_of(const Type& type) {
  std::string text = "Json write(const " + type.cpp + "& value) {\n  Json json = Json::object();\n";
  std::string body;
  bool compares = false;
  for (const Member& member : type.members) {
    if (member.type.kind == Kind::free) continue;
    const std::string name = "value." + member.cpp_name;
    const std::string assign =
        "json[" + quoted(member.name) +
        "] = " + write_expression(member.type, member.optional ? "(*" + name + ")" : name) + ";\n";
    if (member.required) {
      body += "  " + assign;
    } else if (member.optional) {
      body += "  if (" + name + ") " + assign;
    } else {
      body += "  if (!(" + name + " == plain." + member.cpp_name + ")) " + assign;
      compares = true;
    }
  }
  if (compares) text += "  const " + type.cpp + " plain;\n";
  if (type.schema.contains("x-short")) text += write_short(type);
  return text + body + "  return json;\n}\n\n";
}

std::string words_of(const Type& choice) {
  std::string words;
  for (const Schema& word : choice.schema["enum"])
    words += (words.empty() ? "" : ", ") + quoted(word.get<std::string>());
  return "constexpr std::string_view " + words_name(choice) + "[] = {" + words + "};\n\n";
}

}  // namespace

std::string emit_source(const Unit& unit) {
  std::string text =
      "// Made from api_schema/" + unit.name +
      ".schema.json. Do not edit: edit the schema.\n#include \"generated/params/" + unit.name +
      ".h\"\n\n#include <string>\n\n#include \"core/schema/forms.h\"\n#include \"core/schema/reader.h\"\n"
      "#include \"core/schema/writer.h\"\n#include \"generated/params/" +
      unit.name + "_unused.h\"\n\nnamespace seedmesh {\nnamespace {\n\nusing namespace schema;\n\n";
  for (const Type& type : unit.declared) {
    text += type.kind == Kind::choice ? words_of(type) : "";
  }
  std::string choices, writers;
  for (const Type& type : unit.declared) {
    if (type.kind == Kind::choice) {
      choices += "std::string_view text_of(" + type.cpp + " choice) {\n  return " + words_name(type) +
                 "[static_cast<std::size_t>(choice)];\n}\n\n";
    } else {
      text += reader_of(type);
      writers += writer_of(type);
    }
  }
  text += writers + "}  // namespace\n\n" + choices;
  const std::string& params = unit.root.cpp;
  text += params + " read_" + unit.name +
          "(const Json& json, std::string_view pointer, IssueList& issues) {\n  " + params +
          " params;\n  read(Location(json, pointer, issues), params);\n  return params;\n}\n\n";
  text += "Json write_" + unit.name + "(const " + params + "& params) { return write(params); }\n\n" +
          emit_children(unit) + emit_unused(unit);
  return text + "}  // namespace seedmesh\n";
}

}  // namespace codegen

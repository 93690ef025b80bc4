#include <algorithm>
#include <set>

#include "api_schema/codegen/schema.h"
#include "core/schema/forms.h"

namespace codegen {
namespace {

using Words = std::set<std::string>;

const Words annotations = {"$schema",    "title",         "description", "default",  "examples",
                           "x-unit",     "x-group",       "x-step",      "x-order",  "x-short",
                           "x-advanced", "x-cpp-name",    "x-grammar",   "x-widget", "x-files",
                           "x-steps",    "x-params",      "x-formats",   "x-full",   "x-formats-where",
                           "x-motions",  "x-applies-when"};

/// The keywords that each type of value allows, without annotations.
Words keywords_for(const std::string& type) {
  if (type == "object") {
    return {"type",          "properties",    "required",     "additionalProperties",
            "propertyNames", "maxProperties", "minProperties"};
  }
  if (type == "array") return {"type", "items", "minItems", "maxItems"};
  if (type == "string") return {"type", "enum", "const", "minLength", "maxLength", "pattern"};
  if (type == "number") return {"type", "minimum", "maximum", "exclusiveMinimum"};
  if (type == "integer") return {"type", "minimum", "maximum"};
  if (type == "boolean") return {"type"};
  return {};
}

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw SchemaError(where + ": " + what);
}

bool is_identifier(const std::string& text) { return seedmesh::schema::forms::name.accepts(text); }

void check_keywords(const Schema& schema, const Words& known, const std::string& where) {
  for (const auto& [key, value] : schema.items()) {
    if (!known.contains(key) && !annotations.contains(key)) refuse(where, "unknown keyword " + key);
  }
}

void check_text(const Schema& schema, const std::string& where) {
  if (schema.contains("pattern")) {
    const auto pattern = schema["pattern"].get<std::string>();
    if (!seedmesh::schema::find_form(pattern))
      refuse(where, "the pattern " + pattern + " is none of core/schema/forms.h");
  }
  const Words grammars = {"production", "axiom", "expression", "cga"};
  if (schema.contains("x-grammar") && !grammars.contains(schema["x-grammar"].get<std::string>())) {
    refuse(where, "unknown x-grammar");
  }
  if (!schema.contains("enum")) return;
  for (const Schema& word : schema["enum"]) {
    if (!word.is_string() || !is_identifier(word.get<std::string>()))
      refuse(where, "the words of an enum have to be identifiers");
  }
}

void check_number(const Schema& schema, const std::string& where) {
  if (schema["type"] != "integer") return;
  for (const char* key : {"minimum", "maximum"}) {
    if (!schema.contains(key)) refuse(where, std::string("an integer needs a ") + key);
  }
}

void check_object(const Schema& schema, const std::string& where) {
  if (!schema.contains("additionalProperties")) refuse(where, "an object needs additionalProperties");
  const Schema& others = schema["additionalProperties"];
  const bool structure = others == false;
  if (structure != schema.contains("properties"))
    refuse(where, "properties need additionalProperties: false, and the reverse");
  if (others.is_object()) check(others, where + "/additionalProperties");
  if (schema.contains("propertyNames")) {
    const Schema& names = schema["propertyNames"];
    if (names.size() != 1 || !names.contains("pattern")) refuse(where, "propertyNames has to be a pattern");
    if (!seedmesh::schema::find_form(names["pattern"].get<std::string>()))
      refuse(where, "the pattern of propertyNames is none of core/schema/forms.h");
  }
  if (!structure) return;
  for (const auto& [name, property] : schema["properties"].items()) {
    const std::string there = where + "/properties/" + name;
    if (!is_identifier(property.value("x-cpp-name", name)))
      refuse(there, "the name is no C++ identifier; add x-cpp-name");
    for (const char* key : {"title", "description"}) {
      if (property.value(key, "").empty()) refuse(there, std::string("a parameter needs a ") + key);
    }
    check(property, there);
  }
  for (const Schema& name : schema.value("required", Schema::array())) {
    const auto word = name.get<std::string>();
    if (!schema["properties"].contains(word))
      refuse(where, "the required property " + word + " does not exist");
    if (schema["properties"][word].contains("default"))
      refuse(where, word + " is required and has a default");
  }
}

/// The JSON type by which alternatives are distinguished; integer and number are the same.
std::string json_type(const Schema& schema) {
  const std::string type = schema.value("type", "");
  return type == "integer" ? "number" : type;
}

void check_alternatives(const Schema& schema, const std::string& where) {
  check_keywords(schema, {"oneOf"}, where);
  Words types;
  for (std::size_t i = 0; i < schema["oneOf"].size(); ++i) {
    const Schema& alternative = schema["oneOf"][i];
    check(alternative, where + "/oneOf/" + std::to_string(i));
    if (!types.insert(json_type(alternative)).second)
      refuse(where, "two alternatives have the same JSON type");
  }
  if (!schema.contains("x-short")) return;
  if (types != Words{"number", "object"})
    refuse(where, "x-short needs a number and an object as alternatives");
  const Schema& object = schema["oneOf"][0]["type"] == "object" ? schema["oneOf"][0] : schema["oneOf"][1];
  for (const Schema& name : schema["x-short"]) {
    const auto word = name.get<std::string>();
    if (!object["properties"].contains(word))
      refuse(where, "x-short names " + word + ", which is not a member");
    if (object["properties"][word].value("default", Schema()) != schema.value("default", Schema(nullptr))) {
      refuse(where, "the default differs from that of " + word);
    }
  }
}

/// Checks the type of the default, its range and its word.
void check_default(const Schema& schema, const std::string& where) {
  const Schema& value = schema["default"];
  const std::string type = schema.value("type", "");
  const bool fits =
      type.empty() || (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
      (type == "string" && value.is_string()) || (type == "number" && value.is_number()) ||
      (type == "integer" && value.is_number_integer()) || (type == "boolean" && value.is_boolean());
  if (!fits) refuse(where, "the default is not of the type " + type);
  if (schema.contains("minimum") && value < schema["minimum"])
    refuse(where, "the default is below the minimum");
  if (schema.contains("maximum") && value > schema["maximum"])
    refuse(where, "the default is above the maximum");
  if (schema.contains("enum") && std::ranges::find(schema["enum"], value) == schema["enum"].end()) {
    refuse(where, "the default is not in the enum");
  }
}

}  // namespace

void check(const Schema& schema, const std::string& where) {
  if (!schema.is_object()) refuse(where, "a schema has to be an object");
  if (schema.contains("default")) check_default(schema, where);
  if (schema.contains("oneOf")) return check_alternatives(schema, where);
  const std::string type = schema.value("type", "");
  const Words known = keywords_for(type);
  if (known.empty()) refuse(where, "a schema needs a type or oneOf");
  check_keywords(schema, known, where);
  if (type == "object") check_object(schema, where);
  if (type == "string") check_text(schema, where);
  if (type == "number" || type == "integer") check_number(schema, where);
  if (type == "array") {
    if (!schema.contains("items")) refuse(where, "a list needs items");
    check(schema["items"], where + "/items");
  }
}

}  // namespace codegen

#include <set>
#include <sstream>

#include "api_schema/codegen/emit.h"
#include "core/schema/json.h"

namespace codegen {
namespace {

constexpr std::size_t line_length = 108;

std::string number_of(const Schema& value) {
  return value.is_number_float() ? seedmesh::number_text(value.get<double>()) : value.dump();
}

}  // namespace

std::string wrapped(const std::string& text, const std::string& lead) {
  std::istringstream words(text);
  std::string result, line = lead, word;
  while (words >> word) {
    const bool full = line.size() > lead.size() && line.size() + word.size() + 1 > line_length;
    if (full && !line.ends_with('\\')) {  // a backslash at the end would continue the comment
      result += line + "\n";
      line = lead;
    }
    line += (line.size() > lead.size() ? " " : "") + word;
  }
  return result + line + "\n";
}

std::string range_text(const Schema& schema) {
  std::string text;
  if (schema.contains("minimum") && schema.contains("maximum")) {
    text = number_of(schema["minimum"]) + " to " + number_of(schema["maximum"]);
  } else if (schema.contains("minimum")) {
    text = "at least " + number_of(schema["minimum"]);
  } else if (schema.contains("maximum")) {
    text = "at most " + number_of(schema["maximum"]);
  }
  if (schema.contains("exclusiveMinimum")) {
    text = "above " + number_of(schema["exclusiveMinimum"]) + (text.empty() ? "" : ", ") + text;
  }
  if (schema.contains("maxItems")) text = "at most " + schema["maxItems"].dump() + " entries";
  if (schema.contains("maxProperties")) text = "at most " + schema["maxProperties"].dump() + " members";
  return text;
}

std::string quoted(const std::string& text) {
  constexpr std::size_t chunk = 96;
  std::string result = "\"";
  std::size_t column = 0;
  for (const char c : text) {
    if (column >= chunk && (static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {
      result += "\"\n    \"";
      column = 0;
    }
    const std::size_t before = result.size();
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
    column += result.size() - before;
  }
  return result + "\"";
}

std::string enumerator(const std::string& word) {
  static const std::set<std::string> taken{"auto",   "bool", "char",  "default", "delete", "do",
                                           "double", "else", "float", "for",     "if",     "int",
                                           "long",   "new",  "not",   "or",      "short",  "static",
                                           "this",   "true", "false", "union",   "while",  "xor"};
  return taken.contains(word) ? word + "_" : word;
}

std::string initializer(const Type& type, const Schema& value) {
  switch (type.kind) {
    case Kind::choice:
      return type.cpp + "::" + enumerator(value.get<std::string>());
    case Kind::text:
      return quoted(value.get<std::string>());
    case Kind::color: {
      const auto text = value.get<std::string>();
      return "Color{0x" + text.substr(1, 2) + ", 0x" + text.substr(3, 2) + ", 0x" + text.substr(5, 2) + "}";
    }
    case Kind::flag:
    case Kind::integer:
    case Kind::number:
      return number_of(value);
    case Kind::seed:
      return number_of(value) + "U";
    case Kind::list: {
      std::string items;
      for (const Schema& item : value)
        items += (items.empty() ? "" : ", ") + initializer(type.parts[0], item);
      return items.empty() ? "" : "{" + items + "}";
    }
    case Kind::map: {
      std::string entries;
      for (const auto& [key, entry] : value.items()) {
        entries +=
            (entries.empty() ? "{" : ", {") + quoted(key) + ", " + initializer(type.parts[0], entry) + "}";
      }
      return entries.empty() ? "" : "{" + entries + "}";
    }
    case Kind::variant:
      for (const Type& part : type.parts) {
        const std::string json_type = part.schema.value("type", "");
        if (value.is_number() && (json_type == "number" || json_type == "integer"))
          return part.cpp + "{" + initializer(part, value) + "}";
        if (value.is_string() && json_type == "string")
          return part.cpp + "{" + initializer(part, value) + "}";
        if (value.is_array() && json_type == "array") return part.cpp + "{" + initializer(part, value) + "}";
      }
      throw SchemaError("no alternative accepts the default " + value.dump());
    case Kind::structure:
    case Kind::params:
    case Kind::shorthand:
    case Kind::child:
    case Kind::geojson:
    case Kind::free:
      break;
  }
  if (value.is_object() && !value.empty())
    throw SchemaError("the default of an object has to be {}, since its members have defaults");
  return "";
}

std::string words_name(const Type& choice) {
  std::string name;
  for (const char c : choice.cpp) {
    const bool capital = c >= 'A' && c <= 'Z';
    if (capital && !name.empty()) name += '_';
    name += capital ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return name + "_words";
}

}  // namespace codegen

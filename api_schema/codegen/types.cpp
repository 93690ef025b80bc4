#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>

#include "api_schema/codegen/schema.h"
#include "core/schema/forms.h"

namespace codegen {
namespace {

/// Turns the nodes of one schema into types and collects those that need a declaration.
class Typing {
 public:
  explicit Typing(Unit& unit) : unit_(unit) {}

  /// A structure or choice made from this node is called prefix + `name`.
  Type type_of(const Schema& schema, const std::string& name) {
    Type type;
    type.schema = schema;
    if (schema.contains("x-params")) {
      type.kind = Kind::params;
      type.json_name = schema["x-params"].get<std::string>();
      type.cpp = pascal_case(type.json_name) + "Params";
    } else if (schema.contains("oneOf")) {
      alternatives(type, name);
    } else {
      plain(type, schema["type"].get<std::string>(), name);
    }
    return type;
  }

 private:
  void plain(Type& type, const std::string& json_type, const std::string& name) {
    if (json_type == "boolean") set(type, Kind::flag, "bool");
    if (json_type == "number") set(type, Kind::number, "double");
    if (json_type == "integer") set(type, Kind::integer, integer_type(type.schema));
    if (json_type == "string") text(type, name);
    if (json_type == "array") list(type, name);
    if (json_type == "object") object(type, name);
  }

  static void set(Type& type, Kind kind, std::string cpp) {
    type.kind = kind;
    type.cpp = std::move(cpp);
  }

  static std::string integer_type(const Schema& schema) {
    using Narrow = std::numeric_limits<std::int32_t>;
    const bool narrow = schema.contains("minimum") && schema["minimum"].get<double>() >= Narrow::min() &&
                        schema.contains("maximum") && schema["maximum"].get<double>() <= Narrow::max();
    return narrow ? "std::int32_t" : "std::int64_t";
  }

  void text(Type& type, const std::string& name) {
    if (type.schema.contains("enum")) {
      set(type, Kind::choice, unit_.prefix + name);
      declare(type);
    } else if (type.schema.value("pattern", "") == seedmesh::schema::forms::color.pattern) {
      set(type, Kind::color, "Color");
    } else {
      set(type, Kind::text, "std::string");
    }
  }

  void list(Type& type, const std::string& name) {
    const Schema& items = type.schema["items"];
    type.parts.push_back(
        type_of(items, items.contains("title") ? pascal_case(items["title"]) : name + "Item"));
    const std::size_t least = type.schema.value("minItems", std::size_t{0});
    if (least > 0 && least == type.schema.value("maxItems", std::size_t{0})) {
      set(type, Kind::list, "std::array<" + type.parts[0].cpp + ", " + std::to_string(least) + ">");
    } else {
      set(type, Kind::list, "std::vector<" + type.parts[0].cpp + ">");
    }
  }

  void object(Type& type, const std::string& name) {
    if (type.schema.value("x-widget", "") == "request") return set(type, Kind::child, "Child");
    if (type.schema.value("x-widget", "") == "geojson") return set(type, Kind::geojson, "GeoJson");
    const Schema& others = type.schema["additionalProperties"];
    if (others == true) return set(type, Kind::free, "");
    if (others.is_object()) {
      type.parts.push_back(
          type_of(others, others.contains("title") ? pascal_case(others["title"]) : name + "Entry"));
      return set(type, Kind::map, "std::map<std::string, " + type.parts[0].cpp + ">");
    }
    set(type, Kind::structure, unit_.prefix + name);
    for (const auto& [key, property] : type.schema["properties"].items())
      type.members.push_back(member(type, key, property));
    declare(type);
  }

  /// Declares a type once, however often it is used.
  void declare(const Type& type) {
    const auto known = std::ranges::find(unit_.declared, type.cpp, &Type::cpp);
    if (known == unit_.declared.end()) return unit_.declared.push_back(type);
    const auto keywords = [](const Type& each) {
      Schema rest = each.schema;
      for (const char* word : {"title", "description", "default", "examples", "x-applies-when"})
        rest.erase(word);
      return rest;
    };
    if (keywords(*known) != keywords(type))
      throw SchemaError("two different types have the name " + type.cpp);
  }

  Member member(const Type& owner, const std::string& key, const Schema& property) {
    Member result;
    result.name = key;
    result.cpp_name = property.value("x-cpp-name", key);
    for (const Schema& name : owner.schema.value("required", Schema::array())) result.required |= name == key;
    result.type = type_of(property, pascal_case(result.cpp_name));
    result.optional = !result.required && !property.contains("default") && result.type.kind != Kind::free;
    return result;
  }

  void alternatives(Type& type, const std::string& name) {
    if (type.schema.value("x-widget", "") == "seed") return set(type, Kind::seed, "std::uint64_t");
    for (const Schema& each : type.schema["oneOf"]) {
      if (!type.schema.contains("x-short") || each["type"] != "object")
        type.parts.push_back(type_of(each, pascal_case(each.value("x-cpp-name", name))));
    }
    if (type.schema.contains("x-short")) {
      Schema object =
          type.schema["oneOf"][0]["type"] == "object" ? type.schema["oneOf"][0] : type.schema["oneOf"][1];
      object["x-short"] = type.schema["x-short"];
      object["description"] = type.schema["description"];
      type.parts.push_back(type_of(object, name));
      type.members = type.parts[1].members;
      return set(type, Kind::shorthand, type.parts[1].cpp);
    }
    std::string cpp;
    for (const Type& part : type.parts) cpp += (cpp.empty() ? "" : ", ") + part.cpp;
    set(type, Kind::variant, "std::variant<" + cpp + ">");
  }

  Unit& unit_;
};

}  // namespace

std::string pascal_case(const std::string& words) {
  std::string result;
  bool start = true;
  for (const char c : words) {
    const auto letter = static_cast<unsigned char>(c);
    if (!std::isalnum(letter)) {
      start = true;
    } else {
      result += start ? static_cast<char>(std::toupper(letter)) : c;
      start = false;
    }
  }
  return result;
}

Unit load_unit(const std::filesystem::path& path) {
  Unit unit;
  const std::string file = path.filename().string();
  unit.name = file.substr(0, file.find('.'));
  unit.prefix = pascal_case(unit.name);
  const Schema schema = resolve(path, Marks::keep);
  check(schema, file + "#");
  unit.root = Typing(unit).type_of(schema, "Params");
  if (unit.root.kind != Kind::structure)
    throw SchemaError(file + ": the root has to be an object with properties");
  translate_conditions(unit);
  return unit;
}

}  // namespace codegen

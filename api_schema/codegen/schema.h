#pragma once
/// Reads a JSON Schema of api_schema/ into C++ types with their rules, for the emitters. The supported keywords
/// mean the same in Draft 7 and in 2020-12. Every other keyword is an error, so that nothing in a schema is ignored.
///
///   type, properties, required, additionalProperties (false; or one schema: a map; or true: an object that
///   others read), propertyNames {pattern}, items, minItems, maxItems, maxProperties, minimum, maximum,
///   exclusiveMinimum, minLength, maxLength, pattern (one of core/schema/forms.h), enum (of texts), oneOf
///   (alternatives of different JSON types), $ref (a file, or file#/$defs/name; beside it only annotations),
///   $defs, $schema, title, description, default, examples
///
/// Annotations of our own: x-unit, x-group, x-step, x-steps, x-order, x-advanced, x-grammar, x-cpp-name, x-widget;
/// x-applies-when: the condition under which the parameter has an effect (docs/add-a-generator.md); x-full: the
/// member that replaces an omitted number; x-short: beside a oneOf of number and object, the members that the
/// number sets.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace codegen {

/// Keeps members in the order of the file, which is the order of the struct, the form and the docs.
using Schema = nlohmann::ordered_json;

/// An error in a schema. The text names the file and the position in it.
class SchemaError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Kind {
  flag,       ///< bool
  number,     ///< double
  integer,    ///< std::int32_t where the range allows, else std::int64_t
  seed,       ///< std::uint64_t; the $def "seed"
  text,       ///< std::string
  color,      ///< Color; a text of the form "color"
  choice,     ///< an enum class
  list,       ///< std::vector, or std::array where the length is fixed
  map,        ///< std::map from std::string
  structure,  ///< a struct of this header
  params,     ///< the struct of another schema, for a $ref to a whole file
  shorthand,  ///< a structure that may also be written as one number (x-short)
  variant,    ///< std::variant of the alternatives
  child,      ///< Child: a request inside the request; an object with x-widget "request"
  geojson,    ///< GeoJson: an object with x-widget "geojson"
  free,       ///< an object that other code reads: no member
};

struct Member;

struct Type {
  Kind kind = Kind::free;
  std::string cpp;          ///< the C++ type
  std::string json_name;    ///< for Kind::params: the other schema's name
  Schema schema;            ///< keywords and annotations, references resolved
  std::vector<Type> parts;  ///< list, map: the entry; variant: the alternatives; shorthand: number, structure
  std::vector<Member> members;  ///< structure and shorthand
};

/// A part of x-applies-when.
struct Clause {
  std::string holds;   ///< an expression of C++ over `root`, the parameters, and `value`, the structure
  std::string words;   ///< "`leaf.build` is not none"
  std::string reason;  ///< why a parameter has no effect: "if `leaf.build` is none", "unless `age` is given"
};

struct Member {
  std::string name;      ///< the JSON key
  std::string cpp_name;  ///< the same unless x-cpp-name says otherwise
  bool required = false;
  bool optional = false;  ///< neither required nor with a default: std::optional
  Type type;
  std::vector<Clause> applies_when;  ///< all have to hold; empty: it always has an effect
  std::string shown_name;            ///< with applies_when: what messages call it, "leaf.fold"
};

/// A whole schema. `declared` lists the structures and choices; each comes after the types of its members.
struct Unit {
  std::string name;    ///< "lsystem"
  std::string prefix;  ///< "Lsystem"
  Type root;
  std::vector<Type> declared;
};

Schema load_json(const std::filesystem::path& path);

/// The schema with all references resolved, as the service returns it. Marks::keep adds "x-params": name
/// where a reference names a whole file.
enum class Marks { leave_out, keep };
Schema resolve(const std::filesystem::path& path, Marks marks = Marks::leave_out);

/// Throws SchemaError at the first keyword, default or name that is invalid.
void check(const Schema& schema, const std::string& where);

/// Translates x-applies-when of every member. Throws SchemaError where a path leads nowhere or a value cannot
/// be compared.
void translate_conditions(Unit& unit);

/// Reads, checks and types a schema file "<name>.schema.json".
Unit load_unit(const std::filesystem::path& path);

/// "width_rule" and "Width rule" both give "WidthRule".
std::string pascal_case(const std::string& words);

}  // namespace codegen

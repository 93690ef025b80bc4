#pragma once
/// A JSON Schema of api_schema/ read into what the emitters need: C++ types with their rules. The subset is
/// what Draft 7 and 2020-12 share and mean alike; every keyword outside it is refused, so that nothing in a
/// schema is ever ignored.
///
///   type, properties, required, additionalProperties (false; or one schema: a map; or true: an object that
///   others read), propertyNames {pattern}, items, minItems, maxItems, maxProperties, minimum, maximum,
///   exclusiveMinimum, minLength, maxLength, pattern (one of core/schema/forms.h), enum (of texts), oneOf
///   (alternatives of different JSON types), $ref (a file, or file#/$defs/name; beside it only annotations),
///   $defs, $schema, title, description, default, examples
///
/// Annotations of our own: x-unit, x-group, x-step, x-order, x-advanced, x-grammar, x-cpp-name, x-widget,
/// x-steps, x-full: the member beside it that stands for a number that is left out, and x-short: beside a
/// oneOf of number and object, the members that the number stands for.
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace codegen {

/// Keeps members in the order of the file: it is the order of the struct, the form and the docs.
using Schema = nlohmann::ordered_json;

/// A fault in a schema; the text names the file and the place.
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
  free,       ///< an object left to others: no member
};

struct Member;

struct Type {
  Kind kind = Kind::free;
  std::string cpp;          ///< how C++ spells it
  std::string json_name;    ///< for Kind::params: the other schema's name
  Schema schema;            ///< keywords and annotations, references resolved
  std::vector<Type> parts;  ///< list, map: the entry; variant: the alternatives; shorthand: number, structure
  std::vector<Member> members;  ///< structure and shorthand
};

struct Member {
  std::string name;      ///< the JSON key
  std::string cpp_name;  ///< the same unless x-cpp-name says otherwise
  bool required = false;
  bool optional = false;  ///< neither required nor with a default: std::optional
  Type type;
};

/// A whole schema. `declared` has the structures and choices in an order in which each comes after what it is
/// made of.
struct Unit {
  std::string name;    ///< "lsystem"
  std::string prefix;  ///< "Lsystem"
  Type root;
  std::vector<Type> declared;
};

Schema load_json(const std::filesystem::path& path);

/// The schema without a single $ref, as it is served. `marks` leaves "x-params": name where a whole file was
/// referred to.
enum class Marks { leave_out, keep };
Schema resolve(const std::filesystem::path& path, Marks marks = Marks::leave_out);

/// Throws SchemaError at the first keyword, default or name that is not in order.
void check(const Schema& schema, const std::string& where);

/// Reads, checks and types a schema file "<name>.schema.json".
Unit load_unit(const std::filesystem::path& path);

/// "width_rule" and "Width rule" both give "WidthRule".
std::string pascal_case(const std::string& words);

}  // namespace codegen

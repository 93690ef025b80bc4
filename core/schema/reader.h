#pragma once
/// The functions that the generated readers of api_schema call. Each one checks a JSON value against a rule of
/// its schema. It stores the value in a member, or adds an error that states what was found and what was expected.
/// After an error the member keeps its default and reading continues, so that all errors are found at once.
///
/// Includes the whole of nlohmann/json: for .cpp files only.
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/child.h"
#include "core/schema/color.h"
#include "core/schema/geojson.h"
#include "core/schema/issue_list.h"
#include "core/schema/json.h"

namespace seedmesh::schema {

/// The JSON types that alternatives of a schema can have.
enum class JsonKind { null, flag, number, text, list, object };

/// A JSON value and its position in the request. The position is a chain of Locations on the stack, which becomes
/// a JSON Pointer only when an error is reported. Owns neither the value nor the outer Locations: both have to
/// outlive it.
class Location {
 public:
  Location(const Json& value, std::string_view pointer, IssueList& issues)
      : value_(&value), issues_(&issues), token_(pointer) {}

  const Json& value() const { return *value_; }
  IssueList& issue_list() const { return *issues_; }
  JsonKind kind() const;
  std::string pointer() const;

  /// Returns the member `key` of an object, if there is one.
  std::optional<Location> member(std::string_view key) const;
  Location child(const Json& value, std::string_view key) const { return {value, key, npos, *this}; }
  Location child(const Json& value, std::size_t index) const { return {value, {}, index, *this}; }

  /// Adds the error "found …, expected `what`" at this location.
  void expected(std::string_view what, IssueKind kind = IssueKind::wrong_type) const;
  void report(IssueKind kind, std::string message) const;

 private:
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
  Location(const Json& value, std::string_view key, std::size_t index, const Location& parent)
      : value_(&value), parent_(&parent), issues_(parent.issues_), token_(key), index_(index) {}

  const Json* value_;
  const Location* parent_ = nullptr;  ///< null: token_ is the whole pointer to here
  IssueList* issues_;
  std::string_view token_;
  std::size_t index_ = npos;  ///< npos: a member of an object
};

struct NumberRule {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  double above = -std::numeric_limits<double>::infinity();  ///< exclusiveMinimum
};

struct IntegerRule {
  std::int64_t minimum = std::numeric_limits<std::int64_t>::min();
  std::int64_t maximum = std::numeric_limits<std::int64_t>::max();
};

/// A pattern that a text has to match: see forms.h.
struct Form;

struct TextRule {
  std::size_t least = 0;  ///< least length in code points
  std::size_t most = std::numeric_limits<std::size_t>::max();
  const Form* form = nullptr;
};

struct CountRule {
  std::size_t least = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();
  const Form* names = nullptr;  ///< form that the keys of a map must have; null: any key
};

/// "Polygon", "FeatureCollection" or another type of RFC 7946 where the value is GeoJSON; else an empty text.
std::string_view geojson_type(const Json& value);

void read_flag(const Location& location, bool& out);
void read_number(const Location& location, const NumberRule& rule, double& out);
void read_integer(const Location& location, const IntegerRule& rule, std::int64_t& out);
void read_integer(const Location& location, const IntegerRule& rule, std::int32_t& out);
void read_text(const Location& location, const TextRule& rule, std::string& out);
void read_color(const Location& location, Color& out);
void read_seed(const Location& location,
               std::uint64_t& out);                     ///< 0 to 2^64 - 1, as an integer or as decimal digits
void read_child(const Location& location, Child& out);  ///< parameters stay JSON until read_parameters()
void read_geojson(const Location& location, GeoJson& out);  ///< checks only that it is an object
void read_free_object(const Location& location);            ///< checks only that it is an object

/// Returns the index of the value in a list of words, or nullopt after an error. `beside` names the other types that
/// the value may have, for the message.
std::optional<std::size_t> read_word(const Location& location, std::span<const std::string_view> words,
                                     std::string_view beside = {});

template <class Choice>
void read_choice(const Location& location, std::span<const std::string_view> words, Choice& out,
                 std::string_view beside = {}) {
  if (const auto index = read_word(location, words, beside)) out = static_cast<Choice>(*index);
}

/// Checks that the value is an object, and reports unknown and missing members. False: it is no object, so there is
/// nothing to read.
bool check_members(const Location& location, std::span<const std::string_view> known,
                   std::initializer_list<std::string_view> required);

/// Checks that the value is a list (or object) and has as many entries as the rule allows. False: it is no list.
bool check_list(const Location& location, const CountRule& rule);
bool check_map(const Location& location, const CountRule& rule);
void check_key(const Location& entry, std::string_view key, const CountRule& rule);

/// Checks that a list of lists of lists of numbers has all three levels. Returns false, after one error for
/// the whole value, if it has only two. `entry` and `inner` name the entries of the two outer lists, for the
/// message.
bool check_nesting(const Location& location, std::string_view entry, std::string_view inner);

/// Reads each entry. An entry with an error keeps its default value, so that indices stay the same; entries beyond
/// the greatest count are not read.
template <class Value, class Read>
void read_list(const Location& location, const CountRule& rule, std::vector<Value>& out, const Read& read) {
  if (!check_list(location, rule)) return;
  out.clear();
  for (const Json& item : location.value()) {
    const std::size_t index = out.size();
    if (index == rule.most) return;
    read(location.child(item, index), out.emplace_back());
  }
}

/// Reads a list whose length is that of the array.
template <class Value, std::size_t size, class Read>
void read_list(const Location& location, const CountRule&, std::array<Value, size>& out, const Read& read) {
  if (!check_list(location, {.least = size, .most = size})) return;
  for (std::size_t i = 0; i < size && i < location.value().size(); ++i)
    read(location.child(location.value()[i], i), out[i]);
}

/// Reads each member of an object. One with an error keeps its key and gets a default value.
template <class Value, class Read>
void read_map(const Location& location, const CountRule& rule, std::map<std::string, Value>& out,
              const Read& read) {
  if (!check_map(location, rule)) return;
  out.clear();
  for (const auto& [key, value] : location.value().get_ref<const Json::object_t&>()) {
    if (out.size() == rule.most) return;
    const Location entry = location.child(value, key);
    check_key(entry, key, rule);
    read(entry, out[key]);
  }
}

}  // namespace seedmesh::schema

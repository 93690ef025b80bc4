#pragma once
/// What the readers made from api_schema are built of: each function checks one value against one rule of its
/// schema, puts it into its member, or adds a fault that says what was found and what was expected. A value
/// that is refused leaves its member at the default, so that reading goes on and every fault is found at
/// once.
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
#include "core/schema/faults.h"
#include "core/schema/json.h"

namespace seedmesh::schema {

/// The types of JSON, told apart where a schema leaves a choice.
enum class JsonKind { null, flag, number, text, list, object };

/// A value inside a request and the way to it. The way is a chain of places on the stack, written out as a
/// JSON Pointer only when there is a fault. Does not own the value, nor the places above, which must outlive
/// it.
class Place {
 public:
  Place(const Json& value, std::string_view pointer, Faults& faults)
      : value_(&value), faults_(&faults), token_(pointer) {}

  const Json& value() const { return *value_; }
  Faults& faults() const { return *faults_; }
  JsonKind kind() const;
  std::string pointer() const;

  /// The member `key` of an object, if it is there.
  std::optional<Place> member(std::string_view key) const;
  Place child(const Json& value, std::string_view key) const { return {value, key, npos, *this}; }
  Place child(const Json& value, std::size_t index) const { return {value, {}, index, *this}; }

  /// Adds "found …, expected `what`".
  void expected(std::string_view what) const;
  void fault(std::string message) const;

 private:
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
  Place(const Json& value, std::string_view key, std::size_t index, const Place& parent)
      : value_(&value), parent_(&parent), faults_(parent.faults_), token_(key), index_(index) {}

  const Json* value_;
  const Place* parent_ = nullptr;  ///< null: token_ is the whole pointer to here
  Faults* faults_;
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

/// How a text must look beyond its length: a test and the words for it. See forms.h.
struct Form;

struct TextRule {
  std::size_t least = 0;  ///< in characters (code points)
  std::size_t most = std::numeric_limits<std::size_t>::max();
  const Form* form = nullptr;
};

struct CountRule {
  std::size_t least = 0;
  std::size_t most = std::numeric_limits<std::size_t>::max();
  const Form* names = nullptr;  ///< of the keys of a map
};

void read_flag(const Place& place, bool& out);
void read_number(const Place& place, const NumberRule& rule, double& out);
void read_integer(const Place& place, const IntegerRule& rule, std::int64_t& out);
void read_integer(const Place& place, const IntegerRule& rule, std::int32_t& out);
void read_text(const Place& place, const TextRule& rule, std::string& out);
void read_color(const Place& place, Color& out);
void read_seed(const Place& place,
               std::uint64_t& out);               ///< 0 to 2^64 - 1, as an integer or as decimal digits
void read_child(const Place& place, Child& out);  ///< its parameters are JSON until read_parameters
void read_free_object(const Place& place);        ///< only that it is an object: others read what is in it

/// The index of a word in a list, or nullopt after adding a fault.
/// `beside`: what else than a word the value may be, for the message.
std::optional<std::size_t> read_word(const Place& place, std::span<const std::string_view> words,
                                     std::string_view beside = {});

template <class Choice>
void read_choice(const Place& place, std::span<const std::string_view> words, Choice& out,
                 std::string_view beside = {}) {
  if (const auto index = read_word(place, words, beside)) out = static_cast<Choice>(*index);
}

/// Is it an object? Names the members that are not known and those that are missing. False: there is nothing
/// to read.
bool check_members(const Place& place, std::span<const std::string_view> known,
                   std::initializer_list<std::string_view> required);

/// Is it a list, or object, of as many entries as the rule allows? False: there is nothing to read.
bool check_list(const Place& place, const CountRule& rule);
bool check_map(const Place& place, const CountRule& rule);
void check_key(const Place& entry, std::string_view key, const CountRule& rule);

/// Are there lists in the entries of the list? False where its first entry is a list of what is none, so that
/// a list has been left out: one fault for all, which says what the `entry` is and what stands in it.
bool check_nesting(const Place& place, std::string_view entry, std::string_view inner);

/// A refused entry stays in place with its default, so that indexes hold; entries beyond the greatest number
/// are left unread.
template <class Value, class Read>
void read_list(const Place& place, const CountRule& rule, std::vector<Value>& out, const Read& read) {
  if (!check_list(place, rule)) return;
  out.clear();
  for (const Json& item : place.value()) {
    const std::size_t index = out.size();
    if (index == rule.most) return;
    read(place.child(item, index), out.emplace_back());
  }
}

/// A list of fixed length; its length is the rule.
template <class Value, std::size_t size, class Read>
void read_list(const Place& place, const CountRule&, std::array<Value, size>& out, const Read& read) {
  if (!check_list(place, {.least = size, .most = size})) return;
  for (std::size_t i = 0; i < size && i < place.value().size(); ++i)
    read(place.child(place.value()[i], i), out[i]);
}

/// A refused entry keeps its key with a default.
template <class Value, class Read>
void read_map(const Place& place, const CountRule& rule, std::map<std::string, Value>& out,
              const Read& read) {
  if (!check_map(place, rule)) return;
  out.clear();
  for (const auto& [key, value] : place.value().get_ref<const Json::object_t&>()) {
    if (out.size() == rule.most) return;
    const Place entry = place.child(value, key);
    check_key(entry, key, rule);
    read(entry, out[key]);
  }
}

}  // namespace seedmesh::schema

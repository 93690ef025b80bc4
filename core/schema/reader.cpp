#include "core/schema/reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/schema/forms.h"
#include "core/schema/nearest.h"

namespace seedmesh::schema {
namespace {

constexpr std::size_t quoted = 40;  ///< characters of a text that a message repeats

/// What stands there, for a human who looks for it in the request.
std::string found(const Json& value) {
  switch (value.type()) {
    case Json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    case Json::value_t::number_integer:
      return std::to_string(value.get<std::int64_t>());
    case Json::value_t::number_unsigned:
      return std::to_string(value.get<std::uint64_t>());
    case Json::value_t::number_float:
      return number_text(value.get<double>());
    case Json::value_t::string:
      return "the text \"" + shortened(value.get_ref<const std::string&>(), quoted) + "\"";
    case Json::value_t::array:
      return value.empty() ? "an empty list" : "a list";
    case Json::value_t::object:
      return "an object";
    default:
      return "null";
  }
}

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// "from 0 to 1", "of at least 3", "of at most 7", "above 0" or nothing; with the blank before it.
std::string range_words(const std::optional<std::string>& minimum,
                        const std::optional<std::string>& maximum) {
  if (minimum && maximum) return " from " + *minimum + " to " + *maximum;
  if (minimum) return " of at least " + *minimum;
  if (maximum) return " of at most " + *maximum;
  return "";
}

std::string words_for(const NumberRule& rule) {
  const auto text = [](double x) {
    return std::isfinite(x) ? std::optional<std::string>(number_text(x)) : std::nullopt;
  };
  const std::string range = range_words(text(rule.minimum), text(rule.maximum));
  const std::string above = std::isfinite(rule.above) ? " above " + number_text(rule.above) : "";
  return "a number" + above + (above.empty() || range.empty() ? "" : " and") + range;
}

std::string words_for(const IntegerRule& rule) {
  using Limit = std::numeric_limits<std::int64_t>;
  std::optional<std::string> minimum, maximum;
  if (rule.minimum != Limit::min()) minimum = std::to_string(rule.minimum);
  if (rule.maximum != Limit::max()) maximum = std::to_string(rule.maximum);
  return "an integer" + range_words(minimum, maximum);
}

/// What is counted, once and many times.
struct Counted {
  std::string_view one, many;
};
constexpr Counted characters = {"character", "characters"};
constexpr Counted entries = {"entry", "entries"};
constexpr Counted members = {"member", "members"};

/// "1 to 3 entries", "at most 256 entries".
std::string count_words(std::size_t least, std::size_t most, const Counted& what) {
  constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();
  std::string words;
  if (most == no_limit) {
    words = "at least " + std::to_string(least);
  } else if (least == most) {
    words = std::to_string(least);
  } else if (least == 0) {
    words = "at most " + std::to_string(most);
  } else {
    words = std::to_string(least) + " to " + std::to_string(most);
  }
  const std::size_t last = most == no_limit ? least : most;
  return words.append(" ").append(last == 1 ? what.one : what.many);
}

/// Adds a fault where there are too many or too few.
void check_count(const Place& place, std::size_t count, std::size_t least, std::size_t most,
                 const Counted& what) {
  if (count >= least && count <= most) return;
  place.fault("found " + count_words(count, count, what) + ", expected " + count_words(least, most, what));
}

/// Whole numbers come as 5 or as 5.0; JSON knows no difference. Nullopt: not whole, or beyond 64 bits.
std::optional<std::int64_t> whole_number(const Json& value) {
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    if (number > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) return std::nullopt;
    return static_cast<std::int64_t>(number);
  }
  if (value.is_number_integer()) return value.get<std::int64_t>();
  const double number = value.get<double>();
  if (std::floor(number) != number || number < -0x1p63 || number >= 0x1p63) return std::nullopt;
  return static_cast<std::int64_t>(number);
}

std::string hint(std::string_view word, std::span<const std::string_view> words) {
  const std::string_view nearest = nearest_word(word, words);
  return nearest.empty() ? "" : "; did you mean \"" + std::string(nearest) + "\"?";
}

std::string listed(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

}  // namespace

JsonKind Place::kind() const {
  switch (value_->type()) {
    case Json::value_t::boolean:
      return JsonKind::flag;
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
    case Json::value_t::number_float:
      return JsonKind::number;
    case Json::value_t::string:
      return JsonKind::text;
    case Json::value_t::array:
      return JsonKind::list;
    case Json::value_t::object:
      return JsonKind::object;
    default:
      return JsonKind::null;
  }
}

std::string Place::pointer() const {
  if (!parent_) return std::string(token_);
  if (index_ != npos) return parent_->pointer() + "/" + std::to_string(index_);
  return parent_->pointer() + pointer_token(token_);
}

std::optional<Place> Place::member(std::string_view key) const {
  const auto found_member = value_->find(key);
  if (found_member == value_->end()) return std::nullopt;
  return child(*found_member, key);
}

void Place::expected(std::string_view what) const {
  if (faults_->full()) return faults_->count();
  fault("found " + found(*value_) + ", expected " + std::string(what));
}

void Place::fault(std::string message) const {
  if (faults_->full()) return faults_->count();
  faults_->add({pointer(), std::move(message)});
}

void read_flag(const Place& place, bool& out) {
  if (place.kind() == JsonKind::flag) {
    out = place.value().get<bool>();
  } else {
    place.expected("true or false");
  }
}

void read_number(const Place& place, const NumberRule& rule, double& out) {
  const double number = place.kind() == JsonKind::number ? place.value().get<double>() : 0;
  const bool inside = number >= rule.minimum && number <= rule.maximum && number > rule.above;
  if (place.kind() == JsonKind::number && inside) {
    out = number;
  } else {
    place.expected(words_for(rule));
  }
}

void read_integer(const Place& place, const IntegerRule& rule, std::int64_t& out) {
  const auto number = place.kind() == JsonKind::number ? whole_number(place.value()) : std::nullopt;
  if (number && *number >= rule.minimum && *number <= rule.maximum) {
    out = *number;
  } else {
    place.expected(words_for(rule));
  }
}

void read_integer(const Place& place, const IntegerRule& rule, std::int32_t& out) {
  std::int64_t wide = out;
  read_integer(place, rule, wide);
  out = static_cast<std::int32_t>(wide);  // the tool takes 32 bits only where the rule fits into them
}

void read_text(const Place& place, const TextRule& rule, std::string& out) {
  if (place.kind() != JsonKind::text) return place.expected(rule.form ? rule.form->expected : "a text");
  const auto& text = place.value().get_ref<const std::string&>();
  if (rule.form && !rule.form->accepts(text)) return place.expected(rule.form->expected);
  const std::size_t length = count_characters(text);
  if (length < rule.least || length > rule.most)
    return check_count(place, length, rule.least, rule.most, characters);
  out = text;
}

void read_color(const Place& place, Color& out) {
  const auto* const text = place.value().get_ptr<const std::string*>();
  if (const auto color = text ? color_of(*text) : std::nullopt) {
    out = *color;
  } else {
    place.expected(forms::color.expected);
  }
}

void read_seed(const Place& place, std::uint64_t& out) {
  constexpr std::string_view what =
      "an integer from 0 to 18446744073709551615, or its decimal digits as a text";
  const Json& value = place.value();
  if (value.is_number_unsigned()) {
    out = value.get<std::uint64_t>();
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    // Integers of 2^64 and more come as doubles too; 2^64 itself is the first that does not fit.
    if (std::floor(number) != number || number < 0 || number >= 0x1p64) return place.expected(what);
    out = static_cast<std::uint64_t>(number);
  } else if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (!forms::digits.accepts(text) || error != std::errc{} || end != text.data() + text.size()) {
      return place.expected(what);
    }
    out = number;
  } else if (value.is_number_integer() && value.get<std::int64_t>() >= 0) {
    out = static_cast<std::uint64_t>(value.get<std::int64_t>());
  } else {
    place.expected(what);
  }
}

void read_free_object(const Place& place) {
  if (place.kind() != JsonKind::object) place.expected("an object");
}

std::optional<std::size_t> read_word(const Place& place, std::span<const std::string_view> words,
                                     std::string_view beside) {
  const std::string other = beside.empty() ? "" : std::string(beside) + " or ";
  const std::string what = other + (words.size() == 1 ? "" : "one of ") + listed(words);
  if (place.kind() != JsonKind::text) {
    place.expected(what);
    return std::nullopt;
  }
  const auto& text = place.value().get_ref<const std::string&>();
  const auto word = std::ranges::find(words, std::string_view(text));
  if (word == words.end()) {
    place.expected(what + hint(text, words));
    return std::nullopt;
  }
  return static_cast<std::size_t>(word - words.begin());
}

bool check_members(const Place& place, std::span<const std::string_view> known,
                   std::initializer_list<std::string_view> required) {
  if (place.kind() != JsonKind::object) {
    place.expected("an object");
    return false;
  }
  for (const std::string_view name : required) {
    if (place.value().contains(name)) continue;
    place.faults().add_missing(place.pointer(), name, "\"" + std::string(name) + "\" is missing");
  }
  bool is_listed = false;  // once for all strangers of an object
  for (const auto& [key, value] : place.value().get_ref<const Json::object_t&>()) {
    if (std::ranges::find(known, std::string_view(key)) != known.end()) continue;
    if (place.faults().full()) {
      place.faults().count();
      continue;
    }
    std::string help = hint(key, known);
    if (help.empty() && !std::exchange(is_listed, true)) help = "; known are " + listed(known);
    place.child(value, key).fault("\"" + shortened(key, quoted) + "\" is not known here" + help);
  }
  return true;
}

bool check_list(const Place& place, const CountRule& rule) {
  if (place.kind() != JsonKind::list) {
    place.expected("a list");
    return false;
  }
  check_count(place, place.value().size(), rule.least, rule.most, entries);
  return true;
}

bool check_nesting(const Place& place, std::string_view entry, std::string_view inner) {
  const Json& list = place.value();
  if (!list.is_array() || list.empty() || !list[0].is_array() || list[0].empty() || list[0][0].is_array())
    return true;
  place.fault("found lists of numbers, expected one list more around them: each entry is a " +
              std::string(entry) + ", and each entry of that a " + std::string(inner) +
              ", as in [[[0, 0], …]]");
  return false;
}

bool check_map(const Place& place, const CountRule& rule) {
  if (place.kind() != JsonKind::object) {
    place.expected("an object");
    return false;
  }
  check_count(place, place.value().size(), rule.least, rule.most, members);
  return true;
}

void check_key(const Place& entry, std::string_view key, const CountRule& rule) {
  if (!rule.names || rule.names->accepts(key)) return;
  entry.fault("\"" + shortened(key, quoted) + "\" is not a good name; expected " +
              std::string(rule.names->expected));
}

}  // namespace seedmesh::schema

#include "core/schema/reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/schema/forms.h"
#include "core/schema/nearest.h"
#include "core/schema/presets.h"

namespace seedmesh::schema {
namespace {

constexpr std::size_t quoted = 40;  ///< code points of a text that a message quotes

/// The value as a message names it.
std::string found(const Json& value) {
  if (const std::string_view geometry = geojson_type(value); !geometry.empty())
    return "GeoJSON (" + std::string(geometry) + ")";
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

/// "from 0 to 1", "of at least 3", "of at most 7", "above 0" or nothing; with a leading space.
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

/// A noun in the singular and in the plural.
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

/// Reports a count outside of its range.
void check_count(const Location& location, std::size_t count, std::size_t least, std::size_t most,
                 const Counted& what) {
  if (count >= least && count <= most) return;
  location.report(IssueKind::out_of_range, "found " + count_words(count, count, what) + ", expected " +
                                               count_words(least, most, what));
}

/// JSON does not distinguish 5 and 5.0. Nullopt: a fraction, or beyond 64 bits.
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

/// A hint at a similar word, or else at the preset of this name.
std::string hint_or_preset(const std::string& word, std::span<const std::string_view> words) {
  std::string help = hint(word, words);
  if (help.empty() && preset_requests().contains(word))
    help = "; there is a preset of this name, as in {\"preset\": \"" + word + "\"}";
  return help;
}

std::string listed(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text.append(text.empty() ? "" : ", ").append(word);
  return text;
}

}  // namespace

std::string_view geojson_type(const Json& value) {
  static constexpr std::string_view types[] = {
      "Point",        "MultiPoint",         "LineString", "MultiLineString",  "Polygon",
      "MultiPolygon", "GeometryCollection", "Feature",    "FeatureCollection"};
  if (!value.is_object()) return {};
  const auto type = value.find("type");
  if (type == value.end() || !type->is_string()) return {};
  const bool has_content = value.contains("coordinates") || value.contains("geometries") ||
                           value.contains("geometry") || value.contains("features");
  const auto found_type = std::ranges::find(types, type->get_ref<const std::string&>());
  return has_content && found_type != std::end(types) ? *found_type : std::string_view();
}

JsonKind Location::kind() const {
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

std::string Location::pointer() const {
  if (!parent_) return std::string(token_);
  if (index_ != npos) return parent_->pointer() + "/" + std::to_string(index_);
  return parent_->pointer() + pointer_token(token_);
}

std::optional<Location> Location::member(std::string_view key) const {
  const auto found_member = value_->find(key);
  if (found_member == value_->end()) return std::nullopt;
  return child(*found_member, key);
}

void Location::expected(std::string_view what, IssueKind kind) const {
  if (issues_->full()) return issues_->count();
  std::string message = "found " + found(*value_) + ", expected " + std::string(what);
  if (!geojson_type(*value_).empty())
    message += "; the \"coordinates\" of its geometry are such a value, in metres here";
  report(kind, std::move(message));
}

void Location::report(IssueKind kind, std::string message) const {
  if (issues_->full()) return issues_->count();
  issues_->add({kind, pointer(), std::move(message)});
}

void read_flag(const Location& location, bool& out) {
  if (location.kind() == JsonKind::flag) {
    out = location.value().get<bool>();
  } else {
    location.expected("true or false");
  }
}

void read_number(const Location& location, const NumberRule& rule, double& out) {
  if (location.kind() != JsonKind::number) return location.expected(words_for(rule));
  const auto number = location.value().get<double>();
  if (number >= rule.minimum && number <= rule.maximum && number > rule.above) {
    out = number;
  } else {
    location.expected(words_for(rule), IssueKind::out_of_range);
  }
}

void read_integer(const Location& location, const IntegerRule& rule, std::int64_t& out) {
  if (location.kind() != JsonKind::number) return location.expected(words_for(rule));
  const auto number = whole_number(location.value());
  if (number && *number >= rule.minimum && *number <= rule.maximum) {
    out = *number;
  } else {
    location.expected(words_for(rule), number ? IssueKind::out_of_range : IssueKind::wrong_type);
  }
}

void read_integer(const Location& location, const IntegerRule& rule, std::int32_t& out) {
  std::int64_t wide = out;
  read_integer(location, rule, wide);
  out =
      static_cast<std::int32_t>(wide);  // the generated code uses 32 bits only if the range of the rule fits
}

void read_text(const Location& location, const TextRule& rule, std::string& out) {
  if (location.kind() != JsonKind::text) return location.expected(rule.form ? rule.form->expected : "a text");
  const auto& text = location.value().get_ref<const std::string&>();
  if (rule.form && !rule.form->accepts(text)) {
    const std::string preset = rule.form == &forms::preset_name ? hint(text, preset_names()) : "";
    return location.expected(std::string(rule.form->expected) + preset, IssueKind::invalid_value);
  }
  const std::size_t length = count_characters(text);
  if (length < rule.least || length > rule.most)
    return check_count(location, length, rule.least, rule.most, characters);
  out = text;
}

void read_color(const Location& location, Color& out) {
  const auto* const text = location.value().get_ptr<const std::string*>();
  if (const auto color = text ? color_of(*text) : std::nullopt) {
    out = *color;
  } else {
    location.expected(forms::color.expected, text ? IssueKind::invalid_value : IssueKind::wrong_type);
  }
}

/// Whether a text is a whole number. The parser makes such texts of numbers that a double would round.
static bool is_whole(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

void read_seed(const Location& location, std::uint64_t& out) {
  constexpr std::string_view what =
      "an integer from 0 to 18446744073709551615, or its decimal digits as a text";
  const Json& value = location.value();
  if (value.is_number_unsigned()) {
    out = value.get<std::uint64_t>();
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    if (std::floor(number) != number || number < 0 || number >= 0x1p64)
      return location.expected(what, IssueKind::out_of_range);
    out = static_cast<std::uint64_t>(number);
  } else if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (!forms::digits.accepts(text) || error != std::errc{} || end != text.data() + text.size()) {
      if (!is_whole(text)) return location.expected(what, IssueKind::invalid_value);
      return location.report(IssueKind::out_of_range,
                             "found " + shortened(text, 40) + ", expected " + std::string(what));
    }
    out = number;
  } else if (value.is_number_integer() && value.get<std::int64_t>() >= 0) {
    out = static_cast<std::uint64_t>(value.get<std::int64_t>());
  } else {
    location.expected(what, value.is_number() ? IssueKind::out_of_range : IssueKind::wrong_type);
  }
}

void read_free_object(const Location& location) {
  if (location.kind() != JsonKind::object) location.expected("an object");
}

std::optional<std::size_t> read_word(const Location& location, std::span<const std::string_view> words,
                                     std::string_view beside) {
  const std::string other = beside.empty() ? "" : std::string(beside) + " or ";
  const std::string what = other + (words.size() == 1 ? "" : "one of ") + listed(words);
  if (location.kind() != JsonKind::text) {
    location.expected(what);
    return std::nullopt;
  }
  const auto& text = location.value().get_ref<const std::string&>();
  const auto word = std::ranges::find(words, std::string_view(text));
  if (word == words.end()) {
    location.expected(what + hint_or_preset(text, words), IssueKind::invalid_value);
    return std::nullopt;
  }
  return static_cast<std::size_t>(word - words.begin());
}

bool check_members(const Location& location, std::span<const std::string_view> known,
                   std::initializer_list<std::string_view> required) {
  if (location.kind() != JsonKind::object) {
    location.expected("an object");
    return false;
  }
  const bool has_type = std::ranges::find(known, std::string_view("type")) != known.end();
  if (const std::string_view type = geojson_type(location.value()); !type.empty() && !has_type) {
    location.report(IssueKind::wrong_type, "found GeoJSON (" + std::string(type) +
                                               "), expected an object with members of " + listed(known));
    return false;
  }
  for (const std::string_view name : required) {
    if (location.value().contains(name)) continue;
    location.issue_list().add_missing(location.pointer(), name, "\"" + std::string(name) + "\" is missing");
  }
  bool is_listed = false;  // the known names are listed once for all unknown members
  for (const auto& [key, value] : location.value().get_ref<const Json::object_t&>()) {
    if (std::ranges::find(known, std::string_view(key)) != known.end()) continue;
    if (location.issue_list().full()) {
      location.issue_list().count();
      continue;
    }
    std::string help = hint(key, known);
    if (help.empty() && !std::exchange(is_listed, true)) help = "; known are " + listed(known);
    location.child(value, key)
        .report(IssueKind::unknown_key, "\"" + shortened(key, quoted) + "\" is not known here" + help);
  }
  return true;
}

bool check_list(const Location& location, const CountRule& rule) {
  if (location.kind() != JsonKind::list) {
    location.expected("a list");
    return false;
  }
  check_count(location, location.value().size(), rule.least, rule.most, entries);
  return true;
}

bool check_nesting(const Location& location, std::string_view entry, std::string_view inner) {
  const Json& list = location.value();
  if (!list.is_array() || list.empty() || !list[0].is_array() || list[0].empty() || list[0][0].is_array())
    return true;
  location.report(IssueKind::wrong_type,
                  "found lists of numbers, expected one list more around them: each entry is a " +
                      std::string(entry) + ", and each entry of that a " + std::string(inner) +
                      ", as in [[[0, 0], …]]");
  return false;
}

bool check_map(const Location& location, const CountRule& rule) {
  if (location.kind() != JsonKind::object) {
    location.expected("an object");
    return false;
  }
  check_count(location, location.value().size(), rule.least, rule.most, members);
  return true;
}

void check_key(const Location& entry, std::string_view key, const CountRule& rule) {
  if (!rule.names || rule.names->accepts(key)) return;
  entry.report(IssueKind::invalid_value, "\"" + shortened(key, quoted) + "\" is not a valid name; expected " +
                                             std::string(rule.names->expected));
}

}  // namespace seedmesh::schema

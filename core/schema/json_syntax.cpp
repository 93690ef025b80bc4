#include "core/schema/json_syntax.h"

#include <array>
#include <cstdio>
#include <optional>

#include "core/schema/json.h"

namespace seedmesh {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr std::size_t longest_shown = 40;

bool is_of_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.' ||
         c == '+' || c == '-';
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

/// The offset behind the text in quotes that begins at `from`; the size of the text if it does not end.
std::size_t end_of_quotes(std::string_view text, std::size_t from) {
  for (std::size_t i = from + 1; i < text.size(); ++i) {
    if (text[i] == '"') return i + 1;
    if (text[i] == '\\') ++i;
  }
  return text.size();
}

/// The text in quotes around a byte.
struct Quotes {
  std::size_t from = 0;
  std::optional<std::size_t> escape;  ///< the backslash of the escape that contains the byte
};
std::optional<Quotes> quotes_around(std::string_view text, std::size_t at) {
  for (std::size_t i = 0; i < at; ++i) {
    if (text[i] != '"') continue;
    const std::size_t end = end_of_quotes(text, i);
    const bool is_closed = end > i + 1 && end <= at && text[end - 1] == '"';
    if (is_closed) {
      i = end - 1;
      continue;
    }
    Quotes found{i, {}};
    for (std::size_t k = i + 1; k < at; ++k) {
      if (text[k] != '\\') continue;
      const std::size_t length = k + 1 < text.size() && text[k + 1] == 'u' ? 6 : 2;
      if (at < k + length) found.escape = k;
      k += length - 1;
    }
    return found;
  }
  return std::nullopt;
}

/// A character as a message shows it: itself in quotes, or its number if it is not visible.
std::string shown_character(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  std::size_t end = at + 1;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
  const std::string_view character = text.substr(at, end - at);
  std::array<char, 32> out{};
  if (byte < 0x20 || byte == 0x7F) {
    std::snprintf(out.data(), out.size(), "the control character U+%04X", unsigned{byte});
  } else if (character == "\u00A0") {
    return "a no-break space (U+00A0)";
  } else if (character == "\uFEFF") {
    return "a byte order mark (U+FEFF)";
  } else {
    return "\"" + std::string(character) + "\"";
  }
  return out.data();
}

bool is_quote_of_typography(std::string_view text) {
  for (const std::string_view each : {"“", "”", "„", "‟", "‘", "’", "«", "»", "`", "'"}) {
    if (text.starts_with(each)) return true;
  }
  return false;
}

JsonFault fault_in_quotes(std::string_view text, std::size_t stop, const Quotes& quotes) {
  if (stop == text.size())
    return {quotes.from, "found a text in quotes without its end, expected a closing \""};
  if (quotes.escape) {
    const bool is_visible = text[stop] > ' ' && text[stop] < '\x7F';
    const std::string escape(text.substr(*quotes.escape, stop + (is_visible ? 1 : 0) - *quotes.escape));
    return {*quotes.escape, "found the escape " + escape + ", expected " +
                                (escape.starts_with("\\u") ? R"(\u and four hexadecimal digits)"
                                                           : R"(\", \\, \/, \b, \f, \n, \r, \t or \u)")};
  }
  const char c = text[stop];
  if (c == '\n' || c == '\r') return {stop, "found a line break in a text, expected \\n or a closing \""};
  if (c == '\t') return {stop, "found a tab in a text, expected \\t"};
  std::array<char, 8> escape{};
  std::snprintf(escape.data(), escape.size(), "\\u%04x", unsigned{static_cast<unsigned char>(c)});
  return {stop, "found " + shown_character(text, stop) + " in a text, expected the escape " + escape.data()};
}

/// Whether a word is a value of JSON.
bool is_value(std::string_view word) {
  if (word == "true" || word == "false" || word == "null") return true;
  std::size_t i = word.starts_with('-') ? 1 : 0;
  const auto digits = [&] {
    const std::size_t from = i;
    while (i < word.size() && word[i] >= '0' && word[i] <= '9') ++i;
    return i - from;
  };
  const bool has_zero = i < word.size() && word[i] == '0';
  const std::size_t whole = digits();
  if (whole == 0 || (has_zero && whole > 1)) return false;
  if (i < word.size() && word[i] == '.') {
    ++i;
    if (digits() == 0) return false;
  }
  if (i < word.size() && (word[i] == 'e' || word[i] == 'E')) {
    ++i;
    if (i < word.size() && (word[i] == '+' || word[i] == '-')) ++i;
    if (digits() == 0) return false;
  }
  return i == word.size();
}

/// What was expected instead of a word that is no value of JSON.
std::string instead_of_word(std::string_view word, bool is_name) {
  const std::string small = lower(word);
  const std::string_view bare = std::string_view(small).substr(small.find_first_not_of("+-") == 1 ? 1 : 0);
  if (is_name) return "a name in double quotes";
  if (bare == "nan" || bare == "inf" || bare == "infinity")
    return "a finite number; JSON has no infinity and no NaN";
  if (small == "true" || small == "false" || small == "null") return small;
  if (small == "none" || small == "undefined" || small == "nil") return "null";
  if (word.find_first_of("0123456789") <= 1 &&
      word.find_first_not_of("+-.0123456789xXabcdefABCDEF_") == std::string_view::npos)
    return "a number such as 12, -0.5 or 3e-4";
  return "a value; texts are in double quotes";
}

std::string expected_sign(std::string_view before, JsonState state) {
  const char last = before.empty() ? '\0' : before.back();
  if (state.is_complete) return "the end of the text";
  if (state.has_key) return last == ':' ? "a value" : "`:` and a value";
  if (last == '{') return "a name in double quotes, or `}`";
  if (last == '[') return "a value, or `]`";
  if (last == ',') return state.in_object ? "a name in double quotes" : "a value";
  if (before.empty()) return "a JSON value";
  return state.in_object ? "`,` or `}`" : "`,` or `]`";
}

/// The text before a byte, without blanks at its end.
std::string_view text_before(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  return before.substr(0, before.find_last_not_of(blanks) + 1);
}

/// The error of a word that is no value of JSON.
JsonFault fault_of_word(std::string_view text, std::size_t from, std::string_view word, JsonState state) {
  const std::string_view before = text_before(text, from);
  const bool is_behind_comma = before.ends_with(',');
  const bool is_value_place = before.empty() || before.ends_with(':') ||
                              (!state.in_object && (is_behind_comma || before.ends_with('[')));
  const bool is_name_place = state.in_object && (is_behind_comma || before.ends_with('{'));
  return {from, "found " + shortened(word, longest_shown) + ", expected " +
                    (is_value_place || is_name_place ? instead_of_word(word, is_name_place)
                                                     : expected_sign(before, state))};
}

/// The error of a token that is valid, but not at its place, or of a character that begins no token.
JsonFault fault_of_token(std::string_view text, std::size_t from, const std::string& shown, JsonState state) {
  const std::string_view before = text_before(text, from);
  if (from == text.size())
    return {from, "found the end of the text, expected " + expected_sign(before, state)};
  const char c = text[from];
  if (before.ends_with(',') && (c == '}' || c == ']')) {
    return {before.size() - 1, std::string("found a comma before `") + c +
                                   "`, expected none behind the last " + (c == '}' ? "member" : "value")};
  }
  std::string expected = expected_sign(before, state);
  if (c == '#' || text.substr(from, 2) == "//" || text.substr(from, 2) == "/*")
    expected += "; JSON has no comments";
  if (is_quote_of_typography(text.substr(from))) expected += "; only \" encloses names and texts";
  return {from, "found " + shown + ", expected " + expected};
}

}  // namespace

JsonFault json_fault(std::string_view text, std::size_t stop, JsonState state) {
  if (const std::optional<Quotes> quotes = quotes_around(text, stop)) {
    const bool is_whole = stop < text.size() && text[stop] == '"' && !quotes->escape;
    if (!is_whole) return fault_in_quotes(text, stop, *quotes);
    const std::string_view token = text.substr(quotes->from, stop + 1 - quotes->from);
    return fault_of_token(text, quotes->from, "the text " + shortened(token, longest_shown), state);
  }
  std::size_t from = stop;
  while (from > 0 && is_of_word(text[from - 1])) --from;
  std::size_t end = from;
  while (end < text.size() && is_of_word(text[end])) ++end;
  const std::string_view word = text.substr(from, end - from);
  if (!word.empty() && !is_value(word)) return fault_of_word(text, from, word, state);
  const bool is_word = stop < text.size() && is_of_word(text[stop]);
  if (is_word) return fault_of_token(text, from, shortened(word, longest_shown), state);
  return fault_of_token(text, stop, stop < text.size() ? shown_character(text, stop) : "", state);
}

std::size_t offset_of_member(std::string_view text, std::size_t index) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '"') continue;
    const std::size_t end = end_of_quotes(text, i);
    const std::size_t next = text.find_first_not_of(blanks, end);
    if (next < text.size() && text[next] == ':' && index-- == 0) return i;
    i = end - 1;
  }
  return text.size();
}

std::size_t offset_of_depth(std::string_view text, std::size_t depth) {
  std::size_t open = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      i = end_of_quotes(text, i) - 1;
    } else if (text[i] == '{' || text[i] == '[') {
      if (++open > depth) return i;
    } else if (text[i] == '}' || text[i] == ']') {
      --open;
    }
  }
  return text.size();
}

std::string_view foreign_encoding(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 15> beginnings = {{
      {"\xFF\xFE\0\0"sv, "UTF-32"},
      {"\0\0\xFE\xFF"sv, "UTF-32"},
      {"\xFF\xFE"sv, "UTF-16"},
      {"\xFE\xFF"sv, "UTF-16"},
      {"\x1F\x8B"sv, "gzip"},
      {"\x28\xB5\x2F\xFD"sv, "Zstandard"},
      {"PK\x03\x04"sv, "ZIP"},
      {"glTF\x02"sv, "GLB"},
      {"\x89PNG"sv, "PNG"},
      {"\xFF\xD8\xFF"sv, "JPEG"},
      {"II*\0"sv, "TIFF"},
      {"MM\0*"sv, "TIFF"},
      {"SQLite format 3\0"sv, "SQLite"},
      {"\0\0\x27\x0A"sv, "shapefile"},
      {"\0\0\0\x0D\x0A\x09OSMHeader"sv, "OpenStreetMap PBF"},
  }};
  for (const auto& [beginning, name] : beginnings) {
    if (bytes.starts_with(beginning)) return name;
  }
  if (bytes.size() < 4) return {};
  const bool zeros[] = {bytes[0] == '\0', bytes[1] == '\0', bytes[2] == '\0', bytes[3] == '\0'};
  if (zeros[0] + zeros[1] + zeros[2] + zeros[3] == 3) return "UTF-32";
  return zeros[0] != zeros[1] && zeros[0] == zeros[2] && zeros[1] == zeros[3] ? "UTF-16"sv : ""sv;
}

}  // namespace seedmesh

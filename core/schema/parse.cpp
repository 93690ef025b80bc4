#include "core/schema/parse_body.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>

#include "core/base/job.h"
#include "core/schema/json_syntax.h"

namespace seedmesh {
namespace {

constexpr int number_out_of_range = 406;  ///< nlohmann's id of "number overflow"
constexpr std::size_t most_too_large = 100;
constexpr std::size_t escape_size = 6;  ///< a backslash, u and four digits

/// A number beyond the range of a double that was replaced by null: the index among all nulls, and its text.
struct TooLarge {
  std::size_t null = 0;
  std::string written;
};

/// The digits of a whole number in any form of JSON: 15e2 is 1500. Empty if it is a fraction or has more than 40 digits.
std::string digits_of(std::string_view written) {
  constexpr int most_digits = 40;
  const std::size_t mark = std::min(written.find_first_of("eE"), written.size());
  const std::string_view mantissa = written.substr(0, mark);
  std::string_view power = written.substr(std::min(mark + 1, written.size()));
  if (power.starts_with('+')) power.remove_prefix(1);
  int zeros = 0;
  if (!power.empty() && std::from_chars(power.data(), power.data() + power.size(), zeros).ec != std::errc{})
    return "";
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  std::string digits(mantissa.substr(0, point));
  const std::string_view decimals = mantissa.substr(std::min(point + 1, mantissa.size()));
  zeros = std::clamp(zeros, -most_digits, most_digits) - static_cast<int>(decimals.size());
  digits += decimals;
  if (zeros > 0) digits.append(static_cast<std::size_t>(zeros), '0');
  for (; zeros < 0 && digits.ends_with('0'); ++zeros) digits.pop_back();
  const std::size_t first = digits.find_first_not_of("-0");
  if (zeros < 0 || first == std::string::npos || digits.size() - first > most_digits) return "";
  return (digits.starts_with('-') ? "-" : "") + digits.substr(first);
}

std::string too_large_text(std::string_view number) {
  return "found " + shortened(number, 40) + ", which is too large for a number";
}

/// Builds the value from the events of the parser. Each event returns whether to go on; the first error stops the
/// parser and is kept in `error`.
class Builder {
 public:
  Builder(std::string_view text, const JsonLimits& limits) : text_(text), limits_(limits) {}

  std::optional<Error> error;
  bool is_too_large = false;  ///< the error is a number beyond a double
  Json root;

  /// The nulls that replace numbers, in the order of the text. Their errors go to `issues`.
  void expect(std::span<const TooLarge> numbers, std::vector<Issue>& issues) {
    numbers_ = numbers;
    issues_ = &issues;
  }

  bool null() {
    if (!numbers_.empty() && numbers_.front().null == nulls_) {
      issues_->push_back({IssueKind::out_of_range, pointer(), too_large_text(numbers_.front().written)});
      numbers_ = numbers_.subspan(1);
    }
    ++nulls_;
    return add(nullptr);
  }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string& written) {
    // A whole seed that a double would round becomes a text of all its digits.
    if (key_ == "seed" && std::abs(value) >= 0x1p53) {
      if (std::string digits = digits_of(written); !digits.empty()) return add(std::move(digits));
    }
    return add(value == 0 ? 0.0 : value);
  }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }

  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    if (open_.back()->contains(name)) {
      key_ = name;
      return refuse(Code::malformed,
                    issue_at(IssueKind::duplicate_key, pointer(), text_, offset_of_member(text_, keys_read_),
                             "\"" + shortened(name, 40) + "\" is given twice"));
    }
    ++keys_read_;
    has_key_ = true;
    key_ = std::move(name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const Json::exception& failure) {
    if (failure.id == number_out_of_range) {
      is_too_large = true;
      return refuse(Code::invalid, {IssueKind::out_of_range, pointer(), too_large_text(token)});
    }
    // `position` counts the characters read, the offending one included.
    const std::size_t offset = std::min(position == 0 ? 0 : position - 1, text_.size());
    if (const std::optional<std::size_t> half = lone_surrogate(offset)) {
      return refuse(Code::malformed,
                    issue_at(IssueKind::syntax, "", text_, *half,
                             "this is not JSON: found \"" + std::string(text_.substr(*half, escape_size)) +
                                 "\", half of a surrogate pair; expected an escape from \\ud800 to \\udbff "
                                 "and directly after it one from \\udc00 to \\udfff"));
    }
    JsonFault fault = json_fault(text_, offset,
                                 {.in_object = !open_.empty() && open_.back()->is_object(),
                                  .has_key = has_key_,
                                  .is_complete = open_.empty() && values_ > 0});
    return refuse(Code::malformed, issue_at(IssueKind::syntax, "", text_, fault.offset,
                                            "this is not JSON: " + std::move(fault.message)));
  }

 private:
  bool add(Json value) { return put(std::move(value)) != nullptr; }

  bool open(Json container) {
    if (open_.size() == limits_.depth) {
      Issue issue = limit_issue({Resource::depth, limits_.depth, limits_.depth + 1},
                                "nested deeper than " + std::to_string(limits_.depth) + " levels");
      const TextPosition place = text_position(text_, offset_of_depth(text_, limits_.depth));
      issue.line = place.line;
      issue.column = place.column;
      return refuse(Code::malformed, std::move(issue));
    }
    Json* const place = put(std::move(container));
    if (place) {
      open_.push_back(place);
      keys_.push_back(std::move(key_));
    }
    return place != nullptr;
  }

  bool close() {
    key_ = std::move(keys_.back());
    keys_.pop_back();
    open_.pop_back();
    return true;
  }

  /// Inserts a value. Its address is valid until the list around it gets the next entry.
  Json* put(Json value) {
    constexpr std::size_t values_a_check = 4096;
    if (limits_.job && values_ % values_a_check == 0) limits_.job->check();
    has_key_ = false;
    if (++values_ > limits_.values) {
      refuse(Code::limit, limit_issue({Resource::json_values, limits_.values, values_},
                                      "more than " + std::to_string(limits_.values) + " JSON values"));
      return nullptr;
    }
    if (open_.empty()) return &(root = std::move(value));
    Json& parent = *open_.back();
    if (parent.is_object()) return &(parent[key_] = std::move(value));
    parent.push_back(std::move(value));
    return &parent.back();
  }

  /// The pointer of the value that comes next.
  std::string pointer() const {
    std::string text;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const bool last = i + 1 == open_.size();
      if (open_[i]->is_object()) {
        text += pointer_token(last ? key_ : keys_[i + 1]);
      } else {
        text += "/" + std::to_string(open_[i]->size() - (last ? 0 : 1));
      }
    }
    return text;
  }

  bool refuse(Code code, Issue issue) {
    error = Error{code, {std::move(issue)}};
    return false;
  }

  /// The first half of a surrogate pair without its other half, if it begins at `end` or before. Where there is one, the
  /// library has stopped because of it.
  std::optional<std::size_t> lone_surrogate(std::size_t end) const {
    bool is_inside = false;  // a string
    for (std::size_t i = 0; i <= end && i < text_.size(); ++i) {
      if (text_[i] == '"') is_inside = !is_inside;
      if (text_[i] != '\\' || !is_inside) continue;
      if (is_half(i, second_halves)) return i;
      if (is_half(i, first_halves)) {
        if (!is_half(i + escape_size, second_halves)) return i;
        i += escape_size;
      }
      ++i;  // the character after the backslash
    }
    return std::nullopt;
  }

  static constexpr std::string_view first_halves = "89abAB", second_halves = "cdefCDEF";

  /// Whether an escape from \ud800 to \udfff begins at `at`, whose second digit is one of these.
  bool is_half(std::size_t at, std::string_view second_digits) const {
    if (at + escape_size > text_.size()) return false;
    const std::string_view escape = text_.substr(at, escape_size);
    return escape[0] == '\\' && escape[1] == 'u' && (escape[2] == 'd' || escape[2] == 'D') &&
           second_digits.find(escape[3]) != std::string_view::npos &&
           escape.find_first_not_of("0123456789abcdefABCDEF", 4) == std::string_view::npos;
  }

  std::string_view text_;
  JsonLimits limits_;
  std::vector<Json*> open_;        ///< the open lists and objects, outermost first
  std::vector<std::string> keys_;  ///< for each open container its key in its parent, if that is an object
  std::string key_;                ///< key of the value that comes next
  bool has_key_ = false;           ///< the value of key_ was not read yet
  std::size_t keys_read_ = 0;
  std::size_t values_ = 0;
  std::size_t nulls_ = 0;
  std::span<const TooLarge> numbers_;
  std::vector<Issue>* issues_ = nullptr;
};

bool is_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
}

bool is_beyond_double(const std::string& number) {
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  return error == std::errc::result_out_of_range && std::isinf(std::strtod(number.c_str(), nullptr));
}

/// Replaces numbers beyond the range of a double by null. The text is valid JSON up to the first of them.
std::vector<TooLarge> blank_too_large(std::string& text) {
  constexpr std::string_view null = "null";
  std::vector<TooLarge> found;
  std::size_t nulls = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\' ? 1 : 0;
    } else if (text[i] == 'n') {
      ++nulls;
      i += null.size() - 1;
    } else if (text[i] == '-' || (text[i] >= '0' && text[i] <= '9')) {
      std::size_t end = i;
      while (end < text.size() && is_of_number(text[end])) ++end;
      std::string number = text.substr(i, end - i);
      if (number.size() > null.size() && found.size() < most_too_large && is_beyond_double(number)) {
        text.replace(i, number.size(), std::string(null) + std::string(number.size() - null.size(), ' '));
        found.push_back({nulls++, std::move(number)});
      }
      i = end - 1;
    }
  }
  return found;
}

Result<Json> parse_with(Builder& builder, std::string_view text) {
  constexpr std::string_view blank = " \t\r\n";
  if (text.find_first_not_of(blank) == std::string_view::npos) {
    return Error{Code::malformed, {{IssueKind::syntax, "", "the body is empty, expected a JSON object"}}};
  }
  if (const std::string_view found = foreign_encoding(text); !found.empty()) {
    return Error{Code::malformed,
                 {issue_at(IssueKind::syntax, "", text, 0,
                           "found " + std::string(found) + ", expected JSON in UTF-8")}};
  }
  if (const std::size_t bad = find_bad_utf8(text); bad != std::string_view::npos) {
    return Error{Code::malformed,
                 {issue_at(IssueKind::syntax, "", text, bad,
                           "found a byte that is not UTF-8, expected JSON in UTF-8")}};
  }
  if (!Json::sax_parse(text.begin(), text.end(), &builder)) return *std::move(builder.error);
  return std::move(builder.root);
}

}  // namespace

Result<Json> parse_json(std::string_view text, const JsonLimits& limits) {
  Builder builder(text, limits);
  return parse_with(builder, text);
}

Result<Json> parse_body(std::string_view text, std::vector<Issue>& too_large, const JsonLimits& limits) {
  Builder strict(text, limits);
  Result<Json> read = parse_with(strict, text);
  if (!strict.is_too_large) return read;
  std::string blanked(text);
  const std::vector<TooLarge> numbers = blank_too_large(blanked);
  Builder builder(blanked, limits);
  builder.expect(numbers, too_large);
  return parse_with(builder, blanked);
}

}  // namespace seedmesh

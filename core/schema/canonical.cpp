#include <cassert>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/schema/json.h"

namespace seedmesh {
namespace {

void append_string(std::string& out, std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\b':
        out += "\\b";
        break;
      case '\f':
        out += "\\f";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\r':
        out += "\\r";
        break;
      case '\t':
        out += "\\t";
        break;
      default:
        if (byte < 0x20) {
          out.append("\\u00").append({digits[byte / 16U], digits[byte % 16U]});
        } else {
          out += c;
        }
    }
  }
  out += '"';
}

/// Writes values to one text.
class CanonicalWriter {
 public:
  explicit CanonicalWriter(const std::function<void()>& check) : check_(check) {}

  std::string write(const Json& value) {
    append(value);
    return std::move(out_);
  }

 private:
  void append(const Json& value) {
    constexpr std::uint64_t values_between_checks = 4096;
    if (++values_ % values_between_checks == 0 && check_) check_();
    switch (value.type()) {
      case Json::value_t::boolean:
        out_ += value.get<bool>() ? "true" : "false";
        break;
      case Json::value_t::number_integer:
        out_ += std::to_string(value.get<std::int64_t>());
        break;
      case Json::value_t::number_unsigned:
        out_ += std::to_string(value.get<std::uint64_t>());
        break;
      case Json::value_t::number_float: {
        const auto number = value.get<double>();
        out_ += std::isfinite(number) ? number_text(number) : "null";  // JSON cannot express it
        break;
      }
      case Json::value_t::string:
        append_string(out_, value.get_ref<const std::string&>());
        break;
      case Json::value_t::array:
        append_list(value);
        break;
      case Json::value_t::object:
        append_object(value.get_ref<const Json::object_t&>());
        break;
      default:
        out_ += "null";
    }
  }

  void append_list(const Json& list) {
    out_ += '[';
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i > 0) out_ += ',';
      append(list[i]);
    }
    out_ += ']';
  }

  void append_object(const Json::object_t& object) {
    out_ += '{';
    bool first = true;
    for (const auto& [key, member] : object) {
      if (!std::exchange(first, false)) out_ += ',';
      append_string(out_, key);
      out_ += ':';
      append(member);
    }
    out_ += '}';
  }

  const std::function<void()>& check_;
  std::string out_;
  std::uint64_t values_ = 0;
};

}  // namespace

std::string number_text(double number) {
  assert(std::isfinite(number));
  if (number == 0) return "0";
  // to_chars gives d.ddde±dd with the fewest digits that read back; only the layout differs from
  // ECMAScript's.
  char buffer[32];
  const auto written =
      std::to_chars(buffer, buffer + sizeof buffer, std::abs(number), std::chars_format::scientific);
  const std::string_view text(buffer, static_cast<std::size_t>(written.ptr - buffer));
  const std::size_t mark = text.find('e');
  std::string digits(text.substr(0, 1));
  if (mark > 1) digits += text.substr(2, mark - 2);
  int exponent = 0;
  const char* const first = buffer + mark + (text[mark + 1] == '+' ? 2 : 1);
  std::from_chars(first, written.ptr, exponent);

  const auto count = static_cast<int>(digits.size());
  const int point = exponent + 1;  // digits before the decimal point; ECMA-262 calls it n
  std::string out(number < 0 ? 1 : 0, '-');
  if (point > 21 || point < -5) {
    out += digits[0];
    if (count > 1) out.append(1, '.').append(digits, 1);
    return out.append(exponent < 0 ? "e-" : "e+").append(std::to_string(std::abs(exponent)));
  }
  const auto zeros = [](int how_many) { return std::string(static_cast<std::size_t>(how_many), '0'); };
  if (point <= 0) return out.append("0.").append(zeros(-point)).append(digits);
  if (point >= count) return out.append(digits).append(zeros(point - count));
  const auto whole = static_cast<std::size_t>(point);
  return out.append(digits, 0, whole).append(1, '.').append(digits, whole);
}

std::string canonical_text(const Json& value, const std::function<void()>& check) {
  return CanonicalWriter(check).write(value);
}

void merge_patch(Json& target, const Json& patch) {
  if (!patch.is_object()) {
    target = patch;
    return;
  }
  if (!target.is_object()) target = Json::object();
  for (const auto& [key, value] : patch.get_ref<const Json::object_t&>()) {
    if (value.is_null()) {
      target.erase(key);
    } else {
      merge_patch(target[key], value);
    }
  }
}

}  // namespace seedmesh

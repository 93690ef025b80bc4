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

void append(std::string& out, const Json& value) {
  switch (value.type()) {
    case Json::value_t::boolean:
      out += value.get<bool>() ? "true" : "false";
      break;
    case Json::value_t::number_integer:
      out += std::to_string(value.get<std::int64_t>());
      break;
    case Json::value_t::number_unsigned:
      out += std::to_string(value.get<std::uint64_t>());
      break;
    case Json::value_t::number_float: {
      const auto number = value.get<double>();
      out += std::isfinite(number) ? number_text(number) : "null";  // JSON cannot express it
      break;
    }
    case Json::value_t::string:
      append_string(out, value.get_ref<const std::string&>());
      break;
    case Json::value_t::array: {
      out += '[';
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (i > 0) out += ',';
        append(out, value[i]);
      }
      out += ']';
      break;
    }
    case Json::value_t::object: {
      out += '{';
      bool first = true;
      for (const auto& [key, member] : value.get_ref<const Json::object_t&>()) {
        if (!std::exchange(first, false)) out += ',';
        append_string(out, key);
        out += ':';
        append(out, member);
      }
      out += '}';
      break;
    }
    default:
      out += "null";
  }
}

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

std::string canonical_text(const Json& value) {
  std::string out;
  append(out, value);
  return out;
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

#include "core/gltf/json_writer.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace seedmesh::gltf {
namespace {

constexpr std::size_t longest_number = 32;  // the longest float takes 15 characters, the longest integer 20

bool plain(char c) { return c >= ' ' && c != '"' && c != '\\' && c < '\x7F'; }

}  // namespace

void append_number(std::string& out, float value) {
  assert(std::isfinite(value));
  char text[longest_number];
  const auto end = std::to_chars(text, text + sizeof text, value + 0.0F);  // + 0 turns -0 into 0
  out.append(text, end.ptr);
}

void append_number(std::string& out, double value) {
  assert(std::isfinite(value));
  char text[longest_number];
  const auto end = std::to_chars(text, text + sizeof text, value + 0.0);
  out.append(text, end.ptr);
}

void append_decimal(std::string& out, float value) {
  assert(std::isfinite(value));
  char text[longest_number];
  const auto end = std::to_chars(text, text + sizeof text, value + 0.0F);
  const std::string_view number(text, static_cast<std::size_t>(end.ptr - text));
  if (number.find('e') != std::string_view::npos) {
    out += nlohmann::json(shortest(value)).dump();
    return;
  }
  out += number;
  if (number.find('.') == std::string_view::npos) out += ".0";
}

void append_integer(std::string& out, long long value) {
  char text[longest_number];
  const auto end = std::to_chars(text, text + sizeof text, value);
  out.append(text, end.ptr);
}

void append_string(std::string& out, std::string_view text) {
  if (std::all_of(text.begin(), text.end(), plain)) {
    out += '"';
    out += text;
    out += '"';
  } else {
    out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
}

void TextMeter::finish() {
  job_.spend(Resource::output_bytes, text_.size() - counted_);
  counted_ = text_.size();
}

double shortest(float value) {
  assert(std::isfinite(value));
  char text[longest_number];
  const auto end = std::to_chars(text, text + sizeof text, value + 0.0F);
  double result = 0;
  std::from_chars(text, end.ptr, result);
  return result;
}

}  // namespace seedmesh::gltf

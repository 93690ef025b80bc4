#include "core/generators/building/value_functions.h"

#include <algorithm>
#include <array>

namespace seedmesh::building {
namespace {

constexpr std::size_t longest_text = 100'000, longest_array = 100'000;

std::array<std::span<const ValueFunctionRow>, 6> tables() {
  return {text_functions(),  array_functions(), geometry_functions(),
          state_functions(), color_functions(), material_functions()};
}

}  // namespace

std::uint32_t find_value_function(std::string_view name) {
  std::uint32_t base = 0;
  for (const auto& table : tables()) {
    const auto found = std::ranges::find(table, name, &ValueFunctionRow::name);
    if (found != table.end()) return base + static_cast<std::uint32_t>(found - table.begin());
    base += static_cast<std::uint32_t>(table.size());
  }
  return none;
}

const ValueFunctionRow& value_function(std::uint32_t number) {
  for (const auto& table : tables()) {
    if (number < table.size()) return table[number];
    number -= static_cast<std::uint32_t>(table.size());
  }
  return text_functions().front();
}

std::uint32_t value_function_count() {
  std::size_t count = 0;
  for (const auto& table : tables()) count += table.size();
  return static_cast<std::uint32_t>(count);
}

void reject(const Evaluation& at, const std::string& message) { reject(at.d, at.offset, message); }

std::string text_in(const Evaluation& at, const lang::TaggedValue& value) {
  if (is_array(value)) {
    std::string out;
    for (const lang::TaggedValue& each : array_in(at, value).values) {
      out += (out.empty() ? "" : ",") + text_in(at, each);
      if (out.size() > longest_text) break;
    }
    return "[" + out + "]";
  }
  return value.is_text() ? *at.d.out.texts.find(value.text) : text_of_number(value.number);
}

double number_in(const Evaluation& at, const lang::TaggedValue& value) {
  if (value.is_text()) {
    reject(at, "found " + (is_array(value) ? "an array" : "the text " + lang::in_quotes(text_in(at, value))) +
                   ", expected a number");
  }
  return value.number;
}

lang::TaggedValue text_value(Evaluation& at, std::string_view text) {
  if (text.size() > longest_text) reject(at, "the text is longer than 100,000 bytes");
  Texts& texts = at.d.out.texts;
  const std::size_t before = texts.size();
  const std::uint32_t id = texts.id_of(text);
  if (texts.size() != before) at.d.job.spend(Resource::shapes, 1 + text.size() / 64);
  return {0, id};
}

ValueArray array_in(const Evaluation& at, const lang::TaggedValue& value) {
  if (is_array(value)) return at.d.out.arrays[value.text & ~array_bit];
  return {{value}, 0};
}

lang::TaggedValue array_value(Evaluation& at, ValueArray array) {
  if (array.values.size() > longest_array) reject(at, "the array has more than 100,000 values");
  const auto [found, is_new] =
      at.d.array_ids.try_emplace(array, static_cast<std::uint32_t>(at.d.out.arrays.size()));
  if (is_new) {
    at.d.job.spend(Resource::shapes, 1 + array.values.size() / 8);
    at.d.out.arrays.push_back(std::move(array));
  }
  return {0, array_bit | found->second};
}

bool fits(std::string_view text, std::string_view pattern) {
  std::size_t t = 0, p = 0, star = std::string_view::npos, mark = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      mark = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++mark;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::vector<std::string> files_that_fit(const Evaluation& at, std::string_view pattern) {
  std::vector<std::string> out;
  for (const std::string& name : at.d.task.files) {
    // Patterns name files; the request names them without directories and perhaps without an ending.
    const std::size_t slash = pattern.find_last_of('/');
    const std::string_view own = slash == std::string_view::npos ? pattern : pattern.substr(slash + 1);
    const std::size_t dot = own.find_last_of('.');
    if (fits(name, pattern) || fits(name, own) ||
        (dot != std::string_view::npos && fits(name, own.substr(0, dot))))
      out.push_back(name);
  }
  return out;
}

}  // namespace seedmesh::building

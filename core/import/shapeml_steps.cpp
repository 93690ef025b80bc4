/// Operations of ShapeML as those of CityEngine; see shapeml.cpp.
#include <algorithm>

#include "core/import/shapeml_names.h"
#include "core/import/shapeml_reader.h"

namespace seedmesh {
namespace {

constexpr int deepest = 100;  ///< nested braces

}  // namespace

using lang::Token;
using lang::TokenKind;

void ShapemlReader::operations(std::size_t from, std::size_t to, int depth) {
  ends_with_shape_ = false;
  if (depth > deepest) return error(from, "braces are nested more than 100 deep");
  for (std::size_t i = from; i < to;) {
    const Token& token = at(i);
    const std::size_t behind = is(i + 1, "(") ? std::min(partner_[i + 1] + 1, to) : i + 1;
    ends_with_shape_ = false;
    if (is(i, "[") || is(i, "]")) {
      rules_.write(" " + std::string(token.text), token.offset);
      ++i;
    } else if (is(i, ";")) {
      ++i;
    } else if (token.kind != TokenKind::name) {
      error(i, "found " + in_quotes(token) + ", expected an operation or the name of a rule" +
                   (is(i, "^") ? "; no operations have this name" : ""));
      i = behind;
    } else {
      step(i, depth);
      i = behind;
    }
  }
}

void ShapemlReader::step(std::size_t i, int depth) {
  const std::string_view name = at(i).text;
  const auto given = arguments(i);
  if (name == "repeat" && given.size() == 2) return repeat(i, given, depth);
  if (name == "extrudeWorld" && given.size() == 4) return extrude_world(i, given);
  if (name.starts_with("split")) return split(i, given, depth);
  if (name == "scale" || name == "scaleCenter") return scale(i, given);
  if (name == "set" && given.size() == 2) return set(i, given);
  const auto rows = shapeml_operations();
  const auto found = std::ranges::find(rows, name, &ShapemlOperation::name);
  if (found != rows.end()) {
    const int count = static_cast<int>(given.size());
    if (count < found->least || count > found->most) {
      return error(i, in_quotes(at(i)) + " has " + std::to_string(count) +
                          " arguments, for which there is no counterpart");
    }
    if (found->is_left_out) {
      if (warned_.insert(std::string(name)).second)
        source_.warn(at(i).offset, in_quotes(at(i)) + " has no counterpart and is left out");
      return;
    }
    return write_as(i, found->rules, given);
  }
  if (by_name_.contains(std::string(name)) || name.ends_with('_')) {
    ends_with_shape_ = true;
    const bool is_leaf = name.ends_with('_') && !by_name_.contains(std::string(name));
    if (is_leaf && attributes_.contains(shapeml_hidden)) leaves_.insert(std::string(name));
    const std::string_view end = !is_leaf ? "" : attributes_.contains(shapeml_hidden) ? "visible" : ".";
    rules_.write(" " + std::string(name) + std::string(end), at(i).offset);
    if (!given.empty() && !is_leaf) {
      rules_.write("(", at(i).offset);
      write_all(given);
      rules_.write(")", at(i).offset);
    }
    return;
  }
  error(i, in_quotes(at(i)) + " is no rule, and no operation with a counterpart");
}

void ShapemlReader::write_all(const std::vector<std::pair<std::size_t, std::size_t>>& given) {
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (k > 0) rules_.write(", ", at(given[k].first).offset);
    expression(given[k].first, given[k].second, rules_);
  }
}

void ShapemlReader::write_as(std::size_t i, std::string_view rules,
                             const std::vector<std::pair<std::size_t, std::size_t>>& given) {
  rules_.write(" ", at(i).offset);
  for (std::size_t k = 0; k < rules.size(); ++k) {
    if (rules[k] != '$') {
      rules_.write(rules.substr(k, 1), at(i).offset);
      continue;
    }
    ++k;
    if (rules[k] == '*') {
      write_all(given);
    } else if (const auto index = static_cast<std::size_t>(rules[k] - '1'); index < given.size()) {
      expression(given[index].first, given[index].second, rules_);
    }
  }
}

void ShapemlReader::scale(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given) {
  if (given.size() != 1 && given.size() != 3)
    return error(i, in_quotes(at(i)) + " takes one or three factors");
  const auto three = [&](std::string_view before, std::string_view behind) {
    for (std::size_t k = 0; k < 3; ++k) {
      rules_.write(std::string(k > 0 ? ", " : "") + "'(" + std::string(before), at(i).offset);
      const auto& argument = given[given.size() == 1 ? 0 : k];
      expression(argument.first, argument.second, rules_);
      rules_.write(std::string(behind) + ")", at(i).offset);
    }
    rules_.write(")", at(i).offset);
  };
  if (at(i).text == "scaleCenter") {
    rules_.write(" t(", at(i).offset);
    three("0.5 - 0.5 * (", ")");
  }
  rules_.write(" s(", at(i).offset);
  three("", "");
}

void ShapemlReader::set(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given) {
  if (at(given[0].first).kind != TokenKind::string)
    return error(i, "set needs the name of an attribute in quotes");
  const std::string name = "own_" + lang::string_value(at(given[0].first));
  attributes_.insert(name);
  rules_.write(" set(" + name + ", ", at(i).offset);
  expression(given[1].first, given[1].second, rules_);
  rules_.write(")", at(i).offset);
}

void ShapemlReader::whole(std::size_t from, std::size_t to, int depth) {
  operations(from, to, depth);
  // Without the name of a shape behind them, operations make nothing in ShapeML, but a leaf in CityEngine.
  if (!ends_with_shape_) rules_.write(" NIL", at(to).offset);
  ends_with_shape_ = false;
}

void ShapemlReader::repeat(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given,
                           int depth) {
  const std::string name = "Repeat" + std::to_string(++repeats_);
  const std::size_t from = at(i).offset;
  const std::string first = "floor(repetitions / 2)", second = "ceil(repetitions / 2)";
  // Each half of the repetitions is made by itself, so that the depth of rules grows with the logarithm only.
  TracedText rule;
  std::swap(rule, rules_);
  rules_.write(name + "(start, repetitions" + parameters_ + ") -->\n  case repetitions >= 2: " + name +
                   "(start, " + first + parameters_ + ") " + name + "(start + " + first + ", " + second +
                   parameters_ + ")\n  case repetitions >= 1:",
               from);
  block(given[1], depth, "start");
  rules_.write("\n  else: NIL\n", from);
  repeated_.copy(rules_, 0, rules_.size());
  std::swap(rule, rules_);
  rules_.write(" " + name + "(0, floor(", from);
  expression(given[0].first, given[0].second, rules_);
  rules_.write(")" + parameters_ + ")", from);
}

void ShapemlReader::warn_of_index(std::size_t i, const char* message) {
  if (attributes_.contains(shapeml_index) && warned_.insert(message).second)
    source_.warn(at(i).offset, message);
}

void ShapemlReader::extrude_world(std::size_t i,
                                  const std::vector<std::pair<std::size_t, std::size_t>>& given) {
  constexpr double up[] = {0, 1, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Token& token = at(given[k].first);
    const bool is_one = given[k].second == given[k].first + 1 && token.kind == TokenKind::number;
    if (!is_one || token.number != up[k])
      return error(i, "extrudeWorld has a counterpart for the direction 0, 1, 0 only");
  }
  rules_.write(" extrude(world.up, ", at(i).offset);
  expression(given[3].first, given[3].second, rules_);
  rules_.write(")", at(i).offset);
}

void ShapemlReader::block(const std::pair<std::size_t, std::size_t>& given, int depth,
                          std::string_view index) {
  if (!is(given.first, "{"))
    return error(given.first, "found " + in_quotes(at(given.first)) + ", expected operations in braces");
  if (attributes_.contains(shapeml_index))
    rules_.write(" set(" + std::string(shapeml_index) + ", " + std::string(index) + ")",
                 at(given.first).offset);
  whole(given.first + 1, std::min(partner_[given.first], given.second), depth + 1);
}

void ShapemlReader::split(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given,
                          int depth) {
  const std::string_view name = at(i).text;
  const std::size_t from = at(i).offset;
  const std::string axis = name.empty() ? "" : std::string(1, static_cast<char>(name.back() | 0x20));
  if (name == "splitFace" && given.size() >= 2 && given.size() % 2 == 0) {
    if (given.size() > 2) warn_of_index(i, "`index` begins again with each selector of splitFace");
    rules_.write(" comp(f) {", from);
    for (std::size_t k = 0; k + 1 < given.size(); k += 2) {
      rules_.write((k > 0 ? " | " : " ") + lang::string_value(at(given[k].first)) + " :",
                   at(given[k].first).offset);
      block(given[k + 1], depth, "comp.index");
    }
    rules_.write(" }", from);
  } else if (name == "splitFaceByIndex" && given.size() >= 2) {
    rules_.write(" comp(f) {", from);
    for (std::size_t k = 0; k + 1 < given.size(); ++k) {
      rules_.write((k > 0 ? " | " : " ") + std::string(at(given[k].first).text) + " :",
                   at(given[k].first).offset);
      block(given.back(), depth, std::to_string(k));
    }
    rules_.write(" }", from);
  } else if (name.starts_with("splitRepeat") && given.size() == 2) {
    rules_.write(" split(" + axis + ") { ~(", from);
    expression(given[0].first, given[0].second, rules_);
    rules_.write(") :", from);
    block(given[1], depth, "split.index");
    rules_.write(" }*", from);
  } else if ((name == "splitX" || name == "splitY" || name == "splitZ") && given.size() >= 3 &&
             given.size() % 2 == 1 && at(given[0].first).kind == TokenKind::string) {
    pattern(i, lang::string_value(at(given[0].first)), given, depth);
  } else {
    error(i, in_quotes(at(i)) + " with these arguments has no counterpart");
  }
}

}  // namespace seedmesh

#pragma once
/// What the tests of expressions share: a text parsed with a few names, and its value.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "core/lang/expression.h"

namespace seedmesh::lang {

/// Slots x, y, z (0 to 2) and the constants two, half.
inline Names few_names() {
  Names names;
  names.bind_slot("x", 0);
  names.bind_slot("y", 1);
  names.bind_slot("z", 2);
  names.bind_constant("two", 2);
  names.bind_constant("half", 0.5);
  return names;
}

struct Parsed {
  Program program;
  Expression expression;
  std::vector<TextError> faults;
  std::size_t end = 0;  ///< byte of the first token that does not belong

  double at(double x, double y = 0, double z = 0) const {
    const double slots[] = {x, y, z};
    Rng rng = Rng::of_seed(1);
    return program.evaluate(expression, slots, rng);
  }
};

inline Parsed parse(const std::string& text, const Names& names = few_names(),
                    std::uint32_t max_depth = 200) {
  Parsed parsed;
  const std::vector<Token> tokens = tokenize(text, 0, text.size(), parsed.faults);
  std::size_t at = 0;
  parsed.expression = parsed.program.parse(tokens, at, names, parsed.faults, max_depth);
  parsed.end = tokens[at].offset;
  return parsed;
}

/// The value of a text without faults, at x = 3, y = 4, z = 0.
inline double value(const std::string& text) {
  const Parsed parsed = parse(text);
  for (const TextError& fault : parsed.faults)
    ADD_FAILURE() << text << ": " << fault.offset << ": " << fault.message;
  EXPECT_EQ(parsed.end, text.size()) << text;
  return parsed.at(3, 4, 0);
}

/// "offset: message" of every fault, a line each.
inline std::string faults(const std::string& text, std::uint32_t max_depth = 200) {
  std::string all;
  for (const TextError& fault : parse(text, few_names(), max_depth).faults) {
    all += (all.empty() ? "" : "\n") + std::to_string(fault.offset) + ": " + fault.message;
  }
  return all;
}

}  // namespace seedmesh::lang

#include "core/generators/building/shape_grammar/figure_value.h"

#include "core/lang/expression.h"

namespace seedmesh::building {

double figure_value(const std::string& text, const FigureValues& values, const std::string& pointer,
                    std::vector<Issue>& issues) {
  constexpr std::size_t most_errors = 100;
  lang::Names names;
  for (const auto& [name, value] : values) names.bind_constant(name, value);
  std::vector<lang::TextError> errors;
  const std::vector<lang::Token> tokens = lang::tokenize(text, 0, text.size(), errors);
  lang::Program program;
  std::size_t at = 0;
  const lang::Expression expression = program.parse(tokens, at, names, errors);
  if (errors.empty() && at + 1 < tokens.size()) {
    errors.push_back(
        {tokens[at].offset, "found " + in_quotes(tokens[at]) + ", expected the end of the expression"});
  }
  if (errors.empty() && !expression.is_constant)
    errors.push_back({0, "found a random function, expected a value that is not random"});
  for (const lang::TextError& each : errors) {
    if (issues.size() < most_errors)
      issues.push_back(issue_at(each.kind, pointer, text, each.offset, each.message));
  }
  return errors.empty() ? expression.value : 0;
}

}  // namespace seedmesh::building

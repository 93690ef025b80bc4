#include "core/generators/building/listing.h"

#include <algorithm>
#include <string>
#include <utility>

namespace seedmesh::building {
namespace {

using nlohmann::json;

/// A rule as the answer tells it.
struct ToldRule {
  std::string text;
  std::size_t line = 0;
  std::uint32_t choice_count = 0;
};

std::string_view without_end(std::string_view text, std::string_view characters) {
  return text.substr(0, text.find_last_not_of(characters) + 1);
}

/// The first line of a rule, and no more than itself: the label of the next one may end what lies before it.
std::string_view as_written(std::string_view rule, bool is_last) {
  const std::size_t end = rule.find_first_of("\r\n");
  std::string_view line = without_end(rule.substr(0, end), " \t");
  if (end != std::string_view::npos || is_last || !line.ends_with(':')) return line;
  const std::string_view before =
      without_end(without_end(line.substr(0, line.size() - 1), " \t"), "0123456789");
  return without_end(before, " \t");
}

/// By choice: its rule. Choices of bodies that are nested in a successor have none.
class RuleTable {
 public:
  RuleTable(const Grammar& grammar, std::string_view text)
      : rule_of_(grammar.choices.size(), none), numbers_(grammar.choices.size(), 0) {
    // Rules come as they are written, so that lines are counted once.
    std::size_t at = 0, line = 1;
    for (std::size_t r = 0; r < grammar.rules.size(); ++r) {
      const Rule& rule = grammar.rules[r];
      const Body& body = grammar.bodies[rule.body];
      const std::size_t begin = std::clamp<std::size_t>(rule.offset, at, text.size());
      line += static_cast<std::size_t>(std::ranges::count(text.substr(at, begin - at), '\n'));
      at = begin;
      const bool is_last = r + 1 == grammar.rules.size();
      const std::size_t end = is_last ? text.size() : std::max<std::size_t>(grammar.rules[r + 1].offset, at);
      ToldRule told{std::string(as_written(text.substr(at, end - at), is_last)), line, 0};
      for (std::uint32_t b = 0; b < body.branch_count; ++b) {
        const Branch& branch = grammar.branches[body.first_branch + b];
        for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
          const std::uint32_t choice = branch.first_choice + c;
          rule_of_[choice] = static_cast<std::uint32_t>(rules_.size());
          numbers_[choice] = ++told.choice_count;
        }
      }
      rules_.push_back(std::move(told));
    }
  }

  void tell(std::uint32_t choice, json& row) const {
    if (choice == none || rule_of_[choice] == none) return;
    const ToldRule& rule = rules_[rule_of_[choice]];
    row["rule"] = rule.text;
    row["line"] = rule.line;
    if (rule.choice_count > 1) row["choice"] = numbers_[choice];
  }

 private:
  std::vector<std::uint32_t> rule_of_, numbers_;
  std::vector<ToldRule> rules_;
};

json vector(const glm::dvec3& v) { return json::array({v.x + 0.0, v.y + 0.0, v.z + 0.0}); }

json described(const Shapes& shapes, const Grammar& grammar, std::uint32_t index) {
  const Shape& shape = shapes.shapes[index];
  const glm::dmat3& axes = shapes.axes[shape.axes];
  json parameters = json::array();
  for (std::uint32_t i = 0; i < shape.parameter_count; ++i) {
    const double value = shapes.parameters[shape.first_parameter + i];
    if (const std::string* text = shapes.texts.of(value))
      parameters.push_back(*text);
    else
      parameters.push_back(value);
  }
  json parent = nullptr;
  if (shape.parent != none) parent = shape.parent;
  return {{"id", index},
          {"parent", std::move(parent)},
          {"symbol", grammar.symbols[shape.symbol].name},
          {"parameters", std::move(parameters)},
          {"active", shape.is_active},
          {"scope",
           {{"origin", vector(shape.origin)},
            {"axes", json::array({vector(axes[0]), vector(axes[1]), vector(axes[2])})},
            {"size", vector(shape.size)}}}};
}

}  // namespace

json listed(const Shapes& shapes, const Grammar& grammar, std::string_view rules, std::size_t most,
            const Job& job) {
  const RuleTable table(grammar, rules);
  json list = json::array();
  for (std::uint32_t i = 0; i < shapes.shapes.size() && i < most; ++i) {
    json row = described(shapes, grammar, i);
    if (i < shapes.choices.size()) table.tell(shapes.choices[i], row);
    list.push_back(std::move(row));
    if ((i & 4095U) == 0) job.check();
  }
  return list;
}

json listed(const std::map<std::string, Report>& reports) {
  json out = json::object();
  for (const auto& [key, report] : reports) {
    out[key] = {{"count", report.count},
                {"sum", report.sum},
                {"mean", report.sum / static_cast<double>(report.count)},
                {"min", report.least},
                {"max", report.greatest}};
  }
  return out;
}

json listed(const std::vector<Warning>& warnings) {
  json list = json::array();
  for (const Warning& warning : warnings) {
    json row = {{"pointer", warning.pointer.empty() ? "" : "/parameters" + warning.pointer},
                {"message", warning.message}};
    if (warning.line > 0) {
      row["line"] = warning.line;
      row["column"] = warning.column;
    }
    list.push_back(std::move(row));
  }
  return list;
}

}  // namespace seedmesh::building

#include "core/generators/building/shapes_json.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/generators/building/edits.h"

namespace seedmesh::building {
namespace {

using nlohmann::json;

/// A rule as listed.
struct ListedRule {
  std::string text;
  std::size_t line = 0;
  std::uint32_t choice_count = 0;
};

std::string_view without_end(std::string_view text, std::string_view characters) {
  return text.substr(0, text.find_last_not_of(characters) + 1);
}

/// The first line of a rule, without the label of a next rule in the same line.
std::string_view as_written(std::string_view rule, bool is_last) {
  const std::size_t end = rule.find_first_of("\r\n");
  std::string_view line = without_end(rule.substr(0, end), " \t");
  if (end != std::string_view::npos || is_last || !line.ends_with(':')) return line;
  const std::string_view before =
      without_end(without_end(line.substr(0, line.size() - 1), " \t"), "0123456789");
  return without_end(before, " \t");
}

/// The rule of each choice. Choices of nested bodies have none.
class RuleTable {
 public:
  RuleTable(const Grammar& grammar, const RuleText& files)
      : rule_of_(grammar.choices.size(), none), numbers_(grammar.choices.size(), 0) {
    const std::string_view text = files.text;
    // Rules are in the order of the text, so that lines are counted once.
    std::size_t at = 0, line = 1;
    for (std::size_t r = 0; r < grammar.rules.size(); ++r) {
      const Rule& rule = grammar.rules[r];
      const Body& body = grammar.bodies[rule.body];
      const std::size_t begin = std::clamp<std::size_t>(rule.offset, at, text.size());
      line += static_cast<std::size_t>(std::ranges::count(text.substr(at, begin - at), '\n'));
      at = begin;
      const bool is_last = r + 1 == grammar.rules.size();
      const std::size_t end = is_last ? text.size() : std::max<std::size_t>(grammar.rules[r + 1].offset, at);
      ListedRule rule_row{std::string(as_written(text.substr(at, end - at), is_last)), line, 0};
      if (files.parts.size() > 1) {
        const RuleText::Part& part = files.part_at(rule.offset);
        const std::string_view own = files.text_of(part).substr(rule.offset - part.first);
        rule_row.text = as_written(own, true);
        rule_row.line =
            static_cast<std::size_t>(text_position(files.text_of(part), rule.offset - part.first).line);
      }
      for (std::uint32_t b = 0; b < body.branch_count; ++b) {
        const Branch& branch = grammar.branches[body.first_branch + b];
        for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
          const std::uint32_t choice = branch.first_choice + c;
          rule_of_[choice] = static_cast<std::uint32_t>(rules_.size());
          numbers_[choice] = ++rule_row.choice_count;
        }
      }
      rules_.push_back(std::move(rule_row));
    }
  }

  void add_rule(std::uint32_t choice, json& row) const {
    if (choice == none || rule_of_[choice] == none) return;
    const ListedRule& rule = rules_[rule_of_[choice]];
    row["rule"] = rule.text;
    row["line"] = rule.line;
    if (rule.choice_count > 1) row["choice"] = numbers_[choice];
  }

 private:
  std::vector<std::uint32_t> rule_of_, numbers_;
  std::vector<ListedRule> rules_;
};

json vector(const glm::dvec3& v) { return json::array({v.x + 0.0, v.y + 0.0, v.z + 0.0}); }

json array_json(const Shapes& shapes, const lang::TaggedValue& value) {
  json out = json::array();
  for (const lang::TaggedValue& each : shapes.arrays[value.text & ~array_bit].values) {
    if (each.is_text() && !is_array(each)) {
      out.push_back(*shapes.texts.find(each.text));
    } else {
      out.push_back(each.number);
    }
  }
  return out;
}

json described(const Shapes& shapes, const Grammar& grammar, std::uint32_t index) {
  const Shape& shape = shapes.shapes[index];
  const glm::dmat3& axes = shapes.axes[shape.axes];
  json parameters = json::array();
  for (std::uint32_t i = 0; i < shape.parameter_count; ++i) {
    const lang::TaggedValue& value = shapes.parameters[shape.first_parameter + i];
    if (is_array(value)) {
      parameters.push_back(array_json(shapes, value));
    } else if (value.is_text()) {
      parameters.push_back(*shapes.texts.find(value.text));
    } else {
      parameters.push_back(value.number);
    }
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

json json_of(const Shapes& shapes, const Grammar& grammar, const RuleText& rules, std::size_t most,
             const Job& job) {
  const RuleTable table(grammar, rules);
  const std::vector<std::string> paths = paths_of(shapes, grammar, most);
  json list = json::array();
  for (std::uint32_t i = 0; i < shapes.shapes.size() && i < most; ++i) {
    json row = described(shapes, grammar, i);
    row["path"] = paths[i].empty() ? json(nullptr) : json(paths[i]);
    if (i < shapes.choices.size()) table.add_rule(shapes.choices[i], row);
    list.push_back(std::move(row));
    if ((i & 4095U) == 0) job.check();
  }
  return list;
}

json json_of(const std::map<std::string, Report>& reports) {
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

}  // namespace seedmesh::building

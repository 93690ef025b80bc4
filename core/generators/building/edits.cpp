#include "core/generators/building/edits.h"

#include <algorithm>
#include <charconv>

#include "core/generators/building/check.h"
#include "core/generators/building/shapes.h"
#include "core/schema/nearest.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

struct NamedStep {
  std::string_view name;
  std::uint32_t number = 1;
};

/// One step of a path; nullopt where it is not written as name or name[number].
std::optional<NamedStep> read_step(std::string_view text) {
  NamedStep step{text, 1};
  const std::size_t bracket = text.find('[');
  if (bracket != std::string_view::npos) {
    const std::string_view digits = text.substr(bracket + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), step.number);
    const bool is_number = error == std::errc() && step.number > 0;
    if (!is_number || end != digits.data() + digits.size() - 1 || *end != ']') return std::nullopt;
    step.name = text.substr(0, bracket);
  }
  if (step.name.empty() || step.name.find(']') != std::string_view::npos) return std::nullopt;
  return step;
}

/// The steps of a path; empty where one of them is not valid.
std::vector<NamedStep> read_path(std::string_view path) {
  std::vector<NamedStep> steps;
  while (true) {
    const std::size_t slash = path.find('/');
    const std::optional<NamedStep> step = read_step(path.substr(0, slash));
    if (!step) return {};
    steps.push_back(*step);
    if (slash == std::string_view::npos) return steps;
    path.remove_prefix(slash + 1);
  }
}

std::string suggestion(std::string_view name, const Grammar& grammar) {
  std::vector<std::string_view> names;
  for (const Symbol& symbol : grammar.symbols) names.push_back(symbol.name);
  const std::string_view nearest = schema::nearest_word(name, names);
  return nearest.empty() ? "" : "; did you mean \"" + std::string(nearest) + "\"?";
}

void check_names(const std::vector<NamedStep>& steps, const Grammar& grammar, const std::string& pointer,
                 std::vector<Issue>& issues) {
  if (steps.empty()) {
    issues.emplace_back(IssueKind::syntax, pointer,
                        "expected names of shapes between slashes, with a number in brackets, such as "
                        "\"Lot/floor[2]/window[3]\"");
    return;
  }
  const std::string& first = grammar.symbols[grammar.start].name;
  if (steps.front().name != first) {
    issues.emplace_back(
        IssueKind::unknown_name, pointer,
        "found \"" + std::string(steps.front().name) + "\" as the first shape, expected \"" + first + "\"");
  }
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (grammar.symbol_named(steps[i].name) == none) {
      issues.emplace_back(IssueKind::unknown_name, pointer,
                          "the rules have no symbol \"" + std::string(steps[i].name) + "\"" +
                              suggestion(steps[i].name, grammar));
    }
  }
}

std::uint32_t child_of(EditTree& tree, std::uint32_t node, const EditTree::Step& step) {
  const auto next = static_cast<std::uint32_t>(tree.nodes.size());
  const auto [found, is_new] = tree.nodes[node].children.try_emplace(step, next);
  const std::uint32_t child = found->second;
  if (is_new) tree.nodes.emplace_back();
  return child;
}

std::uint32_t attribute_named(const Grammar& grammar, const std::string& name) {
  const auto found = std::ranges::find(grammar.attributes, name, &Attribute::name);
  return static_cast<std::uint32_t>(found - grammar.attributes.begin());
}

}  // namespace

void check_edits(const BuildingParams& params, const Grammar& grammar, std::vector<Issue>& issues) {
  Texts texts = grammar.texts;
  std::map<std::vector<std::pair<std::string_view, std::uint32_t>>, std::size_t> known;
  for (std::size_t i = 0; i < params.edits.size(); ++i) {
    const BuildingEdit& edit = params.edits[i];
    const std::string pointer = "/edits/" + std::to_string(i);
    const std::vector<NamedStep> steps = read_path(edit.shape);
    check_names(steps, grammar, pointer + "/shape", issues);
    std::vector<std::pair<std::string_view, std::uint32_t>> key;
    key.reserve(steps.size());
    for (const NamedStep& step : steps) key.emplace_back(step.name, step.number);
    const auto [before, is_new] = known.emplace(std::move(key), i);
    if (!is_new && !steps.empty()) {
      issues.emplace_back(
          conflict_with({}), pointer + "/shape",
          "edit " + std::to_string(before->second) + " changes the same shape, expected one edit for each");
    }
    if (edit.remove && (edit.rule || !edit.attributes.empty())) {
      issues.emplace_back(conflict_with({"rule", "attributes"}), pointer + "/remove",
                          "a removed shape has neither a rule nor attributes, expected one of them");
    }
    if (!edit.remove && !edit.rule && edit.attributes.empty()) {
      issues.emplace_back(missing_for({"attributes", "rule", "remove"}), pointer,
                          "found no change, expected \"attributes\", \"rule\" or \"remove\"");
    }
    if (edit.rule && grammar.symbol_named(*edit.rule) == none) {
      issues.emplace_back(
          IssueKind::unknown_name, pointer + "/rule",
          "the rules have no symbol \"" + *edit.rule + "\"" + suggestion(*edit.rule, grammar));
    }
    for (const auto& given : edit.attributes)
      check_attribute_value(grammar, texts, given, pointer + "/attributes", issues);
  }
}

EditTree edits_of(const BuildingParams& params, const Grammar& grammar, Texts& texts) {
  EditTree tree;
  for (const BuildingEdit& given : params.edits) {
    std::uint32_t node = 0;
    for (const NamedStep& step : read_path(given.shape))
      node = child_of(tree, node, {grammar.symbol_named(step.name), step.number});
    ShapeEdit edit;
    edit.is_removed = given.remove;
    if (given.rule) edit.rule = grammar.symbol_named(*given.rule);
    for (const auto& [name, value] : given.attributes)
      edit.attributes.emplace(attribute_named(grammar, name), value_of(texts, value));
    tree.nodes[node].edit = static_cast<std::uint32_t>(tree.edits.size());
    tree.edits.push_back(std::move(edit));
  }
  return tree;
}

EditSearch::EditSearch(const EditTree* tree)
    : tree_(tree == nullptr || tree->edits.empty() ? nullptr : tree),
      found_(tree_ == nullptr ? 0 : tree_->edits.size()) {}

const ShapeEdit* EditSearch::visit(std::uint32_t shape, std::uint32_t parent, std::uint32_t symbol) {
  if (tree_ == nullptr) return nullptr;
  nodes_.erase(nodes_.lower_bound(shape), nodes_.end());  // of shapes that were taken back
  std::uint32_t above = 0;
  if (parent != none) {
    const auto way = nodes_.find(parent);
    if (way == nodes_.end()) return nullptr;
    above = way->second;
  }
  const std::uint32_t number = ++numbers_[{above, symbol}];
  const auto& children = tree_->nodes[above].children;
  const auto child = children.find({symbol, number});
  if (child == children.end()) return nullptr;
  nodes_.emplace(shape, child->second);
  const std::uint32_t edit = tree_->nodes[child->second].edit;
  if (edit == none) return nullptr;
  found_[edit] = true;
  return &tree_->edits[edit];
}

std::vector<Warning> missing_edits(const BuildingParams& params, const Shapes& shapes) {
  std::vector<Warning> warnings;
  for (std::size_t i = 0; i < shapes.found_edits.size(); ++i) {
    if (!shapes.found_edits[i]) {
      warnings.push_back(
          {"/edits/" + std::to_string(i) + "/shape",
           "no shape has the path \"" + params.edits[i].shape + "\", so this edit has no effect", 0, 0});
    }
  }
  return warnings;
}

std::vector<std::string> paths_of(const Shapes& shapes, const Grammar& grammar, std::size_t most) {
  const std::size_t count = std::min(most, shapes.shapes.size());
  constexpr std::size_t most_bytes = std::size_t{32} << 20U;
  std::vector<std::string> paths(count);
  std::size_t bytes = 0;
  std::map<EditTree::Step, std::uint32_t> numbers;  // by predecessor and symbol
  for (std::uint32_t i = 0; i < count; ++i) {
    const Shape& shape = shapes.shapes[i];
    const auto renamed = shapes.symbols_before_edits.find(i);
    const std::uint32_t symbol =
        renamed == shapes.symbols_before_edits.end() ? shape.symbol : renamed->second;
    const std::string& name = grammar.symbols[symbol].name;
    if (shape.parent == none) {
      paths[i] = name;
      continue;
    }
    const std::string own = name + "[" + std::to_string(++numbers[{shape.parent, symbol}]) + "]";
    const std::string& above = paths[shape.parent];
    bytes += above.size() + own.size() + 1;
    if (!above.empty() && bytes <= most_bytes) paths[i].append(above).append("/").append(own);
  }
  return paths;
}

}  // namespace seedmesh::building

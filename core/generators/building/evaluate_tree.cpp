/// Runs expressions that are trees; see ValueNode in syntax.h.
#include <algorithm>
#include <cmath>

#include "core/generators/building/components.h"
#include "core/generators/building/evaluate.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building {
namespace {

using lang::TaggedValue;
using Kind = ValueNode::Kind;

constexpr int deepest =
    400;  ///< nested calls and operations; more is a function that calls itself without end
constexpr double most_range = 100'000;

class TreeRunner {
 public:
  explicit TreeRunner(Derivation& d) : d_(d) {}

  TaggedValue run(std::uint32_t index, std::span<const TaggedValue> locals) {
    const ValueNode& node = d_.grammar.value_nodes[index];
    if ((++steps_ & 4095U) == 0) d_.job.check();
    if (++depth_ > deepest)
      reject(d_, node.offset, "functions call each other more than 400 deep, perhaps without an end");
    const TaggedValue out = value_of(node, locals);
    --depth_;
    return out;
  }

 private:
  std::uint32_t operand(const ValueNode& node, std::uint32_t i) const {
    return d_.grammar.value_operands[node.first + i];
  }
  TaggedValue run_operand(const ValueNode& node, std::uint32_t i, std::span<const TaggedValue> locals) {
    return run(operand(node, i), locals);
  }
  static bool holds(const TaggedValue& value) { return value.is_text() || value.number != 0; }
  Evaluation at(const ValueNode& node) { return {d_, node.offset}; }

  std::vector<TaggedValue> all(const ValueNode& node, std::span<const TaggedValue> locals) {
    std::vector<TaggedValue> out;
    for (std::uint32_t i = 0; i < node.count; ++i) out.push_back(run_operand(node, i, locals));
    return out;
  }

  TaggedValue value_of(const ValueNode& node, std::span<const TaggedValue> locals) {
    switch (node.kind) {
      case Kind::constant:
        return node.constant;
      case Kind::slot:
        return d_.slots[node.id];
      case Kind::local:
        return node.id < locals.size() ? locals[node.id] : TaggedValue{};
      case Kind::negate:
        return binary(node, lang::Operation::subtract, {0, 0}, run_operand(node, 0, locals));
      case Kind::invert:
        return truth_value(!holds(run_operand(node, 0, locals)));
      case Kind::binary:
      case Kind::mask: {
        const TaggedValue left = run_operand(node, 0, locals);
        return binary(node, node.operation, left, run_operand(node, 1, locals));
      }
      case Kind::both:
        return truth_value(holds(run_operand(node, 0, locals)) && holds(run_operand(node, 1, locals)));
      case Kind::either:
        return truth_value(holds(run_operand(node, 0, locals)) || holds(run_operand(node, 1, locals)));
      case Kind::choose:
        for (std::uint32_t i = 0; i + 1 < node.count; i += 2) {
          if (holds(run_operand(node, i, locals))) return run_operand(node, i + 1, locals);
        }
        return run_operand(node, node.count - 1, locals);
      case Kind::weigh:
        return weigh(node, locals);
      case Kind::selector:
        return truth_value(d_.component != nullptr && (d_.component->classes[node.frame] & node.id) != 0);
      case Kind::query:
        return answer_of(d_, d_.grammar.queries[node.id]);
      case Kind::components:
        return components(node);
      default:
        return call(node, locals);
    }
  }

  TaggedValue call(const ValueNode& node, std::span<const TaggedValue> locals) {
    const std::vector<TaggedValue> given = all(node, locals);
    Evaluation here = at(node);
    switch (node.kind) {
      case Kind::call: {
        double numbers[lang::max_arity] = {};
        for (std::size_t i = 0; i < given.size() && i < std::size(numbers); ++i)
          numbers[i] = number_in(here, given[i]);
        return number_value(lang::functions()[node.id].call(numbers, d_.random));
      }
      case Kind::function: {
        const FunctionTree& function = d_.grammar.functions[node.id];
        return function.root == none ? TaggedValue{} : run(function.root, given);
      }
      case Kind::special:
        return value_function(node.id).call(here, given);
      case Kind::index:
        return elements(here, node, given);
      case Kind::range:
        return range(here, given);
      default: {
        ValueArray array;
        array.columns = node.id;
        for (const TaggedValue& each : given) {
          const ValueArray inner = array_in(here, each);
          array.values.insert(array.values.end(), inner.values.begin(), inner.values.end());
        }
        return array_value(here, std::move(array));
      }
    }
  }

  /// One draw decides between all percentages.
  TaggedValue weigh(const ValueNode& node, std::span<const TaggedValue> locals) {
    double at_draw = d_.random.unit() * 100;
    for (std::uint32_t i = 0; i + 1 < node.count; i += 2) {
      at_draw -= number_in(at(node), run_operand(node, i, locals));
      if (at_draw < 0) return run_operand(node, i + 1, locals);
    }
    return run_operand(node, node.count - 1, locals);
  }

  /// Texts are joined by +. Operators work on each value of an array, and on numbers with each of them.
  TaggedValue binary(const ValueNode& node, lang::Operation operation, const TaggedValue& left,
                     const TaggedValue& right) {
    Evaluation here = at(node);
    const bool is_comparison = operation == lang::Operation::equal || operation == lang::Operation::not_equal;
    if ((!is_comparison || node.kind == Kind::mask) && (is_array(left) || is_array(right))) {
      const ValueArray a = array_in(here, left), b = array_in(here, right);
      const std::size_t count = is_array(left) && is_array(right)
                                    ? std::min(a.values.size(), b.values.size())
                                    : std::max(a.values.size(), b.values.size());
      ValueArray out;
      out.columns = is_array(left) ? a.columns : b.columns;
      for (std::size_t i = 0; i < count && !a.values.empty() && !b.values.empty(); ++i) {
        out.values.push_back(
            binary(node, operation, a.values[is_array(left) ? i : 0], b.values[is_array(right) ? i : 0]));
      }
      return array_value(here, std::move(out));
    }
    if (operation == lang::Operation::add && (left.is_text() || right.is_text()))
      return text_value(here, text_in(here, left) + text_in(here, right));
    if (left.is_text() && right.is_text() && !is_comparison) {
      const int order = text_in(here, left).compare(text_in(here, right));
      if (operation == lang::Operation::less) return truth_value(order < 0);
      if (operation == lang::Operation::less_equal) return truth_value(order <= 0);
      if (operation == lang::Operation::greater) return truth_value(order > 0);
      if (operation == lang::Operation::greater_equal) return truth_value(order >= 0);
    }
    if (!is_comparison) {
      number_in(here, left);
      number_in(here, right);
    }
    return lang::apply(operation, left, right);
  }

  /// The rows or columns that an index names: a list of numbers, or those where a comparison is true.
  std::vector<double> places(Evaluation& here, const ValueNode& node, std::uint32_t which,
                             const TaggedValue& given) {
    const bool is_mask =
        is_array(given) && d_.grammar.value_nodes[operand(node, which)].kind == ValueNode::Kind::mask;
    std::vector<double> out;
    const ValueArray list = array_in(here, given);
    for (std::size_t i = 0; i < list.values.size(); ++i) {
      if (!is_mask) {
        out.push_back(number_in(here, list.values[i]));
      } else if (holds(list.values[i])) {
        out.push_back(static_cast<double>(i));
      }
    }
    return out;
  }

  /// a[2], a[2, 0], a[0:3, 1], a[b .== "lamp", 0]: one value, one row, or an array of those chosen.
  TaggedValue elements(Evaluation& here, const ValueNode& node, const std::vector<TaggedValue>& given) {
    if (!is_array(given[1]) && (given.size() < 3 || !is_array(given[2]))) return element(here, given);
    const std::vector<double> rows = places(here, node, 1, given[1]);
    const std::vector<double> columns =
        given.size() > 2 ? places(here, node, 2, given[2]) : std::vector<double>{};
    ValueArray out;
    for (const double row : rows) {
      if (columns.empty()) {
        const ValueArray one = array_in(here, element(here, {given[0], number_value(row)}));
        out.values.insert(out.values.end(), one.values.begin(), one.values.end());
        out.columns = one.columns;
      }
      for (const double column : columns)
        out.values.push_back(element(here, {given[0], number_value(row), number_value(column)}));
    }
    if (columns.size() > 1) out.columns = static_cast<std::uint32_t>(columns.size());
    return array_value(here, std::move(out));
  }

  TaggedValue element(Evaluation& here, const std::vector<TaggedValue>& given) {
    const ValueArray array = array_in(here, given[0]);
    const double row = number_in(here, given[1]), column = given.size() > 2 ? number_in(here, given[2]) : 0;
    const double columns = array.columns == 0 ? 1 : array.columns;
    const double count = static_cast<double>(array.values.size());
    const bool is_row = given.size() == 2 && array.columns > 1;
    if (is_row && row >= 0 && (row + 1) * columns <= count) {
      const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(std::floor(row) * columns);
      ValueArray out;
      out.values.assign(first, first + static_cast<std::ptrdiff_t>(columns));
      out.columns = array.columns;
      return array_value(here, std::move(out));
    }
    const double place = std::floor(row) * columns + std::floor(column);
    if (!(row >= 0 && column >= 0 && column < columns && place < count)) {
      // Adding 0 turns -0 into 0.
      reject(here, "found the index " + text_of_number(row + 0.0) +
                       (given.size() > 2 ? ", " + text_of_number(column + 0.0) : std::string()) +
                       ", expected one inside the array of " + text_of_number(count) + " values");
    }
    return array.values[static_cast<std::size_t>(place)];
  }

  TaggedValue range(Evaluation& here, const std::vector<TaggedValue>& given) {
    const double first = number_in(here, given[0]), last = number_in(here, given.back());
    const double step = given.size() > 2 ? number_in(here, given[1]) : last < first ? -1 : 1;
    if (!(step != 0) || !(std::abs((last - first) / step) < most_range))
      reject(here, "found a range with a step of 0 or with more than 100,000 values");
    ValueArray out;
    const double count = std::floor((last - first) / step + 1e-9);
    for (double i = 0; i <= count; ++i) out.values.push_back(number_value(first + i * step));
    return array_value(here, std::move(out));
  }

  /// One value for each component, in their order: that of the first selector that takes it, else 0.
  TaggedValue components(const ValueNode& node) {
    Evaluation here = at(node);
    const ComponentValue& wanted = d_.grammar.component_values[node.id];
    const ShapeState* const original = d_.seen;
    const ShapeState whole = *original;
    const std::uint32_t shape = d_.seen_shape;
    ValueArray out;
    if (!whole.has_asset() && dimension(whole.size) >= 2) {
      const std::vector<Component> all = components_of(d_, whole, wanted.kind);
      std::vector<std::int32_t> numbers(wanted.parts.size(), 0);
      for (std::uint32_t i = 0; i < all.size(); ++i) {
        TaggedValue value = number_value(0);
        for (std::size_t k = 0; k < wanted.parts.size(); ++k) {
          const Part& part = wanted.parts[k];
          if (!part.condition.is_given && (all[i].classes[part.frame] & part.classes) == 0) continue;
          const std::int32_t number = part.index == -2 ? static_cast<std::int32_t>(i) : numbers[k]++;
          if (!is_selected(d_, part, all[i], number, shape)) continue;
          ShapeState own = all[i].state;
          own.comp_index = i;
          own.comp_total = static_cast<std::uint32_t>(all.size());
          look_at(d_, own, shape);
          value = evaluate(d_, part.size.value);
          break;
        }
        out.values.push_back(value);
      }
    }
    look_at(d_, *original, shape);
    fill_slots(d_);
    return array_value(here, std::move(out));
  }

  Derivation& d_;
  int depth_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace

lang::TaggedValue evaluate_tree(Derivation& d, std::uint32_t node) {
  TreeRunner runner(d);
  return runner.run(node, {});
}

}  // namespace seedmesh::building

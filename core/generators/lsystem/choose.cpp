#include "core/generators/lsystem/choose.h"

#include <algorithm>

#include "core/base/math.h"
#include "core/schema/json.h"

namespace seedmesh::lsystem {
namespace {

/// Axes x, y, z and origin, three numbers each.
struct Axes {
  double* x;
  double* axis(int i) const { return x + 3 * i; }
  double* origin() const { return x + 9; }
};

double length_of(const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Returns 0 where an axis has no length and therefore no direction.
double quotient(double a, double b) { return b > 0 ? a / b : 0; }

/// A rotation keeps the length of every axis and the right angles between them.
void move(const Axes& axes, FrameExpression::Move how, const double* by) {
  using Move = FrameExpression::Move;
  if (how == Move::translate) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) axes.origin()[k] += by[i] * axes.axis(i)[k];
    }
  } else if (how == Move::scale) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) axes.axis(i)[k] *= by[i];
    }
  } else {
    const int about = how == Move::rotate_x ? 0 : how == Move::rotate_y ? 1 : 2;
    double* const first = axes.axis((about + 1) % 3);
    double* const second = axes.axis((about + 2) % 3);
    const math::SinCos angle = math::sincos_degrees(by[0]);
    const double ratio = quotient(length_of(first), length_of(second));
    const double back = quotient(length_of(second), length_of(first));
    for (int k = 0; k < 3; ++k) {
      const double old = first[k];
      first[k] = angle.cos * old + angle.sin * ratio * second[k];
      second[k] = angle.cos * second[k] - angle.sin * back * old;
    }
  }
}

void fill_frame(const Grammar& grammar, const FrameExpression& frame, const double* slots, Rng& rng,
                double* out) {
  constexpr double start[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  const double* from = frame.slot == FrameExpression::identity ? start : slots + frame.slot;
  std::copy(from, from + 12, out);
  for (const FrameExpression::Part& part : frame.parts) {
    double by[3];
    for (int i = 0; i < 3; ++i) by[i] = grammar.program.evaluate(part.by[i], slots, rng);
    move({out}, part.move, by);
  }
}

}  // namespace

void fill_framed_arguments(const Grammar& grammar, const Template& made, const double* slots, Rng& rng,
                           double* out, const Job& job) {
  const Kind& kind = grammar.kinds[made.kind];
  for (std::uint32_t i = 0; i < kind.written(); ++i) {
    const lang::Expression& argument = grammar.arguments[made.first_argument + i];
    const std::uint32_t count = kind.frames[i] != 0 ? 12 : 1;
    if (count == 1) {
      *out = grammar.program.evaluate(argument, slots, rng);
    } else {
      fill_frame(grammar, grammar.frames[frame_index(argument)], slots, rng, out);
    }
    for (std::uint32_t k = 0; k < count; ++k, ++out) {
      if (!std::isfinite(*out)) refuse_argument(grammar, made, i, *out, job);
      *out += 0.0;  // -0 becomes 0
    }
  }
}

namespace {

/// Returns the text for whose templates `holds` returns true.
template <class Holds>
std::string text_with(const Grammar& grammar, Holds&& holds) {
  if (holds(grammar.axiom)) return "/axiom";
  const auto find = [&](const Rules& rules) -> const Production* {
    const auto found = std::find_if(rules.productions.begin(), rules.productions.end(),
                                    [&](const Production& each) { return holds(each.successor); });
    return found == rules.productions.end() ? nullptr : &*found;
  };
  const Production* found = find(grammar.productions);
  if (!found) found = find(grammar.interpretation);
  if (!found) found = find(grammar.decomposition);
  for (const Rules& table : grammar.tables) {
    if (!found) found = find(table);
  }
  return found ? found->pointer : "";
}

}  // namespace

std::string writer_of(const Grammar& grammar, KindId kind) {
  return text_with(grammar, [&](Range range) {
    const std::span<const Template> written = grammar.successor(range);
    return std::any_of(written.begin(), written.end(),
                       [&](const Template& each) { return each.kind == kind; });
  });
}

void refuse_argument(const Grammar& grammar, const Template& made, std::uint32_t index, double value,
                     const Job& job) {
  const auto number = static_cast<std::uint32_t>(&made - grammar.templates.data());
  const std::string pointer = text_with(
      grammar, [&](Range range) { return number >= range.first && number < range.first + range.count; });
  job.refuse({IssueKind::evaluation, pointer,
              "parameter " + std::to_string(index + 1) + " of `" + grammar.kinds[made.kind].symbol +
                  "` became " + (value != value ? "undefined (for example 0/0)" : "infinite") +
                  "; expected a finite number"});
}

void refuse_weights(const Grammar& grammar, const Production& last, double total, const Job& job) {
  job.refuse({IssueKind::evaluation, last.pointer,
              "the probabilities of the productions that match `" + grammar.kinds[last.predecessor].symbol +
                  "` sum to " + number_text(std::round(total * 1e9) / 1e9) +
                  ", expected 1 because `weights` is strict"});
}

}  // namespace seedmesh::lsystem

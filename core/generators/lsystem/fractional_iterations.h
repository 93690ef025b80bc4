#pragma once
/// Fractional iterations: draws the state between two derivation steps, so that age changes the drawing
/// continuously.
///
/// A word of n steps is rewritten once more while it is drawn. Only the share f of that step takes effect:
/// lengths and organs grow from 0, turns outside new brackets grow from 0, and state that symbols set is
/// interpolated from the turtle's state. So f = 0 draws step n and f = 1 draws step n + 1, for every grammar:
///
/// - A module of the successor can continue the predecessor; it is called the continuation here. It is the
///   first module of the same kind outside brackets and braces. Its parameters and random values are interpolated
///   from those of the predecessor.
/// - A predecessor without a continuation is drawn before its successor, scaled by 1 - f. The state that it sets is
///   scaled in the same way.
/// - The part that a % removes is scaled by 1 - f.
///
/// Colours, contours and the choice of interpretation rules change abruptly. Compare Prusinkiewicz and
/// Lindenmayer, "The Algorithmic Beauty of Plants", 1990, section 6.1, where growth functions are fitted by
/// hand.
#include "core/generators/lsystem/contexts.h"
#include "core/generators/lsystem/draw.h"

namespace seedmesh::lsystem {

class FractionalStep {
 public:
  /// `share` is f in (0, 1), the share of step `step` + 1. Interpreted modules have continuations only where
  /// interpretation rules use no random numbers, because every module has its own random stream.
  FractionalStep(const Grammar& grammar, Drawing& drawing, std::uint32_t step, double share)
      : grammar_(grammar),
        drawing_(drawing),
        step_(step),
        share_(share),
        parameters_(grammar.widest + std::size_t{1}) {}

  /// Takes one module of a derivation of `step` steps of a system without contexts.
  void module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t born);

  /// Rewrites and draws a whole word of `step` steps. Needed where productions have contexts.
  void word(const Word& word, Job& job);

 private:
  struct Module {
    KindId kind;
    const double* parameters;
    std::uint64_t key;
    std::uint32_t born;
  };
  void stay(const Module& module);
  void rewrite(const Module& module, const Production& production, const double* slots);
  bool can_fade(KindId kind) const;
  bool can_continue(KindId kind) const;

  const Grammar& grammar_;
  Drawing& drawing_;
  std::uint32_t step_;
  double share_;
  std::vector<double> parameters_;
  int cut_depth_ = 0;  ///< depth of open brackets inside the removed part, plus one; 0: no removal
};

}  // namespace seedmesh::lsystem

#pragma once
/// Fractional iterations: the word between two derivation steps, drawn so that age changes it continuously.
///
/// A word of n steps is rewritten once more while it is drawn, and what the step writes has only the share f
/// of its effect: lengths and organs grow from nothing, turns outside new brackets turn from nothing, what
/// symbols set leaves from the turtle's own. So at f = 0 the drawing is that of step n, at f = 1 that of step
/// n + 1, whatever the grammar:
///
/// - The first module of a successor outside brackets and braces that is of its predecessor's kind is its
///   heir: its parameters, and what it draws at random, go from those of the predecessor to its own.
/// - A predecessor that no module takes over from shrinks away by 1 - f in front of its successor, and so
///   does what it sets.
/// - What a % takes away shrinks by 1 - f.
///
/// Colours, contours and the choice of interpretation rules change at once. Compare Prusinkiewicz and
/// Lindenmayer, "The Algorithmic Beauty of Plants", 1990, section 6.1, where growth functions of single
/// systems are fitted by hand.
#include "core/generators/lsystem/contexts.h"
#include "core/generators/lsystem/draw.h"

namespace seedmesh::lsystem {

class Sprouting {
 public:
  /// `share` f in (0, 1) of step `step` + 1. Interpreted modules take over only where interpretation rules
  /// draw nothing at random, since every module draws at its own place.
  Sprouting(const Grammar& grammar, Drawing& drawing, std::uint32_t step, double share)
      : grammar_(grammar),
        drawing_(drawing),
        step_(step),
        share_(share),
        parameters_(grammar.widest + std::size_t{1}) {}

  /// Sink of a derivation of `step` steps of a system without contexts.
  void module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t born);

  /// Rewrites and draws a whole word of `step` steps.
  void word(const Word& word, Job& job);

 private:
  struct Module {
    KindId kind;
    const double* parameters;
    std::uint64_t key;
    std::uint32_t born;
  };
  void stay(const Module& module);
  void sprout(const Module& module, const Production& production, const double* slots);
  bool can_fade(KindId kind) const;
  bool may_take_over(KindId kind) const;

  const Grammar& grammar_;
  Drawing& drawing_;
  std::uint32_t step_;
  double share_;
  std::vector<double> parameters_;
  int cut_depth_ = 0;  ///< brackets open inside the part that is cut away, plus one; 0: nothing is cut
};

}  // namespace seedmesh::lsystem

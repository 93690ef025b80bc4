#pragma once
/// Fast drawing of plain systems. A symbol derives to the same modules everywhere, so the turtle draws them
/// once and then copies them by a rigid motion (Turtle::append_copy). Joints differ from direct drawing only
/// by rounding far below the stored precision.
#include <memory>
#include <vector>

#include "core/generators/lsystem/context_free_derivation.h"
#include "core/generators/lsystem/draw.h"

namespace seedmesh::lsystem {

/// A sink of ContextFreeDerivation.
class DrawingCache {
 public:
  /// Returns true for long words of systems whose rewritten symbols have no parameters, conditions or random
  /// choices and do not depend on the turtle's position. Short words are drawn module by module.
  static bool fits(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps);
  /// The same without the condition that the word is long.
  static bool moves_rigidly(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps);

  DrawingCache(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps, Drawing& drawing,
               const GenerateContext& context);

  void module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t step) {
    drawing_.module(kind, parameters, key, step);
  }
  bool replaces(KindId kind, std::uint32_t step);

 private:
  struct Piece {
    std::uint64_t modules = 1;
    std::vector<std::unique_ptr<Turtle::Recording>> recordings;  ///< one for each entry state of the turtle
  };
  Piece& piece(KindId kind, std::uint32_t steps) {
    return pieces_[std::size_t{steps} * grammar_.kinds.size() + kind];
  }
  void count();
  const Turtle::Recording& draw(KindId kind, std::uint32_t step, Piece& piece);

  const Grammar& grammar_;
  const LsystemParams& params_;
  std::uint32_t steps_;
  Drawing& drawing_;
  const GenerateContext context_;
  Job& job_;
  Meter meter_;
  std::vector<Piece> pieces_;  ///< pieces, indexed by number of steps, then kind
  std::size_t recordings_ = 0;
};

}  // namespace seedmesh::lsystem

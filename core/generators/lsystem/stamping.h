#pragma once
/// Big drawings of plain systems: what a symbol becomes in so many steps is the same wherever it stands, so
/// the turtle draws it once and then sets it down turned and moved (Turtle::press). The joints lie where the
/// turtle would have gone but for rounding far below what is stored.
#include <memory>
#include <vector>

#include "core/generators/lsystem/draw.h"
#include "core/generators/lsystem/free.h"

namespace seedmesh::lsystem {

/// A sink of FreeDerivation.
class Stamping {
 public:
  /// True for systems whose rewritten symbols have no parameters, conditions or chance, that never look at
  /// where the turtle is, and whose words are so long that it is worth it. Small words are drawn module by
  /// module.
  static bool fits(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps);

  Stamping(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps, Drawing& drawing,
           Job& job);

  void module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t step) {
    drawing_.module(kind, parameters, key, step);
  }
  bool takes(KindId kind, std::uint32_t step);

 private:
  struct Piece {
    std::uint64_t modules = 1;
    std::vector<std::unique_ptr<Turtle::Stamp>> stamps;  ///< one for each state that the turtle came with
  };
  Piece& piece(KindId kind, std::uint32_t steps) {
    return pieces_[std::size_t{steps} * grammar_.kinds.size() + kind];
  }
  void count();
  const Turtle::Stamp& draw(KindId kind, std::uint32_t step, Piece& piece);

  const Grammar& grammar_;
  const LsystemParams& params_;
  std::uint32_t steps_;
  Drawing& drawing_;
  Job& job_;
  Meter meter_;
  std::vector<Piece> pieces_;  ///< by steps and kind
  std::size_t stamps_ = 0;
};

}  // namespace seedmesh::lsystem

#pragma once
/// Runs the rules. See syntax.h for the grammar and shapes.h for what comes out.
///
/// Shapes are replaced one by one, newest first, with no memory but the tree itself; the order in which it is
/// done cannot be seen in the result, because every random number hangs on the place of its shape:
///   key(child) = H(key(parent), number of the operation in the successor, number of the piece)
/// Questions to other shapes (occlusion, snap lines) take two passes: in the first all answers are "none" and
/// no snap line holds, in the second they are worked out against what the first one made (CGA reference,
/// context queries).
///
/// Out:    shapes, parents before children.
/// Issues: a number that is not finite, a text where a number is expected, a rule that has no end (1,000
///         shapes inside each other): thrown as Stop with line and column.
/// Cost:   about 0.3 microseconds a box; spends Resource::shapes before they are made.
#include <optional>
#include <span>

#include "core/base/job.h"
#include "core/generators/building/cuts.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// An asset by name: the box it has by itself. `place` is its number with asset_bit.
struct AssetBox {
  std::string name;  ///< of an asset of the request, or else of a built-in part
  glm::dvec3 low{0}, size{1};
};

struct Task {
  const Grammar* grammar = nullptr;
  std::string_view text;                     ///< the rules, for line and column
  bool is_blueprint = false;                 ///< they came with the program
  glm::dvec3 size{0};                        ///< of the first shape
  const Solid* footprint = nullptr;          ///< null: a box
  glm::dvec3 origin{0};                      ///< of the first scope
  std::map<std::string, double> attributes;  ///< given values; texts as numbers of Grammar::texts
  std::optional<int> iterations;
  bool is_sequential = false, is_depth_first = false;
  std::optional<Rounding> rounding;
  std::span<const AssetBox> assets;
  std::size_t own_assets = 0;                     ///< the first of them are the request's own
  bool keeps_masses = false;                      ///< for collision bodies
  bool keeps_choices = false;                     ///< for lists of shapes
  std::uint64_t most_shapes = ~std::uint64_t{0};  ///< the derivation ends where there are more
};

constexpr std::uint16_t deepest_shape = 1'000;

/// A fault at a byte of the rules: /rules with line and column, or /blueprint where they came with the
/// program, whose text the request does not have.
Issue issue_in_rules(const Task& task, std::size_t offset, const std::string& message);

Shapes derive_shapes(const Task& task, Job& job);

}  // namespace seedmesh::building

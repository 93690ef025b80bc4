#pragma once
/// Runs the rules of a grammar (syntax.h); the result is a tree of shapes (shapes.h).
///
/// Shapes are replaced one by one, the newest first. The result does not depend on the order, because every
/// random number is a function of the position of its shape in the tree:
///   key(child) = H(key(parent), number of the operation in the successor, number of the piece)
/// Queries to other shapes (occlusion, snap lines) need two passes. In the first, the result of every query is "none" and
/// there are no snap lines. In the second, queries test the shapes of the first (CGA reference, context queries).
///
/// Out:    shapes, parents before children.
/// Errors: a number that is not finite, a text where a number is expected, rules without an end (1,000 nested
///         shapes): thrown as Stop with line and column.
/// Cost:   about 0.3 us a box; spends Resource::shapes before shapes are made.
#include <map>
#include <optional>
#include <span>

#include "core/base/job.h"
#include "core/generators/building/cuts.h"
#include "core/generators/building/edits.h"
#include "core/generators/building/roof_store.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// An asset that rules can insert, with the box that it has without a scope.
struct AssetBox {
  std::string_view name;  ///< name of an asset of the request or of a built-in part
  glm::dvec3 low{0}, size{1};
};

/// The input of a derivation. Pointers and views are not owned; what they refer to has to outlive derive_shapes().
struct Task {
  const Grammar* grammar = nullptr;
  const Texts* texts = nullptr;                         ///< those of the grammar, and those of given values
  const RuleText* text = nullptr;                       ///< the rules, for line and column
  bool is_blueprint = false;                            ///< whether the rules are part of the program
  glm::dvec3 size{0};                                   ///< size of the first shape
  const Solid* footprint = nullptr;                     ///< null: a box
  glm::dvec3 origin{0};                                 ///< origin of the first scope
  std::map<std::string, lang::TaggedValue> attributes;  ///< given values
  const EditTree* edits = nullptr;
  std::optional<int> iterations;
  bool is_sequential = false, is_depth_first = false;
  std::optional<Rounding> rounding;
  std::span<const AssetBox> assets;
  std::size_t own_assets = 0;  ///< the first of `assets` are those of the request
  const std::map<std::string, std::string>* tables = nullptr;
  std::vector<std::string> files;   ///< names of assets, materials and tables of the request, sorted
  bool keeps_masses = false;        ///< whether masses are kept, for collision bodies
  bool has_strict_weights = false;  ///< probabilities of a choice that do not sum to 1 are an error
  bool stays_inside = false;        ///< a shape that leaves the scope of its predecessor is an error
  bool keeps_choices = false;       ///< whether choices are kept, for lists of shapes
  std::uint64_t most_shapes = ~std::uint64_t{0};  ///< the derivation stops when there are more
  RoofStore* roofs = nullptr;
};

constexpr std::uint16_t deepest_shape = 1'000;

/// Returns an issue at a byte of the rules: with /rules, line and column, or with /blueprint if the rules are part of
/// the program.
Issue issue_in_rules(const Task& task, IssueKind kind, std::size_t offset, const std::string& message);

/// Derives the shapes of a building from its start shape.
Shapes derive_shapes(const Task& task, Job& job);

}  // namespace seedmesh::building

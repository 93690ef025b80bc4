#pragma once
/// Changes of single derived shapes (the parameter `edits`), found by their paths.
///
/// A path names the first shape and the symbols below it: "Lot/floor[2]/window[3]" is the third `window` of the second
/// `floor` of the first shape `Lot`, in the order in which their predecessor makes them. A missing number is 1. A path
/// stays the same when shapes of other symbols are added, or when other shapes change.
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/generators/building/syntax.h"

namespace seedmesh {
struct BuildingParams;
}

namespace seedmesh::building {

struct Shapes;

struct ShapeEdit {
  std::map<std::uint32_t, lang::TaggedValue> attributes;  ///< values, by index into Grammar::attributes
  std::optional<std::uint32_t> rule;                      ///< the symbol whose rule replaces the shape
  bool is_removed = false;
};

/// The edits as a tree over the steps of their paths. Node 0 is above the first shape.
struct EditTree {
  using Step = std::pair<std::uint32_t, std::uint32_t>;  ///< a symbol, and which of them, from 1
  struct Node {
    std::map<Step, std::uint32_t> children;
    std::uint32_t edit = none;
  };
  std::vector<Node> nodes{Node{}};
  std::vector<ShapeEdit> edits;
};

/// Adds the errors of the edits of a request, with their pointers.
void check_edits(const BuildingParams& params, const Grammar& grammar, std::vector<Issue>& issues);

/// Returns the edits of a request that has no errors. Texts of attributes are added to `texts`, which begin with those
/// of the grammar.
EditTree edits_of(const BuildingParams& params, const Grammar& grammar, Texts& texts);

/// Numbers the shapes of each symbol below each predecessor while they are made, and finds their edits in a tree.
class EditSearch {
 public:
  /// If `tree` is null, nothing is found.
  explicit EditSearch(const EditTree* tree);

  /// Counts a new shape and returns its edit; null if it has none. `parent` is the number of its predecessor, or
  /// `none` for the first shape. Call it in the order of the numbers of shapes. A number below an earlier one means
  /// that the shapes from this number on were removed and are made again.
  const ShapeEdit* visit(std::uint32_t shape, std::uint32_t parent, std::uint32_t symbol);

  /// For each edit, whether its shape was made.
  const std::vector<bool>& found() const { return found_; }

 private:
  const EditTree* tree_;
  /// Index into EditTree::nodes, by shape on a path to an edit.
  std::map<std::uint32_t, std::uint32_t> nodes_;
  std::map<EditTree::Step, std::uint32_t> numbers_;  ///< number of shapes so far, by node and symbol
  std::vector<bool> found_;
};

/// Returns warnings about edits without a shape.
std::vector<Warning> missing_edits(const BuildingParams& params, const Shapes& shapes);

/// Returns the paths of the first `most` shapes. Paths beyond 32 MiB together are empty.
std::vector<std::string> paths_of(const Shapes& shapes, const Grammar& grammar, std::size_t most);

}  // namespace seedmesh::building

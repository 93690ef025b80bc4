#pragma once
/// Grows the stems of a tree by Weber and Penn. Each stem is traversed from its base to its tip, and its joints
/// and leaves are written. Its clones and children are pushed on a stack.
#include <vector>

#include "core/generators/tree/leaf_frames.h"
#include "core/generators/tree/weber_penn_stem.h"
#include "core/generators/tree/weber_penn_twigs.h"

namespace seedmesh::tree {

/// A joint of a stem, and where on the stem it is.
struct WeberPennJoint {
  double offset;
  std::uint32_t joint;
};

/// The state of the growth of one tree or of a part of one. `tree` and `writer` are borrowed.
struct WeberPennGrowth {
  WeberPennGrowth(const WeberPennTree& whole, SkeletonWriter& out) : tree(whole), writer(out) {}

  const WeberPennTree& tree;
  SkeletonWriter& writer;
  std::vector<WeberPennStem> waiting;  ///< the last one grows next
  LeafFrames leaves;                   ///< leaves that are not yet written
  WeberPennTwigs twigs;

  // Memory that stems reuse.
  std::vector<WeberPennStem> clones;
  std::vector<double> offsets;         ///< offsets of the children or leaves on a piece of a stem
  std::vector<double> steps;           ///< offsets before they are gathered in whorls
  std::vector<double> stops;           ///< offsets of the joints on a piece
  std::vector<WeberPennJoint> joints;  ///< joints on a piece
  std::vector<Frame> trial_frames;
};

/// Grows one stem. What grows from it waits afterwards: its clones first, then its children.
void grow_stem(WeberPennGrowth& growth, WeberPennStem stem);

/// Grows everything that waits, and writes all leaves.
void grow_waiting(WeberPennGrowth& growth);

/// Writes the leaves that are not yet written.
void write_leaves(WeberPennGrowth& growth);

}  // namespace seedmesh::tree

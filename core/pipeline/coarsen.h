#pragma once
/// Levels of detail of a model that is made already, and triangles taken from them.
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/base/job.h"
#include "core/model/levels.h"

namespace seedmesh {

/// The triangles that a level draws, copies counted.
std::uint64_t drawn_at(const Model& model, std::size_t level);

/// What a model may lose.
struct Sacrifice {
  /// Sheets that hang apart are leaves: some may go where others grow.
  bool leaves = true;
  /// How far a surface may move, as a share of the diagonal of the model; infinite: as far as it must, and
  /// pieces of any size may go. Else no piece goes that is larger than a hundredth of the diagonal squared.
  double detail = std::numeric_limits<double>::infinity();
};

/// Takes triangles from the meshes of a level until it draws at most `most`, or they can lose no more: leaves
/// are thinned, the rest is simplified, then its smallest pieces go. All give up the same share, but for
/// those of fewer than `least` triangles. Indices are wide.
void coarsen_all(Model& model, std::size_t level, std::uint64_t most, std::uint64_t least,
                 const Sacrifice& sacrifice, Job& job);

/// The same where the level then draws at most `most` triangles. Else false, as soon as an attempt does not
/// come half of the way, and its meshes are as they were. Takes the memory of the level a second time.
bool coarsen_if_it_fits(Model& model, std::size_t level, std::uint64_t most, const Sacrifice& sacrifice,
                        Job& job);

/// Adds a level behind the coarsest, of half its triangles; meshes of fewer than `least` triangles,
/// packed ones and collision shapes stay as they are. False, and no such level, where more than `share` of
/// the triangles would be left. Indices are wide.
bool deepen(Model& model, std::uint64_t least, double share, const Sacrifice& sacrifice, Job& job);

}  // namespace seedmesh

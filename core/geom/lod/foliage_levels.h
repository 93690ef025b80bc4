#pragma once
/// Selection of the organs that a plant keeps at coarser levels of detail.
#include <span>
#include <vector>

#include "core/base/job.h"
#include "core/geom/lod/view_samples.h"
#include "core/geom/plant/limbs.h"

namespace seedmesh {

/// Ranks organs by removing them one by one, always the one that alone covers the fewest texels in views from
/// a half circle of directions. Leaves inside a dense crown are removed first, leaves at its outline last.
/// The organs of one level are a subset of those of the finer levels. A kept leaf is enlarged if the added
/// texels are mostly gaps left by removed leaves, and not background.
///
/// Construct it once for all levels. Time: about a microsecond for each organ and view; plants with more
/// organs get fewer views. Memory: 12 bytes for each texel and view, 16 for each organ.
class FoliageLevels {
 public:
  /// `surfaces` has the mesh of each Organ::surface. `filled` is the share of a mesh's width that its texture
  /// fills. Thick limbs hide leaves. All are borrowed during construction only.
  struct Plant {
    const Organs& organs;
    std::span<const Mesh> surfaces;
    const Limbs& limbs;
    float filled = 1;
  };
  FoliageLevels(const Plant& plant, Job& job);

  /// Returns the share `share` of the organs, but at least 0.2 of them, in the same order. `organs` must be those of
  /// the plant.
  Organs keep(const Organs& organs, double share, Job& job);

  /// Returns the least share to keep so that at most the share `loss` of the covered texels becomes uncovered.
  double share_for(double loss) const;

  /// Returns, for each joint, the share 0..1 of its internode that no organ and no other thick limb hides, averaged
  /// over all views.
  Array<float> shown(const Limbs& limbs, Job& job) const;

 private:
  using Corners = std::vector<glm::vec3>;  ///< three for each triangle

  template <class Put>
  void draw(const Organ& organ, float growth, const Put& put, int step = 1);
  template <class Put>
  void cover(const Organ& organ, const Put& put);
  static std::size_t slot(int view, std::size_t texel) {
    return static_cast<std::size_t>(view) * ViewSamples::texels + texel;
  }
  void draw_limbs(const Limbs& limbs, Job& job);
  void rank(const Organs& organs, Job& job);
  float best_growth(const Organ& organ, const Array<std::int8_t>& gain);

  ViewSamples view_samples_;
  std::vector<Corners> footprints_;      ///< triangles of each surface
  Corners placed_;                       ///< triangles of the current organ
  Array<std::uint16_t> leaves_, limbs_;  ///< number of them at each texel of each view
  Array<std::uint32_t> owner_;           ///< exclusive or of the numbers of the organs at each texel
  Array<std::uint32_t> last_visit_;      ///< number of the last call of cover() that touched each texel
  std::uint32_t visits_ = 0;
  Array<std::uint32_t> rank_;  ///< number of organs removed before each organ
  std::vector<float> lost_;    ///< uncovered share of the covered texels, by the number of removed organs
};

}  // namespace seedmesh

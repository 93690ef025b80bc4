#pragma once
/// Which organs of a plant stay at a coarser level of detail: those that would be missed.
#include <span>
#include <vector>

#include "core/base/job.h"
#include "core/geom/limbs.h"
#include "core/geom/sights.h"

namespace seedmesh {

/// Takes organs away one by one, always the one that alone covers the least in the pictures of all sides:
/// leaves inside a dense crown go first, leaves at its outline last. What stays at one level is part of what
/// stays at the finer ones, at its place. A leaf then grows where it covers more of what lost its leaf than
/// of what had none.
///
/// Made once for all levels. Time: about a microsecond an organ and view; fewer views the more organs there
/// are. Memory: 12 bytes a texel and view, 16 an organ.
class FoliageLevels {
 public:
  /// `surfaces`: by Organ::surface, the mesh of each; borrowed only while this is made. `filled`: the share
  /// of a mesh's width that its picture fills. `limbs` cover leaves, if they are thick.
  struct Plant {
    const Organs& organs;
    std::span<const Mesh> surfaces;
    const Limbs& limbs;
    float filled = 1;
  };
  FoliageLevels(const Plant& plant, Job& job);

  /// The share of the organs that stays, from 0.4 to 1, in their order. `organs` must be those of the plant.
  Organs keep(const Organs& organs, double share, Job& job);

  /// The least share that stays where at most `loss` of what the leaves cover is bare afterwards.
  double share_for(double loss) const;

  /// Of each joint: the share of its internode that no organ and no other thick limb covers, in the mean of
  /// all sides.
  Array<float> shown(const Limbs& limbs, Job& job) const;

 private:
  using Corners = std::vector<glm::vec3>;  ///< three a triangle

  template <class Put>
  void draw(const Organ& organ, float growth, const Put& put, int step = 1);
  template <class Put>
  void cover(const Organ& organ, const Put& put);
  static std::size_t slot(int view, std::size_t texel) {
    return static_cast<std::size_t>(view) * Sights::texels + texel;
  }
  void draw_limbs(const Limbs& limbs, Job& job);
  void rank(const Organs& organs, Job& job);
  float best_growth(const Organ& organ, const Array<std::int8_t>& gain);

  Sights sights_;
  std::vector<Corners> footprints_;      ///< by surface
  Corners placed_;                       ///< those of the organ that is looked at
  Array<std::uint16_t> leaves_, limbs_;  ///< how many cover each texel of each view
  Array<std::uint32_t> owner_;           ///< organs that cover it, their numbers combined by exclusive or
  Array<std::uint32_t> stamp_;           ///< of each: who covered it last, so that nobody does so twice
  std::uint32_t stamps_ = 0;
  Array<std::uint32_t> rank_;  ///< of each organ: how many go before it
  std::vector<float> lost_;    ///< by how many went: the share of what was covered that is bare
};

}  // namespace seedmesh

#pragma once
/// What a plant grows among: solids that bound it or stand in its way, what has grown already, and the light
/// that reaches a place. Open L-systems ask it (Mech and Prusinkiewicz, "Visual Models of Plants Interacting
/// with Their Environment", 1996), and prune() cuts by it what has grown where nothing may be.
#include <span>
#include <vector>

#include "core/geom/limbs.h"
#include "core/geom/solid.h"

namespace seedmesh {

/// Light by shadow voxels (Palubicki et al., "Self-organizing tree models for image synthesis", 2009, section
/// 4.1.2): what has grown in a cell shades the cells below it in a pyramid, by shade * falloff^-q in the q-th
/// layer down.
struct ShadowOptions {
  double cell = 0.5;     ///< m
  double shade = 0.2;    ///< of the cell itself
  double falloff = 1.6;  ///< from layer to layer
  int layers = 6;        ///< below the cell
};

/// An internode that others may run into.
struct Stretch {
  glm::dvec3 from{0}, to{0};
  double radius = 0;
  std::uint32_t system = 0;
  std::uint32_t joint = 0, parent = 0;     ///< in the system's Limbs
  std::uint32_t limb = 0, limb_below = 0;  ///< any number for each limb: its own, and its parent joint's
};

/// A place on a plant that asks. Its own limb does not count, behind or ahead, nor do the first internodes of
/// side limbs ahead, nor what grows from the same joint or place, nor the last internodes that it grows from.
struct Prober {
  glm::dvec3 position{0}, heading{0, 1, 0};
  double radius = 0;
  std::uint32_t system = 0;
  std::uint32_t joint = Limbs::none;                           ///< the last one drawn on its branch
  std::uint32_t limb = Limbs::none, limb_ahead = Limbs::none;  ///< that it stands on; that goes on from it
};

class Surroundings {
 public:
  struct Options {
    std::vector<Solid> guides;     ///< growth stays inside the union of these; none: everywhere
    std::vector<Solid> obstacles;  ///< growth stays outside of all
    ShadowOptions shadow;
    double clearance = 0;  ///< that limbs keep from each other beyond their radii, m
  };
  Surroundings(Options options, Job& job);

  /// What may be grown into is left of a point before the surface of guides and obstacles: positive where
  /// growth may be, negative past the surface. 1e9 where there is neither guide nor obstacle.
  double room_at(const glm::dvec3& point) const;
  /// The unit vector to the point of an obstacle that is nearest, or of a guide where there is no obstacle; 0
  /// on it or where there is neither.
  glm::dvec3 toward_surface(const glm::dvec3& point) const;

  /// Forgets all that has grown and takes these instead.
  void settle(std::span<const Stretch> grown);
  /// May the tip grow by `length` along its heading: inside, outside, and clear of what has grown?
  bool is_free(const Prober& prober, double length) const;
  /// 0 dark to 1 open sky; a tip's own shade is not counted.
  double light_at(const glm::dvec3& point) const;

  bool bounds_growth() const { return !options_.guides.empty() || !options_.obstacles.empty(); }

 private:
  struct Cell {
    std::uint64_t key;
    std::uint32_t stretch;
  };
  struct Shade {
    std::uint64_t key;
    double amount;
  };
  void cast_shadows();
  bool collides(const Prober& prober, const glm::dvec3& from, const glm::dvec3& to) const;

  Options options_;
  Job& job_;
  double cell_ = 1;  ///< of the grid of stretches
  std::vector<Stretch> grown_;
  Array<Cell> cells_;    ///< sorted
  Array<Shade> shades_;  ///< sorted, one a cell
};

enum class Membership { centre, whole, clipped };

/// Takes away every internode that is not inside guides and outside obstacles, and all that grows from it:
/// judged by its centre, by all of it (nine points along it), or cut off where it crosses the surface.
/// Outlines and organs go with their joint, and where their own centre is not inside (membership whole: any
/// vertex).
void prune(Skeleton& skeleton, const Surroundings& surroundings, Membership membership, Job& job);

}  // namespace seedmesh

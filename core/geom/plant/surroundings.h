#pragma once
/// The surroundings of a growing plant: solids that bound it or are obstacles, what has grown already, and
/// the light at a point. Open L-systems query it (Mech and Prusinkiewicz, "Visual Models of Plants
/// Interacting with Their Environment", 1996), and prune() removes what has grown into it.
#include <span>
#include <vector>

#include "core/base/rng.h"
#include "core/geom/mesh/solid.h"
#include "core/geom/plant/key_sums.h"
#include "core/geom/plant/limbs.h"

namespace seedmesh {

/// Light by shadow voxels (Palubicki et al., "Self-organizing tree models for image synthesis", 2009, section
/// 4.1.2). Limbs in a cell shade the cells below it in a pyramid, by shade * falloff^-q in the q-th
/// layer below.
struct ShadowOptions {
  double cell = 0.5;     ///< m
  double shade = 0.2;    ///< shade of the cell itself
  double falloff = 1.6;  ///< divisor of the shade from layer to layer
  int layers = 6;        ///< number of layers below the cell
};

/// An internode with which others can collide.
struct GrownInternode {
  glm::dvec3 from{0}, to{0};
  double radius = 0;
  std::uint32_t system = 0;
  std::uint32_t joint = 0, parent = 0;  ///< joints in the system's Limbs
  /// Identifiers of the limb of this internode, and of the limb of its parent joint.
  std::uint32_t limb = 0, limb_below = 0;
};

/// A tip that queries. A query ignores:
/// - the limb of the tip, and the limb that continues it with the first internodes of its side limbs;
/// - internodes that start at the joint or the position of the tip;
/// - the last internodes below the tip.
struct GrowthTip {
  glm::dvec3 position{0}, heading{0, 1, 0};
  double radius = 0;
  std::uint32_t system = 0;
  std::uint32_t joint = Limbs::none;  ///< the last joint on its branch
  /// The limb that it is on, and the limb that continues from it.
  std::uint32_t limb = Limbs::none, limb_ahead = Limbs::none;
};

class Surroundings {
 public:
  struct Options {
    std::vector<Solid> guides;     ///< growth stays inside the union of these; empty: everywhere
    std::vector<Solid> obstacles;  ///< growth stays outside all of these
    ShadowOptions shadow;
    double clearance = 0;  ///< the distance that limbs keep from each other beyond their radii, m
  };
  Surroundings(Options options, Job& job);

  /// Returns the signed distance from a point to the surface of guides and obstacles, in metres: positive where
  /// growth is allowed. 1e9 where there are neither guides nor obstacles.
  double signed_distance_at(const glm::dvec3& point) const;
  /// True where signed_distance_at() is negative; faster, because most points need no distance.
  bool forbids(const glm::dvec3& point) const;
  /// Returns the unit vector to the nearest point of an obstacle, or of a guide where there are no obstacles; 0 on
  /// the surface or where there are neither.
  glm::dvec3 toward_surface(const glm::dvec3& point) const;

  /// Replaces all internodes by copies of `grown`.
  void set_internodes(std::span<const GrownInternode> grown);
  /// True where the tip may grow by `length` along its heading: inside guides, outside obstacles, and clear of
  /// other limbs.
  bool is_free(const GrowthTip& tip, double length);
  /// Returns the light at a point, from 0 (dark) to 1 (open sky). A tip's own shade is not counted.
  double light_at(const glm::dvec3& point);

  bool bounds_growth() const { return !options_.guides.empty() || !options_.obstacles.empty(); }

 private:
  struct Cell {
    std::uint64_t key;
    std::uint32_t internode;
  };
  void fill_cells();
  void cast_shadows();
  std::size_t bucket_of(std::uint64_t key) const { return mix(key) & (starts_.size() - 2); }
  bool collides(const GrowthTip& tip, const glm::dvec3& from, const glm::dvec3& to) const;

  Options options_;
  Job& job_;
  double cell_ = 1;  ///< cell size of the grid of internodes
  std::vector<GrownInternode> grown_;
  /// Whether `cells_` and `shades_` belong to `grown_`. They are computed on first use.
  bool has_cells_ = false, has_shades_ = false;
  Array<Cell> cells_;            ///< cells by bucket of their key, then by number of the stretch
  Array<std::uint32_t> starts_;  ///< start of each bucket in `cells_`, and the end
  KeySums shades_;               ///< the shade of each cell
};

enum class Membership { centre, whole, clipped };

/// The shares of internodes that lie inside, kept from one call of prune() to the next: a growing plant is pruned after
/// each step, and most of its internodes do not change.
class ShareCache {
 public:
  explicit ShareCache(const Job& job) : entries_(job) {}

  /// Returns the share of an internode, or null. The pointer is valid until the next call of keep().
  const double* find(const glm::vec3& from, const glm::vec3& to) const;
  void keep(const glm::vec3& from, const glm::vec3& to, double share);

 private:
  struct Entry {
    glm::vec3 from{0}, to{0};
    double share = -1;  ///< -1: empty
  };
  std::size_t slot_of(const glm::vec3& from, const glm::vec3& to) const;
  void grow();

  Array<Entry> entries_;
  std::size_t count_ = 0;
};

/// Removes every internode that is not inside guides and outside obstacles, and all that grows from it.
/// Membership is decided by its centre, by nine points along it, or the internode is cut at the surface.
/// Outlines and organs are removed with their joint, and where their own centre is not inside (with whole
/// membership: any vertex). `known` may be null; it belongs to these surroundings and this membership.
void prune(Skeleton& skeleton, const Surroundings& surroundings, Membership membership, ShareCache* known,
           Job& job);

}  // namespace seedmesh

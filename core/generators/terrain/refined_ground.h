#pragma once
/// Refined ground: the surface between the samples of a field, and small forms on it.
///
/// The surface is a Catmull-Rom spline through the samples. Forms are octaves of gradient noise whose shape depends on
/// the class of ground: hummocks and tussocks of grass, ridges, ledges and outcrops of rock, lumps of scree, ripples of
/// sand. They depend on the position in the world and end at the reach of the refinement and at the border of the field.
#include <vector>

#include "core/generators/terrain/ground_shares.h"
#include "core/generators/terrain/octave.h"
#include "core/generators/terrain/refinement.h"

namespace seedmesh::terrain {

/// The ground at a point.
struct RefinedPoint {
  float height = 0;
  float weight = 0;  ///< weight of the forms: 1 near the point of the refinement, 0 beyond its reach
  float small = 0;   ///< forms smaller than a metre: height / amplitude, about -1 in hollows, 1 on tops
  Site site;         ///< its slope is that of the field, more on outcrops
};

/// The refined ground of a field. It keeps copies of the samples that it needs, so the field may be released.
class RefinedGround {
 public:
  /// `world`: window of the field in its world.
  RefinedGround(const Refinement& refinement, const GroundColors& colors, const Field& field,
                const Window& world, Rng rng, const Job& job);

  const Refinement& refinement() const { return refinement_; }
  /// Returns true in a divided square. `x` and `z` are metres to the east and south of the north-west sample.
  bool contains(double x, double z) const;

  /// Returns points one after the other. For one thread. Cost: about 0.3 microseconds for a point.
  class Sampler {
   public:
    explicit Sampler(const RefinedGround& ground);
    ~Sampler();
    Sampler(const Sampler&) = delete;
    Sampler& operator=(const Sampler&) = delete;
    /// Metres to the east and south of the north-west sample, within the window of the refinement.
    RefinedPoint at(double x, double z);

   private:
    struct Waves;
    struct Form;
    class Blocks;
    float outcrop_noise(double x, double z);
    Waves waves(double x, double z, float step, bool is_stony);
    Form form(const GroundShares& shares, const Waves& waves, const Site& site, float outcrop) const;

    const RefinedGround& ground_;
    std::vector<OctavePath> octaves_, wide_, outcrops_;
    std::vector<Blocks> blocks_;
  };

 private:
  double spline(double x, double z) const;
  float weight(double x, double z) const;
  float step(double distance) const;

  Refinement refinement_;
  std::int32_t left_ = 0, top_ = 0;  ///< of the kept samples, in samples of the field
  Field heights_;                    ///< kept samples, with those around them
  std::vector<Site> sites_;          ///< of the kept samples, row by row
  std::vector<GroundShares> shares_;
  double world_east_ = 0, world_south_ = 0;  ///< position of the north-west sample of the field
  Rng rng_;
};

}  // namespace seedmesh::terrain

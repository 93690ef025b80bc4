#pragma once
/// The classes of ground at any position of a terrain.
#include <memory>

#include "core/generators/terrain/refined_ground.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

/// Colours of a field by the parameters of its terrain.
GroundColors colors_of(const TerrainParams& params, const Range& range);

class GroundCover {
 public:
  /// `refined` may be null. Takes 24 bytes and about 60 ns for each sample.
  GroundCover(const TerrainParams& params, const Field& field, std::shared_ptr<const RefinedGround> refined,
              const Job& job);

  /// Returns the shares at `x` metres east and `z` metres south of the north-west sample.
  GroundShares at(double x, double z) const;

 private:
  GroundColors colors_;
  std::shared_ptr<const RefinedGround> refined_;
  std::int32_t width_, depth_;
  double cell_;
  Array<GroundShares> shares_;
};

}  // namespace seedmesh::terrain

#pragma once
/// Copies of meshes in a tile, written as EXT_mesh_gpu_instancing.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/generators/world/glb.h"

namespace seedmesh::world {

class Instances {
 public:
  /// Adds a copy. `at`: relative to the middle of the tile, +Y up. `turn`: a unit quaternion about +Y as (y, w).
  void add(const std::array<double, 3>& at, const std::array<float, 3>& scale);
  void add(const std::array<double, 3>& at, const std::array<float, 3>& scale,
           const std::array<float, 2>& turn);
  /// Sets the linear tint of the copy that was added last. Either all copies have a tint or none has. It is the
  /// attribute _COLOR_0, which clients without support for it ignore.
  void tint(const std::array<std::uint8_t, 4>& color) {
    tints_.insert(tints_.end(), color.begin(), color.end());
  }
  std::size_t count() const { return scales_.size() / 3; }

  /// Adds a node for each mesh. All nodes have the same copies.
  void add_to(Glb& glb, const std::string& name, const std::vector<int>& meshes) const;

 private:
  std::vector<float> translations_, scales_;
  std::vector<std::int16_t> turns_;  ///< parts of quaternions by 32767
  std::vector<std::uint8_t> tints_;
  std::array<float, 3> low_{}, high_{};
};

}  // namespace seedmesh::world

#pragma once
/// Copies of meshes in a tile, written as EXT_mesh_gpu_instancing.
#include <array>
#include <string>
#include <vector>

#include "core/generators/world/glb.h"

namespace seedmesh::world {

class Instances {
 public:
  /// `at`: relative to the middle of the tile, +Y up. `turn`: a unit quaternion about +Y as (y, w).
  void add(const std::array<double, 3>& at, const std::array<float, 3>& scale);
  void add(const std::array<double, 3>& at, const std::array<float, 3>& scale,
           const std::array<float, 2>& turn);
  std::size_t count() const { return scales_.size() / 3; }

  /// A node for each mesh; all share the copies.
  void add_to(Glb& glb, const std::string& name, const std::vector<int>& meshes) const;

 private:
  std::vector<float> translations_, scales_, turns_;
  std::array<float, 3> low_{}, high_{};
};

}  // namespace seedmesh::world

#pragma once
/// What tests of the skin ask of several barks at once.
#include <vector>

#include "core/geom/plant/skin.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {

/// All barks as the primitives of one mesh, as they go into the file.
inline MeshMeasures measure_all(const std::vector<Bark>& barks) {
  std::vector<const Mesh*> primitives;
  for (const Bark& bark : barks) primitives.push_back(&bark.mesh);
  return measure(primitives);
}

}  // namespace seedmesh

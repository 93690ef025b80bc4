#include "core/model/widen.h"

#include <algorithm>

namespace seedmesh {

void widen(Model& model, const Job& job) {
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      Indices& index = primitive.mesh.index;
      if (index.small.empty()) continue;
      index.wide = Array<std::uint32_t>(job, index.small.size());
      std::copy(index.small.begin(), index.small.end(), index.wide.begin());
      index.small = Array<std::uint16_t>(job);
    }
  }
}

}  // namespace seedmesh

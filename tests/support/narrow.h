#pragma once
/// Converts indices to 16 bits, as finish() does for a model.
#include <algorithm>

#include "core/model/mesh.h"

namespace seedmesh {

inline void narrow(Mesh& mesh, const Job& job) {
  Array<std::uint16_t> small(job, mesh.index.wide.size());
  std::transform(mesh.index.wide.begin(), mesh.index.wide.end(), small.begin(),
                 [](std::uint32_t i) { return static_cast<std::uint16_t>(i); });
  mesh.index.small = std::move(small);
  mesh.index.wide = Array<std::uint32_t>(job);
}

}  // namespace seedmesh

#include "core/geom/plant/limbs.h"

namespace seedmesh {

Limbs::Limbs(const Job& job)
    : position(job),
      radius(job),
      base_radius(job),
      parent(job),
      starts_limb(job),
      color(job),
      order(job),
      frame(job),
      contour(job),
      birth(job),
      key(job),
      anchor(job),
      share(job) {}

}  // namespace seedmesh

#include "core/geom/plant/organ_tangents.h"

#include "core/base/quick_math.h"

namespace seedmesh {

std::vector<TextureAxes> texture_axes(const Mesh& surface) {
  std::vector<TextureAxes> axes(surface.position.size());
  const Array<glm::vec2>& uv = surface.uv[0];
  const std::uint32_t* corner = surface.index.wide.data();
  for (const std::uint32_t* end = corner + surface.index.wide.size(); corner != end; corner += 3) {
    const glm::vec2 s = uv[corner[1]] - uv[corner[0]], t = uv[corner[2]] - uv[corner[0]];
    const float area = s.x * t.y - s.y * t.x;
    if (area == 0) continue;
    const glm::vec3 a = surface.position[corner[1]] - surface.position[corner[0]],
                    b = surface.position[corner[2]] - surface.position[corner[0]];
    // Divided by the sign of the area in the texture, not by the area: large triangles count more.
    const float sign = area < 0 ? -1.0F : 1.0F;
    for (int k = 0; k < 3; ++k) {
      axes[corner[k]].u += (a * t.y - b * s.y) * sign;
      axes[corner[k]].v += (b * s.x - a * t.x) * sign;
    }
  }
  for (TextureAxes& each : axes) {
    each.u = math::quick_unit(each.u, glm::vec3(0));
    each.v = math::quick_unit(each.v, glm::vec3(0));
  }
  return axes;
}

}  // namespace seedmesh

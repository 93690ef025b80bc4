#include <algorithm>
#include <cmath>

#include "core/base/quick_math.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// Area of a face that cannot be told from none, as a share of the squared size of the model.
constexpr float least_area = 4e-12F;

}  // namespace

std::size_t GraftWriter::settle(std::vector<Trust>& trust, bool is_late) {
  const auto& index = mesh_.index.wide;
  const auto& position = mesh_.position;
  const auto face = [&](std::size_t t) {
    const glm::vec3 &a = position[index[3 * t]], &b = position[index[3 * t + 1]],
                    &c = position[index[3 * t + 2]];
    return glm::cross(b - a, c - a);
  };
  const std::size_t count = index.size() / 3;
  if (!loop_vertices_.empty()) {
    for (std::size_t t = 0; t < count; ++t) {
      const std::uint32_t groups[3] = {group_[index[3 * t]], group_[index[3 * t + 1]],
                                       group_[index[3 * t + 2]]};
      if ((groups[0] & groups[1] & groups[2]) == none) continue;
      const glm::vec3 normal = face(t);
      const float size = std::sqrt(glm::dot(normal, normal));
      if (!(size > 0)) continue;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        if (groups[corner] == none) continue;
        // By the angle of the face there, so that it does not matter how the surface is cut into triangles.
        const glm::vec3& here = position[index[3 * t + corner]];
        const glm::vec3 one = position[index[3 * t + (corner + 1) % 3]] - here;
        const glm::vec3 other = position[index[3 * t + (corner + 2) % 3]] - here;
        const auto angle = static_cast<float>(
            math::quick_atan2(static_cast<double>(size), static_cast<double>(glm::dot(one, other))));
        group_normal_[groups[corner]] += normal * (angle / size);
      }
    }
    for (std::size_t i = 0; i < group_.size(); ++i) {
      if (group_[i] == none) continue;
      // The mean of both surfaces, whatever the size of their faces.
      const std::size_t parent = group_[i] & ~std::uint32_t{1};
      const glm::vec3 one = math::unit(group_normal_[parent], glm::vec3{0});
      const glm::vec3 other = math::unit(group_normal_[parent + 1], glm::vec3{0});
      mesh_.normal[i] = math::unit(one + other, glm::vec3{0, 1, 0}) + 0.0F;
    }
  }
  const float least = 2 * least_area * context_.scale.size * context_.scale.size;
  std::size_t bad = 0;
  for (std::size_t limb = 0; limb + 1 < first_triangle_.size(); ++limb) {
    if (limb % 64 == 0) job_.check();
    bool is_bad = false;
    for (std::size_t t = first_triangle_[limb]; t < first_triangle_[limb + 1]; ++t) {
      const glm::vec3 normal = face(t);
      bool is_sound = glm::dot(normal, normal) > least * least;
      for (std::size_t corner = 0; is_sound && corner < 3; ++corner)
        is_sound = glm::dot(normal, mesh_.normal[index[3 * t + corner]]) > 0;
      if (is_sound) continue;
      // The fault of the openings that it touches, if it touches any.
      bool touches = false;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t group = group_[index[3 * t + corner]];
        if (group == none) continue;
        touches = true;
        Trust& child = trust[group_limb_[group / 2]];
        child = std::max(child, is_late ? Trust::closed : Trust::detached);
      }
      is_bad = is_bad || !touches;
      ++bad;
    }
    if (!is_bad) continue;
    trust[limb] = trust[limb] < Trust::closed && !is_late ? Trust::closed : Trust::none;
  }
  return bad;
}

}  // namespace seedmesh

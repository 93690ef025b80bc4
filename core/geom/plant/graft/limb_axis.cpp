#include "core/geom/plant/graft/limb_axis.h"

#include <algorithm>
#include <cmath>

#include "core/geom/plant/tube_formulas.h"

namespace seedmesh {
namespace {

// The texture does not shrink further where a limb is thinner than this share of its first radius.
constexpr float thinnest_share = 0.2F;

}  // namespace

std::size_t LimbAxis::piece_at(float s, std::size_t from) const {
  std::size_t piece = std::min(from, pieces() - 1);
  while (piece + 1 < pieces() && s > at[piece + 1]) ++piece;
  while (piece > 0 && s < at[piece]) --piece;
  return piece;
}

/// New elements are written by the caller.
void LimbAxis::resize(std::size_t points) {
  point.resize(points);
  at.resize(points);
  radius.resize(points);
  joint.resize(points);
  along.resize(points - 1);
}

bool LimbAxis::read(const Limbs& limbs, const Chains& chains, std::uint32_t head, float shortest) {
  const bool is_root = limbs.parent[head] == Limbs::none;
  std::uint32_t next = is_root ? chains.next[head] : head;
  const std::uint32_t start = is_root ? head : limbs.parent[head];
  along.clear();
  if (next == Limbs::none) return false;
  order = limbs.order.empty() ? 0 : limbs.order[next];
  std::size_t most = 1;
  for (std::uint32_t each = next; each != Limbs::none; each = chains.next[each]) ++most;
  resize(most);
  std::size_t last = 0;
  glm::vec3 from = limbs.position[start];
  float end = 0;
  point[0] = from;
  at[0] = 0;
  radius[0] = limbs.base_radius[next];
  joint[0] = start;
  for (; next != Limbs::none; next = chains.next[next]) {
    const glm::vec3 step = limbs.position[next] - from;
    const float length = std::sqrt(glm::dot(step, step));
    if (length <= shortest) continue;
    if (last > 0) radius[last] = std::max(radius[last], limbs.base_radius[next]);
    along[last++] = step * (1 / length);
    point[last] = from = limbs.position[next];
    at[last] = end += length;
    radius[last] = limbs.radius[next];
    joint[last] = next;
  }
  resize(last + 1);
  return !along.empty();
}

void LimbAxis::read_colors(const Limbs& limbs) {
  color.clear();
  for (std::size_t i = 1; i < joint.size(); ++i)
    color.push_back(limbs.color.empty() ? std::int16_t{0} : limbs.color[joint[i]]);
}

void LimbAxis::set_v(float turns, float least_repeats) {
  v.assign(1, 0.0F);
  const float least = thinnest_share * radius[0];
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const float length = at[i + 1] - at[i];
    const float mean = std::max(0.5F * (radius[i] + radius[i + 1]), least);
    v.push_back(v.back() +
                (turns > 0 ? length * turns / texture_radius(mean, radius[0], least_repeats) : length));
  }
}

void LimbAxis::set_frames(const glm::vec3& first) {
  u.resize(along.size());
  u[0] = first;
  for (std::size_t i = 1; i < along.size(); ++i) u[i] = least_rotation(u[i - 1], along[i - 1], along[i]);
}

glm::vec3 least_rotation(glm::vec3 u, const glm::vec3& from, const glm::vec3& to) {
  const float cosine = glm::dot(from, to);
  if (cosine > -0.999F) u -= (from + to) * (glm::dot(u, to) / (1 + cosine));
  u -= to * glm::dot(u, to);
  return unit_again(u, [&] { return unit_perpendicular(to); });
}

}  // namespace seedmesh

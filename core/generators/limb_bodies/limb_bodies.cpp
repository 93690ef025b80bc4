#include "core/generators/limb_bodies/limb_bodies.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quick_math.h"
#include "core/geom/plant/graft/limb_axis.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"

namespace seedmesh {
namespace {

constexpr int sides = 8;
constexpr std::size_t most_bodies = 32;
constexpr float least_share = 1.0F / 3;
// A body continues along a limb while the limb stays within this share of its radius of a straight line.
constexpr float off_share = 0.35F;

/// Appends the limb that begins at `head` as straight bodies, as far as it is not thinner than `thinnest`.
void cut(const Limbs& limbs, const Chains& chains, std::uint32_t head, float thinnest,
         std::vector<LimbBody>& out) {
  LimbAxis axis;
  if (!axis.read(limbs, chains, head, 0)) return;
  std::size_t last = axis.point.size() - 1;
  while (last > 0 && axis.radius[last] < thinnest) --last;
  if (last == 0) return;
  for (std::size_t first = 0; first < last;) {
    std::size_t next = first + 1;
    const auto is_straight = [&](std::size_t to) {
      const glm::vec3 along = axis.point[to] - axis.point[first];
      const float length = glm::dot(along, along);
      for (std::size_t i = first + 1; i < to; ++i) {
        const glm::vec3 off = axis.point[i] - axis.point[first];
        const glm::vec3 aside = off - along * (length > 0 ? glm::dot(off, along) / length : 0);
        if (glm::dot(aside, aside) > off_share * off_share * axis.radius[i] * axis.radius[i]) return false;
      }
      return true;
    };
    while (next < last && is_straight(next + 1)) ++next;
    out.push_back({axis.point[first], axis.point[next], axis.radius[first], axis.radius[next]});
    first = next;
  }
}

Mesh prism(const LimbBody& body, const Job& job) {
  Mesh mesh = empty_mesh(job);
  const glm::vec3 along = math::unit(body.to - body.from, glm::vec3{0, 1, 0});
  const glm::vec3 u = unit_perpendicular(along), v = glm::cross(along, u);
  const float length = std::sqrt(glm::dot(body.to - body.from, body.to - body.from));
  const float slope = (body.base - body.end) / std::max(length, 1e-6F);
  const auto add = [&](const glm::vec3& position, const glm::vec3& normal) {
    mesh.position.push_back(position + 0.0F);
    mesh.normal.push_back(normal + 0.0F);
    return static_cast<std::uint32_t>(mesh.position.size() - 1);
  };
  const auto out_at = [&](int corner) {
    const math::SinCos at = math::quick_sincos_degrees(360.0 / sides * corner);
    return u * static_cast<float>(at.cos) + v * static_cast<float>(at.sin);
  };
  for (int i = 0; i < sides; ++i) {
    const glm::vec3 a = out_at(i), b = out_at((i + 1) % sides);
    const glm::vec3 normal = math::unit(a + b + along * (2 * slope), a);
    const std::uint32_t corner[4] = {
        add(body.from + a * body.base, normal), add(body.from + b * body.base, normal),
        add(body.to + b * body.end, normal), add(body.to + a * body.end, normal)};
    for (const int k : {0, 1, 2, 0, 2, 3}) mesh.index.wide.push_back(corner[k]);
  }
  for (const bool is_end : {false, true}) {
    const glm::vec3 normal = is_end ? along : -along, centre = is_end ? body.to : body.from;
    std::vector<std::uint32_t> rim;
    for (int i = 0; i < sides; ++i)
      rim.push_back(add(centre + out_at(is_end ? i : sides - i) * (is_end ? body.end : body.base), normal));
    for (std::size_t i = 1; i + 1 < rim.size(); ++i) {
      for (const std::size_t k : {std::size_t{0}, i, i + 1}) mesh.index.wide.push_back(rim[k]);
    }
  }
  return mesh;
}

}  // namespace

std::vector<LimbBody> limb_bodies(const Limbs& limbs, BelowGround below, Job& job) {
  std::vector<LimbBody> bodies;
  if (limbs.size() < 2) return bodies;
  const Chains chains = link_chains(limbs, job);
  struct Thick {
    float radius;
    std::uint32_t head;
  };
  std::vector<Thick> thick;
  float trunk = 0;
  for (const std::uint32_t head : chains.head) {
    const bool is_root = limbs.parent[head] == Limbs::none;
    const std::uint32_t first = is_root ? chains.next[head] : head;
    if (first == Limbs::none) continue;
    const bool is_below = below == BelowGround::left_out && limbs.position[first].y <= 0;
    const float radius = limbs.radius[first];
    if (is_root) trunk = std::max(trunk, radius);
    if (!is_below || is_root) thick.push_back({radius, head});
  }
  std::stable_sort(thick.begin(), thick.end(),
                   [](const Thick& a, const Thick& b) { return a.radius > b.radius; });
  for (const Thick& each : thick) {
    if (!(each.radius > 0) || each.radius < least_share * trunk || bodies.size() >= most_bodies) break;
    cut(limbs, chains, each.head, 0.5F * least_share * trunk, bodies);
  }
  if (bodies.size() > most_bodies) bodies.resize(most_bodies);
  return bodies;
}

void add_limb_bodies(Model& model, const std::vector<LimbBody>& bodies, const GenerateContext& context) {
  Job& job = context.job;
  if (context.demand.collision == CollisionNames::none || bodies.empty()) return;
  std::vector<Mesh> prisms;
  for (const LimbBody& body : bodies) {
    prisms.push_back(prism(body, job));
    job.spend(Resource::triangles, prisms.back().elements());
  }
  add_collision_shapes(model, context.demand.collision, "bark", std::move(prisms));
}

}  // namespace seedmesh

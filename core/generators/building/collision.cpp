#include "core/generators/building/collision.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/body_surface.h"
#include "core/generators/building/hull.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"

namespace seedmesh::building {
namespace {

constexpr std::size_t most_bodies = 32, most_masses = 2'000, most_cuts = 6;
constexpr double least_share = 1e-3, carried_share = 0.05, good_share = 0.92, least_gain = 0.04;

/// A solid and its convex hull, in metres of the world.
struct Mass {
  Solid solid, hull;
  double volume = 0, hull_volume = 0;
  bool is_done = false;  ///< no cut makes its hulls smaller
};

Mass mass_of(Solid solid) {
  Mass mass;
  mass.volume = volume_of(solid, glm::dvec3(1));
  mass.hull = hull_of(solid.points);
  mass.hull_volume = volume_of(mass.hull, glm::dvec3(1));
  mass.solid = std::move(solid);
  return mass;
}

double box_volume(const glm::dvec3& size) { return size.x * size.y * size.z; }

/// The bodies that are taken apart into faces or drawn as a whole. Bodies on faces of others, such as windows
/// and roofs, count if they are large.
std::vector<DecomposedBody> masses_of(const Shapes& shapes) {
  std::vector<DecomposedBody> out = shapes.masses;
  double largest = 0;
  for (const DecomposedBody& each : out) largest = std::max(largest, box_volume(each.size));
  for (const bool is_carried : {false, true}) {
    const double least = is_carried ? carried_share * largest : 0;
    for (const Shape& shape : shapes.shapes) {
      if (!shape.is_active || shape.is_carried != is_carried || dimension(shape.size) < 3) continue;
      if (box_volume(shape.size) < least || out.size() == most_masses) continue;
      const bool is_box = shape.geometry == box_geometry || (shape.geometry & asset_bit) != 0;
      if (!is_box && !shapes.solid_of(shape.geometry).is_closed) continue;
      out.push_back({shape.origin, shape.size, shape.axes, shape.geometry});
      if (!is_carried) largest = std::max(largest, box_volume(shape.size));
    }
  }
  return out;
}

/// Whether the hull contains the other hull, to within a hundredth of its size.
bool contains(const Mass& mass, const Mass& other) {
  const double near = 0.01 * math::cbrt(mass.hull_volume);
  return std::ranges::all_of(mass.hull.faces, [&](const Face& face) {
    const glm::dvec3 normal = math::unit(area_vector(mass.hull, face, glm::dvec3(1)), glm::dvec3(0, 1, 0));
    const glm::dvec3 base = mass.hull.points[mass.hull.corners[mass.hull.loops[face.first_loop].first]];
    return std::ranges::all_of(other.hull.points,
                               [&](const glm::dvec3& p) { return glm::dot(normal, p - base) <= near; });
  });
}

/// Cuts a mass in two so that the hulls are as small as possible. False: no cut makes them much smaller.
bool cut_in_two(Mass& mass, Mass& other, Job& job) {
  double best = mass.hull_volume * (1 - least_gain);
  Mass low_part, high_part;
  bool is_cut = false;
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mass.solid.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    const double extent = high[axis] - low[axis];
    for (const glm::dvec3& p : mass.solid.points) {
      const double at = p[axis];
      if (at > low[axis] + 0.02 * extent && at < high[axis] - 0.02 * extent) places.push_back(at);
    }
    std::ranges::sort(places);
    places.erase(
        std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a < 0.01 * extent; }),
        places.end());
    const std::size_t every = 1 + places.size() / most_cuts;
    for (std::size_t i = 0; i < places.size(); i += every) {
      job.check();
      Mass a = mass_of(clipped(mass.solid, axis, places[i], 1));
      Mass b = mass_of(clipped(mass.solid, axis, places[i], -1));
      const double sum = a.hull_volume + b.hull_volume;
      if (a.hull.faces.empty() || b.hull.faces.empty() || sum >= best) continue;
      best = sum;
      low_part = std::move(a);
      high_part = std::move(b);
      is_cut = true;
    }
  }
  if (!is_cut) return false;
  mass = std::move(low_part);
  other = std::move(high_part);
  return true;
}

Mesh mesh_of(const Solid& hull, Job& job) {
  Mesh mesh = empty_mesh(job);
  BodySurface surface;
  SurfaceBuilder().solid(hull, glm::dvec3(1), surface);
  job.spend(Resource::triangles, surface.index.size() / 3);
  for (std::size_t i = 0; i < surface.position.size(); ++i) {
    mesh.position.push_back(glm::vec3(surface.position[i]));
    mesh.normal.push_back(glm::vec3(surface.normal[i]) + 0.0F);
  }
  for (const std::uint32_t i : surface.index) mesh.index.wide.push_back(i);
  return mesh;
}

}  // namespace

void add_collision(Model& model, const Shapes& shapes, const GenerateContext& context) {
  Job& job = context.job;
  if (context.demand.collision == CollisionNames::none) return;
  std::vector<Mass> masses;
  for (const DecomposedBody& each : masses_of(shapes)) {
    const bool is_box = each.geometry == box_geometry || (each.geometry & asset_bit) != 0;
    Solid solid = is_box ? unit_box() : shapes.solid_of(each.geometry);
    for (glm::dvec3& p : solid.points) p = each.origin + shapes.axes[each.axes] * (p * each.size);
    masses.push_back(mass_of(std::move(solid)));
    job.check();
  }
  const auto is_larger = [](const Mass& a, const Mass& b) { return a.hull_volume > b.hull_volume; };
  std::ranges::stable_sort(masses, is_larger);
  if (masses.size() > 2 * most_bodies) masses.resize(2 * most_bodies);
  std::vector<Mass> outer;
  for (Mass& mass : masses) {
    if (outer.size() < most_bodies &&
        std::ranges::none_of(outer, [&](const Mass& each) { return contains(each, mass); }))
      outer.push_back(std::move(mass));
  }
  masses = std::move(outer);
  // The mass whose hull has most empty volume is cut first, up to the limit of bodies.
  while (masses.size() < most_bodies) {
    Mass* worst = nullptr;
    for (Mass& mass : masses) {
      if (mass.is_done || mass.volume >= good_share * mass.hull_volume) continue;
      if (worst == nullptr || mass.hull_volume - mass.volume > worst->hull_volume - worst->volume)
        worst = &mass;
    }
    if (worst == nullptr) break;
    Mass other;
    if (cut_in_two(*worst, other, job)) {
      masses.push_back(std::move(other));
    } else {
      worst->is_done = true;
    }
  }
  std::ranges::stable_sort(masses, is_larger);
  if (masses.empty()) return;
  const double least = least_share * masses.front().hull_volume;
  std::erase_if(masses,
                [&](const Mass& mass) { return mass.hull.faces.empty() || mass.hull_volume < least; });
  std::vector<Mesh> hulls;
  hulls.reserve(masses.size());
  for (const Mass& mass : masses) hulls.push_back(mesh_of(mass.hull, job));
  add_collision_shapes(model, context.demand.collision, "building", std::move(hulls));
}

}  // namespace seedmesh::building

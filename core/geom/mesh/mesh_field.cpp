#include "core/geom/mesh/mesh_field.h"

#include <algorithm>
#include <cmath>

#include "core/model/build.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t triangles_a_leaf = 8;
constexpr std::size_t check_interval = 4096;

/// Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
glm::dvec3 nearest_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                               const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return sum > 0 ? a + ab * (vb / sum) + ac * (vc / sum) : a;
}

double squared_distance(const glm::dvec3& p, const glm::vec3& low, const glm::vec3& high) {
  const glm::dvec3 apart = p - glm::clamp(p, glm::dvec3(low), glm::dvec3(high));
  return glm::dot(apart, apart);
}

/// No edge of a model that is drawn by rule runs this way. The ray leaves the model along its shortest side, where it
/// meets the fewest boxes.
glm::dvec3 ray_across(const glm::vec3& extent) {
  constexpr glm::dvec3 main_y{0.2871537, 0.9133127, 0.2887301};
  if (extent.y <= extent.x && extent.y <= extent.z) return main_y;
  return extent.x <= extent.z ? glm::dvec3(main_y.y, main_y.x, main_y.z)
                              : glm::dvec3(main_y.x, main_y.z, main_y.y);
}

bool ray_meets_box(const glm::dvec3& from, const glm::dvec3& by_ray, const glm::vec3& low,
                   const glm::vec3& high) {
  double enter = 0, leave = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    // The ray runs upwards along every axis, so that it meets `low` first.
    enter = std::max(enter, (double{low[axis]} - from[axis]) * by_ray[axis]);
    leave = std::min(leave, (double{high[axis]} - from[axis]) * by_ray[axis]);
  }
  constexpr double slack = 1e-12;  // of rounding: a box too many costs time, one too few an intersection
  return enter <= leave * (1 + slack);
}

/// Moeller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
bool ray_meets_triangle(const glm::dvec3& from, const glm::dvec3& ray, const glm::dvec3& a,
                        const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, across = glm::cross(ray, ac);
  const double determinant = glm::dot(ab, across);
  if (determinant == 0) return false;
  // All quantities are multiplied by the determinant, made positive, instead of divided by it.
  const double sign = determinant > 0 ? 1 : -1, whole = determinant * sign;
  const glm::dvec3 to = from - a;
  const double u = glm::dot(to, across) * sign;
  if (u < 0 || u > whole) return false;
  const glm::dvec3 q = glm::cross(to, ab);
  const double v = glm::dot(ray, q) * sign;
  return v >= 0 && u + v <= whole && glm::dot(ac, q) * sign > 0;
}

}  // namespace

MeshField::MeshField(const Model& model, const glm::dvec3& stretch, const glm::dvec3& shift, const Job& job)
    : corner_(job) {
  const auto add = [&](const MeshGroup& group, const glm::dmat4& matrix) {
    for (const Primitive& primitive : group.primitives) {
      const Mesh& mesh = primitive.mesh;
      if (mesh.topology != Topology::triangles) continue;
      for (std::size_t i = 0; i < mesh.index.size(); ++i) {
        if (i % check_interval == 0) job.check();
        const glm::dvec3 at = matrix * glm::dvec4(glm::dvec3(mesh.position[mesh.index.at(i)]), 1);
        corner_.push_back(glm::vec3(at * stretch + shift));
      }
    }
  };
  const std::vector<glm::dmat4> world = world_matrices(model);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.mesh < 0) continue;
    const MeshGroup& group = model.meshes[static_cast<std::size_t>(node.mesh)];
    if (node.instances.transforms.empty()) add(group, world[i]);
    for (const Transform& t : node.instances.transforms) add(group, world[i] * matrix_of(t));
  }
  build_all(job);
}

MeshField::MeshField(std::span<const Mesh* const> meshes, const Job& job) : corner_(job) {
  for (const Mesh* mesh : meshes) {
    for (std::size_t i = 0; i < mesh->index.size(); ++i) {
      if (i % check_interval == 0) job.check();
      corner_.push_back(mesh->position[mesh->index.at(i)]);
    }
  }
  build_all(job);
}

void MeshField::build_all(const Job& job) {
  std::vector<std::uint32_t> order(triangles());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  if (order.empty()) return;
  bvh_nodes_.reserve(order.size() / 2 + 1);
  build(0, static_cast<std::uint32_t>(order.size()), order);
  Array<glm::vec3> sorted(job, corner_.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) sorted[3 * i + k] = corner_[3 * std::size_t{order[i]} + k];
  }
  corner_ = std::move(sorted);
}

std::uint32_t MeshField::build(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order) {
  const auto own = static_cast<std::uint32_t>(bvh_nodes_.size());
  BvhNode bvh_node;
  bvh_node.low = bvh_node.high = corner_[3 * std::size_t{order[first]}];
  glm::vec3 low(1e30F), high(-1e30F);  // of the triangles' centres, times three
  const auto centre = [&](std::uint32_t t) {
    const std::size_t at = 3 * std::size_t{t};
    return corner_[at] + corner_[at + 1] + corner_[at + 2];
  };
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      bvh_node.low = glm::min(bvh_node.low, corner_[3 * std::size_t{order[i]} + k]);
      bvh_node.high = glm::max(bvh_node.high, corner_[3 * std::size_t{order[i]} + k]);
    }
    low = glm::min(low, centre(order[i]));
    high = glm::max(high, centre(order[i]));
  }
  bvh_node.first = first;
  bvh_node.count = count;
  bvh_nodes_.push_back(bvh_node);
  if (count <= triangles_a_leaf) return own;
  const glm::vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const float at_a = centre(a)[axis], at_b = centre(b)[axis];
    return at_a != at_b ? at_a < at_b : a < b;
  });
  build(first, half, order);
  const std::uint32_t second = build(first + half, count - half, order);
  bvh_nodes_[own].first = second;
  bvh_nodes_[own].count = 0;
  return own;
}

MeshField::Nearest MeshField::nearest(const glm::dvec3& point, std::uint32_t guess) const {
  // The guess only limits the search, and by a little more than its distance. So the first of several triangles at the
  // same distance is found, whatever the guess.
  constexpr double more = 1 + 1e-9, least_limit = 1e-300;
  const glm::dvec3 on_guess =
      nearest_on_triangle(point, corner(guess, 0), corner(guess, 1), corner(guess, 2));
  double least = glm::dot(on_guess - point, on_guess - point) * more + least_limit;
  Nearest best{on_guess, 0, guess};
  struct Waiting {
    std::uint32_t bvh_node;
    double distance;  ///< squared, to its box
  };
  const auto waiting_for = [&](std::uint32_t number) {
    return Waiting{number, squared_distance(point, bvh_nodes_[number].low, bvh_nodes_[number].high)};
  };
  Waiting waiting[64];
  int count = 0;
  waiting[count++] = waiting_for(0);
  while (count > 0) {
    const auto [number, apart] = waiting[--count];
    if (apart >= least) continue;
    const BvhNode& bvh_node = bvh_nodes_[number];
    if (bvh_node.count == 0) {
      const Waiting near = waiting_for(number + 1), far = waiting_for(bvh_node.first);
      const bool swapped = far.distance < near.distance;
      waiting[count++] = swapped ? near : far;
      waiting[count++] = swapped ? far : near;
      continue;
    }
    for (std::uint32_t t = bvh_node.first; t < bvh_node.first + bvh_node.count; ++t) {
      const glm::vec3* corners = corner_.data() + 3 * std::size_t{t};
      const glm::vec3 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
      const glm::vec3 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
      if (squared_distance(point, low, high) >= least) continue;
      const glm::dvec3 on = nearest_on_triangle(point, corners[0], corners[1], corners[2]);
      const double distance = glm::dot(on - point, on - point);
      if (distance >= least) continue;
      least = distance;
      best.point = on;
      best.triangle = t;
    }
  }
  best.distance = std::sqrt(glm::dot(best.point - point, best.point - point));
  return best;
}

bool MeshField::contains(const glm::dvec3& point) const {
  if (squared_distance(point, bvh_nodes_[0].low, bvh_nodes_[0].high) > 0) return false;
  const glm::dvec3 ray = ray_across(bvh_nodes_[0].high - bvh_nodes_[0].low), by_ray = 1.0 / ray;
  bool inside = false;
  std::uint32_t waiting[64];
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t number = waiting[--count];
    const BvhNode& bvh_node = bvh_nodes_[number];
    if (!ray_meets_box(point, by_ray, bvh_node.low, bvh_node.high)) continue;
    if (bvh_node.count == 0) {
      waiting[count++] = bvh_node.first;
      waiting[count++] = number + 1;
      continue;
    }
    for (std::uint32_t t = bvh_node.first; t < bvh_node.first + bvh_node.count; ++t) {
      if (ray_meets_triangle(point, ray, corner(t, 0), corner(t, 1), corner(t, 2))) inside = !inside;
    }
  }
  return inside;
}

}  // namespace seedmesh

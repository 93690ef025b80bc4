#include "core/generators/terrain/planet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t points_a_chunk = 4096;
// Squares of a band of a face, for a vertex cache of 16 as in surface.cpp.
constexpr std::int32_t band = 6;

/// Numbers the points of the surface of a cube with `side` points along an edge: first the layer y = 0, then
/// the rims of the layers between, then the layer y = side - 1.
class CubeNumbers {
 public:
  explicit CubeNumbers(std::int32_t side) : side_(side), last_(side - 1) {}
  std::size_t count() const {
    return 6 * static_cast<std::size_t>(last_) * static_cast<std::size_t>(last_) + 2;
  }

  std::uint32_t at(std::int32_t x, std::int32_t y, std::int32_t z) const {
    const std::int64_t layer = std::int64_t{side_} * side_, rim = std::int64_t{4} * last_;
    if (y == 0) return number(std::int64_t{z} * side_ + x);
    if (y == last_) return number(layer + (side_ - 2) * rim + std::int64_t{z} * side_ + x);
    std::int64_t around = 0;
    if (z == 0) {
      around = x;
    } else if (x == last_) {
      around = last_ + z;
    } else if (z == last_) {
      around = 3 * std::int64_t{last_} - x;
    } else {
      around = 4 * std::int64_t{last_} - z;
    }
    return number(layer + (y - 1) * rim + around);
  }

 private:
  static std::uint32_t number(std::int64_t value) { return static_cast<std::uint32_t>(value); }
  std::int32_t side_, last_;
};

/// A face of the cube: its corner and its two directions. The cross product of `across` and `down` points out
/// of the cube.
struct Face {
  glm::ivec3 corner, across, down;  ///< corner: 0 or 1 times the last point
};
constexpr std::size_t faces = 6;
const std::array<Face, faces>& cube() {
  static const std::array<Face, faces> all{{
      {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},  // +Y
      {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},  // -Y
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  // +X
      {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}},  // -X
      {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  // +Z
      {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}},  // -Z
  }};
  return all;
}

/// Calls visit(x, y, z) for every point of the surface, in the order of numbers within each layer.
template <class Visit>
void each_point(std::int32_t side, const Visit& visit) {
  const std::int32_t last = side - 1;
  for (std::int32_t y = 0; y <= last; ++y) {
    const bool whole = y == 0 || y == last;
    for (std::int32_t z = 0; z <= last; ++z) {
      const bool row = whole || z == 0 || z == last;
      for (std::int32_t x = 0; x <= last; x += row ? 1 : last) visit(x, y, z);
    }
  }
}

template <class Body>
void each_chunk(const Planet& planet, const Job& job, const Body& body) {
  parallel_for(job, planet.direction.size(), points_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 body(begin, end);
               });
}

void add_normals(Mesh& mesh, const Planet& planet, const Job& job) {
  mesh.normal = Array<glm::vec3>(job, mesh.position.size(), glm::vec3(0));
  const Array<std::uint32_t>& index = mesh.index.wide;
  const auto face = [&](std::size_t i) {
    const glm::vec3& a = mesh.position[index[i]];
    return glm::cross(mesh.position[index[i + 1]] - a, mesh.position[index[i + 2]] - a);
  };
  for (std::size_t i = 0; i < index.size(); i += 3) {
    if (i % 12288 == 0) job.check();
    const glm::vec3 normal = face(i);
    for (std::size_t k = 0; k < 3; ++k) mesh.normal[index[i + k]] += normal;
  }
  for (std::size_t i = 0; i < mesh.normal.size(); ++i)
    mesh.normal[i] = math::unit(mesh.normal[i], planet.direction[i]);
  // At a cliff, the mean can face away from one of the faces; the radial direction never does.
  for (std::size_t i = 0; i < index.size(); i += 3) {
    const glm::vec3 normal = face(i);
    for (std::size_t k = 0; k < 3; ++k) {
      glm::vec3& own = mesh.normal[index[i + k]];
      if (glm::dot(normal, own) <= 0) own = planet.direction[index[i + k]];
    }
  }
}

// Moss and lichen end irregularly: the change of the slope by patches.
constexpr float ragged = 0.8F;

void add_colors(Mesh& mesh, const Planet& planet, const GroundColors& ground_colors, UpDirection upward,
                Rng rng, const Job& job) {
  NoisePlan patches;
  patches.octaves = 4;
  patches.amplitude = 0.7;
  patches.gain = 0.7;
  patches.wavelength = upward == UpDirection::along_y ? planet.radius / 2 : planet.radius / 3;
  mesh.color = Array<glm::u8vec4>(job, mesh.position.size());
  each_chunk(planet, job, [&](std::size_t begin, std::size_t end) {
    SpaceNoise noise(patches, rng);
    for (std::size_t i = begin; i < end; ++i) {
      const bool is_rock = upward == UpDirection::along_y;
      const float cosine = is_rock ? mesh.normal[i].y : glm::dot(mesh.normal[i], planet.direction[i]);
      const float up = std::clamp(cosine, 0.05F, 1.0F);
      Site site;
      site.height = is_rock ? mesh.position[i].y : planet.height[i];
      site.slope = std::sqrt(1 - up * up) / up;
      site.patch = static_cast<float>(noise.at(glm::dvec3(planet.direction[i]) * planet.radius));
      if (is_rock) site.slope += ragged * site.patch;
      const glm::dvec3 color = glm::dvec3(ground_colors.color(site)) * 255.0 + 0.5;
      mesh.color[i] = {math::to_int32(color.x), math::to_int32(color.y), math::to_int32(color.z), 255};
    }
  });
}

}  // namespace

Planet sphere_of(std::int32_t side, double radius, const Job& job) {
  const CubeNumbers numbers(side);
  Planet planet;
  planet.side = side;
  planet.radius = radius;
  planet.direction = Array<glm::vec3>(job, numbers.count());
  planet.height = Array<float>(job, numbers.count(), 0.0F);
  // Points of a row have equal angles, by tangents that are exact at the edges, where faces meet.
  std::vector<double> along(static_cast<std::size_t>(side));
  for (std::int32_t i = 0; i < side; ++i) {
    along[static_cast<std::size_t>(i)] = i == 0 ? -1
                                         : i == side - 1
                                             ? 1
                                             : math::tan(math::pi / 4 * (2.0 * i / (side - 1) - 1));
  }
  const auto at = [&](std::int32_t i) { return along[static_cast<std::size_t>(i)]; };
  each_point(side, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    const glm::dvec3 position(at(x), at(y), at(z));
    planet.direction[numbers.at(x, y, z)] = glm::vec3(math::unit(position, glm::dvec3(0, 1, 0)));
  });
  return planet;
}

void fault_sphere(Planet& planet, const FaultPlan& plan, Rng rng, const Job& job) {
  struct Fault {
    glm::vec3 axis;
    float above, below;  ///< added on the side of the axis, and on the other side
  };
  std::vector<Fault> faults(static_cast<std::size_t>(plan.planned + plan.extra));
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Rng draw = rng.at("plane").at(i);
    const double y = draw.uniform(-1, 1), flat = std::sqrt(1 - y * y);
    const math::SinCos turn = math::sincos(draw.uniform(0, 2 * math::pi));
    const auto height = static_cast<float>(fault_height(plan, static_cast<int>(i), rng));
    faults[i] = {glm::vec3(flat * turn.cos, y, flat * turn.sin), height,
                 plan.kind == FaultKind::normal ? -height : 0.0F};
  }
  each_chunk(planet, job, [&](std::size_t begin, std::size_t end) {
    for (const Fault& fault : faults) {
      for (std::size_t i = begin; i < end; ++i) {
        const glm::vec3& d = planet.direction[i];
        const float side = (d.x * fault.axis.x + d.y * fault.axis.y) + d.z * fault.axis.z;
        planet.height[i] += side > 0 ? fault.above : fault.below;
      }
    }
  });
}

void noise_sphere(Planet& planet, const NoisePlan& plan, Rng rng, const Job& job) {
  each_chunk(planet, job, [&](std::size_t begin, std::size_t end) {
    SpaceNoise noise(plan, rng);
    for (std::size_t i = begin; i < end; ++i) {
      if (i % 256 == 0) job.check();
      planet.height[i] = static_cast<float>(noise.at(glm::dvec3(planet.direction[i]) * planet.radius));
    }
  });
}

Range range_of(const Planet& planet) {
  const auto [low, high] = std::minmax_element(planet.height.begin(), planet.height.end());
  return {*low, *high};
}

Mesh planet_mesh(const Planet& planet, const GroundColors* ground_colors, UpDirection upward, Rng rng,
                 Job& job) {
  const std::int32_t last = planet.side - 1;
  const CubeNumbers numbers(planet.side);
  job.spend(Resource::triangles, 12 * static_cast<std::size_t>(last) * static_cast<std::size_t>(last));
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, planet.direction.size());
  for (std::size_t i = 0; i < planet.direction.size(); ++i) {
    // The distance from the centre stays at least a hundredth of the radius.
    const double radius =
        std::max(planet.radius + static_cast<double>(planet.height[i]), planet.radius / 100);
    mesh.position[i] = glm::vec3(glm::dvec3(planet.direction[i]) * radius);
  }
  mesh.index.wide =
      Array<std::uint32_t>(job, 36 * static_cast<std::size_t>(last) * static_cast<std::size_t>(last));
  std::uint32_t* out = mesh.index.wide.data();
  for (const Face& face : cube()) {
    const auto number = [&](std::int32_t i, std::int32_t j) {
      const glm::ivec3 at = face.corner * last + face.across * i + face.down * j;
      return numbers.at(at.x, at.y, at.z);
    };
    for (std::int32_t first = 0; first < last; first += band) {
      for (std::int32_t j = 0; j < last; ++j) {
        for (std::int32_t i = first; i < std::min(first + band, last); ++i) {
          const std::uint32_t a = number(i, j), b = number(i + 1, j), c = number(i + 1, j + 1),
                              d = number(i, j + 1);
          for (const std::uint32_t index : {a, b, c, a, c, d}) *out++ = index;
        }
      }
    }
  }
  mesh.cache_ordered = true;
  add_normals(mesh, planet, job);
  if (ground_colors) add_colors(mesh, planet, *ground_colors, upward, rng.at("patches"), job);
  return mesh;
}

}  // namespace seedmesh::terrain

#include "core/generators/tree/grown.h"

#include <cmath>

#include "core/generators/tree/grown_shoots.h"
#include "core/generators/tree/grown_skeleton.h"
#include "core/generators/tree/grown_vigour.h"

namespace seedmesh::tree {
namespace {

// An estimate visits at most this number of internodes over all years, which takes about 0.1 s.
constexpr std::uint64_t most_visited = 1'500'000;

SolidShape shape_of(const TreeObstacle& obstacle) {
  switch (obstacle.obstacle_shape) {
    case TreeObstacleShape::sphere:
      return SolidShape::sphere;
    case TreeObstacleShape::cylinder:
      return SolidShape::cylinder;
    case TreeObstacleShape::cone:
      return SolidShape::cone;
    default:
      return SolidShape::box;
  }
}

glm::dvec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Surroundings::Options obstacles_of(const TreeGrown& grown) {
  Surroundings::Options options;
  for (const TreeObstacle& given : grown.obstacles)
    options.obstacles.push_back({shape_of(given), vector_of(given.position), vector_of(given.size), nullptr});
  return options;
}

ShadowOptions shadow_of(const TreeGrown& grown) {
  const auto& light = grown.light;
  return {light.cell.value_or(grown.internode), light.shade, light.falloff, light.layers};
}

/// Adds the shadows of the cells in which obstacles have their surface.
void shade_below_obstacles(const TreeGrown& grown, const Surroundings& obstacles, double cell,
                           const GrownSite& site) {
  for (const TreeObstacle& given : grown.obstacles) {
    const glm::dvec3 size = vector_of(given.size);
    const glm::dvec3 low = vector_of(given.position) - glm::dvec3{size.x / 2, 0, size.z / 2};
    const auto steps = [&](double length) { return std::max(1, math::to_int32(std::ceil(length / cell))); };
    for (int x = 0; x < steps(size.x); ++x) {
      for (int y = 0; y < steps(size.y); ++y) {
        site.job.check();
        for (int z = 0; z < steps(size.z); ++z) {
          const glm::dvec3 point = low + (glm::dvec3{x, y, z} + 0.5) * cell;
          const double distance = obstacles.signed_distance_at(point);
          if (distance < 0 && distance > -cell) site.shadows.add(point);
        }
      }
    }
  }
}

/// A node on the ground with a bud.
void plant_seed(GrownPlant& plant, const glm::dvec3& foot, std::uint32_t tree, const GrownSite& site) {
  const Rng rng = tree == 0 ? site.random.trunk : site.random.trunk.at("neighbour").at(tree);
  GrownNode root;
  root.position = foot;
  root.axis = plant.axes++;
  root.tree = tree;
  root.key = rng.key();
  GrownBud bud;
  bud.frame = roll(Frame{}, math::quick_sincos_degrees(Rng(rng.at("roll")).uniform(0, 360)));
  bud.node = static_cast<std::uint32_t>(plant.nodes.size());
  bud.axis = root.axis;
  bud.ends_axis = true;
  bud.key = rng.at("stem").key();
  plant.nodes.push_back(root);
  plant.buds.push_back(bud);
}

void grow_year(GrownPlant& plant, const GrownSite& site, std::uint16_t year) {
  const TreeGrown& grown = site.grown;
  sense_light(plant, site);
  gather_light(plant, year - grown.shed_years);
  site.job.check();
  if (grown.allocation == TreeAllocation::priority) {
    divide_by_priority(plant, grown, site.job);
  } else {
    divide_by_lambda(plant, grown.alpha, lambda_in(grown, year));
  }
  shed_branches(plant, site, year);
  grow_shoots(plant, site, year);
  site.job.check();
  thicken(plant, grown);
}

}  // namespace

void grow_grown(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer) {
  const TreeGrown& grown = params.grown;
  Job& job = writer.job();
  const double age = std::min(params.age.value_or(params.mature_age), params.mature_age);
  const auto years = static_cast<std::uint16_t>(math::to_int32(std::ceil(age)));
  const ShadowOptions shadow = shadow_of(grown);
  ShadowGrid shadows(shadow, job);
  const Surroundings obstacles(obstacles_of(grown), job);
  const Surroundings* const given = grown.obstacles.empty() ? nullptr : &obstacles;
  const GrownSite site{grown, random, shadows, given, job, light_samples(grown.perception_angle)};
  GrownPlant plant(job);
  shade_below_obstacles(grown, obstacles, shadow.cell, site);
  plant_seed(plant, glm::dvec3{0}, 0, site);
  for (const TreeNeighbour& neighbour : grown.neighbours) {
    const auto tree = static_cast<std::uint32_t>(plant.nodes.size());
    plant_seed(plant, {neighbour.position[0], 0, neighbour.position[1]}, tree, site);
  }
  std::uint64_t visited = 0;
  for (std::uint16_t year = 1; year <= years; ++year) {
    grow_year(plant, site, year);
    visited += plant.nodes.size();
    if (writer.may_abandon() && visited > most_visited) abandon_attempt();
    job.progress("derive", static_cast<double>(year) / years);
  }
  const double share = years == 0 ? 1 : age - (years - 1);
  write_grown(plant, params, {years, share}, random, writer);
}

}  // namespace seedmesh::tree

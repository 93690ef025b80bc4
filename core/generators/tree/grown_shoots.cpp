#include "core/generators/tree/grown_shoots.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::tree {
namespace {

// A shoot may have many internodes, each with a shadow of many cells.
constexpr std::size_t check_every = 1024, check_shoots_every = 16, check_shadows_every = 64;
constexpr glm::dvec3 up{0, 1, 0};

double unit_at(const Rng& rng, std::string_view name) { return Rng(rng.at(name)).unit(); }

/// The direction of the most light about a bud, of a length that falls to 0 where the light is even.
glm::dvec3 toward_light(const GrownBud& bud, const glm::dvec3& position, const GrownSite& site) {
  const TreeGrown& grown = site.grown;
  const double distance = grown.perception_distance * grown.internode;
  constexpr std::size_t count = std::tuple_size_v<LightSamples>;
  glm::dvec3 direction[count];
  double shade[count];
  double darkest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [off, around] = site.samples[i];
    direction[i] =
        bud.frame.heading * off.cos + (bud.frame.left * around.cos + bud.frame.up * around.sin) * off.sin;
    shade[i] = site.shadows.shade_at(position + direction[i] * distance);
    darkest = std::max(darkest, shade[i]);
  }
  glm::dvec3 sum{0};
  double most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double gain = std::min(1.0, darkest) - std::min(1.0, shade[i]);
    sum += direction[i] * gain;
    most = std::max(most, gain);
  }
  return most > 0 ? math::unit(sum, glm::dvec3{0}) : glm::dvec3{0};
}

/// The heading of the next internode of a bud.
glm::dvec3 next_heading(const GrownBud& bud, const glm::dvec3& position, const GrownSite& site,
                        const Rng& rng) {
  const TreeAxis& level = axis_level(site.grown, bud.order);
  const double angle = level.wander * unit_at(rng, "wander");
  const math::SinCos off = math::quick_sincos_degrees(angle);
  const math::SinCos around = math::quick_sincos_degrees(360 * unit_at(rng, "around"));
  glm::dvec3 heading =
      bud.frame.heading * off.cos + (bud.frame.left * around.cos + bud.frame.up * around.sin) * off.sin;
  heading.y *= 1 - level.level_out;
  heading += up * level.tropism;
  if (level.light > 0) heading += toward_light(bud, position, site) * level.light;
  return math::unit(heading, bud.frame.heading);
}

/// Turns a heading along the surface of an obstacle that an internode of this length would enter. False: it cannot.
bool avoid_obstacles(const glm::dvec3& position, double length, const GrownSite& site, glm::dvec3& heading) {
  if (!site.obstacles || site.obstacles->signed_distance_at(position + heading * length) > 0) return true;
  const glm::dvec3 inward = site.obstacles->toward_surface(position);
  const double into = glm::dot(heading, inward);
  if (into > 0) heading = math::unit(heading - inward * into, heading);
  return site.obstacles->signed_distance_at(position + heading * length) > 0;
}

/// Is a node on the part of a trunk without side buds?
bool is_bare(const GrownNode& node, const TreeGrown& grown) {
  return node.order == 0 && node.position.y < grown.clearance;
}

/// Adds the side buds of a node. `at_end`: the node ends the shoot of a year.
void add_side_buds(GrownPlant& plant, const GrownBud& axis, bool at_end, const GrownSite& site,
                   std::uint16_t year) {
  const TreeAxis& level = axis_level(site.grown, axis.order);
  if (axis.order + 1 >= site.grown.levels || is_bare(plant.nodes[axis.node], site.grown)) return;
  const int count = at_end && level.whorl > 0 ? level.whorl : level.buds;
  const Rng rng = Rng(key_at(plant.nodes[axis.node].key, 0xB0D));
  for (int i = 0; i < count; ++i) {
    const Rng own = rng.at(static_cast<std::uint64_t>(i));
    const double around = level.phyllotaxis * axis.number + 360.0 * i / count +
                          spread(own.at("around"), level.phyllotaxis_spread);
    const double angle = level.angle + spread(own.at("angle"), level.angle_spread);
    GrownBud bud;
    bud.frame = turn(roll(axis.frame, math::quick_sincos_degrees(around)), math::quick_sincos_degrees(angle));
    if (axis.order > 0) bud.frame = upright(bud.frame);
    bud.node = axis.node;
    bud.axis = axis.axis;
    bud.order = static_cast<std::uint16_t>(axis.order + 1);
    bud.idle_since = year;
    bud.key = axis.order == 0 ? site.random.branches.at(own.key()).key() : own.key();
    plant.buds.push_back(bud);
  }
}

/// Grows the shoot of a bud, which moves to its end. Returns the number of its internodes.
int grow_shoot(GrownPlant& plant, GrownBud& bud, const GrownSite& site, std::uint16_t year) {
  const TreeGrown& grown = site.grown;
  const double vigour = std::min(bud.vigour, static_cast<double>(grown.longest_shoot));
  const int count = math::to_int32(std::floor(vigour));
  const double length = grown.internode * axis_level(grown, bud.order).length * (vigour / count);
  const bool begins = !bud.ends_axis;
  for (int i = 0; i < count; ++i) {
    const GrownNode parent = plant.nodes[bud.node];
    const Rng rng = Rng(bud.key).at(bud.number);
    glm::dvec3 heading = next_heading(bud, parent.position, site, rng);
    const bool is_low = parent.position.y + heading.y * length < grown.clearance && heading.y < 0;
    if (is_low || !avoid_obstacles(parent.position, length, site, heading)) {
      bud.node = Limbs::none;
      return i;
    }
    GrownNode node;
    node.position = parent.position + heading * length;
    node.heading = heading;
    node.parent = bud.node;
    node.axis = begins && i == 0 ? plant.axes++ : bud.axis;
    node.order = bud.order;
    node.born = year;
    node.number = bud.number;
    node.continues = !(begins && i == 0);
    node.tree = parent.tree;
    node.shade = length / grown.internode;
    node.key = rng.key();
    bud.frame = headed(bud.frame, heading);
    bud.node = static_cast<std::uint32_t>(plant.nodes.size());
    bud.axis = node.axis;
    plant.nodes.push_back(node);
    site.shadows.add(node.position, node.shade);
    add_side_buds(plant, bud, i + 1 == count, site, year);
    ++bud.number;
  }
  bud.ends_axis = true;
  bud.idle_since = year;
  return count;
}

}  // namespace

const TreeAxis& axis_level(const TreeGrown& grown, int order) {
  static const TreeAxis usual;
  if (grown.level.empty()) return usual;
  return grown.level[std::min(static_cast<std::size_t>(order), grown.level.size() - 1)];
}

LightSamples light_samples(double perception_angle) {
  LightSamples samples;
  for (int i = 0; i <= 2 * samples_of_ring; ++i) {
    const double share = i == 0 ? 0 : i <= samples_of_ring ? 0.5 : 1;
    samples[static_cast<std::size_t>(i)] = {math::quick_sincos_degrees(share * perception_angle),
                                            math::quick_sincos_degrees(360.0 * i / samples_of_ring)};
  }
  return samples;
}

void sense_light(GrownPlant& plant, const GrownSite& site) {
  const double own = site.grown.light.shade;
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    if (i % check_every == 0) site.job.check();
    GrownBud& bud = plant.buds[i];
    const GrownNode& node = plant.nodes[bud.node];
    const double shade = site.shadows.shade_at(node.position);
    bud.light = std::clamp(1 - shade + own * node.shade, 0.0, 1.0);
  }
}

std::uint64_t grow_shoots(GrownPlant& plant, const GrownSite& site, std::uint16_t year) {
  Meter modules(site.job, Resource::modules);
  const std::size_t before = plant.buds.size();
  std::size_t kept = 0;
  std::uint64_t grown = 0;
  for (std::size_t i = 0; i < before; ++i) {
    if (i % check_shoots_every == 0) site.job.check();
    GrownBud bud = plant.buds[i];
    const bool grows = bud.vigour >= 1;
    const bool taken_over = bud.ends_axis && bud.number > 1 && !is_bare(plant.nodes[bud.node], site.grown) &&
                            unit_at(Rng(bud.key).at("takeover").at(year), "die") < site.grown.takeover;
    if (taken_over || (!grows && year >= bud.idle_since + site.grown.bud_years)) continue;
    if (grows) {
      modules.spend(static_cast<std::uint64_t>(site.grown.longest_shoot));
      grown += static_cast<std::uint64_t>(grow_shoot(plant, bud, site, year));
      if (bud.node == Limbs::none) continue;
    }
    plant.buds[kept++] = bud;
  }
  for (std::size_t i = before; i < plant.buds.size(); ++i) plant.buds[kept++] = plant.buds[i];
  plant.buds.resize(kept);
  return grown;
}

void shed_branches(GrownPlant& plant, const GrownSite& site, std::uint16_t year) {
  const TreeGrown& grown = site.grown;
  Array<std::uint32_t> new_index(site.job, plant.nodes.size());
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < plant.nodes.size(); ++i) {
    if (i % check_shadows_every == 0) site.job.check();
    GrownNode node = plant.nodes[i];
    new_index[i] = Limbs::none;
    bool stays = node.parent == Limbs::none;
    if (!stays && new_index[node.parent] != Limbs::none) {
      const bool is_old = year >= node.born + grown.shed_years;
      const bool is_weak = !node.continues && node.vigour < grown.shed * node.young;
      stays = !is_old || !(is_weak || node.light == 0);
      node.parent = new_index[node.parent];
    }
    if (!stays) {
      site.shadows.remove(node.position, node.shade);
      continue;
    }
    new_index[i] = kept;
    plant.nodes[kept++] = node;
  }
  plant.nodes.resize(kept);
  std::size_t buds = 0;
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    GrownBud bud = plant.buds[i];
    bud.node = new_index[bud.node];
    if (bud.node != Limbs::none) plant.buds[buds++] = bud;
  }
  plant.buds.resize(buds);
}

void thicken(GrownPlant& plant, const TreeGrown& grown) {
  const double tip = math::pow(grown.tip_radius, grown.radius_exponent);
  for (GrownNode& node : plant.nodes) {
    node.area_before = node.area;
    node.side_light = 0;  // what it carries, in this loop
  }
  for (std::size_t i = plant.nodes.size(); i-- > 0;) {
    GrownNode& node = plant.nodes[i];
    node.area = std::max({node.area, node.side_light, tip});
    if (node.parent != Limbs::none) plant.nodes[node.parent].side_light += node.area;
  }
}

}  // namespace seedmesh::tree

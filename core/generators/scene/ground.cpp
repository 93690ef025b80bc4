#include "core/generators/scene/ground.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/material_members.h"
#include "core/generators/scene/buildings.h"
#include "core/generators/scene/path_bands.h"
#include "core/generators/terrain/build_model.h"
#include "core/generators/terrain/ground_cover.h"
#include "core/generators/terrain/plan.h"
#include "core/generators/terrain/smooth_step.h"
#include "core/generators/terrain/square.h"
#include "core/generators/terrain/terrain.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"
#include "generated/params/scene.h"
#include "generated/params/terrain.h"

namespace seedmesh::scene {
namespace {

constexpr char terrain_pointer[] = "/terrain/parameters";
constexpr int sides_of_a_disc = 96;

/// Moves the pointers of errors from the terrain's parameters to the scene's.
template <class T>
Result<T> of_terrain(Result<T> result) {
  if (result) return result;
  Error error = std::move(result).error();
  for (Issue& issue : error.issues) issue.pointer.insert(0, terrain_pointer);
  return error;
}

Extent around_middle(const glm::dvec2& size) { return {-size / 2.0, size / 2.0}; }

/// Returns level ground: two triangles, or a disc.
Mesh flat_mesh(const Extent& extent, bool round, const Job& job) {
  Mesh mesh = empty_mesh(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  const auto add = [&](const glm::dvec2& p) {
    const glm::dvec2 share = (p - extent.min) / extent.size();
    mesh.position.push_back({static_cast<float>(p.x), 0, static_cast<float>(p.y)});
    mesh.normal.push_back({0, 1, 0});
    mesh.uv[0].push_back(glm::vec2(share));
  };
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t corner : {a, b, c}) mesh.index.wide.push_back(corner);
  };
  if (!round) {
    for (const glm::dvec2& p :
         {extent.min, {extent.min.x, extent.max.y}, extent.max, {extent.max.x, extent.min.y}})
      add(p);
    face(0, 1, 2);
    face(0, 2, 3);
    return mesh;
  }
  const double radius = extent.max.x;
  for (int i = 0; i < sides_of_a_disc; ++i) {
    const math::SinCos turn = math::sincos(2 * math::pi * i / sides_of_a_disc);
    add({radius * turn.cos, -radius * turn.sin});
  }
  for (std::uint32_t i = 1; i + 1 < sides_of_a_disc; ++i) face(0, i, i + 1);
  return mesh;
}

Model flat_model(const SceneGround& ground, const Extent& extent, bool round, const Job& job) {
  Model model;
  model.name = "ground";
  Node node;
  node.name = "ground";
  if (ground.outline != SceneOutline::none) {
    Material material;
    material.name = "ground";
    material.base_color = linear_color(ground.color);
    material.roughness = 0.95F;
    set_specular(material, ground.specular);
    set_emission(material, ground.emission);
    node.mesh = add_mesh(model, "ground", flat_mesh(extent, round, job), add_material(model, material));
  }
  model.nodes.push_back(std::move(node));
  return model;
}

}  // namespace

Result<Ground> Ground::make(const SceneParams& params, const Job& job) {
  Ground ground;
  if (!params.terrain) {
    const SceneGround level = params.ground.value_or(SceneGround{});
    ground.extent_ = around_middle(glm::dvec2(level.size));
    ground.round_ = level.outline == SceneOutline::disc;
    return ground;
  }
  IssueList errors;
  ground.terrain_ = std::make_shared<const TerrainParams>(
      read_terrain(Json::parse(params.terrain->parameters), "", errors));
  ground.seed_ = params.terrain->seed.value_or(job.rng().at("scene").at("terrain").key());
  Job own = job.for_child(ground.seed_, terrain_pointer);
  Result<terrain::Field> field = of_terrain(terrain::field_of(*ground.terrain_, own));
  if (!field) return std::move(field).error();
  ground.field_ = std::move(*field);
  const terrain::Field& made = ground.field_;
  ground.extent_ = around_middle(glm::dvec2(made.width - 1, made.depth - 1) * made.cell);
  if (ground.terrain_->water_level &&
      *ground.terrain_->water_level > static_cast<double>(terrain::range_of(made, job).low))
    ground.water_ = ground.terrain_->water_level;
  ground.refined_ = terrain::refined_ground(*ground.terrain_, made, own);
  if (std::ranges::any_of(params.layers,
                          [](const SceneLayer& layer) { return layer.place.ground.has_value(); }))
    ground.cover(job);
  return ground;
}

bool Ground::contains(const glm::dvec2& p, double edge) const {
  if (round_) return glm::length(p) <= extent_.max.x - edge;
  return p.x >= extent_.min.x + edge && p.y >= extent_.min.y + edge && p.x <= extent_.max.x - edge &&
         p.y <= extent_.max.y - edge;
}

glm::dvec2 Ground::gradient(const glm::dvec2& p) const {
  constexpr double half = 0.5;
  if (!refines(p)) return sample(p).gradient;
  return {(refined_height(p + glm::dvec2(half, 0)) - refined_height(p - glm::dvec2(half, 0))) / (2 * half),
          (refined_height(p + glm::dvec2(0, half)) - refined_height(p - glm::dvec2(0, half))) / (2 * half)};
}

void Ground::cover(const Job& job) {
  if (!terrain_ || cover_) return;
  const Job own = job.for_child(seed_, terrain_pointer);
  cover_ = std::make_shared<const terrain::GroundCover>(*terrain_, field_, refined_, own);
}

double Ground::share_of(const std::vector<SceneGroundClass>& classes, const glm::dvec2& p) const {
  if (!cover_) return 1;
  const terrain::GroundShares shares = cover_->at(p.x - extent_.min.x, p.y - extent_.min.y);
  float sum = 0;
  for (const SceneGroundClass each : classes) sum += shares.of[static_cast<int>(each)];
  return static_cast<double>(terrain::smooth_step(0.3F, 0.55F, sum));
}
static_assert(static_cast<int>(SceneGroundClass::grass) == terrain::GroundShares::grass &&
              static_cast<int>(SceneGroundClass::litter) == terrain::GroundShares::litter);

bool Ground::refines(const glm::dvec2& p) const {
  return refined_ && refined_->contains(p.x - extent_.min.x, p.y - extent_.min.y);
}

double Ground::refined_height(const glm::dvec2& p) const {
  terrain::RefinedGround::Sampler sampler(*refined_);
  return static_cast<double>(sampler.at(p.x - extent_.min.x, p.y - extent_.min.y).height);
}

/// Squares are split like grid meshes: along the diagonal with the smaller height difference.
Ground::Sample Ground::sample(const glm::dvec2& p) const {
  if (!terrain_) return {};
  const double x = std::clamp((p.x - extent_.min.x) / field_.cell, 0.0, field_.width - 1.0);
  const double z = std::clamp((p.y - extent_.min.y) / field_.cell, 0.0, field_.depth - 1.0);
  const std::int32_t i = std::min(math::to_int32(x), field_.width - 2);
  const std::int32_t j = std::min(math::to_int32(z), field_.depth - 2);
  const double u = x - i, v = z - j;
  const auto at = [&](std::int32_t east, std::int32_t south) {
    return static_cast<double>(field_.at(i + east, j + south));
  };
  const double nw = at(0, 0), ne = at(1, 0), sw = at(0, 1), se = at(1, 1);
  const bool falls = terrain::falls_to_south_east(nw, ne, sw, se);
  glm::dvec2 rise;
  double corner = nw, east = u, south = v;
  if (falls) {
    rise = v >= u ? glm::dvec2(se - sw, sw - nw) : glm::dvec2(ne - nw, se - ne);
  } else if (u + v <= 1) {
    rise = {ne - nw, sw - nw};
  } else {
    rise = {se - sw, se - ne};
    corner = se;
    east = u - 1;
    south = v - 1;
  }
  return {corner + rise.x * east + rise.y * south, rise / field_.cell};
}

double Ground::level_margin() const { return terrain_ ? field_.cell * std::sqrt(2.0) : 0; }

void Ground::level(const Foundation& foundation, const Job& job) {
  job.check();
  if (!terrain_) return;
  if (levelled_.empty()) levelled_ = Array<std::uint8_t>(job, field_.heights.size(), std::uint8_t{0});
  const Footprint& footprint = foundation.footprint;
  const auto height = static_cast<float>(this->height(footprint.at));
  // All squares that the footprint touches become level.
  const double flat = level_margin();
  const double reach = footprint.reach() + flat + foundation.slope_width;
  const auto index = [&](double place, double least, std::int32_t last) {
    return math::to_int32(std::clamp((place - least) / field_.cell, 0.0, static_cast<double>(last)));
  };
  const std::int32_t x0 = index(footprint.at.x - reach, extent_.min.x, field_.width - 1);
  const std::int32_t x1 = index(footprint.at.x + reach, extent_.min.x, field_.width - 1);
  const std::int32_t z0 = index(footprint.at.y - reach, extent_.min.y, field_.depth - 1);
  const std::int32_t z1 = index(footprint.at.y + reach, extent_.min.y, field_.depth - 1);
  for (std::int32_t z = z0; z <= z1; ++z) {
    for (std::int32_t x = x0; x <= x1; ++x) {
      const double outside = footprint.outside(extent_.min + glm::dvec2(x, z) * field_.cell) - flat;
      if (outside > 0 && outside >= foundation.slope_width) continue;
      float& sample = field_.at(x, z);
      std::uint8_t& is_levelled = levelled_[static_cast<std::size_t>(&sample - field_.heights.data())];
      if (is_levelled != 0) continue;
      is_levelled = outside <= 0 ? 1 : 0;
      const double share = outside <= 0 ? 0 : outside / foundation.slope_width;
      const auto old = static_cast<float>(share * share * (3 - 2 * share));
      sample = height + (sample - height) * old;
    }
  }
}

Result<Model> Ground::model(const SceneParams& params, const GenerateContext& context) const {
  Job& job = context.job;
  Model model;
  if (terrain_) {
    Job own = job.for_child(seed_, terrain_pointer);
    Demand demand;
    demand.lods = params.camera ? 1 : context.demand.lods;
    demand.textures = context.demand.textures;
    Result<Model> made = of_terrain(terrain::dressed(*terrain_, field_, {own, demand, context.generators}));
    if (!made) return made;
    model = std::move(*made);
    for (Warning& warning : model.warnings) warning.pointer.insert(0, terrain_pointer);
  } else {
    model = flat_model(params.ground.value_or(SceneGround{}), extent_, round_, job);
  }
  const bool has_detail = terrain_ && terrain_->detail && context.demand.textures > 0;
  add_path_bands(model, params.paths, *this, terrain_ ? field_.cell : 0,
                 has_detail ? PathSurface::soil : PathSurface::plain, job);
  add_outlines(model, params, *this, job);
  return model;
}

}  // namespace seedmesh::scene

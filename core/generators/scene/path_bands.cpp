#include "core/generators/scene/path_bands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/math.h"
#include "core/generators/material_members.h"
#include "core/generators/scene/ground.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"
#include "core/model/levels.h"
#include "core/schema/json.h"
#include "core/texture/ground.h"
#include "core/texture/wall.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

// Height above the ground, so that the ground does not show through. Each following segment is slightly
// higher, so that overlapping segments do not flicker.
constexpr double lift = 0.04, step_up = 0.004, lift_a_cell = 0.04;
constexpr int different_lifts = 7;
constexpr int corners_of_a_joint = 16;
constexpr std::size_t most_path_nodes = 256;  ///< more paths are joined to one mesh for each colour
constexpr double most_squares = 4096;         ///< along one segment

// Wheels leave two ruts. At both edges weeds grow, and the ground is darker.
constexpr float rut_at = 0.46F, rut_width = 0.16F, edge_from = 0.7F;
constexpr glm::vec3 rut_color{0.78F, 0.77F, 0.76F}, weed_color{0.5F, 0.56F, 0.4F},
    middle_color{0.82F, 0.85F, 0.72F};
constexpr const char* soil = "soil_ground";

float smooth_step(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

/// The vertex colour at a distance from the middle line, as a share of half the width.
glm::u8vec4 color_across(float share) {
  const auto mixed = [](const glm::vec3& a, const glm::vec3& b, float by) { return a + (b - a) * by; };
  glm::vec3 color = mixed(middle_color, glm::vec3(1), smooth_step(0.05F, 0.3F, share));
  color = mixed(color, rut_color, 1 - smooth_step(0, rut_width, std::abs(share - rut_at)));
  color = mixed(color, weed_color, smooth_step(edge_from, 1, share)) * 255.0F + 0.5F;
  return {static_cast<std::uint8_t>(color.x), static_cast<std::uint8_t>(color.y),
          static_cast<std::uint8_t>(color.z), 255};
}

class Band {
 public:
  Band(const Ground& ground, double cell, PathSurface surface, Job& job)
      : ground_(ground), cell_(cell), surface_(surface), job_(job) {
    mesh_ = empty_mesh(job);
    if (surface == PathSurface::soil) {
      mesh_.uv[0] = Array<glm::vec2>(job);
      mesh_.color = Array<glm::u8vec4>(job);
    }
  }

  void lay(const std::vector<glm::dvec2>& points, double half_width) {
    bool is_first = true;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (glm::distance(points[i - 1], points[i]) < 1e-3) continue;
      job_.check();
      if (!is_first) disc(points[i - 1], half_width);
      strip(points[i - 1], points[i], half_width);
      is_first = false;
    }
  }

  Mesh take() {
    smooth();
    return std::move(mesh_);
  }

 private:
  /// `share`: the distance from the middle line by half the width.
  std::uint32_t vertex(const glm::dvec2& p, double share) {
    const double above = lift + lift_a_cell * cell_ + step_up * (piece_ % different_lifts);
    mesh_.position.push_back(glm::vec3(glm::dvec3(p.x, ground_.height(p) + above, p.y)));
    if (surface_ == PathSurface::soil) {
      mesh_.uv[0].push_back(glm::vec2(p / texture::ground_tile) + 0.0F);
      mesh_.color.push_back(color_across(static_cast<float>(share)));
    }
    return static_cast<std::uint32_t>(mesh_.position.size()) - 1;
  }
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t corner : {a, b, c}) mesh_.index.wide.push_back(corner);
  }

  void spend(std::uint64_t triangles) { job_.spend(Resource::triangles, triangles); }

  int squares(double length) const {
    return cell_ > 0 ? static_cast<int>(std::clamp(std::ceil(2 * length / cell_), 1.0, most_squares)) : 1;
  }

  void strip(const glm::dvec2& a, const glm::dvec2& b, double half_width) {
    ++piece_;
    const double length = glm::distance(a, b);
    const glm::dvec2 onward = (b - a) / length, left(onward.y, -onward.x);
    const int far = squares(length), wide = squares(2 * half_width);
    spend(2 * static_cast<std::uint64_t>(far) * static_cast<std::uint64_t>(wide));
    std::uint32_t before = 0;
    for (int i = 0; i <= far; ++i) {
      const glm::dvec2 middle = a + onward * (length * i / far);
      const auto row = static_cast<std::uint32_t>(mesh_.position.size());
      for (int k = 0; k <= wide; ++k) {
        const double side = 1 - 2.0 * k / wide;
        vertex(middle + left * (half_width * side), std::abs(side));
      }
      for (std::uint32_t k = 0; i > 0 && k < static_cast<std::uint32_t>(wide); ++k) {
        face(before + k, before + k + 1, row + k + 1);
        face(before + k, row + k + 1, row + k);
      }
      before = row;
    }
  }

  void disc(const glm::dvec2& middle, double radius) {
    ++piece_;
    const int rings = squares(radius);
    spend(corners_of_a_joint * (2 * static_cast<std::uint64_t>(rings) - 1));
    const std::uint32_t centre = vertex(middle, 0);
    for (int ring = 1; ring <= rings; ++ring) {
      const auto first = static_cast<std::uint32_t>(mesh_.position.size());
      for (int i = 0; i < corners_of_a_joint; ++i) {
        const math::SinCos turn = math::sincos(2 * math::pi * i / corners_of_a_joint);
        const double share = static_cast<double>(ring) / rings;
        vertex(middle + glm::dvec2(turn.cos, -turn.sin) * (radius * share), share);
      }
      for (std::uint32_t i = 0; i < corners_of_a_joint; ++i) {
        const std::uint32_t j = (i + 1) % corners_of_a_joint;
        if (ring == 1) {
          face(centre, first + i, first + j);
          continue;
        }
        const std::uint32_t inner = first - corners_of_a_joint;
        face(inner + i, first + i, first + j);
        face(inner + i, first + j, inner + j);
      }
    }
  }

  /// Computes normals from the adjacent triangles.
  void smooth() {
    Array<glm::dvec3> sum(job_, mesh_.position.size(), glm::dvec3(0));
    const Array<std::uint32_t>& index = mesh_.index.wide;
    for (std::size_t i = 0; i < index.size(); i += 3) {
      const glm::dvec3 a(mesh_.position[index[i]]), b(mesh_.position[index[i + 1]]),
          c(mesh_.position[index[i + 2]]);
      for (std::size_t k = 0; k < 3; ++k) sum[index[i + k]] += glm::cross(b - a, c - a);
    }
    for (const glm::dvec3& each : sum) mesh_.normal.push_back(glm::vec3(math::unit(each, {0, 1, 0})));
  }

  const Ground& ground_;
  double cell_;
  PathSurface surface_;
  Job& job_;
  Mesh mesh_;
  int piece_ = 0;
};

/// Returns the largest error of each coarser level of the ground, as reported by the terrain.
std::vector<double> errors_of_levels(const Model& model) {
  std::vector<double> errors;
  for (const Extra& extra : model.nodes.front().extras) {
    if (extra.name != "levels") continue;
    for (const Json& level : Json::parse(extra.json)) errors.push_back(level.at("max_error").get<double>());
  }
  return errors;
}

Mesh copy_of(const Mesh& mesh, double lifted, const Job& job) {
  Mesh copy = empty_mesh(job);
  copy.uv[0] = Array<glm::vec2>(job);
  copy.color = Array<glm::u8vec4>(job);
  copy.uv[0].append(mesh.uv[0].span());
  copy.color.append(mesh.color.span());
  copy.position.append(mesh.position.span());
  copy.normal.append(mesh.normal.span());
  copy.index.wide.append(mesh.index.wide.span());
  for (glm::vec3& each : copy.position) each.y += static_cast<float>(lifted);
  return copy;
}

/// Paths of one mesh.
struct PathGroup {
  PathGroup(const Ground& ground, double cell, PathSurface surface, const Job& shared, const ScenePath& path)
      : job(shared), band(ground, cell, surface, job), first(path) {}
  PathGroup(const PathGroup&) = delete;
  PathGroup& operator=(const PathGroup&) = delete;
  ~PathGroup() = default;

  Job job;  // other threads can be using the request's
  Band band;
  const ScenePath& first;  ///< gives the look of all
};

/// The mesh of a group, with the coarser levels of the ground.
void add_group(Model& model, PathGroup& group, PathSurface surface, const std::vector<double>& errors,
               Job& job) {
  Material material;
  material.name = "path";
  material.base_color = linear_color(group.first.color);
  material.roughness = 1;
  if (surface == PathSurface::soil) {
    material.recipe.kind = soil;
    material.recipe.factor = glm::min(glm::vec3(material.base_color) / texture::grey_of(soil), glm::vec3(1));
  }
  set_specular(material, group.first.specular);
  set_emission(material, group.first.emission);
  const int number = add_material(model, std::move(material));
  Mesh mesh = group.band.take();
  std::vector<Mesh> coarser;
  job.spend(Resource::triangles, errors.size() * mesh.elements());
  for (const double error : errors) coarser.push_back(copy_of(mesh, error, job));
  Node& node = add_node(model, "path", 0, add_mesh(model, "path", std::move(mesh), number));
  for (std::size_t i = 0; i < coarser.size(); ++i)
    add_level(node, add_mesh(model, level_name("path", i + 1), std::move(coarser[i]), number));
}

}  // namespace

void add_path_bands(Model& model, const std::vector<ScenePath>& paths, const Ground& ground, double cell,
                    PathSurface surface, Job& job) {
  const std::vector<double> errors = errors_of_levels(model);
  const bool joins = paths.size() > most_path_nodes;
  std::vector<std::unique_ptr<PathGroup>> groups;
  std::map<std::pair<std::uint32_t, std::array<double, 4>>, std::size_t> group_of;
  for (std::size_t number = 0; number < paths.size(); ++number) {
    const ScenePath& path = paths[number];
    if (!path.shown) continue;
    std::vector<glm::dvec2> points;
    for (const auto& p : path.points) points.emplace_back(p[0], p[1]);
    const std::uint32_t rgb = std::uint32_t{path.color.red} << 16U | std::uint32_t{path.color.green} << 8U |
                              std::uint32_t{path.color.blue};
    const auto [known, is_new] = group_of.emplace(std::pair(rgb, light_key(path)), groups.size());
    if (is_new || !joins) groups.push_back(std::make_unique<PathGroup>(ground, cell, surface, job, path));
    PathGroup& group = joins ? *groups[known->second] : *groups.back();
    const Job::PointerScope scope(group.job, "/paths/" + std::to_string(number));
    group.band.lay(points, path.width / 2);
  }
  for (const std::unique_ptr<PathGroup>& group : groups) add_group(model, *group, surface, errors, job);
}

}  // namespace seedmesh::scene

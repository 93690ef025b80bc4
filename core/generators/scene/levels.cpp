#include "core/generators/scene/levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/math.h"
#include "core/texture/impostor.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::array<double, 4> shares = {0.5, 0.25, 0.12, 0.06};
constexpr int levels_with_impostors = 4, levels_without = 5;
constexpr std::uint64_t draw_level = 7;
// Varies the thresholds, so that plants of equal size do not all change level together.
constexpr double spread = 0.3;
constexpr int halvings = 30;

/// The share of the screen that each placement fills.
struct Views {
  std::vector<Array<float>> share;            ///< by layer and placement
  std::vector<Array<std::uint16_t>> variant;  ///< by layer and placement
};

std::size_t level_at(const LodInfo& lod_info, double share) {
  std::size_t level = 0;
  while (level < shares.size() && share < shares[level]) ++level;
  if (lod_info.has_impostor && level == shares.size()) return lod_info.triangles.size();
  return std::min(level, lod_info.triangles.size() - 1);
}

/// Computes the size of a placement as a share of the height of the camera's image.
class Camera {
 public:
  Camera(const SceneCamera& camera, const Ground& ground)
      : at_(camera.position[0], camera.position[1], camera.position[2]), ground_(ground) {
    const double half = math::radians(camera.field_of_view) / 2;
    half_height_ = math::tan(half);
  }

  double share(const Placement& placement, const SceneLayer& layer, const LodInfo& lod_info) const {
    const double scale = static_cast<double>(placement.scale);
    const glm::dvec3 middle(
        placement.at.x, ground_.height(placement.at) - layer.sink + lod_info.middle * scale, placement.at.y);
    const double distance = glm::length(middle - at_), radius = lod_info.radius * scale;
    return distance <= radius ? 1 : radius / (distance * half_height_);
  }

 private:
  glm::dvec3 at_;
  const Ground& ground_;
  double half_height_ = 1;
};

double widest_of(const Plan& plan, const std::vector<LodInfo>& lod_infos) {
  double widest = 0;
  for (std::size_t layer = 0; layer < plan.all_placements.layers.size(); ++layer) {
    for (const Placement& placement : plan.all_placements.layers[layer]) {
      const LodInfo& lod_info = lod_infos[plan.variant_table.variant_at(layer, placement)];
      widest = std::max(widest, lod_info.radius * static_cast<double>(placement.scale));
    }
  }
  return widest > 0 ? widest : 1;
}

Views views_of(const SceneParams& params, const Plan& plan, const std::vector<LodInfo>& lod_infos,
               const Job& job) {
  Views views;
  std::optional<Camera> camera;
  if (params.camera) camera.emplace(*params.camera, plan.ground);
  const double widest = camera ? 1 : widest_of(plan, lod_infos);
  for (std::size_t layer = 0; layer < plan.all_placements.layers.size(); ++layer) {
    const Array<Placement>& placements = plan.all_placements.layers[layer];
    Array<float> share(job, placements.size());
    Array<std::uint16_t> variant(job, placements.size());
    for (std::size_t i = 0; i < placements.size(); ++i) {
      if (i % 4096 == 0) job.check();
      const Placement& placement = placements[i];
      variant[i] = static_cast<std::uint16_t>(plan.variant_table.variant_at(layer, placement));
      const LodInfo& lod_info = lod_infos[variant[i]];
      if (camera) {
        share[i] = static_cast<float>(camera->share(placement, params.layers[layer], lod_info));
      } else {
        Rng rng(key_at(placement.key, draw_level));
        const double size = lod_info.radius * static_cast<double>(placement.scale) / widest;
        share[i] = static_cast<float>(size * (1 - spread * rng.unit()));
      }
    }
    views.share.push_back(std::move(share));
    views.variant.push_back(std::move(variant));
  }
  return views;
}

template <class Visit>
void each_level(const Views& views, const std::vector<LodInfo>& lod_infos, double factor,
                const Visit& visit) {
  for (std::size_t layer = 0; layer < views.share.size(); ++layer) {
    for (std::size_t i = 0; i < views.share[layer].size(); ++i) {
      const LodInfo& lod_info = lod_infos[views.variant[layer][i]];
      if (lod_info.triangles.empty()) continue;
      visit(layer, i, lod_info, level_at(lod_info, factor * static_cast<double>(views.share[layer][i])));
    }
  }
}

std::uint64_t drawn_with(const Views& views, const std::vector<LodInfo>& lod_infos, double factor) {
  std::uint64_t drawn = 0;
  each_level(views, lod_infos, factor,
             [&](std::size_t, std::size_t, const LodInfo& lod_info, std::size_t level) {
               drawn += lod_info.triangles_at(level);
             });
  return drawn;
}

/// Returns the largest factor, by 30 steps of bisection, that keeps the budget.
double factor_for(const Views& views, const std::vector<LodInfo>& lod_infos, std::uint64_t budget,
                  const Job& job) {
  if (drawn_with(views, lod_infos, 1) <= budget) return 1;
  double kept = 0, broken = 1;
  for (int i = 0; i < halvings; ++i) {
    job.check();
    const double middle = (kept + broken) / 2;
    (drawn_with(views, lod_infos, middle) <= budget ? kept : broken) = middle;
  }
  return kept;
}

}  // namespace

std::uint64_t LodInfo::triangles_at(std::size_t level) const {
  return level < triangles.size() ? triangles[level] : texture::triangles_of_impostor;
}

bool chooses_levels(const SceneParams& params, const Demand& demand) {
  return !demand.growth && (params.camera.has_value() || demand.most_triangles > 0);
}

bool wants_impostors(const SceneParams& params, const Demand& demand) {
  if (demand.growth || demand.textures == 0) return false;
  return demand.impostor || (params.camera && params.camera->impostors);
}

int level_count_of(const SceneParams& params, const Demand& demand) {
  if (!chooses_levels(params, demand)) return demand.lods;
  return std::max(demand.lods, wants_impostors(params, demand) ? levels_with_impostors : levels_without);
}

Levels levels_of(const SceneParams& params, const Plan& plan, const std::vector<LodInfo>& lod_infos,
                 std::uint64_t others, const GenerateContext& context) {
  Job& job = context.job;
  const Views views = views_of(params, plan, lod_infos, job);
  const std::uint64_t most = context.demand.most_triangles;
  const double factor = most > 0 ? factor_for(views, lod_infos, most > others ? most - others : 0, job) : 1;
  Levels levels;
  for (const Array<float>& layer : views.share) levels.emplace_back(job, layer.size(), std::uint8_t{0});
  each_level(views, lod_infos, factor,
             [&](std::size_t layer, std::size_t i, const LodInfo&, std::size_t level) {
               levels[layer][i] = static_cast<std::uint8_t>(level);
             });
  return levels;
}

}  // namespace seedmesh::scene

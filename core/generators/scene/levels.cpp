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
constexpr int levels_with_pictures = 4, levels_without = 5;
constexpr std::uint64_t draw_level = 7;
// Plants of one size do not all change at once.
constexpr double spread = 0.3;
constexpr int halvings = 30;

/// Places with the share of the screen that each fills.
struct Views {
  std::vector<Array<float>> share;         ///< by layer and stand
  std::vector<Array<std::uint16_t>> cast;  ///< likewise
};

std::size_t level_at(const Stature& stature, double share) {
  std::size_t level = 0;
  while (level < shares.size() && share < shares[level]) ++level;
  if (stature.has_picture && level == shares.size()) return stature.triangles.size();
  return std::min(level, stature.triangles.size() - 1);
}

/// How large a stand is for whoever stands at the camera, as a share of the picture's height.
class Camera {
 public:
  Camera(const SceneCamera& camera, const Ground& ground)
      : at_(camera.position[0], camera.position[1], camera.position[2]), ground_(ground) {
    const double half = math::radians(camera.field_of_view) / 2;
    half_height_ = math::tan(half);
  }

  double share(const Stand& stand, const SceneLayer& layer, const Stature& stature) const {
    const double scale = static_cast<double>(stand.scale);
    const glm::dvec3 middle(stand.at.x, ground_.height(stand.at) - layer.sink + stature.middle * scale,
                            stand.at.y);
    const double distance = glm::length(middle - at_), radius = stature.radius * scale;
    return distance <= radius ? 1 : radius / (distance * half_height_);
  }

 private:
  glm::dvec3 at_;
  const Ground& ground_;
  double half_height_ = 1;
};

double widest_of(const Plan& plan, const std::vector<Stature>& statures) {
  double widest = 0;
  for (std::size_t layer = 0; layer < plan.planting.layers.size(); ++layer) {
    for (const Stand& stand : plan.planting.layers[layer]) {
      const Stature& stature = statures[plan.casting.cast_of(layer, stand)];
      widest = std::max(widest, stature.radius * static_cast<double>(stand.scale));
    }
  }
  return widest > 0 ? widest : 1;
}

Views views_of(const SceneParams& params, const Plan& plan, const std::vector<Stature>& statures,
               const Job& job) {
  Views views;
  std::optional<Camera> camera;
  if (params.camera) camera.emplace(*params.camera, plan.ground);
  const double widest = camera ? 1 : widest_of(plan, statures);
  for (std::size_t layer = 0; layer < plan.planting.layers.size(); ++layer) {
    const Array<Stand>& stands = plan.planting.layers[layer];
    Array<float> share(job, stands.size());
    Array<std::uint16_t> cast(job, stands.size());
    for (std::size_t i = 0; i < stands.size(); ++i) {
      if (i % 4096 == 0) job.check();
      const Stand& stand = stands[i];
      cast[i] = static_cast<std::uint16_t>(plan.casting.cast_of(layer, stand));
      const Stature& stature = statures[cast[i]];
      if (camera) {
        share[i] = static_cast<float>(camera->share(stand, params.layers[layer], stature));
      } else {
        Rng rng(key_at(stand.key, draw_level));
        const double size = stature.radius * static_cast<double>(stand.scale) / widest;
        share[i] = static_cast<float>(size * (1 - spread * rng.unit()));
      }
    }
    views.share.push_back(std::move(share));
    views.cast.push_back(std::move(cast));
  }
  return views;
}

template <class Visit>
void each_level(const Views& views, const std::vector<Stature>& statures, double factor, const Visit& visit) {
  for (std::size_t layer = 0; layer < views.share.size(); ++layer) {
    for (std::size_t i = 0; i < views.share[layer].size(); ++i) {
      const Stature& stature = statures[views.cast[layer][i]];
      if (stature.triangles.empty()) continue;
      visit(layer, i, stature, level_at(stature, factor * static_cast<double>(views.share[layer][i])));
    }
  }
}

std::uint64_t drawn_with(const Views& views, const std::vector<Stature>& statures, double factor) {
  std::uint64_t drawn = 0;
  each_level(views, statures, factor,
             [&](std::size_t, std::size_t, const Stature& stature, std::size_t level) {
               drawn += stature.triangles_at(level);
             });
  return drawn;
}

/// The greatest factor, of those that 30 halvings tell apart, with which the budget is kept.
double factor_for(const Views& views, const std::vector<Stature>& statures, std::uint64_t budget,
                  const Job& job) {
  if (drawn_with(views, statures, 1) <= budget) return 1;
  double kept = 0, broken = 1;
  for (int i = 0; i < halvings; ++i) {
    job.check();
    const double middle = (kept + broken) / 2;
    (drawn_with(views, statures, middle) <= budget ? kept : broken) = middle;
  }
  return kept;
}

}  // namespace

std::uint64_t Stature::triangles_at(std::size_t level) const {
  return level < triangles.size() ? triangles[level] : texture::triangles_of_impostor;
}

bool chooses_levels(const SceneParams& params, const Demand& demand) {
  return !demand.growth && (params.camera.has_value() || demand.most_triangles > 0);
}

bool wants_pictures(const SceneParams& params, const Demand& demand) {
  if (demand.growth || demand.textures == 0) return false;
  return demand.impostor || (params.camera && params.camera->impostors);
}

int levels_made_of(const SceneParams& params, const Demand& demand) {
  if (!chooses_levels(params, demand)) return demand.lods;
  return std::max(demand.lods, wants_pictures(params, demand) ? levels_with_pictures : levels_without);
}

Levels levels_of(const SceneParams& params, const Plan& plan, const std::vector<Stature>& statures,
                 std::uint64_t others, const Job& job) {
  const Views views = views_of(params, plan, statures, job);
  const std::uint64_t most = job.demand().most_triangles;
  const double factor = most > 0 ? factor_for(views, statures, most > others ? most - others : 0, job) : 1;
  Levels levels;
  for (const Array<float>& layer : views.share) levels.emplace_back(job, layer.size(), std::uint8_t{0});
  each_level(views, statures, factor,
             [&](std::size_t layer, std::size_t i, const Stature&, std::size_t level) {
               levels[layer][i] = static_cast<std::uint8_t>(level);
             });
  return levels;
}

}  // namespace seedmesh::scene

/// Competition after Deussen et al., "Realistic modeling and rendering of plant ecosystems", 1998: where
/// crowns overlap, the larger plant dominates. Distances between layers after Lane and Prusinkiewicz,
/// "Generating spatial distributions for multilevel models of plant communities", 2002.
#include "core/generators/scene/place_layers.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/scene/buildings.h"
#include "core/generators/scene/patterns.h"
#include "core/generators/scene/rules.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t placements_a_chunk = 4096;
// Number of placements between two checks of the deadline; a placement can have many neighbours.
constexpr std::size_t placements_a_look = 64;
// Attempts for each requested placement before a layer stops.
constexpr std::size_t most_tries = 64;
constexpr std::size_t least_batch = 1024;

// Random streams of a placement.
constexpr std::uint64_t draw_keep = 1, draw_scale = 2, draw_turn = 3;

double drawn(const Placement& placement, std::uint64_t what) {
  return static_cast<double>(key_at(placement.key, what) >> 11U) * 0x1p-53;
}

struct Span {
  double from, to;
  double at(double share) const { return from + (to - from) * share; }
};

Span span_of(const std::variant<double, std::array<double, 2>>& given) {
  if (const double* one = std::get_if<double>(&given)) return {*one, *one};
  const auto& both = std::get<1>(given);
  return {both[0], both[1]};
}

struct Base {
  glm::dvec2 half{0};
  bool round = true;
};
Base base_of(const SceneLayer& layer) {
  if (!layer.footprint) return {};
  if (const double* radius = std::get_if<double>(&*layer.footprint)) return {glm::dvec2(*radius), true};
  const auto& size = std::get<1>(*layer.footprint);
  return {glm::dvec2(size[0], size[1]) / 2.0, false};
}

/// Processes the layers in order; rules of a layer can use the earlier ones.
class LayerPlacer {
 public:
  LayerPlacer(const SceneParams& params, Ground& ground, Job& job)
      : params_(params), ground_(ground), job_(job), obstacles_(ground.extent(), job) {
    for (const ScenePath& path : params.paths) {
      std::vector<glm::dvec2> points;
      for (const auto& p : path.points) points.emplace_back(p[0], p[1]);
      obstacles_.add_path(path_band_of(std::move(points), path.width));
    }
    if (!params.layers.empty()) obstacles_.add_footprints(footprints_of_buildings(params, job));
    made_.layers.reserve(params.layers.size());
    planted_.reserve(params.layers.size());
  }

  ScenePlacements place_layers() {
    for (std::size_t i = 0; i < params_.layers.size(); ++i) {
      const SceneLayer& layer = params_.layers[i];
      if (Rules::reads_neighbours(layer.place)) settle();
      const std::string pointer = "/layers/" + std::to_string(i) + "/place";
      Array<Placement> placements =
          placements_within_limits(layer, i, pointer + amount_of(layer.place.method));
      add_footprints(layer, placements);
      if (placements.empty()) {
        made_.warnings.push_back({pointer, "no position suits the layer"});
      }
      made_.layers.push_back(std::move(placements));
      planted_.emplace_back();
      planted_.back().crown = layer.crown;
    }
    settle();
    return std::move(made_);
  }

 private:
  Array<Placement> placements_within_limits(const SceneLayer& layer, std::size_t number,
                                            const std::string& pointer) {
    const Job::PointerScope scope(job_, pointer);
    Array<Placement> placements = placements_of(layer, number);
    placements.shrink_to_fit();
    job_.spend(Resource::shapes, placements.size());
    return placements;
  }

  Array<Placement> placements_of(const SceneLayer& layer, std::size_t number) {
    const Rng rng = stream_of(layer, number, job_);
    const ScenePlace& place = layer.place;
    if (place.method == SceneMethod::positions) return explicit_placements(layer, rng);
    std::vector<std::size_t> near;
    for (const SceneNeighbour& each : place.near) near.push_back(number_of(each.layer));
    const Rules rules({place, ground_, obstacles_, planted_, std::move(near), rng.at("noise").key()},
                      "/layers/" + std::to_string(number) + "/place", job_);
    if (place.method == SceneMethod::scatter || place.method == SceneMethod::clusters)
      return series_of(layer, number, rules, part_of(place, ground_.extent()), rng.at("places"));
    Array<Placement> placements = pattern_of(place, ground_.extent(), rng.at("places"), job_);
    std::optional<FootprintSet> taken = footprint_set_of(layer);
    filter(placements, layer, rules, taken);
    if (place.count) thin_out(placements, static_cast<std::size_t>(*place.count), job_);
    return placements;
  }

  std::size_t number_of(const std::string& name) const {
    for (std::size_t i = 0; i < params_.layers.size(); ++i) {
      if (params_.layers[i].name == name) return i;
    }
    return 0;  // check() has validated the names
  }

  Array<Placement> explicit_placements(const SceneLayer& layer, Rng rng) {
    Array<Placement> placements(job_);
    const Rng own = rng.at("position");
    for (std::size_t i = 0; i < layer.place.positions.size(); ++i) {
      const ScenePosition& position = layer.place.positions[i];
      Placement placement;
      placement.at = {position.at[0], position.at[1]};
      placement.key = own.at(i).key();
      placement.position = static_cast<std::uint32_t>(i);
      set_pose(placement, layer);
      if (position.scale) placement.scale = static_cast<float>(*position.scale);
      if (position.turn) placement.turn = static_cast<float>(math::radians(*position.turn));
      placements.push_back(placement);
    }
    return placements;
  }

  /// Takes positions of an infinite series until the requested number is kept.
  Array<Placement> series_of(const SceneLayer& layer, std::size_t number, const Rules& rules,
                             const Extent& part, Rng rng) {
    const ScenePlace& place = layer.place;
    const auto wanted = static_cast<std::size_t>(*place.count);
    Array<Placement> all(job_);
    std::optional<FootprintSet> taken = footprint_set_of(layer);
    std::size_t tried = 0;
    const std::size_t most = tries_of_series(layer);
    while (all.size() < wanted && tried < most) {
      const std::size_t missing = wanted - all.size();
      // Enough attempts for the share kept so far, and at least the missing number.
      const double share =
          tried == 0 ? 1 : (static_cast<double>(all.size()) + 1) / (static_cast<double>(tried) + 1);
      const double likely =
          std::min(static_cast<double>(missing) / share * 1.1, 4.0 * static_cast<double>(wanted));
      const std::size_t batch = std::min(
          most - tried, std::max({static_cast<std::size_t>(math::to_int64(likely)), missing, least_batch}));
      Array<Placement> placements =
          place.method == SceneMethod::scatter
              ? scattered(part, {tried, batch}, rng, job_)
              : clustered(part, {static_cast<std::size_t>(place.clusters->count), place.clusters->radius},
                          {tried, batch}, rng, job_);
      tried += batch;
      filter(placements, layer, rules, taken);
      all.append(placements.span().subspan(0, std::min(missing, placements.size())));
    }
    if (all.size() < wanted) {
      made_.warnings.push_back({"/layers/" + std::to_string(number) + "/place/count",
                                "only " + std::to_string(all.size()) + " of " + std::to_string(wanted) +
                                    " found a position that suits the layer"});
    }
    return all;
  }

  /// Sets scale and turn from the layer, in addition to the turn of the pattern.
  static void set_pose(Placement& placement, const SceneLayer& layer) {
    placement.scale = static_cast<float>(span_of(layer.scale).at(drawn(placement, draw_scale)));
    placement.turn += static_cast<float>(math::radians(span_of(layer.turn).at(drawn(placement, draw_turn))));
  }

  std::optional<FootprintSet> footprint_set_of(const SceneLayer& layer) const {
    if (!layer.footprint) return std::nullopt;
    const double reach = glm::length(base_of(layer).half) * span_of(layer.scale).to;
    return std::make_optional<FootprintSet>(ground_.extent(), 2 * reach, job_);
  }

  /// Keeps the placements that pass the rules and whose footprint overlaps none that was kept earlier.
  void filter(Array<Placement>& placements, const SceneLayer& layer, const Rules& rules,
              std::optional<FootprintSet>& taken) {
    Array<std::uint8_t> marks(job_, placements.size());
    const Base base = base_of(layer);
    const double reach = base.round ? base.half.x : glm::length(base.half);
    parallel_for(
        job_, placements.size(), placements_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
          for (std::size_t i = begin; i < end; ++i) {
            if (i % placements_a_look == 0) job_.check();
            Placement& placement = placements[i];
            set_pose(placement, layer);
            const double share = rules.share(placement.at, reach * static_cast<double>(placement.scale));
            marks[i] = share > 0 && drawn(placement, draw_keep) < share ? 1 : 0;
          }
        });
    if (taken) {
      const double margin = layer.foundation ? ground_.level_margin() : 0;
      for (std::size_t i = 0; i < placements.size(); ++i) {
        if (i % placements_a_look == 0) job_.check();
        if (marks[i] == 0) continue;
        Footprint own = Footprint::of(placements[i], base.half, base.round);
        own.half += margin;
        marks[i] = taken->take(own) ? 1 : 0;
      }
    }
    keep(placements, marks);
  }

  /// Adds the footprints as obstacles for later layers, and levels the ground under foundations.
  void add_footprints(const SceneLayer& layer, const Array<Placement>& placements) {
    if (!layer.footprint) return;
    const Base base = base_of(layer);
    Array<Footprint> footprints(job_);
    footprints.reserve(placements.size());
    for (const Placement& placement : placements)
      footprints.push_back(Footprint::of(placement, base.half, base.round));
    if (layer.foundation) {
      for (const Footprint& each : footprints) ground_.level({each, layer.foundation->slope_width}, job_);
    }
    obstacles_.add_footprints(std::move(footprints));
  }

  /// Lets the crowns of all new layers compete with each other and with older ones, and makes the survivors
  /// visible to later layers.
  void settle() {
    const std::size_t first = competed_, last = made_.layers.size();
    if (first == last) return;
    competed_ = last;
    for (std::size_t i = first; i < last; ++i) open_layer(i);
    if (params_.competition > 0) {
      compete(first, last);
      // The survivors have new indices.
      for (std::size_t i = first; i < last; ++i) open_layer(i);
    }
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t k = 0; k < made_.layers[i].size(); ++k)
        planted_[i].by_position->add(made_.layers[i][k].at, static_cast<std::uint32_t>(k));
    }
  }

  void open_layer(std::size_t i) {
    PlacedLayer& planted = planted_[i];
    const Array<Placement>& placements = made_.layers[i];
    planted.placements = &placements;
    planted.widest_crown = 0;
    for (const Placement& placement : placements) {
      planted.widest_crown =
          std::max(planted.widest_crown, planted.crown * static_cast<double>(placement.scale));
    }
    const glm::dvec2 size = ground_.extent().size();
    const double even = std::sqrt(size.x * size.y /
                                  (static_cast<double>(placements.size()) + 1));  // about one for each square
    planted.by_position.emplace(ground_.extent(), std::max(even, planted.widest_crown), job_);
  }

  struct Rival {
    double crown;
    std::uint32_t layer, index;
    std::uint64_t key;
  };

  void compete(std::size_t first, std::size_t last) {
    Array<Rival> rivals(job_);
    std::vector<Array<std::uint8_t>> alive;
    for (std::size_t i = first; i < last; ++i) {
      const Array<Placement>& placements = made_.layers[i];
      alive.emplace_back(job_, placements.size(), std::uint8_t{1});
      if (planted_[i].crown <= 0) continue;
      for (std::size_t k = 0; k < placements.size(); ++k) {
        rivals.push_back({planted_[i].crown * static_cast<double>(placements[k].scale),
                          static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), placements[k].key});
      }
    }
    // Explicit positions are always kept; then the largest come first.
    const auto pose_of = [&](const Rival& rival) { return made_.layers[rival.layer][rival.index].position; };
    std::sort(rivals.begin(), rivals.end(), [&](const Rival& a, const Rival& b) {
      const bool a_is_set = pose_of(a) != no_position, b_is_set = pose_of(b) != no_position;
      if (a_is_set != b_is_set) return a_is_set;
      if (a.crown != b.crown) return a.crown > b.crown;
      if (a.layer != b.layer) return a.layer < b.layer;
      return a.key != b.key ? a.key < b.key : a.index < b.index;
    });
    for (const Rival& rival : rivals) {
      job_.check();
      const Placement& placement = made_.layers[rival.layer][rival.index];
      if (placement.position == no_position && is_beaten(placement.at, rival.crown, last)) {
        alive[rival.layer - first][rival.index] = 0;
      } else {
        planted_[rival.layer].by_position->add(placement.at, rival.index);
      }
    }
    for (std::size_t i = first; i < last; ++i) keep(made_.layers[i], alive[i - first]);
  }

  bool is_beaten(const glm::dvec2& at, double crown, std::size_t layers) const {
    for (std::size_t i = 0; i < layers; ++i) {
      const PlacedLayer& other = planted_[i];
      if (other.crown <= 0) continue;
      const double most = params_.competition * (crown + other.widest_crown);
      const bool beaten = other.by_position->any(at, most, [&](std::uint32_t id, double squared) {
        const double least =
            params_.competition * (crown + other.crown * static_cast<double>((*other.placements)[id].scale));
        return squared < least * least;
      });
      if (beaten) return true;
    }
    return false;
  }

  const SceneParams& params_;
  Ground& ground_;
  Job& job_;
  Obstacles obstacles_;
  ScenePlacements made_;
  std::vector<PlacedLayer> planted_;
  std::size_t competed_ = 0;  ///< number of layers after competition, searchable by position
};

}  // namespace

std::size_t tries_of_series(const SceneLayer& layer) {
  return std::max(static_cast<std::size_t>(*layer.place.count) * most_tries, least_batch);
}

Rng stream_of(const SceneLayer& layer, std::size_t number, const Job& job) {
  const Rng layers = job.rng().at("scene").at("layer");
  return layer.name ? layers.at(*layer.name) : layers.at(number);
}

ScenePlacements place_layers(const SceneParams& params, Ground& ground, Job& job) {
  return LayerPlacer(params, ground, job).place_layers();
}

}  // namespace seedmesh::scene

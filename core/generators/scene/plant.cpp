/// Competition after Deussen et al., "Realistic modeling and rendering of plant ecosystems", 1998: where
/// crowns overlap, the larger plant dominates. Distances between layers after Lane and Prusinkiewicz,
/// "Generating spatial distributions for multilevel models of plant communities", 2002.
#include "core/generators/scene/plant.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/scene/blame.h"
#include "core/generators/scene/patterns.h"
#include "core/generators/scene/rules.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t stands_a_chunk = 4096;
// Between two looks at the clock: a stand may have many neighbours to ask.
constexpr std::size_t stands_a_look = 64;
// Darts for each place that is wanted, before a layer gives up.
constexpr std::size_t most_tries = 64;
constexpr std::size_t least_batch = 1024;

// What is drawn for a stand.
constexpr std::uint64_t draw_keep = 1, draw_scale = 2, draw_turn = 3;

double drawn(const Stand& stand, std::uint64_t what) {
  return static_cast<double>(key_at(stand.key, what) >> 11U) * 0x1p-53;
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

/// Layers in their order, each seeing those before it.
class Planter {
 public:
  Planter(const SceneParams& params, Ground& ground, Job& job)
      : params_(params), ground_(ground), job_(job), obstacles_(ground.extent(), job) {
    for (const ScenePath& path : params.paths) {
      std::vector<glm::dvec2> points;
      for (const auto& p : path.points) points.emplace_back(p[0], p[1]);
      obstacles_.add_way(way_of(std::move(points), path.width));
    }
    made_.layers.reserve(params.layers.size());
    planted_.reserve(params.layers.size());
  }

  Planting plant() {
    for (std::size_t i = 0; i < params_.layers.size(); ++i) {
      const SceneLayer& layer = params_.layers[i];
      if (Rules::look_at_others(layer.place)) settle();
      const std::string place = "/layers/" + std::to_string(i) + "/place";
      Array<Stand> stands = blaming(place + amount_of(layer.place.method), [&] {
        Array<Stand> own = stands_of(layer, i);
        own.shrink_to_fit();
        job_.spend(Resource::shapes, own.size());
        return own;
      });
      add_footprints(layer, stands);
      if (stands.empty()) {
        made_.warnings.push_back({place, "no place suits the layer"});
      }
      made_.layers.push_back(std::move(stands));
      planted_.emplace_back();
      planted_.back().crown = layer.crown;
    }
    settle();
    return std::move(made_);
  }

 private:
  Array<Stand> stands_of(const SceneLayer& layer, std::size_t number) {
    const Rng rng = stream_of(layer, number, job_);
    const ScenePlace& place = layer.place;
    if (place.method == SceneMethod::positions) return explicit_stands(layer, rng);
    std::vector<std::size_t> near;
    for (const SceneNeighbour& each : place.near) near.push_back(number_of(each.layer));
    const Rules rules({place, ground_, obstacles_, planted_, std::move(near), rng.at("noise").key()},
                      "/layers/" + std::to_string(number) + "/place", job_);
    if (place.method == SceneMethod::scatter || place.method == SceneMethod::clusters)
      return series_of(layer, number, rules, part_of(place, ground_.extent()), rng.at("places"));
    Array<Stand> stands = pattern_of(place, ground_.extent(), rng.at("places"), job_);
    std::optional<Plots> plots = plots_of(layer);
    sift(stands, layer, rules, plots);
    if (place.count) thin_out(stands, static_cast<std::size_t>(*place.count), job_);
    return stands;
  }

  std::size_t number_of(const std::string& name) const {
    for (std::size_t i = 0; i < params_.layers.size(); ++i) {
      if (params_.layers[i].name == name) return i;
    }
    return 0;  // check() has seen the names
  }

  Array<Stand> explicit_stands(const SceneLayer& layer, Rng rng) {
    Array<Stand> stands(job_);
    const Rng own = rng.at("position");
    for (std::size_t i = 0; i < layer.place.positions.size(); ++i) {
      const ScenePosition& position = layer.place.positions[i];
      Stand stand;
      stand.at = {position.at[0], position.at[1]};
      stand.key = own.at(i).key();
      stand.position = static_cast<std::uint32_t>(i);
      look(stand, layer);
      if (position.scale) stand.scale = static_cast<float>(*position.scale);
      if (position.turn) stand.turn = static_cast<float>(math::radians(*position.turn));
      stands.push_back(stand);
    }
    return stands;
  }

  /// Places of an endless series until there are as many as are wanted.
  Array<Stand> series_of(const SceneLayer& layer, std::size_t number, const Rules& rules, const Extent& part,
                         Rng rng) {
    const ScenePlace& place = layer.place;
    const auto wanted = static_cast<std::size_t>(*place.count);
    Array<Stand> all(job_);
    std::optional<Plots> plots = plots_of(layer);
    std::size_t tried = 0;
    const std::size_t most = std::max(wanted * most_tries, least_batch);
    while (all.size() < wanted && tried < most) {
      const std::size_t missing = wanted - all.size();
      // As many as the share so far makes likely, and at least as many as are missing.
      const double share =
          tried == 0 ? 1 : (static_cast<double>(all.size()) + 1) / (static_cast<double>(tried) + 1);
      const double likely =
          std::min(static_cast<double>(missing) / share * 1.1, 4.0 * static_cast<double>(wanted));
      const std::size_t batch = std::min(
          most - tried, std::max({static_cast<std::size_t>(math::to_int64(likely)), missing, least_batch}));
      Array<Stand> stands =
          place.method == SceneMethod::scatter
              ? scattered(part, {tried, batch}, rng, job_)
              : clustered(part, {static_cast<std::size_t>(place.clusters->count), place.clusters->radius},
                          {tried, batch}, rng, job_);
      tried += batch;
      sift(stands, layer, rules, plots);
      all.append(stands.span().subspan(0, std::min(missing, stands.size())));
    }
    if (all.size() < wanted) {
      made_.warnings.push_back({"/layers/" + std::to_string(number) + "/place/count",
                                "only " + std::to_string(all.size()) + " of " + std::to_string(wanted) +
                                    " found a place that suits the layer"});
    }
    return all;
  }

  /// Size and turn by the layer, over the turn of the pattern.
  static void look(Stand& stand, const SceneLayer& layer) {
    stand.scale = static_cast<float>(span_of(layer.scale).at(drawn(stand, draw_scale)));
    stand.turn += static_cast<float>(math::radians(span_of(layer.turn).at(drawn(stand, draw_turn))));
  }

  std::optional<Plots> plots_of(const SceneLayer& layer) const {
    if (!layer.footprint) return std::nullopt;
    const double reach = glm::length(base_of(layer).half) * span_of(layer.scale).to;
    return std::make_optional<Plots>(ground_.extent(), 2 * reach, job_);
  }

  /// Keeps what suits the rules and, where they have footprints, stands on none that is kept already.
  void sift(Array<Stand>& stands, const SceneLayer& layer, const Rules& rules, std::optional<Plots>& plots) {
    Array<std::uint8_t> marks(job_, stands.size());
    const Base base = base_of(layer);
    const double reach = base.round ? base.half.x : glm::length(base.half);
    parallel_for(job_, stands.size(), stands_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) {
        if (i % stands_a_look == 0) job_.check();
        Stand& stand = stands[i];
        look(stand, layer);
        const double share = rules.share(stand.at, reach * static_cast<double>(stand.scale));
        marks[i] = share > 0 && drawn(stand, draw_keep) < share ? 1 : 0;
      }
    });
    if (plots) {
      const double margin = layer.foundation ? ground_.level_margin() : 0;
      for (std::size_t i = 0; i < stands.size(); ++i) {
        if (i % stands_a_look == 0) job_.check();
        if (marks[i] == 0) continue;
        Footprint own = Footprint::of(stands[i], base.half, base.round);
        own.half += margin;
        marks[i] = plots->take(own) ? 1 : 0;
      }
    }
    keep(stands, marks);
  }

  /// What stands on the ground keeps later layers off; foundations level it.
  void add_footprints(const SceneLayer& layer, const Array<Stand>& stands) {
    if (!layer.footprint) return;
    const Base base = base_of(layer);
    Array<Footprint> footprints(job_);
    footprints.reserve(stands.size());
    for (const Stand& stand : stands) footprints.push_back(Footprint::of(stand, base.half, base.round));
    if (layer.foundation) {
      for (const Footprint& each : footprints) ground_.level({each, layer.foundation->slope_width}, job_);
    }
    obstacles_.add_footprints(std::move(footprints));
  }

  /// Lets the crowns of all layers since the last time compete with each other and with those that have stood
  /// longer, and makes all of them known to later layers.
  void settle() {
    const std::size_t first = settled_, last = made_.layers.size();
    if (first == last) return;
    settled_ = last;
    for (std::size_t i = first; i < last; ++i) open_layer(i);
    if (params_.competition > 0) {
      compete(first, last);
      // The survivors have new numbers.
      for (std::size_t i = first; i < last; ++i) open_layer(i);
    }
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t k = 0; k < made_.layers[i].size(); ++k)
        planted_[i].by_place->add(made_.layers[i][k].at, static_cast<std::uint32_t>(k));
    }
  }

  void open_layer(std::size_t i) {
    Planted& planted = planted_[i];
    const Array<Stand>& stands = made_.layers[i];
    planted.stands = &stands;
    planted.widest_crown = 0;
    for (const Stand& stand : stands) {
      planted.widest_crown = std::max(planted.widest_crown, planted.crown * static_cast<double>(stand.scale));
    }
    const glm::dvec2 size = ground_.extent().size();
    const double even =
        std::sqrt(size.x * size.y / (static_cast<double>(stands.size()) + 1));  // about one a square
    planted.by_place.emplace(ground_.extent(), std::max(even, planted.widest_crown), job_);
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
      const Array<Stand>& stands = made_.layers[i];
      alive.emplace_back(job_, stands.size(), std::uint8_t{1});
      if (planted_[i].crown <= 0) continue;
      for (std::size_t k = 0; k < stands.size(); ++k) {
        rivals.push_back({planted_[i].crown * static_cast<double>(stands[k].scale),
                          static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), stands[k].key});
      }
    }
    // Explicit positions stand whatever comes; then the largest first.
    const auto place_of = [&](const Rival& rival) { return made_.layers[rival.layer][rival.index].position; };
    std::sort(rivals.begin(), rivals.end(), [&](const Rival& a, const Rival& b) {
      const bool a_is_set = place_of(a) != no_position, b_is_set = place_of(b) != no_position;
      if (a_is_set != b_is_set) return a_is_set;
      if (a.crown != b.crown) return a.crown > b.crown;
      if (a.layer != b.layer) return a.layer < b.layer;
      return a.key != b.key ? a.key < b.key : a.index < b.index;
    });
    for (const Rival& rival : rivals) {
      job_.check();
      const Stand& stand = made_.layers[rival.layer][rival.index];
      if (stand.position == no_position && is_beaten(stand.at, rival.crown, last)) {
        alive[rival.layer - first][rival.index] = 0;
      } else {
        planted_[rival.layer].by_place->add(stand.at, rival.index);
      }
    }
    for (std::size_t i = first; i < last; ++i) keep(made_.layers[i], alive[i - first]);
  }

  bool is_beaten(const glm::dvec2& at, double crown, std::size_t layers) const {
    for (std::size_t i = 0; i < layers; ++i) {
      const Planted& other = planted_[i];
      if (other.crown <= 0) continue;
      const double most = params_.competition * (crown + other.widest_crown);
      const bool beaten = other.by_place->any(at, most, [&](std::uint32_t id, double squared) {
        const double least =
            params_.competition * (crown + other.crown * static_cast<double>((*other.stands)[id].scale));
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
  Planting made_;
  std::vector<Planted> planted_;
  std::size_t settled_ = 0;  ///< layers that have competed and are known by place
};

}  // namespace

Rng stream_of(const SceneLayer& layer, std::size_t number, const Job& job) {
  const Rng layers = job.rng().at("scene").at("layer");
  return layer.name ? layers.at(*layer.name) : layers.at(number);
}

Planting plant(const SceneParams& params, Ground& ground, Job& job) {
  return Planter(params, ground, job).plant();
}

}  // namespace seedmesh::scene

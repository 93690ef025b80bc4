// Trees of parks and yards, and the borders between lots.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "core/base/math.h"
#include "core/generators/city/house_box.h"
#include "core/generators/city/objects.h"
#include "core/generators/city/rings.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double park_margin = 2.5, yard_margin = 1.6, house_margin = 2.5,
                 jitter = 0.38;      // m; share of a cell
constexpr double least_piece = 0.8;  // of borders, m
constexpr int tries = 6;

bool is_far_from(const std::vector<CmRing>& rings, const dvec2& p, double margin) {
  return std::all_of(rings.begin(), rings.end(),
                     [&](const CmRing& ring) { return distance_to_ring(ring, p) >= margin; });
}

CityObject tree_at(const dvec2& p, std::uint32_t part, std::uint32_t models, Rng& draw) {
  CityObject tree;
  tree.position = p;
  tree.turn = draw.uniform(0, 360);
  tree.scale = draw.uniform(0.8, 1.2);
  tree.model = draw.below(models);
  tree.part = part;
  return tree;
}

/// Trees on a jittered lattice whose cells are numbered from the origin, so that a park keeps its trees where its
/// outline stays.
void plant_park(const CityPlan& plan, std::uint32_t number, double spacing, Rng rng, ObjectKind& kind) {
  const Part& part = plan.parts[number];
  dvec2 low(1e9), high(-1e9);
  for (const CmPoint& p : part.rings[0]) {
    low = glm::min(low, in_metres(p));
    high = glm::max(high, in_metres(p));
  }
  const auto cell = [spacing](double value) { return math::to_int32(std::floor(value / spacing)); };
  for (int row = cell(low.y); row <= cell(high.y); ++row) {
    for (int column = cell(low.x); column <= cell(high.x); ++column) {
      Rng draw = rng.at(static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)))
                     .at(static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)));
      const double north = draw.uniform(-jitter, jitter), east = draw.uniform(-jitter, jitter);
      const dvec2 p((column + 0.5 + east) * spacing, (row + 0.5 + north) * spacing);
      if (!is_in(part.rings, p * 100.0) || !is_far_from(part.rings, p, park_margin)) continue;
      const bool is_kept =
          std::any_of(plan.landmarks.begin(), plan.landmarks.end(),
                      [&](const Landmark& each) { return glm::length(each.position - p) < each.radius; });
      if (!is_kept) kind.objects.push_back(tree_at(p, number, kind.model_count(), draw));
    }
  }
}

void plant_yard(const CityPlan& plan, const Lot& lot, double mean, Rng rng, ObjectKind& kind) {
  const std::vector<CmRing>& rings = plan.parts[lot.part].rings;
  const HouseBox house = box_of(*lot.house);
  dvec2 low(1e9), high(-1e9);
  for (const CmPoint& p : lot.corners) {
    low = glm::min(low, in_metres(p));
    high = glm::max(high, in_metres(p));
  }
  Rng draw = rng.at(lot.key);
  const double wanted = mean * (lot.area - lot.house->width * lot.house->depth) / 600;
  const int count = math::to_int32(std::floor(wanted + draw.unit()));
  std::vector<dvec2> placed;
  for (int i = 0; i < count; ++i) {
    for (int n = 0; n < tries; ++n) {
      const double north = draw.uniform(low.y, high.y), east = draw.uniform(low.x, high.x);
      const dvec2 p(east, north);
      const bool is_near_tree = std::any_of(placed.begin(), placed.end(),
                                            [&p](const dvec2& each) { return glm::length(each - p) < 4; });
      if (is_near_tree || house.contains(p, house_margin) || !is_in(rings, p * 100.0) ||
          !is_far_from(rings, p, yard_margin))
        continue;
      placed.push_back(p);
      kind.objects.push_back(tree_at(p, lot.part, kind.model_count(), draw));
      break;
    }
  }
}

/// An edge of a lot's outline, from the lower to the higher corner.
struct LotEdge {
  CmPoint a, b;
  std::uint32_t lot = 0;
  friend auto operator<=>(const LotEdge&, const LotEdge&) = default;
};

/// A border between two lots; edges in a row of the same two lots and direction are one.
struct LotBorder {
  dvec2 a{0}, b{0};
  std::array<std::uint32_t, 2> lots{};
};

std::vector<LotEdge> edges_of_lots(const CityPlan& plan) {
  std::vector<LotEdge> edges;
  for (std::uint32_t i = 0; i < plan.lots.size(); ++i) {
    for (const CmRing& ring : plan.parts[plan.lots[i].part].rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const CmPoint &a = ring[k], &b = ring[(k + 1) % ring.size()];
        edges.push_back({std::min(a, b), std::max(a, b), i});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<LotBorder> borders_between(const std::vector<LotEdge>& edges) {
  std::vector<LotBorder> borders;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].a != edges[i + 1].a || edges[i].b != edges[i + 1].b) continue;
    borders.push_back({in_metres(edges[i].a), in_metres(edges[i].b), {edges[i].lot, edges[i + 1].lot}});
  }
  const auto key = [](const LotBorder& each) { return each.lots; };
  std::stable_sort(borders.begin(), borders.end(),
                   [&](const LotBorder& a, const LotBorder& b) { return key(a) < key(b); });
  std::vector<LotBorder> joined;
  for (const LotBorder& each : borders) {
    if (!joined.empty() && joined.back().lots == each.lots) {
      LotBorder& last = joined.back();
      const dvec2 run = last.b - last.a, next = each.b - each.a;
      const double turn = std::abs(run.x * next.y - run.y * next.x);
      if (last.b == each.a && turn < 0.02 * glm::length(run) * glm::length(next)) {
        last.b = each.b;
        continue;
      }
    }
    joined.push_back(each);
  }
  return joined;
}

/// Adds what is left of a border outside of the houses of its lots.
void add_pieces(const CityPlan& plan, const LotBorder& border, std::vector<BorderPiece>& pieces) {
  const double length = glm::length(border.b - border.a);
  if (length < least_piece) return;
  const double trim = 0.6 / length;  // pieces that meet at a corner do not touch
  std::vector<std::array<double, 2>> free = {{trim, 1 - trim}};
  for (const std::uint32_t number : border.lots) {
    if (!plan.lots[number].house) continue;
    const auto taken = covered(box_of(*plan.lots[number].house), border.a, border.b);
    if (!taken) continue;
    std::vector<std::array<double, 2>> left;
    for (const auto& each : free) {
      if (each[0] < (*taken)[0]) left.push_back({each[0], std::min(each[1], (*taken)[0])});
      if (each[1] > (*taken)[1]) left.push_back({std::max(each[0], (*taken)[1]), each[1]});
    }
    free = std::move(left);
  }
  for (const auto& each : free) {
    if ((each[1] - each[0]) * length < least_piece) continue;
    pieces.push_back({border.a + (border.b - border.a) * each[0], border.a + (border.b - border.a) * each[1],
                      plan.lots[border.lots[0]].part, plan.lots[border.lots[1]].part});
  }
}

}  // namespace

double distance_to_ring(const CmRing& ring, const glm::dvec2& metres) {
  double least = 1e18;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    least = std::min(least,
                     distance_to_segment(metres * 100.0, in_cm(ring[i]), in_cm(ring[(i + 1) % ring.size()])));
  }
  return least / 100;
}

std::vector<ObjectKind> trees_of(const CityPlan& plan, const CityParams& params, const Job& job) {
  std::vector<ObjectKind> kinds;
  if (params.parks) {
    ObjectKind kind{"park_trees", "/parks/models", params.parks->models, {}};
    const Rng rng = job.rng().at("parks");
    for (std::uint32_t i = 0; i < plan.parts.size(); ++i) {
      const Part& part = plan.parts[i];
      if (part.kind != PartKind::park) continue;
      job.check();
      const std::uint64_t key = part.block == no_index ? 0 : plan.blocks[part.block].key;
      plant_park(plan, i, params.parks->spacing, rng.at(key), kind);
    }
    kinds.push_back(std::move(kind));
  }
  if (params.yards && params.yards->trees > 0) {
    ObjectKind kind{"yard_trees", "/yards/models", params.yards->models, {}};
    const Rng rng = job.rng().at("yards");
    for (std::size_t i = 0; i < plan.lots.size(); ++i) {
      if (i % 256 == 0) job.check();
      if (plan.lots[i].house) plant_yard(plan, plan.lots[i], params.yards->trees, rng, kind);
    }
    kinds.push_back(std::move(kind));
  }
  std::erase_if(kinds, [](const ObjectKind& kind) { return kind.objects.empty(); });
  return kinds;
}

std::vector<BorderPiece> lot_borders(const CityPlan& plan, const Job& job) {
  std::vector<BorderPiece> pieces;
  const std::vector<LotBorder> borders = borders_between(edges_of_lots(plan));
  for (std::size_t i = 0; i < borders.size(); ++i) {
    if (i % 1024 == 0) job.check();
    if (plan.lots[borders[i].lots[0]].house || plan.lots[borders[i].lots[1]].house)
      add_pieces(plan, borders[i], pieces);
  }
  return pieces;
}

}  // namespace seedmesh::city

// Dimensions and distances: docs/cities.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/base/math.h"
#include "core/generators/city/furniture_models.h"
#include "core/generators/city/objects.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double kerb_tolerance = 0.06;   // of corners beside the kerb line, m
constexpr double least_tree_spacing = 2;  // m

/// One side of a street, along its kerb in the direction from the end with the smaller key.
struct Side {
  dvec2 start{0}, along{1, 0}, inward{0, 1};  ///< inward: from the street to the lots
  double length = 0, sidewalk = 0, carriageway = 0;
  std::optional<double> tree_spacing = {};           ///< spacing of the class of the street
  std::array<bool, 2> at_junction = {false, false};  ///< whether the start and the end are at a junction
  bool is_right = false;                             ///< whether the side is to the right of `along`
  std::uint64_t key = 0;
  std::uint32_t part = 0;  ///< the carriageway
};

/// The range along a line of the corners that lie beside it at a distance, positive to the left; metres.
std::optional<std::array<double, 2>> range_beside(const CmRing& ring, const dvec2& start, const dvec2& along,
                                                  double distance) {
  const dvec2 left(-along.y, along.x);
  double low = 1e9, high = -1e9;
  for (const CmPoint& p : ring) {
    const dvec2 off = in_metres(p) - start;
    if (std::abs(glm::dot(off, left) - distance) > kerb_tolerance) continue;
    low = std::min(low, glm::dot(off, along));
    high = std::max(high, glm::dot(off, along));
  }
  if (high - low < 1) return std::nullopt;
  return std::array<double, 2>{low, high};
}

void add_sides(const CityPlan& plan, std::uint32_t number, std::vector<Side>& sides) {
  const Part& part = plan.parts[number];
  const PlanarEdge& edge = plan.graph.edges[part.street];
  const CrossSection& section = plan.class_of(part.street);
  const bool is_forward = plan.graph.node_key[edge.from] < plan.graph.node_key[edge.to];
  const std::uint32_t first = is_forward ? edge.from : edge.to, last = is_forward ? edge.to : edge.from;
  const dvec2 a = in_metres(plan.graph.nodes[first]), b = in_metres(plan.graph.nodes[last]);
  const double length = glm::length(b - a);
  if (length < 1) return;
  const dvec2 along = (b - a) / length, left(-along.y, along.x);
  for (const bool is_right : {false, true}) {
    const bool is_right_of_edge = is_right == is_forward;
    if (section.has_wall && is_right_of_edge) continue;
    const double sign = is_right ? -1 : 1;
    const auto range = range_beside(part.rings[0], a, along, sign * section.width / 2);
    if (!range) continue;
    Side side;
    side.inward = left * sign;
    side.along = along;
    side.start = a + along * (*range)[0] + side.inward * (section.width / 2);
    side.length = (*range)[1] - (*range)[0];
    side.sidewalk = section.sidewalk[is_right_of_edge ? 1 : 0];
    side.carriageway = section.width;
    side.tree_spacing = section.tree_spacing;
    side.at_junction = {plan.graph.street_ends(first) > 2, plan.graph.street_ends(last) > 2};
    side.is_right = is_right;
    side.part = number;
    side.key = key_at(plan.graph.edge_key[part.street], is_right ? 1 : 0);
    sides.push_back(side);
  }
}

/// Places objects along one side so that none touches another.
class SideFiller {
 public:
  /// `walks`: the parts of the plan that are sidewalks of the street.
  SideFiller(const CityPlan& plan, const Side& side, std::span<const std::uint32_t> walks, Rng rng)
      : plan_(plan), side_(side), walks_(walks), rng_(rng.at(side.key)) {}

  struct Rule {
    std::uint64_t name = 0;
    double spacing = 10, share = 1;
    double margin = 1;    ///< metres from the ends
    double junction = 1;  ///< metres from ends at a junction
    double radius = 0.4;  ///< space along the street on either side
    double offset = 0.5;  ///< metres from the kerb; negative on the carriageway
    int parity = -1;      ///< 0, 1: every second position; -1: all
    double turn = 0;      ///< degrees from facing the street
  };

  /// Adds objects at the positions of a rule.
  void fill(const Rule& rule, ObjectKind& kind) {
    const double low = side_.at_junction[0] ? rule.junction : rule.margin;
    const double high = side_.length - (side_.at_junction[1] ? rule.junction : rule.margin);
    if (high - low < 2 * rule.radius) return;
    const auto count = std::max(1, math::to_int32(std::floor((high - low) / rule.spacing)));
    const double first = (low + high) / 2 - rule.spacing * (count - 1) / 2;
    for (int i = 0; i < count; ++i) {
      if (rule.parity >= 0 && i % 2 != rule.parity) continue;
      add(rule, static_cast<std::uint64_t>(i), first + rule.spacing * i, kind);
    }
  }

  void add(const Rule& rule, std::uint64_t index, double at, ObjectKind& kind) {
    Rng draw = rng_.at(rule.name).at(index);
    if (draw.unit() >= rule.share || !is_free(at, rule)) return;
    CityObject object;
    object.position = side_.start + side_.along * at + side_.inward * rule.offset;
    object.turn = turn_of(side_.inward) + rule.turn;
    object.model = draw.below(kind.model_count());
    // In narrow faces, sidewalks are narrower than the class has them.
    object.part = rule.offset < 0 ? side_.part : walk_at(object.position);
    if (object.part == no_index) return;
    kind.objects.push_back(object);
  }

 private:
  bool is_free(double at, const Rule& rule) {
    if (rule.offset < 0) return true;  // cars are not on the sidewalk
    for (const auto& [place, radius] : taken_) {
      if (std::abs(place - at) < radius + rule.radius) return false;
    }
    taken_.emplace_back(at, rule.radius);
    return true;
  }

  /// The sidewalk at a position; no_index beside all.
  std::uint32_t walk_at(const dvec2& metres) const {
    const auto found = std::find_if(walks_.begin(), walks_.end(), [&](std::uint32_t part) {
      return is_inside(plan_.parts[part].rings[0], metres * 100.0);
    });
    return found == walks_.end() ? no_index : *found;
  }

  const CityPlan& plan_;
  const Side& side_;
  std::span<const std::uint32_t> walks_;
  Rng rng_;
  std::vector<std::pair<double, double>> taken_;
};

template <class Row>
void begin_kind(std::vector<ObjectKind>& kinds, const std::optional<Row>& row, const char* name) {
  ObjectKind kind;
  kind.name = name;
  kind.pointer = std::string("/furniture/") + name + "/models";
  if (row) kind.models = row->models;
  kinds.push_back(std::move(kind));
}

void fill_side(const CityPlan& plan, const Side& side, std::span<const std::uint32_t> walks,
               const CityFurniture& wanted, Rng rng, std::vector<ObjectKind>& kinds) {
  SideFiller filler(plan, side, walks, rng);
  const double near_kerb = std::min(0.45, side.sidewalk / 2);
  if (wanted.lamps) {
    filler.fill(
        {0, wanted.lamps->spacing / 2, wanted.lamps->share, 2, 3, 0.5, near_kerb, side.is_right ? 1 : 0},
        kinds[0]);
  }
  // A sign stands where traffic on the right side of the street arrives at a junction.
  if (wanted.signs && side.at_junction[side.is_right ? 1 : 0] && side.length > 12) {
    const double at = side.is_right ? side.length - 2 : 2;
    filler.add({4, 0, wanted.signs->share, 0, 0, 0.4, near_kerb, -1, 90}, 0, at, kinds[4]);
  }
  if (wanted.bins && side.sidewalk >= 1.2)
    filler.fill({3, wanted.bins->spacing, wanted.bins->share, 3, 6, 0.6, near_kerb, -1}, kinds[3]);
  if (wanted.benches && side.sidewalk >= 1.8) {
    filler.fill({2, wanted.benches->spacing, wanted.benches->share, 4, 8, 1.4, side.sidewalk - 0.55, -1},
                kinds[2]);
  }
  const double tree_spacing = side.tree_spacing.value_or(wanted.trees ? wanted.trees->spacing : 0);
  const double tree_share = wanted.trees ? wanted.trees->share : CityTrees{}.share;
  if (tree_spacing > 0 && side.sidewalk >= 1.5) {
    filler.fill({1, std::max(tree_spacing, least_tree_spacing), tree_share, 2, 8, 0.6,
                 std::min(1.0, side.sidewalk / 2), -1},
                kinds[1]);
  }
  if (wanted.cars && side.carriageway >= 6)
    filler.fill({5, wanted.cars->spacing, wanted.cars->share, 5, 8, 2.6, -1.1, -1}, kinds[5]);
}

}  // namespace

std::uint32_t ObjectKind::model_count() const {
  return models.empty() ? built_in_count(name) : static_cast<std::uint32_t>(models.size());
}

double turn_of(const glm::dvec2& inward) {
  return std::floor(math::degrees(math::atan2(-inward.x, inward.y)) * 1e4 + 0.5) / 1e4;
}

bool has_street_furniture(const CityParams& params) {
  const CityClasses& classes = params.streets.classes;
  return params.furniture != CityFurniture{} || classes.highway.trees || classes.major.trees ||
         classes.minor.trees || classes.lane.trees;
}

std::vector<ObjectKind> street_furniture(const CityPlan& plan, const CityParams& params, const Job& job) {
  if (!has_street_furniture(params)) return {};
  const CityFurniture& wanted = params.furniture;
  std::vector<ObjectKind> kinds;
  begin_kind(kinds, wanted.lamps, "lamps");
  begin_kind(kinds, wanted.trees, "trees");
  begin_kind(kinds, wanted.benches, "benches");
  begin_kind(kinds, wanted.bins, "bins");
  begin_kind(kinds, wanted.signs, "signs");
  begin_kind(kinds, wanted.cars, "cars");
  const Rng rng = job.rng().at("furniture");
  std::vector<std::vector<std::uint32_t>> walks(plan.graph.edges.size());
  for (std::uint32_t i = 0; i < plan.parts.size(); ++i) {
    const Part& part = plan.parts[i];
    if (part.kind == PartKind::sidewalk && part.street != no_index) walks[part.street].push_back(i);
  }
  std::vector<Side> sides;
  for (std::uint32_t i = 0; i < plan.parts.size(); ++i) {
    const Part& part = plan.parts[i];
    if (part.kind != PartKind::carriageway || part.street == no_index || part.rings.empty()) continue;
    job.check();
    sides.clear();
    add_sides(plan, i, sides);
    for (const Side& side : sides) fill_side(plan, side, walks[part.street], wanted, rng, kinds);
  }
  std::erase_if(kinds, [](const ObjectKind& kind) { return kind.objects.empty(); });
  return kinds;
}

}  // namespace seedmesh::city

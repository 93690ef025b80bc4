// Minor streets within a cell of major streets.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "core/base/math.h"
#include "core/generators/city/cell_division.h"
#include "core/generators/city/dead_ends.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/tensor.h"
#include "core/generators/city/tunnel_clearance.h"
#include "core/generators/city/vectors.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double piece_length = 3000;  // of a bent street, cm
constexpr double least_density = 0.1;
constexpr std::uint64_t most_steps_of_a_cell = 100'000;

std::uint64_t point_key(const CmPoint& p) {
  return key_at(key_at(0xCE11, static_cast<std::uint32_t>(p.x)), static_cast<std::uint32_t>(p.y));
}

class Cell final : public RoadRules {
 public:
  Cell(const GrowthInput& input, const TunnelClearance& tunnels, Rng rng)
      : input_(input),
        streets_(input.streets),
        tunnels_(tunnels),
        rng_(rng),
        network_(limits_of(input.streets)) {
    is_along_field_ = input.minor_field != nullptr;
    if (streets_.minor_pattern) {
      is_raster_ = *streets_.minor_pattern == CityMinorPattern::raster;
      is_radial_ = *streets_.minor_pattern == CityMinorPattern::radial;
    } else {
      is_raster_ = streets_.pattern == CityPattern::raster;
      is_radial_ = streets_.pattern == CityPattern::radial;
    }
  }

  void add_loop(const StreetGraph& majors, const std::vector<std::uint32_t>& loop) {
    for (const std::uint32_t half : loop) {
      const std::uint32_t from = node_of(majors.nodes[start_of(majors.edges, half)]);
      const std::uint32_t to = node_of(majors.nodes[end_of(majors.edges, half)]);
      const PlanarEdge& edge = majors.edges[half / 2];
      if (!seen_.emplace(half / 2, 0).second) continue;
      // Given streets of all classes count as major ones here.
      const auto kind = edge.tag >= first_given ? EdgeClass::major : static_cast<EdgeClass>(edge.tag);
      network_.add_edge(from, to, kind, is_street_class(kind));
    }
    std::vector<std::uint32_t> ring;
    ring.reserve(loop.size());
    for (const std::uint32_t half : loop) ring.push_back(node_of(majors.nodes[start_of(majors.edges, half)]));
    rings_.push_back(std::move(ring));
    std::vector<std::uint8_t> borders;
    borders.reserve(loop.size());
    for (const std::uint32_t half : loop)
      borders.push_back(is_street_tag(majors.edges[half / 2].tag) ? 0 : 1);
    borders_.push_back(std::move(borders));
  }

  /// Growth starts at the nodes of the outline whose draws are the least within three quarters of a street.
  std::vector<StreetGrammar::Start> starts() {
    std::vector<StreetGrammar::Start> all;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const std::vector<std::uint32_t>& ring = rings_[r];
      const std::size_t count = ring.size();
      std::vector<double> draw;
      draw.reserve(count);
      for (const std::uint32_t node : ring) draw.push_back(draw_of(node));
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t before = (i + count - 1) % count;
        if (borders_[r][i] != 0 || borders_[r][before] != 0 || !is_least(ring, draw, i)) continue;
        if (network_.is_closed(ring[i])) continue;
        const dvec2 in = inward_at(network_, ring[before], ring[i], ring[(i + 1) % count]);
        const std::uint64_t key =
            rng_.at("start").at(point_key(network_.nodes()[ring[i]])).at(side_of(in)).key();
        all.push_back({0, 1, propose(ring[i], in, Rng(key)), key});
      }
    }
    for (const std::vector<std::uint32_t>& street : across_) add_starts(street, all);
    return all;
  }

  /// Whether a cell on hills has much fewer streets than space: steep ground can end all branches at its start.
  bool is_sparse() const {
    if (!input_.landform || !is_along_field_) return false;
    constexpr double least = 0.4;  // of one street in each mean length
    double doubled = 0, built = 0;
    for (const std::vector<std::uint32_t>& ring : rings_) {
      CmRing points;
      for (const std::uint32_t node : ring) points.push_back(network_.nodes()[node]);
      doubled += static_cast<double>(doubled_area(points));
    }
    for (const StreetPiece& piece : pieces()) built += distance(piece.a, piece.b);
    return built * streets_.length * 100 < least * doubled / 2;
  }

  /// Further starts at the nodes of the streets that grew and of the outline, ahead and to both sides.
  std::vector<StreetGrammar::Start> restarts(int round) {
    std::vector<StreetGrammar::Start> all;
    const auto add = [&](std::uint32_t node, const dvec2& direction) {
      const std::uint64_t key = rng_.at("restart")
                                    .at(static_cast<std::uint64_t>(round))
                                    .at(point_key(network_.nodes()[node]))
                                    .at(side_of(direction))
                                    .key();
      all.push_back({0, 1, propose(node, direction, Rng(key)), key});
    };
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const std::vector<std::uint32_t>& ring = rings_[r];
      for (std::size_t i = 0, before = ring.size() - 1; i < ring.size(); before = i++) {
        if (borders_[r][i] != 0 || borders_[r][before] != 0 || network_.is_closed(ring[i])) continue;
        add(ring[i], inward_at(network_, ring[before], ring[i], ring[(i + 1) % ring.size()]));
      }
    }
    for (const NetworkEdge& edge : std::vector<NetworkEdge>(network_.edges())) {
      if (edge.is_removed || edge.is_fixed || edge.kind != EdgeClass::minor) continue;
      if (network_.arms(edge.to).size() > 2) continue;
      const dvec2 along = in_cm(network_.nodes()[edge.to]) - in_cm(network_.nodes()[edge.from]);
      const dvec2 ahead = along / length_of(along);
      for (const double turn : {0.0, 90.0, -90.0}) add(edge.to, rotated(ahead, turn));
    }
    return all;
  }

  GlobalGoals global_goals(double rule, double road, Rng key) override {
    GlobalGoals goals;
    if (!is_road(road)) return goals;
    const Road done = roads_[static_cast<std::size_t>(road)];
    goals.rule = {rule, rule, rule};
    const std::array<double, 3> turns = {0, 90, -90};
    for (std::size_t slot = 0; slot < 3; ++slot) {
      Rng draw = key.at(slot);
      if (slot > 0 && draw.unit() >= streets_.branch_probability) continue;
      const double spread = slot == 0 ? streets_.noise / 3 : streets_.noise;
      const dvec2 direction = rotated(done.end_direction, turns[slot] + draw.uniform(-spread, spread));
      goals.delay[slot] = slot == 0 ? 0 : 1;
      goals.road[slot] = propose(done.end, direction, key.at("road").at(slot));
    }
    return goals;
  }

  RoadState local_constraints(double number) override {
    if (!is_road(number)) return RoadState::failed;
    Road& road = roads_[static_cast<std::size_t>(number)];
    Rng draw = road.key.at("shape");
    const double density = input_.density.at(in_metres(network_.nodes()[road.start]));
    const double length = streets_.length * 100 * (1.3 - 0.5 * density) *
                          (1 + draw.uniform(-streets_.length_spread, streets_.length_spread));
    const bool is_straight = is_raster_ || is_radial_ || is_along_field_;
    const double freedom = is_along_field_ ? freedom_at(in_cm(network_.nodes()[road.start]))
                           : is_straight   ? 0
                                           : 1;
    const double bend = freedom > 0 ? freedom * draw.uniform(-streets_.bend, streets_.bend) : 0;
    const std::int32_t pieces = std::max(1, math::to_int32(length / piece_length + 0.5));
    dvec2 direction = aligned(road.direction, in_cm(network_.nodes()[road.start]));
    std::uint32_t node = road.start;
    for (std::int32_t n = 0; n < pieces; ++n) {
      if (n > 0 && bend != 0) direction = rotated(direction, bend / pieces);
      const dvec2 from = in_cm(network_.nodes()[node]);
      if (n > 0 && is_along_field_) direction = aligned(direction, from);
      const dvec2 end = from + direction * (length / pieces);
      if (input_.density.at(end / 100.0) < least_density ||
          input_.is_blocked(from, end, streets_.classes.minor.grade) || tunnels_.is_above(from, end))
        return RoadState::failed;
      const PieceResult built = network_.build_piece(node, end, EdgeClass::minor);
      if (built.state != PieceState::free) return RoadState::failed;
      node = built.node;
    }
    road.end = node;
    road.end_direction = direction;
    has_branches_ = true;
    return RoadState::succeed;
  }

  std::array<double, 2> measure(double road) const override {
    if (!is_road(road)) return {0, 0};
    const Road& each = roads_[static_cast<std::size_t>(road)];
    const dvec2 along = in_cm(network_.nodes()[each.end]) - in_cm(network_.nodes()[each.start]);
    return {math::degrees(math::atan2(along.y, along.x)), length_of(along) / 100};
  }

  void settle_dead_ends() { city::settle_dead_ends(network_, input_, tunnels_, rng_.at("dead end")); }

  /// Whether a road was built at whose end others could branch off.
  bool has_branches() const { return has_branches_; }

  std::vector<StreetPiece> pieces() const {
    std::vector<StreetPiece> all;
    for (const NetworkEdge& edge : network_.edges()) {
      if (!edge.is_removed && edge.kind == EdgeClass::minor && !edge.is_fixed) {
        all.push_back(
            {network_.nodes()[edge.from], network_.nodes()[edge.to], static_cast<std::uint32_t>(edge.kind)});
      }
    }
    return all;
  }

 private:
  struct Road {
    std::uint32_t start = 0, end = 0;
    dvec2 direction{0}, end_direction{0};
    Rng key;
  };

  std::uint32_t node_of(const CmPoint& p) {
    const auto known = by_point_.find(p);
    if (known != by_point_.end()) return known->second;
    const std::uint32_t node = network_.add_node(p);
    by_point_.emplace(p, node);
    return node;
  }

  bool is_road(double road) const { return road >= 0 && road < static_cast<double>(roads_.size()); }
  double propose(std::uint32_t start, const dvec2& direction, Rng key) {
    roads_.push_back({start, start, direction, direction, key});
    return static_cast<double>(roads_.size() - 1);
  }

  /// Two cells at a node draw alike for a share of the nodes.
  double draw_of(std::uint32_t node) const {
    const Rng at = rng_.at("attach").at(point_key(network_.nodes()[node]));
    if (at.at("alike").unit() < streets_.crossings) return at.at("both").unit();
    return at.at(cell_key_).unit();
  }

  bool is_least(const std::vector<std::uint32_t>& ring, const std::vector<double>& draw,
                std::size_t i) const {
    const double reach = streets_.length * 75;
    const std::size_t count = ring.size();
    for (const std::size_t step : {std::size_t{1}, count - 1}) {
      double gone = 0;
      for (std::size_t at = i, n = 1; n < count; ++n) {
        const std::size_t next = (at + step) % count;
        gone += distance(network_.nodes()[ring[at]], network_.nodes()[ring[next]]);
        if (gone > reach) break;
        if (draw[next] < draw[i]) return false;
        at = next;
      }
    }
    return true;
  }

  static std::uint64_t side_of(const dvec2& in) { return (in.x >= 0 ? 1U : 0U) + (in.y >= 0 ? 2U : 0U); }

  /// How little a street along the field keeps to it: the share of an organic pattern.
  double freedom_at(const dvec2& p) const { return input_.minor_field->organic_share_at(p); }

  /// The direction, or that of the pattern which is nearest to it, or one between them.
  dvec2 aligned(const dvec2& direction, const dvec2& p) const {
    if (!is_raster_ && !is_radial_ && !is_along_field_) return direction;
    const dvec2 frame =
        is_along_field_ ? input_.minor_field->direction_at(p) : frame_at(streets_, is_radial_, p);
    if (frame == dvec2(0)) return direction;
    dvec2 best = frame;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const dvec2 turned = rotated(frame, 90.0 * quarter);
      if (glm::dot(turned, direction) > glm::dot(best, direction)) best = turned;
    }
    const double freedom = is_along_field_ ? freedom_at(p) : 0;
    if (freedom == 0) return best;
    const dvec2 mean = best * (1 - freedom) + direction * freedom;  // at most 45 degrees apart
    return mean / length_of(mean);
  }

  /// Growth starts at nodes of a street across the cell as at those of the outline, to both sides.
  void add_starts(const std::vector<std::uint32_t>& street, std::vector<StreetGrammar::Start>& all) {
    for (const bool is_left : {true, false}) {
      std::vector<double> draw;
      for (const std::uint32_t node : street) {
        const Rng at = rng_.at("attach").at(point_key(network_.nodes()[node]));
        const bool is_alike = at.at("alike").unit() < streets_.crossings;
        draw.push_back((is_alike ? at.at("both") : at.at(is_left ? 1U : 2U)).unit());
      }
      for (std::size_t i = 1; i + 1 < street.size(); ++i) {
        if (!is_least(street, draw, i)) continue;
        const dvec2 left = inward_at(network_, street[i - 1], street[i], street[i + 1]);
        const dvec2 in = is_left ? left : -left;
        const std::uint64_t key =
            rng_.at("start").at(point_key(network_.nodes()[street[i]])).at(side_of(in)).key();
        all.push_back({0, 1, propose(street[i], in, Rng(key)), key});
      }
    }
  }

 public:
  void set_key(std::uint64_t key) { cell_key_ = key; }

  /// Lets no street end at the mouth of a tunnel.
  void close_tunnels() {
    for (const SeparatedStreet* each : tunnels_.tunnels()) {
      for (const CmPoint& end : {each->line.front(), each->line.back()}) {
        const auto known = by_point_.find(end);
        if (known != by_point_.end()) network_.close_node(known->second);
      }
    }
  }

  /// Divides a cell that is much larger than usual by streets that do not depend on the density.
  void divide() {
    constexpr double largest = 2.2;  // of the square of the spacing
    const double spacing = streets_.major_spacing * 100;
    const bool is_straight = is_raster_ || is_radial_ || is_along_field_;
    DivisionRules rules;
    rules.largest = largest * spacing * spacing;
    rules.bend = is_straight ? 0 : std::min(streets_.bend, 60.0);
    rules.rng = rng_.at("divide");
    rules.aligned = [&](const dvec2& direction, const dvec2& at) { return aligned(direction, at); };
    rules.may_end = [&](std::uint32_t node) { return !network_.is_closed(node); };
    rules.may_pass = [&](const dvec2& from, const dvec2& to) {
      return input_.density.at(to / 100.0) >= least_density &&
             !input_.is_blocked(from, to, streets_.classes.minor.grade) && !tunnels_.is_above(from, to);
    };
    across_ = divide_cell(network_, rings_, rules);
  }

 private:
  const GrowthInput& input_;
  const CityStreets& streets_;
  const TunnelClearance& tunnels_;
  Rng rng_;
  std::uint64_t cell_key_ = 0;
  bool has_branches_ = false;
  bool is_raster_ = false, is_radial_ = false, is_along_field_ = false;
  Network network_;
  std::map<CmPoint, std::uint32_t> by_point_;
  std::map<std::uint32_t, int> seen_;
  std::vector<std::vector<std::uint32_t>> rings_;
  std::vector<std::vector<std::uint8_t>> borders_;
  std::vector<Road> roads_;
  std::vector<std::vector<std::uint32_t>> across_;  ///< streets that divide the cell
};

/// Whether the productions ask for a road.
class RoadProbe final : public RoadRules {
 public:
  bool is_asked = false;
  GlobalGoals global_goals(double, double, Rng) override { return {}; }
  RoadState local_constraints(double) override {
    is_asked = true;
    return RoadState::failed;
  }
  std::array<double, 2> measure(double) const override { return {0, 0}; }
};

bool builds_roads(const StreetGrammar& grammar, const Job& job) {
  constexpr std::uint64_t most_steps = 1000;
  RoadProbe probe;
  grammar.grow({{0, 1, 0, 1}}, probe, most_steps, job);
  return probe.is_asked;
}

}  // namespace

CellStreets grow_cell(const GrowthInput& input, const StreetGraph& majors,
                      const std::vector<std::vector<std::uint32_t>>& loops, Job& job) {
  const TunnelClearance tunnels(input.landform, majors.separated);
  Cell cell(input, tunnels, job.rng().at("cells"));
  // The key of a cell is its lowest point, which edits elsewhere leave alone.
  CmPoint lowest = majors.nodes[start_of(majors.edges, loops[0][0])];
  for (const std::uint32_t half : loops[0])
    lowest = std::min(lowest, majors.nodes[start_of(majors.edges, half)]);
  cell.set_key(point_key(lowest));
  for (const std::vector<std::uint32_t>& loop : loops) cell.add_loop(majors, loop);
  cell.close_tunnels();
  if (!input.wards && builds_roads(input.grammar, job)) cell.divide();
  const auto grow = [&](const std::vector<StreetGrammar::Start>& starts) {
    const auto steps = input.grammar.grow(starts, cell, most_steps_of_a_cell, job);
    if (!steps) return;
    job.refuse(limit_issue({Resource::steps, *steps, *steps + 1},
                           "the minor streets between some major streets do not stop growing",
                           "/streets/productions"));
  };
  grow(cell.starts());
  constexpr int most_restarts = 6;
  for (int round = 0; round < most_restarts && cell.is_sparse(); ++round) grow(cell.restarts(round));
  cell.settle_dead_ends();
  return {cell.pieces(), cell.has_branches()};
}

}  // namespace seedmesh::city

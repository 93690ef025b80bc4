#include "core/generators/city/lots.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/city/division.h"
#include "core/generators/city/wards.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr std::size_t blocks_a_chunk = 16;
constexpr std::size_t blocks_a_batch = 1024;  // divided at the same time; their memory serves the next batch

/// The side of its streets on which a block lies: that of the street with the lowest key. Two blocks on both sides of
/// one street have the same nodes.
std::uint64_t side_key(const CityPlan& plan, const BlockOutline& outline) {
  const StreetGraph& graph = plan.graph;
  std::uint64_t lowest = ~std::uint64_t{0}, side = 0;
  for (std::size_t i = 0; i < outline.edges.size(); ++i) {
    const std::uint32_t street = outline.edges[i].street;
    if (street == no_index || graph.edge_key[street] > lowest) continue;
    const PlanarEdge& edge = graph.edges[street];
    const dvec2 along = in_cm(graph.nodes[edge.to]) - in_cm(graph.nodes[edge.from]);
    const dvec2 run = in_cm(outline.ring[(i + 1) % outline.ring.size()]) - in_cm(outline.ring[i]);
    const bool is_along = glm::dot(along, run) > 0;
    const std::uint64_t here = is_along == (graph.node_key[edge.from] < graph.node_key[edge.to]) ? 1 : 2;
    side = graph.edge_key[street] < lowest ? here : std::min(side, here);
    lowest = graph.edge_key[street];
  }
  return side;
}

/// The key of a block: its sorted nodes, here by the corners' streets.
std::uint64_t block_key(const CityPlan& plan, const BlockOutline& outline) {
  std::vector<std::uint64_t> keys;
  const auto add = [&](std::uint32_t street) {
    keys.push_back(plan.graph.node_key[plan.graph.edges[street].from]);
    keys.push_back(plan.graph.node_key[plan.graph.edges[street].to]);
  };
  for (const BlockEdge& edge : outline.edges) {
    if (edge.street != no_index) add(edge.street);
  }
  for (const std::uint32_t street : outline.hole_streets) add(street);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::uint64_t key = 0xB10C;
  for (const std::uint64_t each : keys) key = key_at(key, each);
  return key_at(key, side_key(plan, outline));
}

/// The keys of all blocks. Blocks between the same streets, on the same side of one, also have the key of their lowest
/// corner.
std::vector<std::uint64_t> keys_of(const CityPlan& plan, const std::vector<BlockOutline>& outlines) {
  std::vector<std::uint64_t> keys;
  keys.reserve(outlines.size());
  for (const BlockOutline& each : outlines) keys.push_back(block_key(plan, each));
  std::vector<std::uint64_t> sorted = keys;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return keys;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto same = std::equal_range(sorted.begin(), sorted.end(), keys[i]);
    if (same.second - same.first < 2) continue;
    const CmPoint& lowest = *std::min_element(outlines[i].ring.begin(), outlines[i].ring.end());
    keys[i] =
        key_at(key_at(keys[i], static_cast<std::uint32_t>(lowest.x)), static_cast<std::uint32_t>(lowest.y));
  }
  return keys;
}

/// Whether a block is the middle of a roundabout.
bool is_island(const StreetGraph& graph, const BlockOutline& outline) {
  return !graph.ring_nodes.empty() &&
         std::all_of(outline.edges.begin(), outline.edges.end(), [&](const BlockEdge& edge) {
           if (edge.street == no_index) return false;
           const PlanarEdge& street = graph.edges[edge.street];
           return graph.is_on_ring(street.from) && graph.is_on_ring(street.to);
         });
}

/// How a block was divided, made by one thread.
struct Divided {
  std::optional<Division> division;
  bool is_park = false, is_square = false, is_island = false;
  std::string zone;
};

/// A position just inside of a block: 2 cm to the left of the middle of its longest edge.
glm::dvec2 position_in(const CmRing& ring) {
  std::size_t longest = 0;
  const auto length = [&ring](std::size_t i) { return distance(ring[i], ring[(i + 1) % ring.size()]); };
  for (std::size_t i = 1; i < ring.size(); ++i) longest = length(i) > length(longest) ? i : longest;
  const dvec2 a = in_cm(ring[longest]), along = in_cm(ring[(longest + 1) % ring.size()]) - a;
  return a + along / 2.0 + dvec2(-along.y, along.x) * (2 / length(longest));
}

/// Returns the lot of a piece, without its corners.
Lot lot_of(const CityPlan& plan, const Division& division, const Piece& piece) {
  Lot lot;
  lot.key = piece.key;
  lot.is_inner = piece.is_inner;
  double widest = -1, longest = -1;
  std::uint32_t first_street = no_index;
  for (std::size_t i = 0; i < piece.ring.size(); ++i) {
    const SharedEdge& edge = division.edges()[piece.edges[i]];
    if (edge.street == no_index) continue;
    const CmPoint &a = piece.ring[i], &b = piece.ring[(i + 1) % piece.ring.size()];
    const double length = distance(a, b) / 100, width = plan.class_of(edge.street).width;
    lot.frontage += length;
    lot.is_corner |= first_street != no_index && first_street != edge.street;
    first_street = edge.street;
    if (length < 3 && longest >= 3) continue;
    if (longest < 3 || width > widest || (width == widest && length > longest)) {
      widest = width;
      longest = length;
      lot.street = edge.street;
      lot.front_start = a;
      lot.front_end = b;
    }
  }
  return lot;
}

glm::dvec2 middle_of(const CmRing& ring) {
  glm::dvec2 sum{0};
  for (const CmPoint& p : ring) sum += in_metres(p);
  return sum / static_cast<double>(ring.size());
}

/// The name of the first zone around a position in metres; empty outside of all.
std::string zone_at(const std::vector<NamedZone>& zones, const glm::dvec2& metres) {
  for (const NamedZone& zone : zones) {
    if (zone.map.at(metres) >= 0.5) return zone.name;
  }
  return {};
}

/// Whether a landmark keeps a block whole, or makes it a square.
bool has_landmark(const std::vector<Landmark>& landmarks, bool Landmark::*plot, const BlockOutline& outline) {
  return std::any_of(landmarks.begin(), landmarks.end(), [&](const Landmark& each) {
    return each.*plot && is_inside(outline.ring, each.position * 100.0);
  });
}

/// Adds the corners that cuts have added to the outline of a block to the part on its other side.
void add_to_part(Part& part, const SharedEdge& edge) {
  CmRing added;
  edge.append_between(edge.b, edge.a, added);
  if (added.empty()) return;
  for (CmRing& ring : part.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring[i] != edge.b || ring[(i + 1) % ring.size()] != edge.a) continue;
      ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, added.begin(), added.end());
      return;
    }
  }
}

/// The parts of water by the edges of their outlines.
using Shores = std::map<std::pair<CmPoint, CmPoint>, std::uint32_t>;
Shores shores_of(const CityPlan& plan) {
  Shores shores;
  for (std::uint32_t n = 0; n < plan.parts.size(); ++n) {
    if (plan.parts[n].kind != PartKind::water) continue;
    for (const CmRing& ring : plan.parts[n].rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) shores[{ring[i], ring[(i + 1) % ring.size()]}] = n;
    }
  }
  return shores;
}

/// Reserves memory for the lots of all blocks, as many for each as in those that are done. Growing lists would need more
/// of it, and time to move lots.
void reserve_lots(CityPlan& plan, std::size_t done, std::size_t blocks) {
  constexpr std::size_t spare = 32;  // one more of this number
  const std::size_t lots = plan.lots.size() * blocks / done;
  plan.lots.reserve(lots + lots / spare);
  plan.parts.reserve(plan.parts.size() + (lots + lots / spare - plan.lots.size()) + (blocks - done) / 4);
  plan.blocks.reserve(blocks);
}

void add_block(CityPlan& plan, const BlockOutline& outline, Divided& divided, const FieldMap& density,
               const Shores& shores) {
  Division& division = *divided.division;
  const auto number = static_cast<std::uint32_t>(plan.blocks.size());
  Block block;
  block.key = division.whole().key;
  block.streets = outline.hole_streets;
  for (const BlockEdge& edge : outline.edges) {
    if (edge.street != no_index) block.streets.push_back(edge.street);
  }
  std::sort(block.streets.begin(), block.streets.end());
  block.streets.erase(std::unique(block.streets.begin(), block.streets.end()), block.streets.end());
  block.rings.push_back(division.outline(division.whole()));
  for (const CmRing& hole : outline.holes) block.rings.push_back(hole);
  if (divided.is_park) {
    Part part;
    const bool is_small = area_of(block.rings) < 1500;
    part.kind = (is_small && !divided.is_island) || divided.is_square ? PartKind::square : PartKind::park;
    part.block = number;
    part.rings = block.rings;
    plan.parts.push_back(std::move(part));
  }
  plan.blocks.push_back(std::move(block));
  if (divided.is_park) return;
  for (const SharedEdge& edge : division.edges()) {
    if (edge.added.empty()) continue;
    if (edge.sidewalk != no_index) {
      add_to_part(plan.parts[edge.sidewalk], edge);
    } else if (const auto shore = shores.find({edge.b, edge.a}); shore != shores.end()) {
      add_to_part(plan.parts[shore->second], edge);
    }
  }
  for (std::size_t n = 0; n < division.pieces().size(); ++n) {
    const Piece& piece = division.pieces()[n];
    Lot lot = lot_of(plan, division, piece);
    lot.part = static_cast<std::uint32_t>(plan.parts.size());
    lot.density = density.at(middle_of(piece.ring));
    lot.zone = divided.zone.empty() ? zone_at(plan.zones, middle_of(piece.ring)) : divided.zone;
    Part part;
    part.kind = PartKind::lot;
    part.block = number;
    part.street = lot.street;
    part.rings.push_back(division.take_outline(n));
    lot.area = area_of(part.rings);
    lot.corners = division.take_corners(n);
    plan.parts.push_back(std::move(part));
    plan.lots.push_back(std::move(lot));
  }
}

}  // namespace

const char* name_of(PartKind kind) {
  static constexpr const char* names[] = {"carriageway", "junction", "sidewalk", "verge",
                                          "park",        "square",   "lot",      "water"};
  return names[static_cast<std::size_t>(kind)];
}

double area_of(const std::vector<CmRing>& rings) {
  double sum = 0;
  for (const CmRing& ring : rings) sum += static_cast<double>(doubled_area(ring));
  return sum / 2e4;
}

void divide_blocks(CityPlan& plan, std::vector<BlockOutline> outlines, const CityLots& lots,
                   const FieldMap& density, Job& job) {
  CityLots whole = lots;  // of a citadel
  whole.division = CityDivision::none;
  const Rng rng = job.rng().at("lots");
  const std::vector<std::uint64_t> keys = keys_of(plan, outlines);
  const auto divide = [&](std::size_t number) {
    const BlockOutline& outline = outlines[number];
    const std::uint64_t key = keys[number];
    Divided each;
    const Ward* ward = ward_at(plan.wards, position_in(outline.ring));
    if (ward) each.zone = ward->zone;
    const bool is_whole = has_landmark(plan.landmarks, &Landmark::is_block_whole, outline);
    each.division.emplace(outline, is_whole || each.zone == zone_citadel ? whole : lots, key, rng);
    each.is_square =
        each.zone == zone_square || has_landmark(plan.landmarks, &Landmark::is_on_square, outline);
    const bool is_outside = !plan.wards.empty() && !ward;
    const bool is_empty = density.at(middle_of(outline.ring)) < 0.1;
    const bool is_drawn = !is_whole && rng.at("park").at(key).unit() < lots.park_share;
    each.is_island = is_island(plan.graph, outline);
    each.is_park = each.is_island || !outline.holes.empty() || is_empty || is_outside || each.is_square ||
                   !each.division->holds_lots() || is_drawn;
    if (!each.is_park) each.division->cut(job);
    return each;
  };
  const Shores shores = shores_of(plan);
  Meter meter(job, Resource::shapes);
  std::vector<std::optional<Divided>> divided(std::min(outlines.size(), blocks_a_batch));
  for (std::size_t first = 0; first < outlines.size(); first += blocks_a_batch) {
    const std::size_t count = std::min(blocks_a_batch, outlines.size() - first);
    if (first == blocks_a_batch) reserve_lots(plan, first, outlines.size());
    parallel_for(job, count, blocks_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) {
        job.check();
        divided[i].emplace(divide(first + i));
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      job.check();
      meter.spend(1 + divided[i]->division->pieces().size());
      add_block(plan, outlines[first + i], *divided[i], density, shores);
      divided[i].reset();
      outlines[first + i] = {};
    }
  }
}

}  // namespace seedmesh::city

#include "core/generators/city/ground_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/geom/mesh/finish.h"
#include "core/geom/mesh/weld.h"
#include "core/geom/polygon/delaunay.h"
#include "core/model/empty_mesh.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double inner_spacing = 10;   // of vertices inside of parts, m
constexpr double border_distance = 4;  // of these vertices from edges, m
constexpr double dash_spacing = 12;    // of lane lines: 3 m of line, 9 m of gap

double length_of(const CrossLine& start, const CrossLine& end) {
  return glm::length(end.left + end.right - start.left - start.right) / 2;
}

/// Where the lane lines of a street begin, and their dashes for each metre: whole dashes with their gaps.
struct Dashes {
  double begin = 0, a_metre = 1;
};
Dashes dashes_of(const StreetStrips& strips) {
  double station = 0, begin = -1, end = 0;
  for (std::size_t i = 0; i < strips.kinds.size(); ++i) {
    if (strips.kinds[i] == StripKind::lanes && begin < 0) begin = station;
    station += length_of(strips.lines[i], strips.lines[i + 1]);
    if (strips.kinds[i] == StripKind::lanes) end = station;
  }
  if (begin < 0 || end <= begin) return {};
  return {begin, std::max(1.0, std::floor((end - begin) / dash_spacing + 0.5)) / (end - begin)};
}

GroundMesh::StreetLayer layer_of(StripKind kind, const StripPiece& piece) {
  if (!piece.is_marking) return GroundMesh::StreetLayer::asphalt;
  if (kind == StripKind::lanes) return GroundMesh::StreetLayer::lane_lines;
  return kind == StripKind::zebra ? GroundMesh::StreetLayer::crossings : GroundMesh::StreetLayer::stop_lines;
}

bool is_inside_part(const Part& part, const dvec2& metres) {
  bool is_in = false;
  for (const CmRing& ring : part.rings) is_in ^= is_inside(ring, metres * 100.0);
  return is_in;
}

bool is_near_border(const Part& part, const dvec2& metres, double distance) {
  for (const CmRing& ring : part.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double off =
          distance_to_segment(metres * 100.0, in_cm(ring[i]), in_cm(ring[(i + 1) % ring.size()]));
      if (off < distance * 100) return true;
    }
  }
  return false;
}

}  // namespace

GroundMesh::GroundMesh(const CityPlan& plan, const Surface& surface, bool has_textures, const Job& job)
    : plan_(plan), surface_(surface), has_textures_(has_textures), job_(job), triangulator_(&job) {
  for (Mesh* mesh : {&welded_, &mesh_}) {
    *mesh = empty_mesh(job);
    mesh->uv[0] = Array<glm::vec2>(job);
  }
  dvec2 low = in_metres(plan.area[0][0]), high = low;
  for (const CmPoint& p : plan.area[0]) {
    low = glm::min(low, in_metres(p));
    high = glm::max(high, in_metres(p));
  }
  // Coordinates are rounded to single precision.
  least_ = static_cast<float>(std::max(1e-6, 3e-12 * glm::dot(high - low, high - low)));
}

void GroundMesh::add_part(std::uint32_t number) {
  const Part& part = plan_.parts[number];
  points_.clear();
  sizes_.clear();
  for (const CmRing& ring : part.rings) {
    const std::size_t first = points_.size();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const CmPoint& next = ring[(i + 1) % ring.size()];
      points_.push_back(in_metres(ring[i]));
      surface_.points_between(ring[i], next, between_);
      points_.insert(points_.end(), between_.begin(), between_.end());
    }
    sizes_.push_back(static_cast<std::uint32_t>(points_.size() - first));
  }
  const auto& corners = triangulator_.run(points_, sizes_, 0);
  corners_.assign(corners.begin(), corners.end());
  inner_.clear();
  if (!surface_.is_level() && part.street == no_index && part.node == no_index) add_inner_points(part);
  if (part.kind == PartKind::lot && !surface_.is_level()) add_inner_points(part);
  refine_triangles(points_, corners_, inner_, &job_);
  const auto first = static_cast<std::uint32_t>(mesh_.position.size());
  for (const dvec2& p : points_) add_vertex(p, surface_.height(number, p), {0, 1, 0}, glm::vec2(p));
  add_triangles(first);
}

void GroundMesh::add_carriageway(std::uint32_t number, StreetLayer layer) {
  const Part& part = plan_.parts[number];
  const StreetStrips& strips = surface_.strips(part.street);
  if (strips.lines.size() < 2) {
    if (layer == StreetLayer::asphalt) add_part(number);
    return;
  }
  const CrossSection& section = plan_.class_of(part.street);
  const auto may_have_layer = [&](StripKind kind) {
    return layer == StreetLayer::asphalt || layer_of(kind, {0, 1, true}) == layer;
  };
  if (std::none_of(strips.kinds.begin(), strips.kinds.end(), may_have_layer)) return;
  const Dashes dashes = dashes_of(strips);
  pieces_before_.clear();
  set_pieces(strips.kinds[0], section, has_textures_, pieces_);
  double station = 0;
  for (std::size_t i = 0; i < strips.kinds.size(); ++i) {
    pieces_after_.clear();
    if (i + 1 < strips.kinds.size()) set_pieces(strips.kinds[i + 1], section, has_textures_, pieces_after_);
    set_sides(part, i, station);
    sides_.periods_across = has_textures_ && layer == StreetLayer::crossings ? bars_of(section) + 0.5 : 0;
    const bool has_dashes = has_textures_ && layer == StreetLayer::lane_lines;
    sides_.first_dash = has_dashes ? dashes.begin : 0;
    sides_.dashes_a_metre = has_dashes ? dashes.a_metre : 1;
    for (const StripPiece& piece : pieces_) {
      if (layer_of(strips.kinds[i], piece) == layer) add_strip(number, piece);
    }
    station += sides_.length;
    std::swap(pieces_before_, pieces_);
    std::swap(pieces_, pieces_after_);
  }
}

/// The ends of a strip, with the corners of its own pieces and of those of its neighbours.
void GroundMesh::set_sides(const Part& part, std::size_t strip, double station) {
  const StreetStrips& strips = surface_.strips(part.street);
  sides_.start = strips.lines[strip];
  sides_.end = strips.lines[strip + 1];
  sides_.station = station;
  sides_.length = length_of(sides_.start, sides_.end);
  const auto set_shares = [this](const std::vector<StripPiece>& neighbours, std::vector<double>& shares) {
    shares.clear();
    const auto add = [&shares](const std::vector<StripPiece>& pieces) {
      for (const StripPiece& piece : pieces) {
        if (piece.from > 0) shares.push_back(piece.from);
      }
    };
    add(pieces_);
    add(neighbours);
    std::sort(shares.begin(), shares.end());
    shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
  };
  set_shares(pieces_before_, sides_.start_shares);
  set_shares(pieces_after_, sides_.end_shares);
  const PlanarEdge& edge = plan_.graph.edges[part.street];
  const auto set_corner = [&](bool is_at_end, std::uint32_t node, std::vector<dvec2>& corner) {
    corner.clear();
    if (!is_at_end) return;
    const CmPoint& at = plan_.graph.nodes[node];
    const CmRing& ring = part.rings[0];
    if (std::find(ring.begin(), ring.end(), at) != ring.end()) corner.push_back(in_metres(at));
  };
  set_corner(strip == 0, edge.from, sides_.start_corner);
  set_corner(strip + 1 == strips.kinds.size(), edge.to, sides_.end_corner);
}

/// One piece of a strip. Its corners at the ends of the strip include those of the neighbours.
void GroundMesh::add_strip(std::uint32_t number, const StripPiece& piece) {
  points_.clear();
  uv_.clear();
  const double width = glm::length(sides_.start.right - sides_.start.left);
  const auto add = [&](const CrossLine& line, double share, double station) {
    points_.push_back(point_across(line, share));
    uv_.emplace_back(static_cast<float>((station - sides_.first_dash) * sides_.dashes_a_metre),
                     static_cast<float>(share * width));
    if (sides_.periods_across > 0)
      uv_.back() = {static_cast<float>(share * sides_.periods_across), static_cast<float>(station)};
  };
  // Counter-clockwise: along the right side, across the end, back along the left side, across the start.
  const double end = sides_.station + sides_.length;
  add(sides_.start, piece.to, sides_.station);
  add(sides_.end, piece.to, end);
  const auto add_corner = [&](const std::vector<dvec2>& corner, double at) {
    for (const dvec2& p : corner) {
      points_.push_back(p);
      uv_.emplace_back(static_cast<float>(at), static_cast<float>(width / 2));
    }
  };
  add_corner(sides_.end_corner, end);
  for (std::size_t k = sides_.end_shares.size(); k-- > 0;) {
    const double share = sides_.end_shares[k];
    if (share > piece.from && share < piece.to) add(sides_.end, share, end);
  }
  add(sides_.end, piece.from, end);
  add(sides_.start, piece.from, sides_.station);
  for (const double share : sides_.start_shares) {
    if (share > piece.from && share < piece.to) add(sides_.start, share, sides_.station);
  }
  add_corner(sides_.start_corner, sides_.station);
  sizes_ = {static_cast<std::uint32_t>(points_.size())};
  const auto& corners = triangulator_.run(points_, sizes_, 0);
  corners_.assign(corners.begin(), corners.end());
  if (points_.size() > 4) refine_triangles(points_, corners_, {}, &job_);
  const auto first = static_cast<std::uint32_t>(mesh_.position.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    add_vertex(points_[i], surface_.height(number, points_[i]), {0, 1, 0}, uv_[i]);
  add_triangles(first);
}

/// A lattice over the whole city, without the points that are near the border of the part.
void GroundMesh::add_inner_points(const Part& part) {
  if (part.kind == PartKind::water) return;
  dvec2 low = points_[0], high = points_[0];
  for (const dvec2& p : points_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  for (double y = std::ceil(low.y / inner_spacing) * inner_spacing; y < high.y; y += inner_spacing) {
    job_.check();
    for (double x = std::ceil(low.x / inner_spacing) * inner_spacing; x < high.x; x += inner_spacing) {
      const dvec2 p(x, y);
      if (is_inside_part(part, p) && !is_near_border(part, p, border_distance)) inner_.push_back(p);
    }
  }
  constexpr double tunnel_distance = 0.5;  // m
  for (const dvec2& p : surface_.tunnels().ground_points()) {
    const bool is_in_box = p.x > low.x && p.y > low.y && p.x < high.x && p.y < high.y;
    if (is_in_box && is_inside_part(part, p) && !is_near_border(part, p, tunnel_distance))
      inner_.push_back(p);
  }
}

/// Adds the triangles of the last part, and the normals of its vertices where it is not level.
void GroundMesh::add_triangles(std::uint32_t first) {
  const bool has_normals = !surface_.is_level();
  if (has_normals) normals_.assign(points_.size(), glm::vec3(0));
  for (std::size_t i = 0; i + 2 < corners_.size(); i += 3) {
    const std::array<std::uint32_t, 3> at = {corners_[i], corners_[i + 1], corners_[i + 2]};
    const glm::vec3 &p = mesh_.position[first + at[0]], &q = mesh_.position[first + at[1]],
                    &r = mesh_.position[first + at[2]];
    const glm::vec3 normal = glm::cross(q - p, r - p);
    if (normal.y <= least_) continue;
    for (const std::uint32_t corner : at) {
      if (has_normals) normals_[corner] += normal;
      mesh_.index.wide.push_back(first + corner);
    }
  }
  if (!has_normals) return;
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    const float length = std::sqrt(glm::dot(normals_[i], normals_[i]));
    if (length > 0) mesh_.normal[first + i] = normals_[i] / length;
  }
}

void GroundMesh::weld_if_large(Job& job) {
  constexpr std::size_t large = 65'536;  // vertices
  if (mesh_.position.size() < large) return;
  weld(mesh_, job);
  append_last();
}

// Blocks are ordered one by one, since ordering all of a large mesh at once needs as much memory again.
void GroundMesh::append_last() {
  order_for_cache(mesh_, job_);
  const auto first = static_cast<std::uint32_t>(welded_.position.size());
  welded_.position.append(mesh_.position.span());
  welded_.normal.append(mesh_.normal.span());
  welded_.uv[0].append(mesh_.uv[0].span());
  for (const std::uint32_t corner : mesh_.index.wide) welded_.index.wide.push_back(first + corner);
  mesh_.position.clear();
  mesh_.normal.clear();
  mesh_.uv[0].clear();
  mesh_.index.wide.clear();
  mesh_.cache_ordered = false;
}

Mesh GroundMesh::take(Job& job) {
  weld(mesh_, job);
  if (welded_.position.empty()) return std::move(mesh_);
  append_last();
  welded_.cache_ordered = true;
  return std::move(welded_);
}

std::uint32_t GroundMesh::add_vertex(const dvec2& p, double height, const glm::vec3& normal,
                                     const glm::vec2& uv) {
  mesh_.position.push_back(
      {static_cast<float>(p.x), static_cast<float>(height), static_cast<float>(0 - p.y)});
  mesh_.normal.push_back(normal);
  mesh_.uv[0].push_back(uv);
  return static_cast<std::uint32_t>(mesh_.position.size() - 1);
}

}  // namespace seedmesh::city

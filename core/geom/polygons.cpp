#include "core/geom/polygons.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/geom/places.h"
#include "core/geom/triangulate.h"

namespace seedmesh {
namespace {

// Of the diagonal of all outlines. Whoever welds the mesh does so at half of it or less.
constexpr float weld_share = 2e-6F;
// Of its square. Triangles of half this area count as degenerate.
constexpr double area_share = 2e-12;

/// An outline without repeated points, in the plane that fits it best.
struct Polygon {
  std::vector<glm::vec3> point;
  std::vector<std::uint32_t> place;  ///< of each point, shared with points of other outlines
  std::vector<glm::dvec2> flat;      ///< in the plane
  std::vector<std::uint32_t> triangle;
  glm::vec3 normal{0};
};

/// Newell's normal: its length is twice the area of the outline.
glm::dvec3 newell(const std::vector<glm::vec3>& points) {
  glm::dvec3 sum{0};
  const glm::dvec3 origin = points[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += glm::cross(glm::dvec3(points[i]) - origin, glm::dvec3(points[(i + 1) % points.size()]) - origin);
  }
  return sum;
}

/// The places of an outline in an order that depends neither on where it starts nor on its direction.
std::uint64_t cycle_key(const std::vector<std::uint32_t>& places) {
  const std::size_t count = places.size();
  const auto least =
      static_cast<std::size_t>(std::min_element(places.begin(), places.end()) - places.begin());
  const bool forward = places[(least + 1) % count] <= places[(least + count - 1) % count];
  std::uint64_t key = count;
  for (std::size_t i = 0; i < count; ++i) {
    key = key_at(key, places[forward ? (least + i) % count : (least + count - i) % count]);
  }
  return key;
}

/// The directed edges in use in each layer. An edge may be used once in each direction.
class Edges {
 public:
  explicit Edges(const Job& job) : used_(job, 64) {}

  bool is_free(int layer, std::uint32_t from, std::uint32_t to) {
    return !(use(layer, from, to) & direction(from, to));
  }
  void take(int layer, std::uint32_t from, std::uint32_t to) {
    std::uint32_t& bits = used_[key(layer, from, to)];
    bits = (bits == NumberTable::none ? 0 : bits) | direction(from, to);
  }

 private:
  static std::uint32_t direction(std::uint32_t from, std::uint32_t to) { return from < to ? 1 : 2; }
  static std::uint64_t key(int layer, std::uint32_t from, std::uint32_t to) {
    const std::uint64_t both = std::uint64_t{std::min(from, to)} << 32U | std::max(from, to);
    return key_at(both, static_cast<std::uint64_t>(layer));
  }
  std::uint32_t use(int layer, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t bits = used_.peek(key(layer, from, to));
    return bits == NumberTable::none ? 0 : bits;
  }

  NumberTable used_;
};

enum class Side { front, back };

class PolygonMaker {
 public:
  PolygonMaker(const Outlines& outlines, Job& job)
      : outlines_(outlines),
        job_(job),
        place_(job, outlines.vertex.size()),
        is_shared_(job),
        edges_(job),
        seen_(job, 64),
        faces_(job, 64),
        vertices_(job, 64),
        budget_(job, Resource::triangles) {
    const Box box = bounds_of(outlines.vertex.span());
    const glm::vec3 extent = box.max - box.min;
    size_ = std::sqrt(glm::dot(extent, extent));
    find_places(box);
  }

  std::vector<Bark> run() {
    for (std::size_t i = 0; i < outlines_.outline.size(); ++i) {
      if (i % 256 == 0) job_.check();
      add(outlines_.outline[i]);
    }
    std::vector<Bark> all;
    for (auto& [where, mesh] : meshes_) {
      finish(mesh);
      all.push_back({where.second, std::move(mesh), where.first});
    }
    return all;
  }

 private:
  /// Welds all points and finds out which places outlines pass more than once; only those can bring trouble.
  void find_places(const Box& box) {
    Weld weld(job_, box, std::max(weld_share * size_, 1e-30F), outlines_.vertex.size());
    for (std::uint32_t i = 0; i < outlines_.outline.size(); ++i) {
      const Outline& outline = outlines_.outline[i];
      if (i % 256 == 0) job_.check();
      for (std::uint32_t k = outline.first; k < outline.first + outline.count; ++k) {
        const std::uint32_t place = weld.number(outlines_.vertex[k]);
        place_[k] = place;
        if (k > outline.first && place_[k - 1] == place) continue;
        if (place == is_shared_.size()) {
          is_shared_.push_back(0);
        } else {
          is_shared_[place] = 1;
        }
      }
    }
  }

  void add(const Outline& outline) {
    Polygon polygon;
    for (std::uint32_t k = outline.first; k < outline.first + outline.count; ++k) {
      if (!polygon.place.empty() && polygon.place.back() == place_[k]) continue;
      polygon.point.push_back(outlines_.vertex[k]);
      polygon.place.push_back(place_[k]);
    }
    while (polygon.place.size() > 1 && polygon.place.front() == polygon.place.back()) {
      polygon.place.pop_back();
      polygon.point.pop_back();
    }
    if (polygon.place.size() < 3 || !flatten(polygon)) return;
    if (touches_itself(polygon)) {
      // Its own triangles may be in each other's way, so they are looked at like those of neighbours.
      for (std::uint32_t place : polygon.place) is_shared_[place] = 1;
    }
    const bool may_coincide =
        std::all_of(polygon.place.begin(), polygon.place.end(), [&](auto p) { return is_shared_[p]; });
    if (may_coincide) {
      std::uint32_t& seen = seen_[cycle_key(polygon.place)];
      if (seen != NumberTable::none) return;
      seen = 1;
    }
    polygon.triangle = triangulate(polygon.flat, area_share * size_ * size_);
    drop_triangles_made_before(polygon);
    budget_.spend(polygon.triangle.size() / 3);
    if (crosses_itself(polygon.triangle, polygon)) {
      for (std::size_t t = 0; t < polygon.triangle.size(); t += 3)
        place(outline, polygon, {&polygon.triangle[t], 3});
    } else if (!polygon.triangle.empty()) {
      place(outline, polygon, polygon.triangle);
    }
  }

  /// Triangles of outlines that coincide in part; they would fight over the same pixels.
  void drop_triangles_made_before(Polygon& polygon) {
    std::vector<std::uint32_t> fresh;
    for (std::size_t t = 0; t < polygon.triangle.size(); t += 3) {
      const std::span<const std::uint32_t> corners{&polygon.triangle[t], 3};
      std::array<std::uint32_t, 3> places{};
      std::transform(corners.begin(), corners.end(), places.begin(),
                     [&](auto corner) { return polygon.place[corner]; });
      if (std::all_of(places.begin(), places.end(), [&](auto place) { return is_shared_[place]; })) {
        std::sort(places.begin(), places.end());
        std::uint32_t& seen = faces_[key_at(std::uint64_t{places[0]} << 32U | places[1], places[2])];
        if (seen != NumberTable::none) continue;
        seen = 1;
      }
      fresh.insert(fresh.end(), corners.begin(), corners.end());
    }
    polygon.triangle = std::move(fresh);
  }

  /// Fills in the plane; false where the outline has no area.
  bool flatten(Polygon& polygon) const {
    const glm::dvec3 sum = newell(polygon.point);
    if (!(std::sqrt(glm::dot(sum, sum)) > 4 * area_share * size_ * size_)) return false;
    const glm::dvec3 normal = math::unit(sum, {0, 1, 0});
    glm::dvec3 u{0};
    for (std::size_t i = 0; i + 1 < polygon.point.size() && u == glm::dvec3(0); ++i) {
      const glm::dvec3 edge = glm::dvec3(polygon.point[i + 1]) - glm::dvec3(polygon.point[0]);
      u = math::unit(edge - normal * glm::dot(edge, normal), {0, 0, 0});
    }
    const glm::dvec3 v = glm::cross(normal, u);
    for (const glm::vec3& p : polygon.point) {
      const glm::dvec3 from_first = glm::dvec3(p) - glm::dvec3(polygon.point[0]);
      polygon.flat.emplace_back(glm::dot(from_first, u), glm::dot(from_first, v));
    }
    polygon.normal = glm::vec3(normal);
    return true;
  }

  static bool touches_itself(const Polygon& polygon) {
    std::vector<std::uint32_t> places = polygon.place;
    std::sort(places.begin(), places.end());
    return std::adjacent_find(places.begin(), places.end()) != places.end();
  }

  /// True where the outline runs along one of its own edges twice in the same direction.
  static bool crosses_itself(std::span<const std::uint32_t> triangles, const Polygon& polygon) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        edges.emplace_back(polygon.place[triangles[t + k]], polygon.place[triangles[t + (k + 1) % 3]]);
      }
    }
    std::sort(edges.begin(), edges.end());
    return std::adjacent_find(edges.begin(), edges.end()) != edges.end();
  }

  /// Puts triangles into the first layer that has their edges free, turned over if need be.
  void place(const Outline& outline, const Polygon& polygon, std::span<const std::uint32_t> triangles) {
    for (int layer = 0;; ++layer) {
      for (const Side side : {Side::front, Side::back}) {
        if (!fits(layer, side, polygon, triangles)) continue;
        write(outline, layer, side, polygon, triangles);
        return;
      }
    }
  }

  template <class Visit>
  void each_edge(Side side, const Polygon& polygon, std::span<const std::uint32_t> triangles,
                 Visit visit) const {
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t from = polygon.place[triangles[t + k]], to = polygon.place[triangles[t + (k + 1) % 3]];
        if (!is_shared_[from] || !is_shared_[to]) continue;
        if (side == Side::back) std::swap(from, to);
        visit(from, to);
      }
    }
  }

  bool fits(int layer, Side side, const Polygon& polygon, std::span<const std::uint32_t> triangles) {
    bool is_free = true;
    each_edge(side, polygon, triangles, [&](std::uint32_t from, std::uint32_t to) {
      is_free = is_free && edges_.is_free(layer, from, to);
    });
    return is_free;
  }

  void write(const Outline& outline, int layer, Side side, const Polygon& polygon,
             std::span<const std::uint32_t> triangles) {
    each_edge(side, polygon, triangles,
              [&](std::uint32_t from, std::uint32_t to) { edges_.take(layer, from, to); });
    Mesh& mesh = mesh_of(layer, outline.color);
    if (mesh.position.size() + triangles.size() > 0xFFFFFFFEU)
      Job::refuse("The polygons have more vertices than 32-bit indices can name.");
    const glm::vec3 normal = (side == Side::front ? polygon.normal : -polygon.normal) + 0.0F;
    glm::dvec2 low = polygon.flat[0], high = low;
    for (const glm::dvec2& p : polygon.flat) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    std::vector<std::uint8_t> is_used(polygon.point.size());
    for (std::uint32_t point : triangles) is_used[point] = 1;
    std::vector<std::uint32_t> vertex(polygon.point.size());
    for (std::size_t i = 0; i < vertex.size(); ++i) {
      if (!is_used[i]) continue;
      const glm::vec2 uv = glm::vec2((polygon.flat[i] - low) / (high - low)) + 0.0F;
      vertex[i] =
          find_vertex(mesh, {layer, outline.color}, polygon.place[i], {polygon.point[i] + 0.0F, normal, uv});
    }
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      const std::size_t second = side == Side::front ? 1 : 2;
      for (std::size_t k : {std::size_t{0}, second, 3 - second})
        mesh.index.wide.push_back(vertex[triangles[t + k]]);
    }
  }

  struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 uv;
  };
  using Where = std::pair<int, std::int16_t>;  ///< layer and colour

  /// The number of an equal vertex of another outline, or of a new one.
  std::uint32_t find_vertex(Mesh& mesh, const Where& where, std::uint32_t place, const Vertex& vertex) {
    const auto fresh = static_cast<std::uint32_t>(mesh.position.size());
    std::uint64_t key =
        key_at(static_cast<std::uint64_t>(where.first), static_cast<std::uint16_t>(where.second));
    for (float value : {vertex.position.x, vertex.position.y, vertex.position.z, vertex.normal.x,
                        vertex.normal.y, vertex.normal.z, vertex.uv.x, vertex.uv.y}) {
      key = key_at(key, std::bit_cast<std::uint32_t>(value));
    }
    if (is_shared_[place]) {
      std::uint32_t& number = vertices_[key];
      if (number != NumberTable::none) return number;
      number = fresh;
    }
    mesh.position.push_back(vertex.position);
    mesh.normal.push_back(vertex.normal);
    mesh.uv[0].push_back(vertex.uv);
    return fresh;
  }

  Mesh& mesh_of(int layer, std::int16_t color) {
    const auto [at, is_new] = meshes_.try_emplace(Where{layer, color});
    if (is_new) {
      at->second.position = Array<glm::vec3>(job_);
      at->second.normal = Array<glm::vec3>(job_);
      at->second.uv[0] = Array<glm::vec2>(job_);
      at->second.index.wide = Array<std::uint32_t>(job_);
    }
    return at->second;
  }

  static void finish(Mesh& mesh) {
    mesh.position.shrink_to_fit();
    mesh.normal.shrink_to_fit();
    mesh.uv[0].shrink_to_fit();
    mesh.index.wide.shrink_to_fit();
  }

  const Outlines& outlines_;
  Job& job_;
  float size_ = 0;
  Array<std::uint32_t> place_;     ///< of each vertex of the outlines
  Array<std::uint8_t> is_shared_;  ///< of each place
  Edges edges_;
  NumberTable seen_;      ///< outlines made, by their places
  NumberTable faces_;     ///< triangles made, by their places
  NumberTable vertices_;  ///< vertices made, by everything they hold
  Meter budget_;
  std::map<Where, Mesh> meshes_;
};

}  // namespace

std::vector<Bark> polygons(const Outlines& outlines, Job& job) {
  if (outlines.outline.empty()) return {};
  return PolygonMaker(outlines, job).run();
}

}  // namespace seedmesh

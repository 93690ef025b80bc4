#include "core/geom/plant/polygons.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "core/geom/mesh/edge_adjacency.h"
#include "core/geom/mesh/point_grid.h"
#include "core/geom/plant/outline_plane.h"
#include "core/geom/polygon/triangulate.h"
#include "core/model/empty_mesh.h"
#include "core/model/index_width.h"

namespace seedmesh {
namespace {

// The welding distance, as a share of the diagonal of all outlines. Readers weld at half of it or less.
constexpr float weld_share = 2e-6F;
// The least area, as a share of the squared diagonal. Triangles of half this area count as degenerate.
constexpr double area_share = 2e-12;
// Outlines with at most this number of points keep a vertex cache of 16 entries warm in any order of
// triangles.
constexpr std::size_t most_in_cache = 14;
// The number of vertices between the prefetch of a slot and its use.
constexpr std::uint32_t look_ahead = 12;

/// Triangles of one outline that go to one mesh.
struct Piece {
  std::uint32_t outline = 0;
  std::uint32_t first_corner = 0, corners = 0;
  int layer = 0;
  glm::vec3 normal{0}, u{0};
};

/// The positions of an outline in an order that depends neither on its first point nor on its direction.
std::uint64_t cycle_key(const std::vector<std::uint32_t>& numbers) {
  const std::size_t count = numbers.size();
  const auto least =
      static_cast<std::size_t>(std::min_element(numbers.begin(), numbers.end()) - numbers.begin());
  const bool forward = numbers[(least + 1) % count] <= numbers[(least + count - 1) % count];
  std::uint64_t key = count;
  for (std::size_t i = 0; i < count; ++i) {
    key = key_at(key, numbers[forward ? (least + i) % count : (least + count - i) % count]);
  }
  return key;
}

/// Finds vertices that coincide. Outlines whose positions belong to no other outline, as most leaves, need
/// not agree with any.
struct Neighbourhood {
  Neighbourhood(const Outlines& outlines, Job& job)
      : is_shared(job), number(job, outlines.vertex.size()), outlines_(outlines) {
    const Box box = bounds_of(outlines.vertex.span());
    const glm::vec3 extent = box.max - box.min;
    size_ = std::sqrt(glm::dot(extent, extent));
    Weld weld(job, box, std::max(weld_share * size_, 1e-30F), outlines.vertex.span());
    is_shared.reserve(outlines.vertex.size());
    for (std::uint32_t i = 0; i < outlines.outline.size(); ++i) {
      const Outline& outline = outlines.outline[i];
      if (i % 256 == 0) job.check();
      for (std::uint32_t k = outline.first; k < outline.first + outline.count; ++k) {
        if (k + look_ahead < outlines.vertex.size()) weld.expect(k + look_ahead);
        number[k] = weld.number(k);
        if (k > outline.first && number[k - 1] == number[k]) continue;
        if (number[k] == is_shared.size()) {
          is_shared.push_back(0);
        } else {
          is_shared[number[k]] = 1;
        }
      }
    }
  }

  bool is_alone(const Outline& outline) const {
    const std::span<const std::uint32_t> numbers = number.span().subspan(outline.first, outline.count);
    return std::none_of(numbers.begin(), numbers.end(), [&](auto p) { return is_shared[p]; });
  }

  /// Fills in the polygon. Returns false where the outline has no area.
  bool read(const Outline& outline, FlatOutline& polygon) const {
    return polygon.read(outlines_, outline, number.span(), 4 * least_area());
  }
  double least_area() const { return area_share * size_ * size_; }

  Array<std::uint8_t>
      is_shared;  ///< of each position: several outlines contain it. Only there can triangles meet.
  Array<std::uint32_t> number;  ///< the position of each vertex of the outlines

 private:
  const Outlines& outlines_;
  float size_ = 0;
};

/// First pass: decides about each outline that shares positions.
class PolygonCutter {
 public:
  PolygonCutter(const Outlines& outlines, Neighbourhood& near, Job& job)
      : corner(job),
        piece(job),
        book(job),
        outlines_(outlines),
        near_(near),
        seen_(job, 64),
        faces_(job, 64),
        job_(job),
        budget_(job, Resource::triangles) {
    for (std::uint32_t i = 0; i < outlines.outline.size(); ++i) {
      if (i % 256 == 0) job.check();
      if (!near.is_alone(outlines.outline[i])) add(i);
    }
  }

  Array<std::uint32_t> corner;  ///< three a triangle, numbers of the outlines' vertices
  Array<Piece> piece;
  EdgeAdjacency book;

 private:
  void add(std::uint32_t number) {
    if (!near_.read(outlines_.outline[number], polygon_)) return;
    if (touches_itself()) {
      // Its own triangles may overlap, so they are checked like those of neighbours.
      for (std::uint32_t each : polygon_.number) near_.is_shared[each] = 1;
    }
    if (std::all_of(polygon_.number.begin(), polygon_.number.end(),
                    [&](auto p) { return near_.is_shared[p]; })) {
      std::uint32_t& seen = seen_[cycle_key(polygon_.number)];
      if (seen != NumberTable::none) return;
      seen = number;
    }
    check_vertex_count(job_, corner.size(), "The polygons");
    const auto first = static_cast<std::uint32_t>(corner.size());
    const std::span<const std::uint32_t> triangles = triangulator_.run(polygon_.flat, near_.least_area());
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      if (is_made_before(triangles.subspan(t, 3))) continue;
      for (std::size_t k = 0; k < 3; ++k) corner.push_back(polygon_.vertex[triangles[t + k]]);
    }
    const auto count = static_cast<std::uint32_t>(corner.size()) - first;
    budget_.spend(count / 3);
    const std::uint32_t step = count > 0 && crosses_itself(first, count) ? 3 : count;
    for (std::uint32_t done = 0; done < count; done += step) enter(number, first + done, step);
  }

  bool touches_itself() {
    const auto shared = std::count_if(polygon_.number.begin(), polygon_.number.end(),
                                      [&](auto p) { return near_.is_shared[p]; });
    if (shared < 2) return false;
    sorted_ = polygon_.number;
    std::sort(sorted_.begin(), sorted_.end());
    return std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end();
  }

  /// A triangle of outlines that coincide in part: two of them would be drawn in the same pixels.
  bool is_made_before(std::span<const std::uint32_t> triangle) {
    std::array<std::uint32_t, 3> numbers{polygon_.number[triangle[0]], polygon_.number[triangle[1]],
                                         polygon_.number[triangle[2]]};
    if (!near_.is_shared[numbers[0]] || !near_.is_shared[numbers[1]] || !near_.is_shared[numbers[2]])
      return false;
    std::sort(numbers.begin(), numbers.end());
    std::uint32_t& seen = faces_[key_at(std::uint64_t{numbers[0]} << 32U | numbers[1], numbers[2])];
    return std::exchange(seen, 1) != NumberTable::none;
  }

  /// Fills edges_ with the edges that other outlines may share.
  void list_edges(std::uint32_t first, std::uint32_t count) {
    edges_.clear();
    for (std::uint32_t t = first; t < first + count; t += 3) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const EdgeAdjacency::Edge edge{near_.number[corner[t + k]], near_.number[corner[t + (k + 1) % 3]]};
        if (near_.is_shared[edge.from] && near_.is_shared[edge.to]) edges_.push_back(edge);
      }
    }
  }

  /// True where two triangles have an edge in the same direction.
  bool crosses_itself(std::uint32_t first, std::uint32_t count) {
    list_edges(first, count);
    if (edges_.size() < 2) return false;
    const auto key = [](const EdgeAdjacency::Edge& e) { return std::uint64_t{e.from} << 32U | e.to; };
    std::sort(edges_.begin(), edges_.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    return std::adjacent_find(edges_.begin(), edges_.end(),
                              [&](const auto& a, const auto& b) { return key(a) == key(b); }) != edges_.end();
  }

  void enter(std::uint32_t outline, std::uint32_t first, std::uint32_t count) {
    list_edges(first, count);
    piece.push_back(
        {outline, first, count, book.add(edges_), glm::vec3(polygon_.normal), glm::vec3(polygon_.u)});
  }

  const Outlines& outlines_;
  Neighbourhood& near_;
  NumberTable seen_;   ///< outlines made, by their positions
  NumberTable faces_;  ///< triangles made, by their positions
  Job& job_;
  Meter budget_;
  FlatOutline polygon_;
  Triangulator triangulator_{&job_};
  std::vector<std::uint32_t> sorted_;
  std::vector<EdgeAdjacency::Edge> edges_;
};

/// Second pass: writes the outlines in order, those without shared positions as they are, the others by their
/// pieces, whose orientation is known now.
class PieceWriter {
 public:
  struct Inputs {
    const Outlines& outlines;
    const Neighbourhood& near;
    std::span<const std::uint16_t> bones;
  };

  PieceWriter(const Inputs& inputs, PolygonCutter& cut, Job& job)
      : outlines_(inputs.outlines),
        near_(inputs.near),
        cut_(cut),
        bones_(inputs.bones),
        job_(job),
        budget_(job, Resource::triangles),
        vertices_(job, 64) {}

  std::vector<Bark> run() {
    make_room();
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < outlines_.outline.size(); ++i) {
      if (i % 256 == 0) job_.check();
      if (near_.is_alone(outlines_.outline[i])) {
        cut_alone(i);
        continue;
      }
      for (; next < cut_.piece.size() && cut_.piece[next].outline == i; ++next) {
        const Piece& piece = cut_.piece[next];
        write(piece, cut_.corner.span().subspan(piece.first_corner, piece.corners),
              cut_.book.is_turned(next));
      }
    }
    std::vector<Bark> all;
    for (auto& [where, mesh] : meshes_) {
      if (mesh.index.wide.empty()) continue;
      mesh.position.shrink_to_fit();
      mesh.normal.shrink_to_fit();
      mesh.uv[0].shrink_to_fit();
      mesh.bone.shrink_to_fit();
      all.push_back({where.second, std::move(mesh), where.first});
    }
    return all;
  }

 private:
  using Where = std::pair<int, std::int16_t>;  ///< layer and colour
  struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 uv;
    std::uint16_t bone;
  };

  Where where(const Piece& piece) const { return {piece.layer, outlines_.outline[piece.outline].color}; }

  /// Allocates the largest size that each mesh can need.
  void make_room() {
    struct Need {
      std::size_t vertices = 0, corners = 0;
      bool fits_cache = true;
    };
    std::map<Where, Need> needs;
    const auto add = [&](const Where& at, std::size_t points, std::size_t corners) {
      Need& need = needs[at];
      need.vertices += points;
      need.corners += corners;
      need.fits_cache = need.fits_cache && points <= most_in_cache;
    };
    for (const Piece& piece : cut_.piece) {
      add(where(piece), std::min(outlines_.outline[piece.outline].count, piece.corners), piece.corners);
    }
    for (const Outline& outline : outlines_.outline) {
      if (outline.count >= 3 && near_.is_alone(outline))
        add({0, outline.color}, outline.count, 3 * (std::size_t{outline.count} - 2));
    }
    for (const auto& [at, need] : needs) {
      check_vertex_count(job_, need.vertices, "The polygons");
      Mesh& mesh = meshes_[at];
      mesh = empty_mesh(job_);
      mesh.uv[0] = Array<glm::vec2>(job_);
      mesh.bone = Array<std::uint16_t>(job_);
      mesh.position.reserve(need.vertices);
      mesh.normal.reserve(need.vertices);
      mesh.uv[0].reserve(need.vertices);
      if (!bones_.empty()) mesh.bone.reserve(need.vertices);
      mesh.index.wide.reserve(need.corners);
      mesh.cache_ordered = need.fits_cache;
    }
  }

  void cut_alone(std::uint32_t number) {
    if (!near_.read(outlines_.outline[number], polygon_)) return;
    const std::span<const std::uint32_t> triangles = triangulator_.run(polygon_.flat, near_.least_area());
    if (triangles.empty()) return;
    budget_.spend(triangles.size() / 3);
    corners_.clear();
    for (std::uint32_t each : triangles) corners_.push_back(polygon_.vertex[each]);
    write({number, 0, 0, 0, glm::vec3(polygon_.normal), glm::vec3(polygon_.u)}, corners_, false);
  }

  void write(const Piece& piece, std::span<const std::uint32_t> corners, bool is_turned) {
    const Outline& outline = outlines_.outline[piece.outline];
    Mesh& mesh = mesh_at(where(piece));
    const glm::vec3 origin = outlines_.vertex[outline.first];
    const std::uint16_t bone =
        bones_.empty() || outline.limb_joint == Limbs::none ? std::uint16_t{0} : bones_[outline.limb_joint];
    const glm::vec3 v = glm::cross(piece.normal, piece.u);
    flat_.resize(outline.count);
    glm::vec2 low{0}, high{0};
    for (std::uint32_t i = 0; i < outline.count; ++i) {
      const glm::vec3 offset = outlines_.vertex[outline.first + i] - origin;
      flat_[i] = {glm::dot(offset, piece.u), glm::dot(offset, v)};
      low = glm::min(low, flat_[i]);
      high = glm::max(high, flat_[i]);
    }
    const glm::vec2 extent = high - low;
    const glm::vec2 scale{extent.x > 0 ? 1 / extent.x : 0, extent.y > 0 ? 1 / extent.y : 0};
    const glm::vec3 normal = (is_turned ? -piece.normal : piece.normal) + 0.0F;

    vertex_.assign(outline.count, unused);
    for (std::uint32_t corner : corners) vertex_[corner - outline.first] = used;
    for (std::uint32_t i = 0; i < outline.count; ++i) {
      if (vertex_[i] == unused) continue;
      const glm::vec2 uv = glm::min((flat_[i] - low) * scale, glm::vec2(1)) + 0.0F;
      vertex_[i] = find_vertex(mesh, where(piece), near_.number[outline.first + i],
                               {outlines_.vertex[outline.first + i] + 0.0F, normal, uv, bone});
    }
    std::uint32_t* out = mesh.index.wide.extend(corners.size());
    for (std::size_t t = 0; t < corners.size(); t += 3) {
      const std::size_t second = is_turned ? 2 : 1;
      for (std::size_t k : {std::size_t{0}, second, 3 - second})
        *out++ = vertex_[corners[t + k] - outline.first];
    }
  }

  /// The number of an equal vertex of another outline, or of a new one.
  std::uint32_t find_vertex(Mesh& mesh, const Where& where, std::uint32_t position, const Vertex& vertex) {
    const auto fresh = static_cast<std::uint32_t>(mesh.position.size());
    if (near_.is_shared[position]) {
      std::uint64_t key =
          key_at(static_cast<std::uint64_t>(where.first), static_cast<std::uint16_t>(where.second));
      for (float value : {vertex.position.x, vertex.position.y, vertex.position.z, vertex.normal.x,
                          vertex.normal.y, vertex.normal.z, vertex.uv.x, vertex.uv.y}) {
        key = key_at(key, std::bit_cast<std::uint32_t>(value));
      }
      if (vertex.bone != 0) key = key_at(key, vertex.bone);
      std::uint32_t& number = vertices_[key];
      if (number != NumberTable::none) return number;
      number = fresh;
    }
    mesh.position.push_back(vertex.position);
    mesh.normal.push_back(vertex.normal);
    mesh.uv[0].push_back(vertex.uv);
    if (!bones_.empty()) mesh.bone.push_back(vertex.bone);
    return fresh;
  }

  Mesh& mesh_at(const Where& at) {
    if (!last_ || last_at_ != at) {
      last_ = &meshes_.at(at);
      last_at_ = at;
    }
    return *last_;
  }

  static constexpr std::uint32_t unused = 0xFFFFFFFFU, used = 0xFFFFFFFEU;

  const Outlines& outlines_;
  const Neighbourhood& near_;
  PolygonCutter& cut_;
  std::span<const std::uint16_t> bones_;
  Job& job_;
  Meter budget_;
  FlatOutline polygon_;
  Triangulator triangulator_{&job_};
  std::vector<std::uint32_t> corners_;
  NumberTable vertices_;  ///< vertices at shared positions, by all their attributes
  std::map<Where, Mesh> meshes_;
  Mesh* last_ = nullptr;
  Where last_at_;
  std::vector<glm::vec2> flat_;
  std::vector<std::uint32_t> vertex_;
};

}  // namespace

std::vector<Bark> polygons(const Outlines& outlines, Job& job, std::span<const std::uint16_t> bones) {
  if (outlines.outline.empty()) return {};
  Neighbourhood near(outlines, job);
  PolygonCutter cut(outlines, near, job);
  return PieceWriter({outlines, near, bones}, cut, job).run();
}

}  // namespace seedmesh

#include "core/generators/city/city_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "core/base/math.h"
#include "core/generators/city/bridge_mesh.h"
#include "core/generators/city/chunks.h"
#include "core/generators/city/contents.h"
#include "core/geom/mesh/weld.h"
#include "core/geom/polygon/triangulate.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

struct Look {
  const char* name;
  std::array<std::uint8_t, 3> color;
  float roughness;
};
constexpr Look looks[] = {
    {"asphalt", {0x45, 0x46, 0x48}, 0.95F}, {"junction", {0x48, 0x49, 0x4b}, 0.95F},
    {"sidewalk", {0x9b, 0x98, 0x92}, 0.9F}, {"verge", {0x7f, 0x8a, 0x62}, 1.0F},
    {"park", {0x5f, 0x7d, 0x45}, 1.0F},     {"square", {0xa8, 0x9d, 0x88}, 0.9F},
    {"lot", {0x86, 0x8f, 0x6a}, 1.0F},      {"water", {0x35, 0x55, 0x66}, 0.2F},
};
constexpr double water_depth = 1.2;  // below the streets, m

Material material_of(const Look& look) {
  Material material;
  material.name = look.name;
  material.base_color = {linear_of_srgb(look.color[0]), linear_of_srgb(look.color[1]),
                         linear_of_srgb(look.color[2]), 1};
  material.roughness = look.roughness;
  return material;
}

bool is_low(PartKind kind) { return kind == PartKind::carriageway || kind == PartKind::junction; }

double height_of(PartKind kind) {
  return kind == PartKind::water ? 0 - water_depth : is_low(kind) ? 0 : kerb_height;
}

struct DirectedEdge {
  CmPoint a, b;
  friend auto operator<=>(const DirectedEdge&, const DirectedEdge&) = default;
};

/// All edges of carriageways and junctions, sorted.
std::vector<DirectedEdge> low_edges(const CityPlan& plan) {
  std::vector<DirectedEdge> edges;
  for (const Part& part : plan.parts) {
    if (!is_low(part.kind)) continue;
    for (const CmRing& ring : part.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// All edges of water, sorted.
std::vector<DirectedEdge> water_edges(const CityPlan& plan) {
  std::vector<DirectedEdge> edges;
  for (const Part& part : plan.parts) {
    if (part.kind != PartKind::water) continue;
    for (const CmRing& ring : part.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// The edges of a part that one of the given edges has the other way round.
template <class Visit>
void visit_kerbs(const Part& part, const std::vector<DirectedEdge>& low, const Visit& visit) {
  for (const CmRing& ring : part.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const CmPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (std::binary_search(low.begin(), low.end(), DirectedEdge{b, a})) visit(a, b);
    }
  }
}

std::uint64_t count_kerbs(const Part& part, const std::vector<DirectedEdge>& low) {
  std::uint64_t count = 0;
  visit_kerbs(part, low, [&count](const CmPoint&, const CmPoint&) { ++count; });
  return count;
}

class GroundMesh {
 public:
  explicit GroundMesh(const Job& job) : triangulator_(&job) {
    mesh_.position = Array<glm::vec3>(job);
    mesh_.normal = Array<glm::vec3>(job);
    mesh_.uv[0] = Array<glm::vec2>(job);
    mesh_.index.wide = Array<std::uint32_t>(job);
  }

  void add_part(const Part& part, double height) {
    points_.clear();
    sizes_.clear();
    for (const CmRing& ring : part.rings) {
      for (const CmPoint& p : ring) points_.push_back(in_metres(p));
      sizes_.push_back(static_cast<std::uint32_t>(ring.size()));
    }
    const auto first = static_cast<std::uint32_t>(mesh_.position.size());
    for (const dvec2& p : points_) add_vertex(p, height, {0, 1, 0}, glm::vec2(p));
    const auto& corners = triangulator_.run(points_, sizes_, 0);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      const std::uint32_t a = first + corners[i], b = first + corners[i + 1], c = first + corners[i + 2];
      if (!has_area(a, b, c)) continue;
      for (const std::uint32_t corner : {a, b, c}) mesh_.index.wide.push_back(corner);
    }
  }

  /// The upright face of a kerb or quay along an edge whose left side is higher.
  void add_wall(const CmPoint& from, const CmPoint& to, double low, double high) {
    const dvec2 a = in_metres(from), b = in_metres(to), along = (b - a) / std::sqrt(glm::dot(b - a, b - a));
    // The right side of the edge, seen from above; north is -Z.
    const glm::vec3 normal(static_cast<float>(along.y), 0, static_cast<float>(along.x));
    const auto first = static_cast<std::uint32_t>(mesh_.position.size());
    const auto length = static_cast<float>(std::sqrt(glm::dot(b - a, b - a)));
    const auto height = static_cast<float>(high - low);
    add_vertex(a, low, normal, {0, 0});
    add_vertex(b, low, normal, {length, 0});
    add_vertex(b, high, normal, {length, height});
    add_vertex(a, high, normal, {0, height});
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh_.index.wide.push_back(first + corner);
  }

  Mesh take(Job& job) {
    weld(mesh_, job);
    return std::move(mesh_);
  }

 private:
  /// Whether a level triangle is wide enough to keep its side in single precision. Corners on a straight border
  /// make triangles without area, which cover nothing.
  bool has_area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    constexpr float least = 1e-3F;  // twice the area in square metres
    const glm::vec3 &p = mesh_.position[a], &q = mesh_.position[b], &r = mesh_.position[c];
    return (q.z - p.z) * (r.x - p.x) - (q.x - p.x) * (r.z - p.z) > least;
  }

  void add_vertex(const dvec2& p, double height, const glm::vec3& normal, const glm::vec2& uv) {
    mesh_.position.push_back(
        {static_cast<float>(p.x), static_cast<float>(height), static_cast<float>(0 - p.y)});
    mesh_.normal.push_back(normal);
    mesh_.uv[0].push_back(uv);
  }

  Mesh mesh_;
  Triangulator triangulator_;
  std::vector<dvec2> points_;
  std::vector<std::uint32_t> sizes_;
};

/// Parts of one chunk and kind.
struct GroundPiece {
  std::uint32_t chunk = 0;
  PartKind kind = PartKind::verge;
  std::vector<std::uint32_t> parts;
};

/// All parts but walls, by chunk and kind.
std::vector<GroundPiece> ground_pieces(const CityPlan& plan, const Chunks& chunks) {
  std::map<std::pair<std::uint32_t, PartKind>, std::vector<std::uint32_t>> sorted;
  for (std::uint32_t i = 0; i < plan.parts.size(); ++i) {
    const Part& part = plan.parts[i];
    if (!part.is_wall) sorted[{chunks.of(part), part.kind}].push_back(i);
  }
  std::vector<GroundPiece> pieces;
  for (auto& [key, parts] : sorted) pieces.push_back({key.first, key.second, std::move(parts)});
  return pieces;
}

/// One mesh for each kind of part in each chunk.
void add_ground(Model& model, const CityPlan& plan, const Chunks& chunks, ChunkNodes& nodes, Job& job) {
  job.spend(Resource::triangles, ground_triangles(plan));
  const std::vector<DirectedEdge> low = low_edges(plan), water = water_edges(plan);
  std::array<int, std::size(looks)> materials;
  materials.fill(-1);
  for (const GroundPiece& piece : ground_pieces(plan, chunks)) {
    const auto kind = static_cast<std::size_t>(piece.kind);
    GroundMesh mesh(job);
    std::size_t done = 0;
    for (const std::uint32_t number : piece.parts) {
      const Part& part = plan.parts[number];
      if (done++ % 256 == 0) job.check();
      mesh.add_part(part, height_of(part.kind));
      if (part.kind == PartKind::water) continue;
      const double height = height_of(part.kind);
      const auto add_quay = [&](const CmPoint& a, const CmPoint& b) {
        mesh.add_wall(a, b, 0 - water_depth, height);
      };
      visit_kerbs(part, water, add_quay);
      if (is_low(part.kind)) continue;
      visit_kerbs(part, low,
                  [&](const CmPoint& a, const CmPoint& b) { mesh.add_wall(a, b, 0, kerb_height); });
    }
    if (materials[kind] < 0) {
      materials[kind] = static_cast<int>(model.materials.size());
      model.materials.push_back(material_of(looks[kind]));
    }
    MeshGroup group;
    group.name = looks[kind].name;
    Primitive primitive;
    primitive.mesh = mesh.take(job);
    primitive.material = materials[kind];
    group.primitives.push_back(std::move(primitive));
    const int node = add_node(model, looks[kind].name, nodes.group(piece.chunk, "ground"));
    model.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(group));
  }
}

/// Adds a node with one mesh.
void add_mesh(Model& model, const char* name, const Look& look, Mesh mesh) {
  MeshGroup group;
  group.name = name;
  Primitive primitive;
  primitive.mesh = std::move(mesh);
  primitive.material = static_cast<int>(model.materials.size());
  model.materials.push_back(material_of(look));
  group.primitives.push_back(std::move(primitive));
  const int node = add_node(model, name, 0);
  model.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(std::move(group));
}

/// The parts of a town wall, raised to its height.
void add_town_wall(Model& model, const CityPlan& plan, double height, Job& job) {
  std::vector<DirectedEdge> edges;
  for (const Part& part : plan.parts) {
    if (!part.is_wall) continue;
    for (const CmRing& ring : part.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
  }
  if (edges.empty()) return;
  std::sort(edges.begin(), edges.end());
  const std::vector<DirectedEdge> low = low_edges(plan);
  GroundMesh mesh(job);
  for (const Part& part : plan.parts) {
    if (part.is_wall) mesh.add_part(part, height);
  }
  for (const DirectedEdge& edge : edges) {
    const DirectedEdge back{edge.b, edge.a};
    if (std::binary_search(edges.begin(), edges.end(), back)) continue;
    const bool is_at_kerb = std::binary_search(low.begin(), low.end(), back);
    mesh.add_wall(edge.a, edge.b, is_at_kerb ? 0 : kerb_height, height);
  }
  add_mesh(model, "wall", {"wall", {0x8d, 0x84, 0x74}, 0.95F}, mesh.take(job));
}

void add_bridges(Model& model, const CityPlan& plan, Job& job) {
  Mesh mesh = bridge_mesh(plan, job);
  if (mesh.elements() == 0) return;
  job.spend(Resource::triangles, mesh.elements());
  add_mesh(model, "bridges", {"bridge", {0x8a, 0x88, 0x84}, 0.9F}, std::move(mesh));
}

}  // namespace

std::uint64_t ground_triangles(const CityPlan& plan) {
  const std::vector<DirectedEdge> low = low_edges(plan), water = water_edges(plan);
  std::uint64_t count = 0;
  for (const Part& part : plan.parts) {
    for (const CmRing& ring : part.rings) count += ring.size();
    count += 2 * part.rings.size() - 4;
    if (part.is_wall) count += 2 * part.rings[0].size() - 4;
    if (part.kind == PartKind::water) continue;
    count += 2 * count_kerbs(part, water);
    if (!is_low(part.kind)) count += 2 * count_kerbs(part, low);
  }
  return count;
}

Result<Model> city_model(const CityPlan& plan, const CityParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Model model;
  model.name = "city";
  add_node(model, "city", -1);
  const Chunks chunks(plan, params);
  ChunkNodes nodes(model, chunks);
  add_ground(model, plan, chunks, nodes, job);
  add_town_wall(model, plan, params.streets.wards.wall_height, job);
  add_bridges(model, plan, job);
  if (auto error = add_contents(model, nodes, chunks, plan, params, context)) return std::move(*error);
  return model;
}

}  // namespace seedmesh::city

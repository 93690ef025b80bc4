#include "core/generators/city/yard_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

#include "core/base/math.h"
#include "core/generators/city/city_model.h"
#include "core/generators/city/solid_builder.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr float border_depth = 0.25F;  // of hedges and fences below the ground, m
constexpr double post_spacing = 2.6;

double half_width_of(CityBorder kind) {
  return kind == CityBorder::hedge ? 0.3 : kind == CityBorder::wall ? 0.15 : 0.05;
}

/// The corners of the hedges or walls so far, in cells of 5 mm.
using CornerCells = std::set<std::pair<std::int64_t, std::int64_t>>;

/// Returns how much shorter a hedge or a wall is than its border at both ends, so that no corner of it is within 5 mm of
/// the corner of another. Adds its corners.
double gap_of(const BorderPiece& piece, double half, CornerCells& taken) {
  constexpr double cells_per_metre = 200, least = 0.01, step = 0.02;
  constexpr int tries = 5;
  const dvec2 run = piece.b - piece.a;
  const double length = glm::length(run);
  const dvec2 along = run / length, side = dvec2(-along.y, along.x) * half;
  double gap = 0;
  std::array<std::pair<std::int64_t, std::int64_t>, 4> corners;
  const auto is_free = [&](const std::pair<std::int64_t, std::int64_t>& corner) {
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y)
        if (taken.contains({corner.first + x, corner.second + y})) return false;
    }
    return true;
  };
  for (int i = 0; i < tries; ++i) {
    gap = std::min(least + step * i, length / 4);
    const dvec2 a = piece.a + along * gap, b = piece.b - along * gap;
    const std::array<dvec2, 4> at = {a - side, a + side, b - side, b + side};
    std::transform(at.begin(), at.end(), corners.begin(), [](const dvec2& p) {
      return std::pair(math::to_int64(std::floor(p.x * cells_per_metre)),
                       math::to_int64(std::floor(p.y * cells_per_metre)));
    });
    if (std::all_of(corners.begin(), corners.end(), is_free)) break;
  }
  taken.insert(corners.begin(), corners.end());
  return gap;
}

/// A hedge or a wall, or the panel and the posts of a fence, along a border. `ground` has the heights of the ground
/// at its ends; a hedge or a wall is shorter by `gap` at each end.
void add_border(SolidBuilder& solid, const BorderPiece& piece, const std::array<double, 2>& ground,
                CityBorder kind, double height, double gap) {
  const dvec2 run = piece.b - piece.a;
  const double length = glm::length(run);
  const dvec2 along = run / length, side(-along.y, along.x);
  const auto corner = [&](double s, double offset) {
    const dvec2 p = piece.a + along * s + side * offset;
    return glm::vec2(static_cast<float>(p.x), static_cast<float>(0 - p.y));
  };
  const auto base = [&](double s) {
    return static_cast<float>(ground[0] + (ground[1] - ground[0]) * s / length);
  };
  const auto add = [&](double from, double to, double half, float low, float high) {
    const float a = base(from), b = base(to);
    solid.add_slab({corner(from, -half), corner(to, -half), corner(to, half), corner(from, half)},
                   {a + low, b + low, b + low, a + low}, {a + high, b + high, b + high, a + high});
  };
  const auto top = static_cast<float>(height);
  if (kind != CityBorder::fence) {
    add(gap, length - gap, half_width_of(kind), 0 - border_depth, top);
    return;
  }
  add(0, length, 0.02, 0.1F, top);
  const int posts = 1 + math::to_int32(std::floor(length / post_spacing));
  for (int i = 0; i <= posts; ++i) {
    const double at = 0.06 + (length - 0.12) * i / posts;
    add(at - 0.05, at + 0.05, 0.05, 0 - border_depth, top + 0.08F);
  }
}

SolidMaterial solid_material_of(CityBorder kind) {
  if (kind == CityBorder::hedge) return {"hedge", {0x45, 0x5e, 0x33}, 1, 0};
  if (kind == CityBorder::wall) return {"yard_wall", {0xb9, 0xae, 0x9a}, 0.95F, 0};
  return {"fence", {0x8a, 0x76, 0x5e}, 0.9F, 0};
}

}  // namespace

std::uint64_t yard_border_triangles(const BorderPiece& piece, CityBorder kind) {
  if (kind != CityBorder::fence) return 12;
  const int posts = 1 + math::to_int32(std::floor(glm::length(piece.b - piece.a) / post_spacing));
  return 12 + 12 * static_cast<std::uint64_t>(posts + 1);
}

std::vector<BorderPiece> yard_borders(const Surface& surface, const CityParams& params, const Job& job) {
  constexpr double longest = 6, gap = 0.02;
  if (!params.yards || params.yards->border == CityBorder::none) return {};
  std::vector<BorderPiece> whole = lot_borders(surface.plan(), job);
  if (params.yards->front) {
    const double half_width = half_width_of(params.yards->border);
    std::vector<BorderPiece> fronts = front_borders(surface.plan(), job);
    end_beside(fronts, whole, half_width);
    const std::vector<BorderPiece> sides = side_street_borders(surface.plan(), half_width, job);
    whole.insert(whole.end(), fronts.begin(), fronts.end());
    whole.insert(whole.end(), sides.begin(), sides.end());
  }
  if (surface.is_level()) return whole;
  std::vector<BorderPiece> pieces;
  for (const BorderPiece& each : whole) {
    const dvec2 run = each.b - each.a;
    const double length = glm::length(run);
    const int count = math::to_int32(std::ceil(length / longest));
    for (int i = 0; i < count; ++i) {
      const double end = i + 1 < count ? (i + 1.0) / count - gap / length : 1;
      pieces.push_back({each.a + run * (static_cast<double>(i) / count), each.a + run * end, each.part});
    }
  }
  return pieces;
}

void add_yard_borders(Model& model, ChunkNodes& nodes, const Chunks& chunks, const Surface& surface,
                      const CityParams& params, Job& job) {
  const CityPlan& plan = surface.plan();
  std::map<std::uint32_t, SolidBuilder> by_chunk;
  CornerCells taken;
  for (const BorderPiece& piece : yard_borders(surface, params, job)) {
    job.check();
    job.spend(Resource::triangles, yard_border_triangles(piece, params.yards->border));
    const std::uint32_t chunk = chunks.at((piece.a + piece.b) / 2.0, plan.parts[piece.part].block);
    const std::array<double, 2> ground = {surface.height(piece.part, piece.a),
                                          surface.height(piece.part, piece.b)};
    const CityBorder kind = params.yards->border;
    const double gap = kind == CityBorder::fence ? 0 : gap_of(piece, half_width_of(kind), taken);
    add_border(by_chunk.try_emplace(chunk, job).first->second, piece, ground, kind, params.yards->height,
               gap);
  }
  if (by_chunk.empty()) return;
  const auto material = static_cast<int>(model.materials.size());
  const SolidMaterial look = solid_material_of(params.yards->border);
  model.materials.push_back(material_of(look));
  for (auto& [chunk, solid] : by_chunk) {
    MeshGroup group;
    group.name = look.name;
    Primitive primitive;
    primitive.mesh = solid.take(job);
    primitive.material = material;
    group.primitives.push_back(std::move(primitive));
    const int node = add_node(model, look.name, nodes.group(chunk, "borders"));
    model.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(group));
  }
}

}  // namespace seedmesh::city

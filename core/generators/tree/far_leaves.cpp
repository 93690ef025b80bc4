// A card of one triangle. The twigs of core/geom/plant/leafy_twig.h and needle_twig.h are widest at two fifths of their
// length from the tip, and end in points. A triangle around nearly all of a twig therefore has only 0.6 of the area of
// the smallest triangle around the whole square. Texture coordinates outside 0..1 are those of the transparent margin.
#include "core/generators/tree/far_leaves.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/base/math.h"
#include "core/generators/tree/leaves.h"
#include "core/generators/tree/materials.h"
#include "core/geom/lod/view_samples.h"
#include "core/geom/mesh/sheet.h"

namespace seedmesh::tree {
namespace {

constexpr std::array<glm::vec2, 3> corners{glm::vec2(-0.5F, 1), glm::vec2(1.42F, 1),
                                           glm::vec2(0.46F, -0.25F)};
// Light from above, of the sun at 55 degrees for leaves without shadow, and of the sky; the ground has a quarter of it.
constexpr double sun = 3.6, sky = 0.72, ground_share = 0.25, unshaded = 0.9, sun_degrees = 55;
// Share of the sides of a triangle that its texture fills.
constexpr double filled = 0.5;
constexpr int views = 3, azimuths = 4;
// Shares of the brightness that leaves gain where no twig and where no other leaf shades them.
constexpr double from_twigs = 0.025, from_leaves = 0.25;
// The coarseness at which leaf_mesh() makes flat squares.
constexpr std::int32_t flat = 4;

/// Replaces each square of two triangles and four vertices by one triangle in its plane. The vertices of a square
/// differ in the texture coordinates alone, which are 0 or 1.
Mesh as_triangles(const Mesh& squares, std::size_t begin, std::size_t end, const Job& job) {
  Mesh mesh = empty_sheet(job);
  for (std::size_t first = begin; first < end; first += 4) {
    std::array<glm::vec3, 4> at;
    for (std::size_t i = first; i < first + 4; ++i) {
      const glm::vec2 uv = squares.uv[0][i];
      at[(uv.x > 0.5F ? 1U : 0U) + (uv.y > 0.5F ? 2U : 0U)] = squares.position[i];
    }
    for (const glm::vec2& uv : corners) {
      mesh.position.push_back(at[0] + uv.x * (at[1] - at[0]) + uv.y * (at[2] - at[0]) + 0.0F);
      mesh.normal.push_back(squares.normal[first]);
      mesh.uv[0].push_back(uv);
      mesh.index.wide.push_back(static_cast<std::uint32_t>(mesh.index.wide.size()));
    }
  }
  settle_normals(mesh);
  return mesh;
}

/// Moves flat cards to the mean position of bent ones: two thirds of the height of the arc above its chord.
void raise_to_mean(Mesh& squares, const TreeParams& params) {
  const TreeBuild build = build_of(params);
  if (build == TreeBuild::card || build == TreeBuild::cross) return;
  const auto height = static_cast<float>(math::radians(params.leaf.droop) / 12);
  for (std::size_t i = 0; i < squares.position.size(); ++i)
    squares.position[i] += height * squares.normal[i] + 0.0F;
}

template <class T>
void take(const Array<T>& from, std::span<const std::uint32_t> vertices, Array<T>& to, const Job& job) {
  if (from.empty()) return;
  to = Array<T>(job, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) to[i] = from[vertices[i]];
}

glm::vec3 face_of(const Mesh& mesh, std::size_t corner) {
  const glm::vec3& a = mesh.position[mesh.index.at(corner)];
  return glm::cross(mesh.position[mesh.index.at(corner + 1)] - a,
                    mesh.position[mesh.index.at(corner + 2)] - a);
}

/// The axes of a level view: right and towards the viewer; the third is up.
struct LevelView {
  glm::dvec3 right, towards;
};

/// The light on a surface; mean over azimuths of the sun.
double light_of(const glm::dvec3& normal, const LevelView& view) {
  const math::SinCos height = math::sincos_degrees(sun_degrees);
  double light = sky * (ground_share + (1 - ground_share) * 0.5 * (1 + normal.y));
  for (int i = 0; i < azimuths; ++i) {
    const math::SinCos turn = math::sincos_degrees(45 + 90.0 * i);
    const double aside = glm::dot(normal, view.right) * turn.sin + glm::dot(normal, view.towards) * turn.cos;
    light += unshaded * sun / azimuths * std::max(normal.y * height.sin + aside * height.cos, 0.0);
  }
  return light;
}

/// The nearest triangle at each texel of a view, and its light.
class LitView {
 public:
  LitView(const Box& box, const LevelView& view, const Job& job)
      : view_(view),
        middle_(0.5F * (box.min + box.max)),
        scale_(ViewSamples::across / std::max(static_cast<double>(glm::distance(box.min, box.max)), 1e-9)),
        depth_(job, ViewSamples::texels, -far),
        light_(job, ViewSamples::texels, 0.0F) {}

  /// Draws the part of a triangle that the texture fills.
  void draw(const std::array<glm::dvec3, 3>& at, const glm::dvec3& normal) {
    const glm::dvec3 center = (at[0] + at[1] + at[2]) / 3.0;
    const bool is_front = glm::dot(glm::cross(at[1] - at[0], at[2] - at[0]), view_.towards) > 0;
    const auto light = static_cast<float>(light_of(is_front ? normal : -normal, view_));
    const auto depth = static_cast<float>(glm::dot(center - middle_, view_.towards));
    const auto placed = [&](std::size_t i) {
      const glm::dvec3 off = center + filled * (at[i] - center) - middle_;
      return 0.5 * ViewSamples::across + scale_ * glm::dvec2(glm::dot(off, view_.right), off.y);
    };
    ViewSamples::fill(placed(0), placed(1), placed(2), [&](std::size_t texel) {
      if (depth <= depth_[texel]) return;
      depth_[texel] = depth;
      light_[texel] = light;
    });
  }

  double sum() const { return std::accumulate(light_.begin(), light_.end(), 0.0); }
  double covered() const {
    return static_cast<double>(std::ranges::count_if(depth_, [](float depth) { return depth > -far; }));
  }

 private:
  static constexpr float far = 1e30F;

  LevelView view_;
  glm::dvec3 middle_;
  double scale_;
  Array<float> depth_, light_;
};

/// The mean light on what is seen of a mesh of such triangles.
double light_on(const Mesh& mesh, const Job& job) {
  double light = 0, covered = 0;
  for (int number = 0; number < views; ++number) {
    const math::SinCos turn = math::sincos_degrees(120.0 * number);
    LitView view(bounds_of(mesh.position.span()), {{turn.cos, 0, -turn.sin}, {turn.sin, 0, turn.cos}}, job);
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
      std::array<glm::dvec3, 3> at;
      glm::dvec3 normal(0);
      for (std::size_t k = 0; k < 3; ++k) {
        at[k] = mesh.position[mesh.index.at(i + k)];
        normal += glm::dvec3(mesh.normal[mesh.index.at(i + k)]);
      }
      view.draw(at, math::unit(normal, {0, 1, 0}));
    }
    light += view.sum();
    covered += view.covered();
  }
  return light / std::max(covered, 1.0);
}

}  // namespace

float gain_of(const Mesh& all, const Mesh& outer, const Job& job) {
  return static_cast<float>(light_on(all, job) / std::max(light_on(outer, job), 1e-6));
}

float dimming(double share) { return static_cast<float>((1 - from_twigs) * (1 - from_leaves * (1 - share))); }

bool has_far_leaves(const TreeParams& params, const GenerateContext& context) {
  return context.demand.textures > 0 && build_of(params) != TreeBuild::mesh && has_leaf_texture(params) &&
         params.leaf.images.color.empty();
}

Mesh far_leaf(const TreeParams& params, LeafDetail detail, int level, const Job& job) {
  if (detail == LeafDetail::bent) return leaf_of(params, level, job);
  TreeParams coarse = params;
  coarse.leaf.coarseness = flat;
  Mesh squares = leaf_of(coarse, level, job);
  raise_to_mean(squares, params);
  if (detail == LeafDetail::square) return squares;
  // The first of crossed cards is level where the upper sides of leaves face up; from the side the second is visible.
  const bool has_second = detail == LeafDetail::one_card && squares.position.size() > 4;
  return as_triangles(squares, has_second ? 4 : 0, has_second ? 8 : squares.position.size(), job);
}

Mesh outer_sides(const Mesh& mesh, const Mesh& leaf, const glm::vec3& middle, const Job& job) {
  const std::size_t half = leaf.index.size() / 2;
  Array<std::uint32_t> kept(job);
  kept.reserve(mesh.index.size() / 2);
  for (std::size_t first = 0; first < mesh.index.size(); first += 2 * half) {
    if (first % 65'536 == 0) job.check();
    for (std::size_t i = first; i < first + half; i += 3) {
      const glm::vec3 out = mesh.position[mesh.index.at(i)] - middle, face = face_of(mesh, i);
      const std::size_t side = face.x * out.x + face.z * out.z >= 0 ? i : i + half;
      for (std::size_t corner = side; corner < side + 3; ++corner) kept.push_back(mesh.index.at(corner));
    }
  }
  Mesh outer;
  take(mesh.position, kept.span(), outer.position, job);
  take(mesh.normal, kept.span(), outer.normal, job);
  for (std::size_t set = 0; set < mesh.uv.size(); ++set) take(mesh.uv[set], kept.span(), outer.uv[set], job);
  take(mesh.color, kept.span(), outer.color, job);
  take(mesh.tangent, kept.span(), outer.tangent, job);
  take(mesh.bone, kept.span(), outer.bone, job);
  outer.index.wide = Array<std::uint32_t>(job, kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) outer.index.wide[i] = static_cast<std::uint32_t>(i);
  outer.cache_ordered = mesh.cache_ordered;
  outer.no_minus_zero = mesh.no_minus_zero;
  return outer;
}

}  // namespace seedmesh::tree

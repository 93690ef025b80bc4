#include "core/geom/foliage.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace {

// Leaves a worker takes at once.
constexpr std::size_t chunk = 4096;
// Leaves of a twig, and how long and wide each is as a share of the twig.
constexpr int twig_leaves = 9;
constexpr float twig_leaf_length = 0.42F, twig_leaf_width = 0.2F;
// Needles of a shoot, and how long and wide.
constexpr int needles = 12;
constexpr float needle_length = 0.42F, needle_width = 0.06F;
// How far the sides of a leaf stand up from its midrib, and its tip hangs, as shares of the length.
constexpr float fold = 0.09F, droop = 0.08F;

/// Adds a part, given by a frame in the leaf's own space, and gives it a normal by its faces.
class Builder {
 public:
  std::uint32_t point(const glm::vec3& position, glm::vec2 uv) {
    out.position.push_back(position);
    out.normal.emplace_back(0);
    out.uv.push_back(uv);
    return static_cast<std::uint32_t>(out.position.size() - 1);
  }
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3 normal = glm::cross(out.position[b] - out.position[a], out.position[c] - out.position[a]);
    for (const std::uint32_t corner : {a, b, c}) {
      out.index.push_back(corner);
      out.normal[corner] += normal;
    }
  }
  LeafTemplate take() {
    for (glm::vec3& normal : out.normal) normal = math::unit(normal, glm::vec3{0, 0, 1});
    return std::move(out);
  }
  LeafTemplate out;
};

glm::vec2 picture(const glm::vec3& p) { return {p.x + 0.5F, 1 - p.y}; }

void add_kite(Builder& builder, const glm::vec3& base, const glm::vec3& along, const glm::vec3& aside,
              const glm::vec3& up) {
  const auto at = [&](float x, float y, float z, glm::vec2 uv) {
    return builder.point(base + aside * x + along * y + up * z, uv);
  };
  const std::uint32_t foot = at(0, 0, 0, {0.5F, 1}), right = at(0.5F, 0.45F, fold, {1, 0.55F}),
                      tip = at(0, 1, -droop, {0.5F, 0}), left = at(-0.5F, 0.45F, fold, {0, 0.55F});
  builder.face(foot, right, tip);
  builder.face(foot, tip, left);
}

LeafTemplate kite() {
  Builder builder;
  add_kite(builder, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  return builder.take();
}

LeafTemplate blade() {
  Builder builder;
  struct Row {
    float y, half, bend;
  };
  constexpr Row rows[] = {{0.3F, 0.42F, 0.02F}, {0.55F, 0.5F, 0.015F}, {0.82F, 0.26F, -0.03F}};
  const auto put = [&](float x, float y, float z) {
    const glm::vec3 p{x, y, z};
    return builder.point(p, picture(p));
  };
  const std::uint32_t foot = put(0, 0, 0);
  std::uint32_t right = foot, middle = foot, left = foot;
  for (const Row& row : rows) {
    const std::uint32_t r = put(row.half, row.y, row.bend + fold), m = put(0, row.y, row.bend),
                        l = put(-row.half, row.y, row.bend + fold);
    if (middle == foot) {
      builder.face(foot, r, m);
      builder.face(foot, m, l);
    } else {
      builder.face(middle, right, r);
      builder.face(middle, r, m);
      builder.face(middle, m, l);
      builder.face(middle, l, left);
    }
    right = r;
    middle = m;
    left = l;
  }
  const std::uint32_t tip = put(0, 1, -droop);
  builder.face(middle, right, tip);
  builder.face(middle, tip, left);
  return builder.take();
}

LeafTemplate twig() {
  Builder builder;
  for (int i = 0; i < twig_leaves; ++i) {
    const bool is_last = i + 1 == twig_leaves;
    const double side = i % 2 ? 1 : -1;
    const float y = 0.08F + 0.5F * static_cast<float>(i) / (twig_leaves - 1);
    const math::SinCos out = math::sincos_degrees(is_last ? 0 : side * (62 - 4 * i));
    const math::SinCos lift = math::sincos_degrees(i % 3 == 0 ? 24 : i % 3 == 1 ? -14 : 6);
    const glm::vec3 flat{static_cast<float>(out.sin), static_cast<float>(out.cos), 0};
    const glm::vec3 along =
        flat * static_cast<float>(lift.cos) + glm::vec3{0, 0, static_cast<float>(lift.sin)};
    const glm::vec3 aside = math::unit(glm::cross(along, glm::vec3{0, 0, 1}), glm::vec3{1, 0, 0});
    add_kite(builder, {0, y, 0}, along * twig_leaf_length, aside * (twig_leaf_width),
             glm::cross(aside, along) * twig_leaf_length);
  }
  return builder.take();
}

LeafTemplate needle() {
  Builder builder;
  for (int i = 0; i < needles; ++i) {
    const math::SinCos around = math::sincos_degrees(137.5 * i), out = math::sincos_degrees(52);
    const glm::vec3 radial{static_cast<float>(around.cos), 0, static_cast<float>(around.sin)};
    const glm::vec3 aside{static_cast<float>(-around.sin), 0, static_cast<float>(around.cos)};
    const glm::vec3 along =
        radial * static_cast<float>(out.sin) + glm::vec3{0, static_cast<float>(out.cos), 0};
    const glm::vec3 base{0, 0.6F * static_cast<float>(i) / (needles - 1), 0};
    const std::uint32_t right = builder.point(base + aside * (-0.5F * needle_width), {0, 1}),
                        left = builder.point(base + aside * (0.5F * needle_width), {1, 1}),
                        tip = builder.point(base + along * needle_length, {0.5F, 0});
    builder.face(right, left, tip);
  }
  return builder.take();
}

void add_card(Builder& builder, const glm::vec3& across) {
  const std::uint32_t a = builder.point(across * -0.5F, {0, 1}), b = builder.point(across * 0.5F, {1, 1}),
                      c = builder.point(across * 0.5F + glm::vec3{0, 1, 0}, {1, 0}),
                      d = builder.point(across * -0.5F + glm::vec3{0, 1, 0}, {0, 0});
  builder.face(a, b, c);
  builder.face(a, c, d);
}

LeafTemplate card(bool is_cross) {
  Builder builder;
  add_card(builder, {1, 0, 0});
  if (is_cross) add_card(builder, {0, 0, -1});
  return builder.take();
}

/// The product of two scales below which the shape's smallest triangle has no area, as strict readers reckon
/// it: a share of the squared diagonal of all.
float least_scale_product(std::span<const Organ> leaves, float size, const LeafTemplate& shape) {
  glm::vec3 low{1e30F}, high{-1e30F};
  float longest = 0;
  for (const Organ& leaf : leaves) {
    low = glm::min(low, leaf.position);
    high = glm::max(high, leaf.position);
    longest = std::max({longest, leaf.scale.x, leaf.scale.y, leaf.scale.z});
  }
  const glm::vec3 extent = high - low + 2 * size * longest;
  float smallest = 1;
  for (std::size_t t = 0; t < shape.index.size(); t += 3) {
    const glm::vec3& a = shape.position[shape.index[t]];
    const glm::vec3 normal =
        glm::cross(shape.position[shape.index[t + 1]] - a, shape.position[shape.index[t + 2]] - a);
    smallest = std::min(smallest, 0.5F * std::sqrt(glm::dot(normal, normal)));
  }
  return 4e-12F * glm::dot(extent, extent) / smallest;
}

double hash_unit(std::uint64_t key, std::uint64_t what) {
  return static_cast<double>(key_at(key, what) >> 11U) * 0x1p-53;
}

}  // namespace

LeafTemplate leaf_template(LeafForm form) {
  switch (form) {
    case LeafForm::kite:
      return kite();
    case LeafForm::blade:
      return blade();
    case LeafForm::twig:
      return twig();
    case LeafForm::needle:
      return needle();
    case LeafForm::card:
      return card(false);
    case LeafForm::cross:
      return card(true);
  }
  return kite();
}

Mesh foliage(std::span<const Organ> leaves, const LeafTemplate& shape, const FoliageOptions& options,
             Job& job) {
  Mesh mesh;
  Array<std::uint32_t> drawn(job);
  const float size = options.size * static_cast<float>(1 / std::sqrt(std::clamp(options.density, 1e-3, 1.0)));
  const float least = least_scale_product(leaves, size, shape);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const glm::vec3& scale = leaves[i].scale;
    if (std::min({scale.x * scale.y, scale.x * scale.z, scale.y * scale.z}) * size * size <= least) continue;
    if (options.density >= 1 || hash_unit(leaves[i].key, 0xDE45) < options.density)
      drawn.push_back(static_cast<std::uint32_t>(i));
  }
  if (drawn.empty()) return mesh;
  const std::size_t corners = shape.position.size(), count = drawn.size();
  job.spend(Resource::triangles, count * shape.index.size() / 3);
  if (count * corners > 0xFFFFFFFEU)
    Job::refuse("The leaves have more vertices than 32-bit indices can name.");
  mesh.position = Array<glm::vec3>(job, count * corners);
  mesh.normal = Array<glm::vec3>(job, count * corners);
  mesh.uv[0] = Array<glm::vec2>(job, count * corners);
  if (options.tint > 0) mesh.color = Array<glm::u8vec4>(job, count * corners);
  mesh.index.wide = Array<std::uint32_t>(job, count * shape.index.size());
  mesh.cache_ordered = true;
  glm::vec3 low{1e30F}, high{-1e30F};
  for (const std::uint32_t i : drawn) {
    low = glm::min(low, leaves[i].position);
    high = glm::max(high, leaves[i].position);
  }
  // A little below the middle, so that the lowest leaves do not look straight down.
  glm::vec3 middle = 0.5F * (low + high);
  middle.y -= 0.2F * (high.y - low.y);
  parallel_for(job, count, chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t k = begin; k < end; ++k) {
      const Organ& leaf = leaves[drawn[k]];
      const glm::mat3 turn = glm::mat3_cast(leaf.frame);
      const glm::mat3 place{turn[0] * (leaf.scale.x * size), turn[1] * (leaf.scale.y * size),
                            turn[2] * (leaf.scale.z * size)};
      const glm::vec3 outward = math::unit(leaf.position - middle, glm::vec3{0, 1, 0});
      const auto shade = static_cast<std::uint8_t>(
          255 - math::to_int32(255 * static_cast<double>(options.tint) * hash_unit(leaf.key, 0x7147)));
      const std::size_t first = k * corners;
      for (std::size_t c = 0; c < corners; ++c) {
        mesh.position[first + c] = leaf.position + place * shape.position[c] + 0.0F;
        glm::vec3 normal = turn * shape.normal[c];
        if (options.crown > 0) normal += (outward - normal) * options.crown;
        mesh.normal[first + c] = math::unit(normal, turn[2]) + 0.0F;
        mesh.uv[0][first + c] = shape.uv[c];
        if (options.tint > 0) mesh.color[first + c] = {shade, shade, shade, 255};
      }
      std::uint32_t* out = mesh.index.wide.data() + k * shape.index.size();
      for (const std::uint32_t index : shape.index) *out++ = static_cast<std::uint32_t>(first) + index;
    }
  });
  return mesh;
}

}  // namespace seedmesh

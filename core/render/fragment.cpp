#include "core/render/fragment.h"

#include "core/base/quick_math.h"

namespace seedmesh::render {

/// Texels::at() in single precision.
static glm::u16vec4 texel_of(const texture::Texels::Level& level, const glm::vec2& at, bool repeat) {
  const auto place = [repeat](float share, std::uint32_t size) {
    const float inside = repeat ? share - std::floor(share) : std::clamp(share, 0.0F, 1.0F);
    return std::min(static_cast<std::uint32_t>(static_cast<std::int32_t>(inside * static_cast<float>(size))),
                    size - 1);
  };
  return level.texels[std::size_t{place(at.y, level.height)} * level.width + place(at.x, level.width)];
}

/// The mean of the four texels around a position, by distance. For textures that are larger in the picture than
/// they are: single texels would show as squares.
static glm::vec4 blended(const texture::Texels::Level& level, const glm::vec2& at, bool repeat) {
  struct Pair {
    std::uint32_t low, high;
    float share;  ///< of the high one
  };
  const auto pair_of = [repeat](float share, std::uint32_t size) {
    const float inside = repeat ? share - std::floor(share) : std::clamp(share, 0.0F, 1.0F);
    const float place = inside * static_cast<float>(size) - 0.5F, whole = std::floor(place);
    const auto low = static_cast<std::int32_t>(whole), last = static_cast<std::int32_t>(size) - 1;
    const auto kept = [&](std::int32_t i) {
      if (i < 0) return static_cast<std::uint32_t>(repeat ? last : 0);
      if (i > last) return static_cast<std::uint32_t>(repeat ? 0 : last);
      return static_cast<std::uint32_t>(i);
    };
    return Pair{kept(low), kept(low + 1), place - whole};
  };
  const Pair x = pair_of(at.x, level.width), y = pair_of(at.y, level.height);
  const auto row = [&](std::uint32_t number) {
    const glm::u16vec4* const texels = &level.texels[std::size_t{number} * level.width];
    return glm::vec4(texels[x.low]) * (1 - x.share) + glm::vec4(texels[x.high]) * x.share;
  };
  return row(y.low) * (1 - y.share) + row(y.high) * y.share;
}

void FragmentReader::take_drawing(std::uint32_t drawing) {
  drawing_ = drawing;
  number_ = ~0U;
  of_ = &shown_.scene.drawings[drawing];
  surface_ = &shown_.scene.surfaces[of_->surface];
  uv_ = uv_of(*of_->mesh, *surface_);
  if (shown_.vertices.empty()) lens_ = shown_.lens_of(*of_);
  const glm::mat4& at = shown_.scene.items.list[of_->item].at;
  // Of a transform that stretches along its axes, normals shrink there.
  turn_ = glm::mat3(at);
  for (int axis = 0; axis < 3; ++axis) turn_[axis] /= std::max(glm::dot(turn_[axis], turn_[axis]), 1e-30F);
  mirrored_ = is_mirrored(at);
}

void FragmentReader::take_triangle(std::uint32_t number) {
  number_ = number;
  const Mesh& mesh = *of_->mesh;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = mesh.index.at(std::size_t{3} * number + i);
    corner_[i] = shown_.vertex(*of_, lens_, vertex);
    normal_[i] = mesh.normal.empty() ? glm::vec3(0) : mesh.normal[vertex];
    color_[i] = surface_->color;
    if (!mesh.color.empty()) color_[i] *= glm::vec3(glm::u8vec3(mesh.color[vertex])) * (1 / 255.0F);
    if (uv_) at_[i] = (*uv_)[vertex];
  }
  const auto area = static_cast<double>(
      (std::int64_t{corner_[1].x} - corner_[0].x) * (std::int64_t{corner_[2].y} - corner_[0].y) -
      (std::int64_t{corner_[1].y} - corner_[0].y) * (std::int64_t{corner_[2].x} - corner_[0].x));
  per_area_ = 1 / area;
  if (uv_) texels_ = texels_of_sample(*surface_->texels, at_, per_area_);
  const bool from_behind = (area > 0) != mirrored_;  // rows run downwards
  for (glm::vec3& normal : normal_) normal = turn_ * (from_behind ? -normal : normal);
}

Fragment FragmentReader::thin(std::uint32_t vertex) const {
  Fragment out;
  out.near = shown_.vertex(*of_, lens_, vertex).depth;
  out.surface = of_->surface;
  out.color = surface_->color;
  if (!of_->mesh->color.empty()) out.color *= glm::vec3(glm::u8vec3(of_->mesh->color[vertex])) * (1 / 255.0F);
  return out;
}

Fragment FragmentReader::at(std::uint32_t drawing, std::uint32_t number, float x, float y, float samples) {
  if (drawing != drawing_) take_drawing(drawing);
  if (of_->mesh->topology != Topology::triangles) return thin(number);
  if (number != number_) take_triangle(number);
  const auto weight = [&](const Projected& a, const Projected& b) {
    const double e = static_cast<double>(b.x - a.x) * (static_cast<double>(y) - a.y) -
                     static_cast<double>(b.y - a.y) * (static_cast<double>(x) - a.x);
    return static_cast<float>(e * per_area_);
  };
  const float u = weight(corner_[1], corner_[2]) * corner_[0].depth,
              v = weight(corner_[2], corner_[0]) * corner_[1].depth,
              w = weight(corner_[0], corner_[1]) * corner_[2].depth;
  Fragment out;
  out.near = (u + v) + w;
  out.surface = of_->surface;
  out.alpha = surface_->alpha;
  const float distance = 1 / out.near, a = u * distance, b = v * distance, c = w * distance;
  out.color = (color_[0] * a + color_[1] * b) + color_[2] * c;
  if (uv_) {
    const glm::vec2 place = (at_[0] * a + at_[1] * b) + at_[2] * c;
    const std::size_t level = surface_->texels->level_of(texels_ * static_cast<double>(samples));
    const texture::Texels::Level& texels = surface_->texels->level(level);
    // Empty texels of cut-out textures have no colour.
    const bool is_magnified = level == 0 && !surface_->texels->has_holes();
    const glm::vec4 texel = is_magnified ? blended(texels, place, surface_->repeat)
                                         : glm::vec4(texel_of(texels, place, surface_->repeat));
    out.color *= glm::vec3(texel) * (1 / 65'535.0F);
    out.alpha *= texel.w * (1 / 65'535.0F);
  }
  if (!of_->mesh->normal.empty())
    out.normal = math::quick_unit((normal_[0] * a + normal_[1] * b) + normal_[2] * c, glm::vec3(0, 1, 0));
  return out;
}

}  // namespace seedmesh::render

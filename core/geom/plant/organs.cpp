#include "core/geom/plant/organs.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/base/wide.h"
#include "core/geom/mesh/negative_zero.h"
#include "core/geom/plant/organ_block.h"
#include "core/geom/plant/organ_groups.h"
#include "core/geom/plant/organ_tangents.h"
#include "core/geom/plant/tube_formulas.h"
#include "core/model/index_width.h"

namespace seedmesh {
namespace {

constexpr std::size_t organs_a_chunk = 64;

SEEDMESH_WIDE void shift(const std::uint32_t* from, std::size_t count, std::uint32_t by,
                         std::uint32_t* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = from[i] + by;
}

/// Writes the vertices and triangles of organs.
class Placer {
 public:
  Placer(const Mesh& surface, const FoliageOptions& options, Mesh& out, const Job& job)
      : surface_(surface), options_(options), out_(out), job_(job) {
    if (options.tangents && surface.tangent.empty()) axes_ = texture_axes(surface);
    for (std::size_t k = 0; k < organ_lanes; ++k) {
      uv_.insert(uv_.end(), surface.uv[0].begin(), surface.uv[0].end());
      for (const std::uint32_t corner : surface.index.wide)
        index_.push_back(corner + static_cast<std::uint32_t>(k * surface.position.size()));
    }
  }

  /// Organs `numbers[begin]` to `numbers[end - 1]` of `organs`.
  void place_all(const Array<Organ>& organs, std::span<const std::uint32_t> numbers, std::size_t begin,
                 std::size_t end) const {
    OrganBlock block(surface_, options_, axes_, job_);
    const std::size_t vertices = surface_.position.size();
    for (std::size_t i = begin; i < end; i += organ_lanes) {
      const std::size_t count = std::min(organ_lanes, end - i);
      block.place(organs, numbers.subspan(i, count));
      block.write(count, out_.position.data() + i * vertices, out_.normal.data() + i * vertices,
                  out_.tangent.empty() ? nullptr : out_.tangent.data() + i * vertices);
      place_copies(i, count);
      place_rest(organs, numbers.subspan(i, count), i * vertices);
    }
    const std::size_t first = begin * vertices, count = (end - begin) * vertices;
    clear_minus_zeros(out_.position, first, count);
    clear_minus_zeros(out_.normal, first, count);
    clear_minus_zeros(out_.uv[0], first, count);
    clear_minus_zeros(out_.tangent, first, count);
  }

 private:
  /// What is the same for all organs; up to organ_lanes organs.
  void place_copies(std::size_t first, std::size_t count) const {
    const std::size_t vertices = surface_.position.size(), corners = surface_.index.wide.size();
    if (!uv_.empty())
      std::memcpy(out_.uv[0].data() + first * vertices, uv_.data(), count * vertices * sizeof(glm::vec2));
    shift(index_.data(), count * corners, static_cast<std::uint32_t>(first * vertices),
          out_.index.wide.data() + first * corners);
  }

  /// Colours, bones and wind weights.
  void place_rest(const Array<Organ>& organs, std::span<const std::uint32_t> numbers,
                  std::size_t first) const {
    const std::size_t vertices = surface_.position.size();
    const bool is_plain = !out_.color.empty() && surface_.color.empty();
    if (is_plain) place_plain(organs, numbers, out_.color.data() + first);
    if ((out_.color.empty() || is_plain) && out_.bone.empty() && !options_.wind) return;
    for (const std::uint32_t number : numbers) {
      const Organ& organ = organs[number];
      if (!out_.color.empty() && !is_plain) place_colors(organ, first);
      if (!out_.bone.empty()) std::fill_n(out_.bone.data() + first, vertices, bone_of(organ));
      if (options_.wind) place_wind(organ, first);
      first += vertices;
    }
  }

  std::uint16_t bone_of(const Organ& organ) const {
    return organ.limb_joint == Limbs::none ? std::uint16_t{0} : options_.bones[organ.limb_joint];
  }

  float shade_of(const Organ& organ) const {
    return 1.0F - options_.tint * fraction_of(key_at(organ.key, 0x7147));
  }

  std::uint32_t word_of(const Organ& organ) const {
    if (options_.shade) return options_.shade->color_of(organ);
    return 0xFF000000U | static_cast<std::uint8_t>(255.0F * shade_of(organ)) * 0x010101U;
  }

  /// For surfaces without colours: one colour for all vertices of an organ.
  void place_plain(const Array<Organ>& organs, std::span<const std::uint32_t> numbers,
                   glm::u8vec4* to) const {
    constexpr std::size_t together = 4;
    const std::size_t vertices = surface_.position.size(), rest = vertices % together;
    for (const std::uint32_t number : numbers) {
      // Written as words: bytes are slower.
      const std::uint32_t color = word_of(organs[number]);
      static_assert(sizeof(color) == sizeof(glm::u8vec4) && std::endian::native == std::endian::little);
      const std::uint32_t colors[together] = {color, color, color, color};
      glm::u8vec4* const end = to + (vertices - rest);
      for (; to != end; to += together) std::memcpy(static_cast<void*>(to), colors, sizeof(colors));
      for (std::size_t i = 0; i < rest; ++i) std::memcpy(static_cast<void*>(to++), &color, sizeof(color));
    }
  }

  void place_colors(const Organ& organ, std::size_t first) const {
    const float shade = shade_of(organ);
    const auto dimmed = [&](std::uint8_t value) {
      return static_cast<std::uint8_t>(static_cast<float>(value) * shade);
    };
    for (std::size_t i = 0; i < surface_.position.size(); ++i) {
      const glm::u8vec4 own = surface_.color[i];
      out_.color[first + i] = {dimmed(own.r), dimmed(own.g), dimmed(own.b), own.a};
    }
  }

  /// An organ moves as a whole with the limb at its base. Its own flutter increases from its base to its tip.
  void place_wind(const Organ& organ, std::size_t first) const {
    const glm::vec2 sway = options_.wind->at(organ.limb_joint, organ.position);
    for (std::size_t i = 0; i < surface_.position.size(); ++i) {
      out_.uv[2][first + i] = {options_.wind->trunk_bend(organ.position.y), sway.x};
      out_.uv[3][first + i] = {sway.y, std::clamp(surface_.position[i].y, 0.0F, 1.0F)};
    }
  }

  const Mesh& surface_;
  const FoliageOptions& options_;
  Mesh& out_;
  const Job& job_;
  std::vector<glm::vec2> uv_;         ///< of organ_lanes organs
  std::vector<std::uint32_t> index_;  ///< of organ_lanes organs
  std::vector<TextureAxes> axes_;     ///< of each vertex of the surface, where tangents are made
};

Mesh room_for(const Mesh& surface, std::size_t count, const FoliageOptions& options, Job& job) {
  const std::uint64_t vertices = std::uint64_t{surface.position.size()} * count;
  check_vertex_count(job, vertices, "The organs");
  job.spend(Resource::triangles, surface.index.wide.size() / 3 * count);
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, vertices);
  mesh.normal = Array<glm::vec3>(job, vertices);
  if (!surface.uv[0].empty()) mesh.uv[0] = Array<glm::vec2>(job, vertices);
  if (options.tangents || !surface.tangent.empty()) mesh.tangent = Array<glm::vec4>(job, vertices);
  if (options.tint > 0 || options.shade || !surface.color.empty())
    mesh.color = Array<glm::u8vec4>(job, vertices);
  if (!options.bones.empty()) mesh.bone = Array<std::uint16_t>(job, vertices);
  if (options.wind) {
    for (const std::size_t set : {2U, 3U}) mesh.uv[set] = Array<glm::vec2>(job, vertices);
  }
  mesh.index.wide = Array<std::uint32_t>(job, surface.index.wide.size() * count);
  mesh.cache_ordered = surface.cache_ordered;
  mesh.no_minus_zero = true;
  return mesh;
}

}  // namespace

std::vector<Foliage> place_organs(const Organs& organs, const FoliageOptions& options, Job& job) {
  std::vector<Foliage> foliage;
  for (const OrganGroup& group : organ_groups(organs, options, job)) {
    const Mesh& surface = options.surfaces[group.surface];
    foliage.push_back({group.surface, group.color, room_for(surface, group.organs.size(), options, job)});
    const Placer placer(surface, options, foliage.back().mesh, job);
    parallel_for(job, group.organs.size(), organs_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   job.check();
                   placer.place_all(organs.organ, group.organs, begin, end);
                 });
  }
  return foliage;
}

std::vector<FoliageInstances> organ_transforms(const Organs& organs, const FoliageOptions& options,
                                               Job& job) {
  std::vector<FoliageInstances> all;
  for (const OrganGroup& group : organ_groups(organs, options, job)) {
    const Mesh& surface = options.surfaces[group.surface];
    job.spend(Resource::triangles, surface.index.wide.size() / 3 * group.organs.size());
    FoliageInstances instances{group.surface, group.color, {}};
    for (const std::uint32_t i : group.organs) {
      const Organ& organ = organs.organ[i];
      instances.transforms.push_back({organ.position, organ.frame, organ.scale});
    }
    all.push_back(std::move(instances));
  }
  return all;
}

}  // namespace seedmesh

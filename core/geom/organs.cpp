#include "core/geom/organs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/base/rng.h"
#include "core/base/wide.h"
#include "core/geom/minus_zero.h"
#include "core/geom/organ_block.h"
#include "core/geom/organ_groups.h"
#include "core/geom/organ_tangents.h"
#include "core/geom/tangents.h"

namespace seedmesh {
namespace {

constexpr std::size_t organs_a_chunk = 64;

SEEDMESH_WIDE void shift(const std::uint32_t* from, std::size_t count, std::uint32_t by,
                         std::uint32_t* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = from[i] + by;
}

glm::vec3 unit_of(const glm::vec3& v, const glm::vec3& otherwise) {
  std::uint32_t fault = 0;
  const glm::vec3 unit = organ_unit(v, fault);
  return fault == 0 ? unit : math::unit(v, otherwise);
}

/// Writes organs' vertices and triangles at their places.
class Placer {
 public:
  Placer(const Mesh& surface, const FoliageOptions& options, Mesh& out)
      : surface_(surface),
        options_(options),
        out_(out),
        in_blocks_(OrganBlock::takes(surface)),
        together_(in_blocks_ ? organ_lanes : 1) {
    if (options.tangents && surface.tangent.empty()) sides_ = picture_sides(surface);
    for (std::size_t k = 0; k < together_; ++k) {
      uv_.insert(uv_.end(), surface.uv[0].begin(), surface.uv[0].end());
      for (const std::uint32_t corner : surface.index.wide)
        index_.push_back(corner + static_cast<std::uint32_t>(k * surface.position.size()));
    }
  }

  /// Organs `numbers[begin]` to `numbers[end - 1]` of `organs`.
  void place_all(const Array<Organ>& organs, std::span<const std::uint32_t> numbers, std::size_t begin,
                 std::size_t end) const {
    OrganBlock block(surface_, options_, sides_);
    const std::size_t vertices = surface_.position.size();
    for (std::size_t i = begin; i < end; i += together_) {
      const std::size_t count = std::min(together_, end - i);
      if (in_blocks_ && block.reckon(organs, numbers.subspan(i, count))) {
        glm::vec4* tangent = sides_.empty() ? nullptr : out_.tangent.data() + i * vertices;
        block.write(count, out_.position.data() + i * vertices, out_.normal.data() + i * vertices, tangent);
      } else {
        for (std::size_t k = i; k < i + count; ++k) place_shape(organs[numbers[k]], k * vertices);
      }
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
  /// Positions and directions.
  void place_shape(const Organ& organ, std::size_t first) const {
    const std::size_t vertices = surface_.position.size();
    const glm::mat3 turn = glm::mat3_cast(organ.frame);
    const glm::mat3 stretch{turn[0] * organ.scale.x, turn[1] * organ.scale.y, turn[2] * organ.scale.z};
    const glm::vec3* from = surface_.position.data();
    glm::vec3* position = out_.position.data() + first;
    for (std::size_t i = 0; i < vertices; ++i) position[i] = organ.position + stretch * from[i];
    place_normals(organ, turn, out_.normal.data() + first);
    if (!surface_.tangent.empty()) place_tangents(first, turn, stretch);
    if (options_.crown) follow_crown(position, out_.normal.data() + first);
    if (!sides_.empty()) place_sides(first, stretch);
  }

  /// What is the same of all organs, of up to `together_` of them.
  void place_copies(std::size_t first, std::size_t count) const {
    const std::size_t vertices = surface_.position.size(), corners = surface_.index.wide.size();
    if (!uv_.empty())
      std::memcpy(out_.uv[0].data() + first * vertices, uv_.data(), count * vertices * sizeof(glm::vec2));
    shift(index_.data(), count * corners, static_cast<std::uint32_t>(first * vertices),
          out_.index.wide.data() + first * corners);
  }

  /// All else, of `numbers` one behind another.
  void place_rest(const Array<Organ>& organs, std::span<const std::uint32_t> numbers,
                  std::size_t first) const {
    const std::size_t vertices = surface_.position.size();
    const bool is_gray = !out_.color.empty() && surface_.color.empty();
    if (is_gray) place_grays(organs, numbers, out_.color.data() + first);
    if ((out_.color.empty() || is_gray) && out_.bone.empty() && !options_.wind) return;
    for (const std::uint32_t number : numbers) {
      const Organ& organ = organs[number];
      if (!out_.color.empty() && !is_gray) place_colors(organ, first);
      if (!out_.bone.empty()) std::fill_n(out_.bone.data() + first, vertices, bone_of(organ));
      if (options_.wind) place_wind(organ, first);
      first += vertices;
    }
  }

  static float fraction(std::uint64_t hash) { return static_cast<float>(hash >> 40U) * 0x1p-24F; }

  std::uint16_t bone_of(const Organ& organ) const {
    return organ.limb_joint == Limbs::none ? std::uint16_t{0} : options_.bones[organ.limb_joint];
  }

  void place_normals(const Organ& organ, const glm::mat3& turn, glm::vec3* normal) const {
    const glm::vec3 inverse = 1.0F / organ.scale;
    const glm::vec3* from = surface_.normal.data();
    for (std::size_t i = 0; i < surface_.normal.size(); ++i) {
      if (i > 0 && from[i] == from[i - 1]) {  // flat, as most leaves are
        normal[i] = normal[i - 1];
        continue;
      }
      normal[i] = unit_of(turn * (from[i] * inverse), {0, 1, 0});
    }
  }

  float shade_of(const Organ& organ) const {
    return 1.0F - options_.tint * fraction(key_at(organ.key, 0x7147));
  }

  /// Of surfaces without colours: one gray for all vertices of an organ.
  void place_grays(const Array<Organ>& organs, std::span<const std::uint32_t> numbers,
                   glm::u8vec4* to) const {
    constexpr std::size_t together = 4;
    const std::size_t vertices = surface_.position.size(), rest = vertices % together;
    for (const std::uint32_t number : numbers) {
      const auto gray = static_cast<std::uint8_t>(255.0F * shade_of(organs[number]));
      // As words: parts of one are slow to write.
      const std::uint32_t color = 0xFF000000U | gray * 0x010101U;
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

  void place_tangents(std::size_t first, const glm::mat3& turn, const glm::mat3& stretch) const {
    for (std::size_t i = 0; i < surface_.tangent.size(); ++i) {
      const glm::vec3 normal = out_.normal[first + i];
      const glm::vec3 along = stretch * glm::vec3(surface_.tangent[i]);
      out_.tangent[first + i] = glm::vec4(math::quick_unit(along - normal * glm::dot(along, normal), turn[0]),
                                          surface_.tangent[i].w);
    }
  }

  void place_sides(std::size_t first, const glm::mat3& stretch) const {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const glm::vec3 normal = out_.normal[first + i], u = stretch * sides_[i].u;
      const glm::vec3 across = glm::cross(u, stretch * sides_[i].v);
      std::uint32_t fault = 0;
      const glm::vec4 tangent = organ_tangent(normal, u, across, fault);
      out_.tangent[first + i] = fault == 0 ? tangent : glm::vec4(any_across(normal), tangent.w);
    }
  }

  /// An organ moves whole with the limb at its base; its own flutter grows from there to its tip.
  void place_wind(const Organ& organ, std::size_t first) const {
    const glm::vec2 sway = options_.wind->at(organ.limb_joint, organ.position);
    for (std::size_t i = 0; i < surface_.position.size(); ++i) {
      out_.uv[2][first + i] = {options_.wind->trunk_bend(organ.position.y), sway.x};
      out_.uv[3][first + i] = {sway.y, std::clamp(surface_.position[i].y, 0.0F, 1.0F)};
    }
  }

  /// Vertices keep to the side of all their faces: the mean of an organ's own normal and the crown's is taken
  /// on the side where the organ's is, and only as far as no face would look away from it.
  void follow_crown(const glm::vec3* position, glm::vec3* normal) const {
    const glm::vec3 middle = *options_.crown;
    const float share = options_.crown_share;
    const std::size_t vertices = surface_.position.size();
    for (std::size_t i = 0; i < vertices; ++i) {
      const glm::vec3 own = normal[i];
      glm::vec3 outward = unit_of(position[i] - middle, own);
      if (glm::dot(outward, own) < 0) outward = -outward;
      normal[i] = unit_of(own + (outward - own) * share, own);
    }
    const std::uint32_t* corner = surface_.index.wide.data();
    for (const std::uint32_t* end = corner + surface_.index.wide.size(); corner != end; corner += 3) {
      const glm::vec3 a = position[corner[0]];
      const glm::vec3 face = unit_of(glm::cross(position[corner[1]] - a, position[corner[2]] - a), {0, 1, 0});
      for (int k = 0; k < 3; ++k) {
        glm::vec3& here = normal[corner[k]];
        const float over = glm::dot(here, face);
        if (over < organ_least_over) here = unit_of(here + face * (organ_wanted_over - over), face);
      }
    }
  }

  const Mesh& surface_;
  const FoliageOptions& options_;
  Mesh& out_;
  bool in_blocks_;
  std::size_t together_;  ///< organs
  // Of so many organs.
  std::vector<glm::vec2> uv_;
  std::vector<std::uint32_t> index_;
  std::vector<PictureSides> sides_;  ///< of each vertex, where tangents are made
};

Mesh room_for(const Mesh& surface, std::size_t count, const FoliageOptions& options, Job& job) {
  const std::uint64_t vertices = std::uint64_t{surface.position.size()} * count;
  if (vertices > 0xFFFFFFFEU) Job::refuse("the organs have more vertices than 32-bit indices can name");
  job.spend(Resource::triangles, surface.index.wide.size() / 3 * count);
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, vertices);
  mesh.normal = Array<glm::vec3>(job, vertices);
  if (!surface.uv[0].empty()) mesh.uv[0] = Array<glm::vec2>(job, vertices);
  if (options.tangents || !surface.tangent.empty()) mesh.tangent = Array<glm::vec4>(job, vertices);
  if (options.tint > 0 || !surface.color.empty()) mesh.color = Array<glm::u8vec4>(job, vertices);
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

/// The organs that one Foliage is made of, in pieces.
struct OrganPlacing::Share {
  Share(OrganGroup all, const FoliageOptions& options, Job& job)
      : group(std::move(all)),
        foliage{group.surface, group.color,
                room_for(options.surfaces[group.surface], group.organs.size(), options, job)},
        placer(options.surfaces[group.surface], options, foliage.mesh) {}
  std::size_t pieces() const { return chunk_count(group.organs.size(), organs_a_chunk); }

  OrganGroup group;
  Foliage foliage;
  Placer placer;
};

OrganPlacing::OrganPlacing(const Organs& organs, const FoliageOptions& options, Job& job)
    : organs_(organs), options_(options), job_(job) {}

OrganPlacing::~OrganPlacing() = default;

std::size_t OrganPlacing::prepare() {
  std::size_t pieces = 0;
  for (OrganGroup& group : organ_groups(organs_, options_, job_)) {
    shares_.push_back(std::make_unique<Share>(std::move(group), options_, job_));
    pieces += shares_.back()->pieces();
  }
  return pieces;
}

void OrganPlacing::place(std::size_t piece) const {
  job_.check();
  auto share = shares_.begin();
  for (; piece >= (*share)->pieces(); ++share) piece -= (*share)->pieces();
  const std::vector<std::uint32_t>& numbers = (*share)->group.organs;
  const std::size_t begin = piece * organs_a_chunk;
  (*share)->placer.place_all(organs_.organ, numbers, begin, std::min(numbers.size(), begin + organs_a_chunk));
}

std::vector<Foliage> OrganPlacing::take() {
  std::vector<Foliage> foliage;
  for (const std::unique_ptr<Share>& share : shares_) foliage.push_back(std::move(share->foliage));
  shares_.clear();
  return foliage;
}

std::vector<Foliage> place_organs(const Organs& organs, const FoliageOptions& options, Job& job) {
  OrganPlacing placing(organs, options, job);
  parallel_for(job, placing.prepare(), 1,
               [&](std::size_t piece, std::size_t, std::size_t) { placing.place(piece); });
  return placing.take();
}

std::vector<FoliagePlaces> organ_places(const Organs& organs, const FoliageOptions& options, Job& job) {
  std::vector<FoliagePlaces> all;
  for (const OrganGroup& group : organ_groups(organs, options, job)) {
    const Mesh& surface = options.surfaces[group.surface];
    job.spend(Resource::triangles, surface.index.wide.size() / 3 * group.organs.size());
    FoliagePlaces places{group.surface, group.color, {}};
    for (const std::uint32_t i : group.organs) {
      const Organ& organ = organs.organ[i];
      places.places.push_back({organ.position, organ.frame, organ.scale});
    }
    all.push_back(std::move(places));
  }
  return all;
}

}  // namespace seedmesh

#include "core/geom/organs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/base/rng.h"
#include "core/base/wide.h"
#include "core/geom/organ_block.h"
#include "core/geom/organ_tangents.h"
#include "core/geom/tangents.h"

namespace seedmesh {
namespace {

constexpr std::size_t organs_a_chunk = 512;
constexpr std::size_t bits_an_organ = 16;  // there are fewer than 2^28
constexpr float least_share = 2e-4F;       // of the model's size
constexpr float least_extent = 1e-9F;

/// Organs of one surface and colour, in their order.
struct Group {
  std::uint32_t surface;
  std::int16_t color;
  std::vector<std::uint32_t> organs;
};

/// Hashes seen so far, in a table with open addresses.
class Seen {
 public:
  Seen(std::size_t most, const Job& job) {
    std::size_t size = 16;
    while (size < 2 * most) size *= 2;
    table_ = Array<std::uint64_t>(job, size, std::uint64_t{0});
  }
  /// False: it was there before.
  bool insert(std::uint64_t hash) {
    hash += hash == 0 ? 1 : 0;
    std::size_t at = hash & (table_.size() - 1);
    for (; table_[at] != 0; at = (at + 1) & (table_.size() - 1)) {
      if (table_[at] == hash) return false;
    }
    table_[at] = hash;
    return true;
  }

 private:
  Array<std::uint64_t> table_;
};

std::uint64_t word_of(float a, float b) {
  std::uint32_t words[2];
  std::memcpy(words, &a, sizeof(a));
  std::memcpy(words + 1, &b, sizeof(b));
  return words[0] | std::uint64_t{words[1]} << 32U;
}

/// Of all that places an organ.
std::uint64_t place_of(const Organ& organ) {
  std::uint64_t hash = mix(word_of(organ.position.x, organ.position.y) + organ.surface);
  hash = mix(hash ^ word_of(organ.position.z, organ.frame.w));
  hash = mix(hash ^ word_of(organ.frame.x, organ.frame.y));
  hash = mix(hash ^ word_of(organ.frame.z, organ.scale.x));
  return mix(hash ^ word_of(organ.scale.y, organ.scale.z));
}

/// Tells which organs may stand where another does: those whose places have one bit in common of a table.
class Crossroads {
 public:
  Crossroads(const Organs& organs, const Job& job) : bit_(job, organs.organ.size()) {
    std::size_t size = 1024;
    while (size < bits_an_organ * organs.organ.size()) size *= 2;
    Array<std::uint64_t> taken(job, size / 64, std::uint64_t{0});
    shared_ = Array<std::uint64_t>(job, size / 64, std::uint64_t{0});
    for (std::size_t i = 0; i < bit_.size(); ++i) {
      const glm::vec3& at = organs.organ[i].position;
      const std::uint64_t bit = mix(word_of(at.x, at.y) ^ word_of(at.z, 0) << 7U) & (size - 1);
      bit_[i] = static_cast<std::uint32_t>(bit);
      const std::uint64_t flag = std::uint64_t{1} << bit % 64, met = taken[bit / 64] & flag;
      taken[bit / 64] |= flag;
      if (met == 0) continue;
      shared_[bit / 64] |= flag;
      ++met_;
    }
  }
  bool is_shared(std::size_t organ) const {
    return (shared_[bit_[organ] / 64] >> bit_[organ] % 64 & 1U) != 0;
  }
  /// At least as many as they are.
  std::size_t most() const { return 2 * met_; }

 private:
  Array<std::uint32_t> bit_;  ///< of each organ
  Array<std::uint64_t> shared_;
  std::size_t met_ = 0;  ///< that came where one was
};

std::vector<Group> groups_of(const Organs& organs, const FoliageOptions& options, const Job& job) {
  std::map<std::pair<std::uint32_t, std::int16_t>, std::vector<std::uint32_t>> by_look;
  const Crossroads crossroads(organs, job);
  Seen seen(crossroads.most(), job);
  std::vector<float> extents;
  for (const Mesh& surface : options.surfaces) {
    const Box box = bounds_of(surface.position.span());
    const glm::vec3 extent = box.max - box.min;
    extents.push_back(std::max({extent.x, extent.y, extent.z}));
  }
  const float least = std::max(least_share * options.model_size, least_extent);
  const std::size_t count = organs.organ.size();
  std::uint32_t surface = 0;
  std::int16_t color = 0;
  std::vector<std::uint32_t>* members = nullptr;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) job.check();
    const Organ& organ = organs.organ[i];
    const float smallest = std::min({organ.scale.x, organ.scale.y, organ.scale.z}) * extents[organ.surface];
    if (!(smallest > least)) continue;
    if (crossroads.is_shared(i) && !seen.insert(place_of(organ))) continue;
    if (!members || surface != organ.surface || color != organ.color) {
      surface = organ.surface;
      color = organ.color;
      members = &by_look[{surface, color}];
      if (by_look.size() == 1) members->reserve(count);
    }
    members->push_back(i);
  }
  std::vector<Group> groups;
  for (auto& [key, list] : by_look) groups.push_back({key.first, key.second, std::move(list)});
  return groups;
}

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
  return mesh;
}

}  // namespace

std::vector<Foliage> place_organs(const Organs& organs, const FoliageOptions& options, Job& job) {
  std::vector<Foliage> foliage;
  for (const Group& group : groups_of(organs, options, job)) {
    const Mesh& surface = options.surfaces[group.surface];
    foliage.push_back({group.surface, group.color, room_for(surface, group.organs.size(), options, job)});
    const Placer placer(surface, options, foliage.back().mesh);
    parallel_for(job, group.organs.size(), organs_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   job.check();
                   placer.place_all(organs.organ, group.organs, begin, end);
                 });
  }
  return foliage;
}

std::vector<FoliagePlaces> organ_places(const Organs& organs, const FoliageOptions& options, Job& job) {
  std::vector<FoliagePlaces> all;
  for (const Group& group : groups_of(organs, options, job)) {
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

#include "core/geom/organ_block.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/wide.h"
#include "core/geom/four.h"

namespace seedmesh {
namespace {

using Lanes3 = OrganLanes3;
using Lanes4 = OrganLanes4;
constexpr std::size_t lanes = organ_lanes;
constexpr float least_over = organ_least_over, wanted_over = organ_wanted_over;
// They are written as rows, one behind another.
static_assert(sizeof(Lanes3) == 3 * lanes * sizeof(float) && sizeof(Lanes4) == 4 * lanes * sizeof(float));

/// Of each lane, not 0 where a vector had no direction.
using Faults = std::uint32_t[lanes];

/// The columns of the rotation of each lane (as glm::mat3_cast makes it), the same stretched, and what each
/// coordinate of a normal is multiplied with before it is turned.
struct Turns {
  Lanes3 turn[3], stretch[3], inverse;
};

glm::vec3 product(const Lanes3 (&m)[3], std::size_t l, const glm::vec3& v) {
  return {m[0].x[l] * v.x + m[1].x[l] * v.y + m[2].x[l] * v.z,
          m[0].y[l] * v.x + m[1].y[l] * v.y + m[2].y[l] * v.z,
          m[0].z[l] * v.x + m[1].z[l] * v.y + m[2].z[l] * v.z};
}

glm::vec3 cross_of(const glm::vec3& a, const glm::vec3& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

glm::vec3 at(const Lanes3& from, std::size_t l) { return {from.x[l], from.y[l], from.z[l]}; }

void put(Lanes3& __restrict out, std::size_t l, const glm::vec3& v) {
  out.x[l] = v.x;
  out.y[l] = v.y;
  out.z[l] = v.z;
}

SEEDMESH_WIDE void turns_of(const float (&q)[4][lanes], const Lanes3& scale, Turns& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const float x = q[0][l], y = q[1][l], z = q[2][l], w = q[3][l];
    const glm::vec3 columns[3] = {
        {1.0F - 2.0F * (y * y + z * z), 2.0F * (x * y + w * z), 2.0F * (x * z - w * y)},
        {2.0F * (x * y - w * z), 1.0F - 2.0F * (x * x + z * z), 2.0F * (y * z + w * x)},
        {2.0F * (x * z + w * y), 2.0F * (y * z - w * x), 1.0F - 2.0F * (x * x + y * y)}};
    const float by[3] = {scale.x[l], scale.y[l], scale.z[l]};
    for (int k = 0; k < 3; ++k) {
      put(out.turn[k], l, columns[k]);
      put(out.stretch[k], l, {columns[k].x * by[k], columns[k].y * by[k], columns[k].z * by[k]});
    }
    put(out.inverse, l, {1.0F / by[0], 1.0F / by[1], 1.0F / by[2]});
  }
}

SEEDMESH_WIDE void place_point(const Turns& turns, const Lanes3& place, const glm::vec3& from,
                               Lanes3& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 p = product(turns.stretch, l, from);
    put(out, l, {place.x[l] + p.x, place.y[l] + p.y, place.z[l] + p.z});
  }
}

SEEDMESH_WIDE void place_normal(const Turns& turns, const glm::vec3& from, Lanes3& __restrict out,
                                std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 shrunk{from.x * turns.inverse.x[l], from.y * turns.inverse.y[l],
                           from.z * turns.inverse.z[l]};
    put(out, l, organ_unit(product(turns.turn, l, shrunk), faults[l]));
  }
}

/// Where u grows, and across the picture.
SEEDMESH_WIDE void place_sides(const Turns& turns, const PictureSides& from, Lanes3& __restrict u,
                               Lanes3& __restrict across) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 along_u = product(turns.stretch, l, from.u), along_v = product(turns.stretch, l, from.v);
    put(u, l, along_u);
    put(across, l, cross_of(along_u, along_v));
  }
}

SEEDMESH_WIDE void place_tangent(const Lanes3& normal, const Lanes3& u, const Lanes3& across,
                                 Lanes4& __restrict out, std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec4 tangent = organ_tangent(at(normal, l), at(u, l), at(across, l), faults[l]);
    put(out.xyz, l, glm::vec3(tangent));
    out.w[l] = tangent.w;
  }
}

SEEDMESH_WIDE void turn_outward(const glm::vec3& middle, float share, const Lanes3& position,
                                const Lanes3& normal, Lanes3& __restrict mixed,
                                std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 own = at(normal, l);
    const glm::vec3 away{position.x[l] - middle.x, position.y[l] - middle.y, position.z[l] - middle.z};
    const glm::vec3 out = organ_unit(away, faults[l]);
    const float side = out.x * own.x + out.y * own.y + out.z * own.z < 0.0F ? -1.0F : 1.0F;
    const glm::vec3 between{own.x + (out.x * side - own.x) * share, own.y + (out.y * side - own.y) * share,
                            own.z + (out.z * side - own.z) * share};
    put(mixed, l, organ_unit(between, faults[l]));
  }
}

/// Across a face, not of length 1. False: at each lane the normals of its corners lie, with a margin, on its
/// side.
SEEDMESH_WIDE bool face_of(const Lanes3* position, const Lanes3* normal, const std::uint32_t* corner,
                           Lanes3& __restrict out) {
  const Lanes3 &a = position[corner[0]], &b = position[corner[1]], &c = position[corner[2]];
  const Lanes3 &n0 = normal[corner[0]], &n1 = normal[corner[1]], &n2 = normal[corner[2]];
  std::uint32_t any = 0;
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 across = cross_of({b.x[l] - a.x[l], b.y[l] - a.y[l], b.z[l] - a.z[l]},
                                      {c.x[l] - a.x[l], c.y[l] - a.y[l], c.z[l] - a.z[l]});
    put(out, l, across);
    const float square = across.x * across.x + across.y * across.y + across.z * across.z;
    const float least = (least_over + 1e-3F) * std::sqrt(square);
    const bool is_sound = (square > 1e-30F) &
                          (n0.x[l] * across.x + n0.y[l] * across.y + n0.z[l] * across.z > least) &
                          (n1.x[l] * across.x + n1.y[l] * across.y + n1.z[l] * across.z > least) &
                          (n2.x[l] * across.x + n2.y[l] * across.y + n2.z[l] * across.z > least);
    any |= is_sound ? 0U : 1U;
  }
  return any != 0;
}

SEEDMESH_WIDE void to_units(Lanes3& v, std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) put(v, l, organ_unit(at(v, l), faults[l]));
}

SEEDMESH_WIDE void face_forward(const Lanes3& face, Lanes3& __restrict normal,
                                std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 here{normal.x[l], normal.y[l], normal.z[l]}, f{face.x[l], face.y[l], face.z[l]};
    const float over = here.x * f.x + here.y * f.y + here.z * f.z;
    const bool is_flat = over < least_over;
    const float by = wanted_over - over;
    std::uint32_t fault = 0;
    const glm::vec3 turned = organ_unit({here.x + f.x * by, here.y + f.y * by, here.z + f.z * by}, fault);
    faults[l] |= is_flat ? fault : 0U;
    put(normal, l, {is_flat ? turned.x : here.x, is_flat ? turned.y : here.y, is_flat ? turned.z : here.z});
  }
}

using SixteenFloats = float __attribute__((vector_size(64)));
static_assert(sizeof(SixteenFloats) == lanes * sizeof(float));

/// Lane by lane all `count` >= 4 rows, one lane behind another: a matrix turned about its diagonal, in
/// squares of four by four.
SEEDMESH_WIDE void write_columns(const float* rows, std::size_t count, float* out) {
  for (std::size_t done = 0; done < count; done += Four::size) {
    const std::size_t first = std::min(done, count - Four::size);
    SixteenFloats a, b, c, d;
    std::memcpy(&a, rows + first * lanes, sizeof(a));
    std::memcpy(&b, rows + (first + 1) * lanes, sizeof(b));
    std::memcpy(&c, rows + (first + 2) * lanes, sizeof(c));
    std::memcpy(&d, rows + (first + 3) * lanes, sizeof(d));
    const SixteenFloats low = __builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28,
                                                      13, 29),
                        low2 = __builtin_shufflevector(c, d, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28,
                                                       13, 29),
                        high = __builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14,
                                                       30, 15, 31),
                        high2 = __builtin_shufflevector(c, d, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14,
                                                        30, 15, 31);
    // Lane k of every four.
    const SixteenFloats lane[4] = {
        __builtin_shufflevector(low, low2, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
        __builtin_shufflevector(low, low2, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31),
        __builtin_shufflevector(high, high2, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
        __builtin_shufflevector(high, high2, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31)};
    float* to = out + first;
    for (std::size_t k = 0; k < Four::size; ++k) {
      const FourFloats quarters[4] = {__builtin_shufflevector(lane[k], lane[k], 0, 1, 2, 3),
                                      __builtin_shufflevector(lane[k], lane[k], 4, 5, 6, 7),
                                      __builtin_shufflevector(lane[k], lane[k], 8, 9, 10, 11),
                                      __builtin_shufflevector(lane[k], lane[k], 12, 13, 14, 15)};
      for (std::size_t q = 0; q < Four::size; ++q)
        std::memcpy(to + (k + Four::size * q) * count, &quarters[q], sizeof(FourFloats));
    }
  }
}

/// The first `organs` lanes of `count` rows.
void write_rows(const float* rows, std::size_t count, std::size_t organs, float* out) {
  if (organs == lanes && count >= Four::size) return write_columns(rows, count, out);
  for (std::size_t l = 0; l < organs; ++l) {
    for (std::size_t row = 0; row < count; ++row) *out++ = rows[row * lanes + l];
  }
}

}  // namespace

bool OrganBlock::reckon(const Array<Organ>& organs, std::span<const std::uint32_t> numbers) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const Organ& organ = organs[numbers[std::min(l, numbers.size() - 1)]];
    put(place_, l, organ.position);
    put(scale_, l, organ.scale);
    quat_[0][l] = organ.frame.x;
    quat_[1][l] = organ.frame.y;
    quat_[2][l] = organ.frame.z;
    quat_[3][l] = organ.frame.w;
  }
  Turns turns;
  turns_of(quat_, scale_, turns);
  Faults faults = {};
  const std::size_t vertices = surface_.position.size();
  Lanes3 own;
  for (std::size_t i = 0; i < vertices; ++i) {
    place_point(turns, place_, surface_.position[i], position_[i]);
    if (i == 0 || surface_.normal[i] != surface_.normal[i - 1])  // flat, as most leaves are: only once
      place_normal(turns, surface_.normal[i], own, faults);
    if (options_.crown) {
      turn_outward(*options_.crown, options_.crown_share, position_[i], own, normal_[i], faults);
    } else {
      normal_[i] = own;
    }
  }
  if (options_.crown) face_outward(faults);
  Lanes3 u, across;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    if (i == 0 || sides_[i] != sides_[i - 1]) place_sides(turns, sides_[i], u, across);
    place_tangent(normal_[i], u, across, tangent_[i], faults);
  }
  return std::all_of(faults, faults + lanes, [](std::uint32_t fault) { return fault == 0; });
}

/// Normals that follow a crown stay on the side of all their faces.
void OrganBlock::face_outward(std::uint32_t* faults) {
  const std::uint32_t* corner = surface_.index.wide.data();
  for (const std::uint32_t* end = corner + surface_.index.wide.size(); corner != end; corner += 3) {
    Lanes3 face;
    if (!face_of(position_, normal_, corner, face)) continue;
    to_units(face, faults);
    for (int k = 0; k < 3; ++k) face_forward(face, normal_[corner[k]], faults);
  }
}

void OrganBlock::write(std::size_t count, glm::vec3* position, glm::vec3* normal, glm::vec4* tangent) const {
  const std::size_t vertices = surface_.position.size();
  write_rows(reinterpret_cast<const float*>(position_), 3 * vertices, count,
             reinterpret_cast<float*>(position));
  write_rows(reinterpret_cast<const float*>(normal_), 3 * vertices, count, reinterpret_cast<float*>(normal));
  if (!tangent) return;
  write_rows(reinterpret_cast<const float*>(tangent_), 4 * vertices, count,
             reinterpret_cast<float*>(tangent));
}

}  // namespace seedmesh

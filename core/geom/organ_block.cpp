#include "core/geom/organ_block.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/wide.h"
#include "core/geom/four.h"

namespace seedmesh {
namespace {

using Lanes3 = OrganLanes3;
constexpr std::size_t lanes = organ_lanes;

/// Of each lane, not 0 where a vector had no direction.
using Faults = std::uint32_t[lanes];

/// The columns of the rotation of each lane (as glm::mat3_cast makes it), and the same stretched.
struct Turns {
  Lanes3 turn[3], stretch[3];
};

glm::vec3 product(const Lanes3 (&m)[3], std::size_t l, const glm::vec3& v) {
  return {m[0].x[l] * v.x + m[1].x[l] * v.y + m[2].x[l] * v.z,
          m[0].y[l] * v.x + m[1].y[l] * v.y + m[2].y[l] * v.z,
          m[0].z[l] * v.x + m[1].z[l] * v.y + m[2].z[l] * v.z};
}

void put(Lanes3& __restrict out, std::size_t l, const glm::vec3& v) {
  out.x[l] = v.x;
  out.y[l] = v.y;
  out.z[l] = v.z;
}

/// math::quick_unit of vectors of ordinary size; others set the flag.
glm::vec3 unit_of(const glm::vec3& v, std::uint32_t& fault) {
  const float square = v.x * v.x + v.y * v.y + v.z * v.z;
  fault |= square > 1e-30F && square < 1e30F ? 0U : 1U;
  const float length = std::sqrt(square);
  return {v.x / length, v.y / length, v.z / length};
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
  }
}

SEEDMESH_WIDE void place_point(const Turns& turns, const Lanes3& place, const glm::vec3& from,
                               Lanes3& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 p = product(turns.stretch, l, from);
    put(out, l, {place.x[l] + p.x, place.y[l] + p.y, place.z[l] + p.z});
  }
}

SEEDMESH_WIDE void place_normal(const Turns& turns, const Lanes3& scale, const glm::vec3& from,
                                Lanes3& __restrict out, std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const float x = scale.x[l], y = scale.y[l], z = scale.z[l];
    const bool is_even = (x == y) & (y == z);
    const glm::vec3 shrunk{from.x * (1.0F / scale.x[l]), from.y * (1.0F / scale.y[l]),
                           from.z * (1.0F / scale.z[l])};
    std::uint32_t uneven_fault = 0;
    const glm::vec3 uneven = unit_of(shrunk, uneven_fault);
    const glm::vec3 own{is_even ? from.x : uneven.x, is_even ? from.y : uneven.y,
                        is_even ? from.z : uneven.z};
    put(out, l, unit_of(product(turns.turn, l, own), faults[l]));
    faults[l] |= is_even ? 0U : uneven_fault;
  }
}

SEEDMESH_WIDE void turn_outward(const glm::vec3& middle, float share, const Lanes3& position,
                                Lanes3& __restrict normal, std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 own{normal.x[l], normal.y[l], normal.z[l]};
    const glm::vec3 away{position.x[l] - middle.x, position.y[l] - middle.y, position.z[l] - middle.z};
    const glm::vec3 out = unit_of(away, faults[l]);
    const float side = out.x * own.x + out.y * own.y + out.z * own.z < 0.0F ? -1.0F : 1.0F;
    const glm::vec3 mixed{own.x + (out.x * side - own.x) * share, own.y + (out.y * side - own.y) * share,
                          own.z + (out.z * side - own.z) * share};
    put(normal, l, unit_of(mixed, faults[l]));
  }
}

SEEDMESH_WIDE void face_of(const Lanes3& a, const Lanes3& b, const Lanes3& c, Lanes3& __restrict out,
                           std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 x{b.x[l] - a.x[l], b.y[l] - a.y[l], b.z[l] - a.z[l]};
    const glm::vec3 y{c.x[l] - a.x[l], c.y[l] - a.y[l], c.z[l] - a.z[l]};
    put(out, l, unit_of({x.y * y.z - y.y * x.z, x.z * y.x - y.z * x.x, x.x * y.y - y.x * x.y}, faults[l]));
  }
}

/// A normal that would look away from a face is turned toward it.
SEEDMESH_WIDE void face_forward(const Lanes3& face, Lanes3& __restrict normal,
                                std::uint32_t* __restrict faults) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 here{normal.x[l], normal.y[l], normal.z[l]}, f{face.x[l], face.y[l], face.z[l]};
    const float over = here.x * f.x + here.y * f.y + here.z * f.z;
    const bool is_flat = over < 0.1F;
    const float by = 0.15F - over;
    std::uint32_t fault = 0;
    const glm::vec3 turned = unit_of({here.x + f.x * by, here.y + f.y * by, here.z + f.z * by}, fault);
    faults[l] |= is_flat ? fault : 0U;
    put(normal, l, {is_flat ? turned.x : here.x, is_flat ? turned.y : here.y, is_flat ? turned.z : here.z});
  }
}

}  // namespace

namespace {

/// Lanes `lane` to `lane + count - 1`, at most four, to `out` and every `step` after it.
void write_lanes(const Lanes3& from, std::size_t lane, std::size_t count, glm::vec3* out, std::size_t step) {
  if (count < Four::size) {
    for (std::size_t k = 0; k < count; ++k) out[k * step] = from.at(lane + k);
    return;
  }
  FourFloats x, y;
  std::memcpy(&x, from.x + lane, sizeof(x));
  std::memcpy(&y, from.y + lane, sizeof(y));
  const FourFloats xy[2] = {__builtin_shufflevector(x, y, 0, 4, 1, 5),
                            __builtin_shufflevector(x, y, 2, 6, 3, 7)};
  double pairs[4];
  std::memcpy(pairs, xy, sizeof(pairs));
  for (std::size_t k = 0; k < Four::size; ++k) {
    glm::vec3& to = out[k * step];
    std::memcpy(static_cast<void*>(&to), pairs + k, sizeof(double));
    to.z = from.z[lane + k];
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
  for (std::size_t i = 0; i < vertices; ++i) {
    place_point(turns, place_, surface_.position[i], position_[i]);
    if (i > 0 && surface_.normal[i] == surface_.normal[i - 1]) {  // flat, as most leaves are
      normal_[i] = normal_[i - 1];
    } else {
      place_normal(turns, scale_, surface_.normal[i], normal_[i], faults);
    }
  }
  if (options_.crown) {
    for (std::size_t i = 0; i < vertices; ++i)
      turn_outward(*options_.crown, options_.crown_share, position_[i], normal_[i], faults);
    const std::uint32_t* corner = surface_.index.wide.data();
    for (const std::uint32_t* end = corner + surface_.index.wide.size(); corner != end; corner += 3) {
      Lanes3 face;
      face_of(position_[corner[0]], position_[corner[1]], position_[corner[2]], face, faults);
      for (int k = 0; k < 3; ++k) face_forward(face, normal_[corner[k]], faults);
    }
  }
  return std::all_of(faults, faults + lanes, [](std::uint32_t fault) { return fault == 0; });
}

void OrganBlock::write(std::size_t count, glm::vec3* position, glm::vec3* normal) const {
  const std::size_t vertices = surface_.position.size();
  for (std::size_t lane = 0; lane < count; lane += Four::size) {
    const std::size_t organs = std::min(Four::size, count - lane);
    for (std::size_t i = 0; i < vertices; ++i) {
      write_lanes(position_[i], lane, organs, position + lane * vertices + i, vertices);
      write_lanes(normal_[i], lane, organs, normal + lane * vertices + i, vertices);
    }
  }
}

}  // namespace seedmesh

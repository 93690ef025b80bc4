#include "core/geom/plant/organ_block.h"

#include <algorithm>
#include <cmath>

#include "core/base/quick_math.h"
#include "core/base/wide.h"
#include "core/geom/mesh/tangents.h"
#include "core/geom/plant/organ_rows.h"

namespace seedmesh {
namespace {

using Lanes3 = OrganLanes3;
using Lanes4 = OrganLanes4;
constexpr std::size_t lanes = organ_lanes;
static_assert(sizeof(Lanes3) == 3 * lanes * sizeof(float) && sizeof(Lanes4) == 4 * lanes * sizeof(float));

// A normal that follows a crown has at least the first cosine to its faces; one with less is turned to the
// second.
constexpr float least_over = 0.1F, wanted_over = 0.15F;
// The same of outward normals. They may be almost flat to their faces: the lower side of a leaf is then lit nearly as
// its upper side. The margin is several times the error of normals of eight bits.
constexpr float least_beside = 0.03F, wanted_beside = 0.05F;
// Outward normals are between straight up and the surface of the crown, because leaves turn to the light.
constexpr float up_share = 0.68F;
constexpr int most_passes = 4;

/// Of each lane: the columns of the rotation, the columns multiplied by the scale, and the inverse of the
/// scale, which normals are multiplied by before they are rotated.
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

float dot_of(const glm::vec3& a, const glm::vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

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

SEEDMESH_WIDE std::uint32_t all_units(const Lanes3& v, Lanes3& out) {
  std::uint32_t failures = 0;
  for (std::size_t l = 0; l < lanes; ++l) {
    std::uint32_t failure = 0;
    put(out, l, organ_unit(at(v, l), failure));
    failures |= failure;
  }
  return failures;
}

/// The unit vectors of `v`. otherwise(lane) is returned for a vector without a direction.
template <class Otherwise>
void to_units(const Lanes3& v, const Otherwise& otherwise, Lanes3& out) {
  Lanes3 units;
  if (all_units(v, units) != 0) {
    for (std::size_t l = 0; l < lanes; ++l) {
      std::uint32_t failure = 0;
      organ_unit(at(v, l), failure);
      if (failure != 0) put(units, l, math::unit(at(v, l), otherwise(l)));
    }
  }
  out = units;
}

SEEDMESH_WIDE void place_point(const Turns& turns, const Lanes3& place, const glm::vec3& from,
                               Lanes3& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 p = product(turns.stretch, l, from);
    put(out, l, {place.x[l] + p.x, place.y[l] + p.y, place.z[l] + p.z});
  }
}

SEEDMESH_WIDE void place_normal(const Turns& turns, const glm::vec3& from, Lanes3& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 shrunk{from.x * turns.inverse.x[l], from.y * turns.inverse.y[l],
                           from.z * turns.inverse.z[l]};
    put(out, l, product(turns.turn, l, shrunk));
  }
}

/// Where u grows, and across the surface.
SEEDMESH_WIDE void place_axes(const Turns& turns, const TextureAxes& from, Lanes3& __restrict u,
                              Lanes3& __restrict across) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 along_u = product(turns.stretch, l, from.u), along_v = product(turns.stretch, l, from.v);
    put(u, l, along_u);
    put(across, l, cross_of(along_u, along_v));
  }
}

SEEDMESH_WIDE std::uint32_t all_tangents(const Lanes3& normal, const Lanes3& u, const Lanes3& across,
                                         Lanes4& __restrict out) {
  std::uint32_t failures = 0;
  for (std::size_t l = 0; l < lanes; ++l) {
    std::uint32_t failure = 0;
    const glm::vec4 tangent = organ_tangent(at(normal, l), at(u, l), at(across, l), failure);
    put(out.xyz, l, glm::vec3(tangent));
    out.w[l] = tangent.w;
    failures |= failure;
  }
  return failures;
}

void place_tangent(const Lanes3& normal, const Lanes3& u, const Lanes3& across, Lanes4& out) {
  if (all_tangents(normal, u, across, out) == 0) return;
  for (std::size_t l = 0; l < lanes; ++l) {
    std::uint32_t failure = 0;
    organ_tangent(at(normal, l), at(u, l), at(across, l), failure);
    if (failure != 0) put(out.xyz, l, any_perpendicular(at(normal, l)));
  }
}

/// A tangent that the surface brings along.
void turn_tangent(const Turns& turns, const glm::vec4& from, const Lanes3& normals, Lanes4& out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 normal = at(normals, l), along = product(turns.stretch, l, glm::vec3(from));
    put(out.xyz, l, math::quick_unit(along - normal * glm::dot(along, normal), at(turns.turn[0], l)));
    out.w[l] = from.w;
  }
}

SEEDMESH_WIDE void away_from(const glm::vec3& middle, const Lanes3& position, Lanes3& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l)
    put(out, l, {position.x[l] - middle.x, position.y[l] - middle.y, position.z[l] - middle.z});
}

/// Between a normal and the direction outward, on the side of the normal.
SEEDMESH_WIDE void mix_on_own_side(float share, const Lanes3& outward, const Lanes3& normal,
                                   Lanes3& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 own = at(normal, l), away = at(outward, l);
    const float side = dot_of(away, own) < 0.0F ? -1.0F : 1.0F;
    put(out, l,
        {own.x + (away.x * side - own.x) * share, own.y + (away.y * side - own.y) * share,
         own.z + (away.z * side - own.z) * share});
  }
}

/// Between away from the middle of an ellipsoid, at right angles to the one through the point, and up.
SEEDMESH_WIDE void ellipsoid_normal(const glm::vec3& middle, const glm::vec3& by, const Lanes3& position,
                                    Lanes3& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 away{(position.x[l] - middle.x) * by.x, (position.y[l] - middle.y) * by.y,
                         (position.z[l] - middle.z) * by.z};
    const float share = (1 - up_share) / std::sqrt(dot_of(away, away) + 1e-30F);
    put(out, l, {away.x * share, away.y * share + up_share, away.z * share});
  }
}

/// Between a normal and the direction outward.
SEEDMESH_WIDE void mix_outward(float share, const Lanes3& outward, const Lanes3& normal,
                               Lanes3& __restrict out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 own = at(normal, l), away = at(outward, l);
    put(out, l,
        {own.x + (away.x - own.x) * share, own.y + (away.y - own.y) * share,
         own.z + (away.z - own.z) * share});
  }
}

/// The cross product of a face's sides. Returns false where at each lane the normals of its corners are on
/// its side, with a margin.
SEEDMESH_WIDE bool face_of(const Lanes3* position, const Lanes3* normal, const std::uint32_t* corner,
                           float least_cosine, Lanes3& __restrict out) {
  const Lanes3 &a = position[corner[0]], &b = position[corner[1]], &c = position[corner[2]];
  const Lanes3 &n0 = normal[corner[0]], &n1 = normal[corner[1]], &n2 = normal[corner[2]];
  std::uint32_t any = 0;
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 across = cross_of({b.x[l] - a.x[l], b.y[l] - a.y[l], b.z[l] - a.z[l]},
                                      {c.x[l] - a.x[l], c.y[l] - a.y[l], c.z[l] - a.z[l]});
    put(out, l, across);
    const float square = dot_of(across, across), least = (least_cosine + 1e-3F) * std::sqrt(square);
    // Bits instead of && keep the loop free of branches.
    const auto bit = [](bool holds) { return holds ? 1U : 0U; };
    any |= 1U ^ (bit(square > 1e-30F) & bit(dot_of(at(n0, l), across) > least) &
                 bit(dot_of(at(n1, l), across) > least) & bit(dot_of(at(n2, l), across) > least));
  }
  return any != 0;
}

/// Turns a normal where it is too flat to a face. `turned` gets the vector before it is normalised.
SEEDMESH_WIDE void lean_toward(const Lanes3& face, const Lanes3& normal, Lanes3& __restrict turned) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 here = at(normal, l), f = at(face, l);
    const float by = wanted_over - dot_of(here, f);
    put(turned, l, {here.x + f.x * by, here.y + f.y * by, here.z + f.z * by});
  }
}

/// Turns a normal where it is too flat to a face, at right angles to the face as far as possible. `turned` gets the
/// vector before it is normalised.
SEEDMESH_WIDE void turn_beside(const Lanes3& face, const Lanes3& normal, Lanes3& __restrict turned) {
  constexpr float by_share = wanted_beside / 0.99874922F;  // sqrt(1 - wanted_beside^2)
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 here = at(normal, l), f = at(face, l);
    const float over = dot_of(here, f);
    const glm::vec3 beside{here.x - f.x * over, here.y - f.y * over, here.z - f.z * over};
    const float by = by_share * std::sqrt(dot_of(beside, beside)) + 1e-6F;
    put(turned, l, {beside.x + f.x * by, beside.y + f.y * by, beside.z + f.z * by});
  }
}

SEEDMESH_WIDE void select_flat(const Lanes3& face, const Lanes3& turned, float least_cosine,
                               Lanes3& __restrict normal) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 here = at(normal, l), other = at(turned, l);
    const bool is_flat = dot_of(here, at(face, l)) < least_cosine;
    put(normal, l, {is_flat ? other.x : here.x, is_flat ? other.y : here.y, is_flat ? other.z : here.z});
  }
}

/// Takes the vertex's own normal where the turned one is behind the face or flat to it.
SEEDMESH_WIDE void select_restored(const Lanes3& face, const Lanes3& own, Lanes3& __restrict normal) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 here = at(normal, l), other = at(own, l), f = at(face, l);
    const bool is_off = dot_of(here, f) < 0.01F * std::sqrt(dot_of(f, f));
    put(normal, l, {is_off ? other.x : here.x, is_off ? other.y : here.y, is_off ? other.z : here.z});
  }
}

}  // namespace

OrganBlock::OrganBlock(const Mesh& surface, const FoliageOptions& options, std::span<const TextureAxes> axes,
                       const Job& job)
    : surface_(surface),
      options_(options),
      axes_(axes),
      position_(job, surface.position.size()),
      normal_(job, surface.position.size()),
      own_(job, options.crown && options.outward ? surface.position.size() : 0),
      tangent_(job, surface.tangent.empty() ? axes.size() : surface.tangent.size()) {}

void OrganBlock::place(const Array<Organ>& organs, std::span<const std::uint32_t> numbers) {
  Lanes3 base, scale;
  float quaternion[4][lanes];
  for (std::size_t l = 0; l < lanes; ++l) {  // the last organ fills the other lanes
    const Organ& organ = organs[numbers[std::min(l, numbers.size() - 1)]];
    put(base, l, organ.position);
    put(scale, l, organ.scale);
    quaternion[0][l] = organ.frame.x;
    quaternion[1][l] = organ.frame.y;
    quaternion[2][l] = organ.frame.z;
    quaternion[3][l] = organ.frame.w;
  }
  Turns turns;
  turns_of(quaternion, scale, turns);
  Lanes3 own, vector;
  for (std::size_t i = 0; i < surface_.position.size(); ++i) {
    place_point(turns, base, surface_.position[i], position_[i]);
    if (i == 0 || surface_.normal[i] != surface_.normal[i - 1]) {  // most leaves are flat
      place_normal(turns, surface_.normal[i], vector);
      to_units(
          vector,
          [](std::size_t) {
            return glm::vec3{0, 1, 0};
          },
          own);
    }
    normal_[i] = own;
    if (!own_.empty()) own_[i] = own;
    if (!surface_.tangent.empty()) turn_tangent(turns, surface_.tangent[i], own, tangent_[i]);
    if (!options_.crown) continue;
    const auto its_own = [&](std::size_t l) { return at(own, l); };
    if (options_.outward) {
      const glm::vec3 by = 1.0F / (options_.crown_axes * options_.crown_axes);
      ellipsoid_normal(*options_.crown, by, position_[i], vector);
    } else {
      away_from(*options_.crown, position_[i], vector);
    }
    to_units(vector, its_own, vector);
    if (options_.outward) {
      mix_outward(options_.crown_share, vector, own, normal_[i]);
    } else {
      mix_on_own_side(options_.crown_share, vector, own, normal_[i]);
    }
    to_units(normal_[i], its_own, normal_[i]);
  }
  if (options_.crown && options_.outward) {
    // Normals of bent surfaces have several faces: turning a normal for one of them may turn it off another.
    int pass = 0;
    while (pass < most_passes && turn_toward_faces()) ++pass;
    if (pass == most_passes) restore_turned_off();
  } else if (options_.crown) {
    turn_toward_faces();
  }
  Lanes3 u, across;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (i == 0 || axes_[i] != axes_[i - 1]) place_axes(turns, axes_[i], u, across);
    place_tangent(normal_[i], u, across, tangent_[i]);
  }
}

void OrganBlock::restore_turned_off() {
  const std::uint32_t* corner = surface_.index.wide.data();
  for (const std::uint32_t* end = corner + surface_.index.wide.size(); corner != end; corner += 3) {
    Lanes3 face;
    if (!face_of(position_.data(), normal_.data(), corner, least_beside, face)) continue;
    for (int k = 0; k < 3; ++k) select_restored(face, own_[corner[k]], normal_[corner[k]]);
  }
}

bool OrganBlock::turn_toward_faces() {
  bool has_turned = false;
  const float least = options_.outward ? least_beside : least_over;
  const std::uint32_t* corner = surface_.index.wide.data();
  for (const std::uint32_t* end = corner + surface_.index.wide.size(); corner != end; corner += 3) {
    Lanes3 face, turned;
    if (!face_of(position_.data(), normal_.data(), corner, least, face)) continue;
    to_units(
        face,
        [](std::size_t) {
          return glm::vec3{0, 1, 0};
        },
        face);
    has_turned = true;
    for (int k = 0; k < 3; ++k) {
      Lanes3& normal = normal_[corner[k]];
      if (options_.outward) {
        turn_beside(face, normal, turned);
      } else {
        lean_toward(face, normal, turned);
      }
      to_units(
          turned, [&](std::size_t l) { return at(face, l); }, turned);
      select_flat(face, turned, least, normal);
    }
  }
  return has_turned;
}

void OrganBlock::write(std::size_t count, glm::vec3* position, glm::vec3* normal, glm::vec4* tangent) const {
  const std::size_t vertices = surface_.position.size();
  const auto write_all = [&](const auto& lanes_of, std::size_t rows, auto* to) {
    write_rows(reinterpret_cast<const float*>(lanes_of.data()), rows * vertices, count,
               reinterpret_cast<float*>(to));
  };
  write_all(position_, 3, position);
  write_all(normal_, 3, normal);
  if (tangent) write_all(tangent_, 4, tangent);
}

}  // namespace seedmesh

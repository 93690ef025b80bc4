#include "core/generators/tree/leaf_frames.h"

#include "core/base/quick_float.h"
#include "core/base/wide.h"
#include "core/generators/tree/wide_chance.h"

namespace seedmesh::tree {
namespace {

// Lanes of the widest vectors of floats; a few leaves too many are reckoned rather than one by one.
constexpr std::size_t lanes = 16;
constexpr std::size_t most = LeafFrames::most;

struct Turn {
  float w, x, y, z;
};

Turn product(const Turn& a, const Turn& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

/// Where +Z goes.
glm::vec3 up_of(const Turn& q) {
  return {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)};
}

/// With the upper side outward and up by the share `bend`, as to_light() has it: first about the sky, then
/// about the level axis at right angles to the upper side. The order of the two is changed, and the axis is
/// that of before.
Turn lit(const Turn& q, float x, float z, float bend) {
  const glm::vec3 up = up_of(q);
  const float outward = math::quick_atan2(up.x * z - up.z * x, up.x * x + up.z * z);
  const math::FloatSinCos about = math::quick_sincos(-0.5F * bend * outward);
  const float aside = std::sqrt(up.x * up.x + up.z * up.z);
  const bool is_level = aside < 1e-6F;
  const math::FloatSinCos rise = math::quick_sincos(0.5F * bend * math::quick_atan2(aside, up.y));
  const float by = rise.sin / (is_level ? 1 : aside);
  const float level_x = is_level ? 0 : -up.z * by, level_z = is_level ? 0 : up.x * by;
  return product(product({about.cos, 0, about.sin, 0}, {is_level ? 1 : rise.cos, level_x, 0, level_z}), q);
}

/// Turned over about the heading where the upper side looks down; w >= 0.
Turn settled(const Turn& q) {
  const bool is_down = q.y * q.z < q.w * q.x;
  const Turn r{is_down ? -q.y : q.w, is_down ? -q.z : q.x, is_down ? q.w : q.y, is_down ? q.x : q.z};
  const float side = r.w < 0 ? -1 : 1;
  // + 0 makes -0 a 0
  return {r.w * side + 0.0F, r.x * side + 0.0F, r.y * side + 0.0F, r.z * side + 0.0F};
}

void put_half(double degrees, std::size_t i, float* __restrict sine, float* __restrict cosine) {
  const math::FloatSinCos half = math::quick_float_sincos_degrees(0.5 * degrees);
  sine[i] = half.sin;
  cosine[i] = half.cos;
}

/// Sine and cosine of half the angles `degrees`.
SEEDMESH_WIDE void halve(const double* degrees, std::size_t count, float* __restrict sine,
                         float* __restrict cosine) {
  for (std::size_t i = 0; i < count; ++i) put_half(degrees[i], i, sine, cosine);
}

/// The same of angles that chance has changed by up to `range`.
SEEDMESH_WIDE void vary_and_halve(const double* degrees, const std::uint64_t* key, std::uint64_t place,
                                  double range, std::size_t count, float* __restrict sine,
                                  float* __restrict cosine) {
  for (std::size_t i = 0; i < count; ++i)
    put_half(degrees[i] + drawn_at(key[i], place, range), i, sine, cosine);
}

/// Numbers of leaves by columns; angles as sine and cosine of their halves.
struct Columns {
  const float (&stem)[4][most];  ///< w x y z
  const float (&about)[2][most], (&down)[2][most];
  const float (&position)[3][most];

  Turn on_stem(std::size_t i) const {
    const float s = about[0][i], c = about[1][i], t = down[0][i], d = down[1][i];
    return product({stem[0][i], stem[1][i], stem[2][i], stem[3][i]}, {c * d, -c * t, s * d, s * t});
  }
};

void put(float (&__restrict out)[4][most], std::size_t i, const Turn& q) {
  out[0][i] = q.w;
  out[1][i] = q.x;
  out[2][i] = q.y;
  out[3][i] = q.z;
}

SEEDMESH_WIDE void turn_still(const Columns& c, std::size_t count, float (&__restrict out)[4][most]) {
  for (std::size_t i = 0; i < count; ++i) put(out, i, settled(c.on_stem(i)));
}

SEEDMESH_WIDE void turn_lit(const Columns& c, std::size_t count, float bend,
                            float (&__restrict out)[4][most]) {
  for (std::size_t i = 0; i < count; ++i)
    put(out, i, settled(lit(c.on_stem(i), c.position[0][i], c.position[2][i], bend)));
}

}  // namespace

void LeafFrames::reckon(const Habit& habit, const glm::vec3& scale, Organ* out) {
  float about[2][most], down[2][most], turned[4][most];
  const std::size_t count = (count_ + lanes - 1) / lanes * lanes;
  const auto reckon_halves = [&](const double* degrees, std::uint64_t place, double range,
                                 float(&halves)[2][most]) {
    if (range == 0) return halve(degrees, count, halves[0], halves[1]);
    vary_and_halve(degrees, key_, place, range, count, halves[0], halves[1]);
  };
  reckon_halves(about_, place_of("rotate"), habit.about_v, about);
  reckon_halves(down_, place_of("down"), habit.down_v, down);
  const Columns columns{stem_, about, down, position_};
  if (habit.bend == 0) {
    turn_still(columns, count, turned);
  } else {
    turn_lit(columns, count, static_cast<float>(habit.bend), turned);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    Organ organ;
    organ.frame = {turned[0][i], turned[1][i], turned[2][i], turned[3][i]};
    organ.position = {position_[0][i], position_[1][i], position_[2][i]};
    organ.scale = scale;
    organ.limb_joint = joint_[i];
    organ.key = key_[i];
    out[i] = organ;
  }
}

}  // namespace seedmesh::tree

#include "core/generators/tree/leaf_frames.h"

#include <bit>

#include "core/base/quick_float.h"
#include "core/base/wide.h"

namespace seedmesh::tree {
namespace {

// Floats in the widest vectors. Loops run over a multiple of this, which is quicker than a remainder loop.
constexpr std::size_t lanes = 16;
constexpr std::size_t capacity = LeafFrames::capacity;

struct Quaternion {
  float w, x, y, z;
};

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

/// The image of +Z: the upper side of the leaf.
glm::vec3 up_of(const Quaternion& q) {
  return {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)};
}

/// As turned_to_light() of a frame. The second rotation is applied first, about the axis before the first
/// rotation.
Quaternion turned_to_light(const Quaternion& q, float x, float z, float bend) {
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

/// Turns a leaf over about its heading if its upper side faces down. The result has w >= 0.
Quaternion upper_side_up(const Quaternion& q) {
  const bool is_down = q.y * q.z < q.w * q.x;
  const Quaternion r{is_down ? -q.y : q.w, is_down ? -q.z : q.x, is_down ? q.w : q.y, is_down ? q.x : q.z};
  const float side = r.w < 0 ? -1 : 1;
  // Adding 0 makes -0 a 0.
  return {r.w * side + 0.0F, r.x * side + 0.0F, r.y * side + 0.0F, r.z * side + 0.0F};
}

/// Uniform in [-range, range): Rng(key).at(name).uniform(-range, range) bit for bit. Converts 53 bits to a
/// double by both halves as the last bits of 2^52 and 2^84, for which all processors have vector
/// instructions.
double random_at(std::uint64_t key, std::uint64_t name, double range) {
  const std::uint64_t bits = key_at(key_at(key, name), 0) >> 11U;
  const auto low = std::bit_cast<double>((bits & 0xFFFFFFFFU) | 0x4330000000000000U);
  const auto high = std::bit_cast<double>((bits >> 32U) | 0x4530000000000000U);
  return -range + (range - -range) * (((high - (0x1p84 + 0x1p52)) + low) * 0x1p-53);
}

void put_half(double degrees, std::size_t i, float* __restrict sine, float* __restrict cosine) {
  const math::FloatSinCos half = math::quick_float_sincos_degrees(0.5 * degrees);
  sine[i] = half.sin;
  cosine[i] = half.cos;
}

/// Gives sine and cosine of half the angles.
SEEDMESH_WIDE void halve(const double* degrees, std::size_t count, float* __restrict sine,
                         float* __restrict cosine) {
  for (std::size_t i = 0; i < count; ++i) put_half(degrees[i], i, sine, cosine);
}

/// The same for angles that vary by up to `range`.
// NOLINTNEXTLINE(readability-function-size): with separate pointers, compilers use vector instructions
SEEDMESH_WIDE void vary_and_halve(const double* degrees, const std::uint64_t* key, std::uint64_t name,
                                  double range, std::size_t count, float* __restrict sine,
                                  float* __restrict cosine) {
  for (std::size_t i = 0; i < count; ++i)
    put_half(degrees[i] + random_at(key[i], name, range), i, sine, cosine);
}

/// The batch by columns. Angles are given by sine and cosine of their halves.
struct Columns {
  const float (&stem)[4][capacity];  ///< w x y z
  const float (&rotate)[2][capacity], (&down)[2][capacity];
  const float (&position)[3][capacity];

  Quaternion on_stem(std::size_t i) const {
    const float s = rotate[0][i], c = rotate[1][i], t = down[0][i], d = down[1][i];
    return product({stem[0][i], stem[1][i], stem[2][i], stem[3][i]}, {c * d, -c * t, s * d, s * t});
  }
};

void put(float (&__restrict out)[4][capacity], std::size_t i, const Quaternion& q) {
  out[0][i] = q.w;
  out[1][i] = q.x;
  out[2][i] = q.y;
  out[3][i] = q.z;
}

SEEDMESH_WIDE void turn_still(const Columns& c, std::size_t count, float (&__restrict out)[4][capacity]) {
  for (std::size_t i = 0; i < count; ++i) put(out, i, upper_side_up(c.on_stem(i)));
}

SEEDMESH_WIDE void turn_lit(const Columns& c, std::size_t count, float bend,
                            float (&__restrict out)[4][capacity]) {
  for (std::size_t i = 0; i < count; ++i)
    put(out, i, upper_side_up(turned_to_light(c.on_stem(i), c.position[0][i], c.position[2][i], bend)));
}

}  // namespace

Frame turned_to_light(const Frame& leaf, const glm::dvec3& position, double bend) {
  double outward = math::quick_atan2(position.z, position.x) - math::quick_atan2(leaf.up.z, leaf.up.x);
  if (outward > math::pi) outward -= 2 * math::pi;
  if (outward < -math::pi) outward += 2 * math::pi;
  const Frame turned = rotated(leaf, {0, 1, 0}, math::quick_sincos(-bend * outward));
  const double aside = std::sqrt(turned.up.x * turned.up.x + turned.up.z * turned.up.z);
  if (aside < 1e-9) return turned;
  const glm::dvec3 level_axis{-turned.up.z / aside, 0, turned.up.x / aside};
  return rotated(turned, level_axis, math::quick_sincos(bend * math::quick_atan2(aside, turned.up.y)));
}

void LeafFrames::write(const Options& options, const glm::vec3& scale, Organ* out) {
  float rotate[2][capacity], down[2][capacity], turned[4][capacity];
  const std::size_t count = (count_ + lanes - 1) / lanes * lanes;
  const auto find_halves = [&](const double* degrees, std::uint64_t name, double range,
                               float(&halves)[2][capacity]) {
    if (range == 0) return halve(degrees, count, halves[0], halves[1]);
    vary_and_halve(degrees, key_, name, range, count, halves[0], halves[1]);
  };
  find_halves(rotate_, name_key("rotate"), options.rotate_v, rotate);
  find_halves(down_, name_key("down"), options.down_v, down);
  const Columns columns{stem_, rotate, down, position_};
  if (options.bend == 0) {
    turn_still(columns, count, turned);
  } else {
    turn_lit(columns, count, static_cast<float>(options.bend), turned);
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

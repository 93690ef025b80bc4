#include "core/generators/tree/leaf_frames.h"

#include <bit>

#include "core/base/wide.h"

namespace seedmesh::tree {
namespace {

// Lanes of the widest vectors of doubles; a few leaves too many are reckoned rather than one by one.
constexpr std::size_t lanes = 8;

/// The first draw at `place` below a key, as Rng::uniform(-range, range) makes it. The conversion is exact,
/// and one that every processor has for several at once: both halves as the last bits of 2^52 and 2^84.
double drawn_at(std::uint64_t key, std::uint64_t place, double range) {
  const std::uint64_t bits = key_at(key_at(key, place), 0) >> 11U;
  const auto low = std::bit_cast<double>((bits & 0xFFFFFFFFU) | 0x4330000000000000U);
  const auto high = std::bit_cast<double>((bits >> 32U) | 0x4530000000000000U);
  return -range + (range - -range) * (((high - (0x1p84 + 0x1p52)) + low) * 0x1p-53);
}

/// Numbers of leaves, and where their frames go.
struct Columns {
  const double (&stem)[9][LeafFrames::most];
  const double (&position)[3][LeafFrames::most];
  const double (&about)[LeafFrames::most], (&down)[LeafFrames::most];
  const std::uint64_t (&key)[LeafFrames::most];
  float (&x)[LeafFrames::most], (&y)[LeafFrames::most], (&z)[LeafFrames::most], (&w)[LeafFrames::most];

  Frame on_stem(std::size_t i, const LeafFrames::Habit& habit) const {
    const Frame frame{{stem[0][i], stem[1][i], stem[2][i]},
                      {stem[3][i], stem[4][i], stem[5][i]},
                      {stem[6][i], stem[7][i], stem[8][i]}};
    const double round = about[i] + drawn_at(key[i], place_of("rotate"), habit.about_v);
    const double from = down[i] + drawn_at(key[i], place_of("down"), habit.down_v);
    return pitch(roll(frame, math::quick_sincos_degrees(round)), math::quick_sincos_degrees(from));
  }
  glm::dvec3 at(std::size_t i) const { return {position[0][i], position[1][i], position[2][i]}; }
  void put(std::size_t i, const Frame& frame) const {
    const glm::quat q = quaternion(frame);
    x[i] = q.x;
    y[i] = q.y;
    z[i] = q.z;
    w[i] = q.w;
  }
};

SEEDMESH_WIDE void reckon_still(const Columns& c, std::size_t count, const LeafFrames::Habit& habit) {
  for (std::size_t i = 0; i < count; ++i) c.put(i, upper_side_up(c.on_stem(i, habit)));
}

SEEDMESH_WIDE void reckon_lit(const Columns& c, std::size_t count, const LeafFrames::Habit& habit) {
  for (std::size_t i = 0; i < count; ++i)
    c.put(i, upper_side_up(to_light(c.on_stem(i, habit), c.at(i), habit.bend)));
}

}  // namespace

void LeafFrames::add(const Frame& stem, const glm::dvec3& position, std::uint32_t joint,
                     const Stance& stance) {
  const glm::dvec3 axes[] = {stem.heading, stem.left, stem.up};
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) stem_[3 * axis + k][count_] = axes[axis][k];
    position_[axis][count_] = position[axis];
  }
  about_[count_] = stance.about;
  down_[count_] = stance.down;
  key_[count_] = stance.key;
  joint_[count_] = joint;
  ++count_;
}

void LeafFrames::reckon(const Habit& habit, const glm::vec3& scale, Organ* out) {
  const Columns columns{stem_, position_, about_, down_, key_, x_, y_, z_, w_};
  const std::size_t count = (count_ + lanes - 1) / lanes * lanes;
  if (habit.bend == 0) {
    reckon_still(columns, count, habit);
  } else {
    reckon_lit(columns, count, habit);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    Organ organ;
    organ.frame = {w_[i], x_[i], y_[i], z_[i]};
    organ.position = glm::vec3(columns.at(i));
    organ.scale = scale;
    organ.limb_joint = joint_[i];
    organ.key = key_[i];
    out[i] = organ;
  }
}

}  // namespace seedmesh::tree

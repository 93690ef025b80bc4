#include "core/generators/tree/leaf_frames.h"

#include "core/base/wide.h"
#include "core/generators/tree/wide_chance.h"

namespace seedmesh::tree {
namespace {

// Lanes of the widest vectors of doubles; a few leaves too many are reckoned rather than one by one.
constexpr std::size_t lanes = 8;

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

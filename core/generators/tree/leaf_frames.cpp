#include "core/generators/tree/leaf_frames.h"

#include "core/base/wide.h"

namespace seedmesh::tree {
namespace {

// Lanes of the widest vectors of doubles; a few leaves too many are reckoned rather than one by one.
constexpr std::size_t lanes = 8;

/// Numbers of leaves, and where their frames go.
struct Columns {
  const double (&stem)[9][LeafFrames::most];
  const double (&position)[3][LeafFrames::most];
  const double (&about)[LeafFrames::most], (&down)[LeafFrames::most];
  float (&x)[LeafFrames::most], (&y)[LeafFrames::most], (&z)[LeafFrames::most], (&w)[LeafFrames::most];

  Frame on_stem(std::size_t i) const {
    const Frame frame{{stem[0][i], stem[1][i], stem[2][i]},
                      {stem[3][i], stem[4][i], stem[5][i]},
                      {stem[6][i], stem[7][i], stem[8][i]}};
    return pitch(roll(frame, math::quick_sincos_degrees(about[i])), math::quick_sincos_degrees(down[i]));
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

SEEDMESH_WIDE void reckon_still(const Columns& c, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) c.put(i, upper_side_up(c.on_stem(i)));
}

SEEDMESH_WIDE void reckon_lit(const Columns& c, std::size_t count, double bend) {
  for (std::size_t i = 0; i < count; ++i) c.put(i, upper_side_up(to_light(c.on_stem(i), c.at(i), bend)));
}

}  // namespace

void LeafFrames::add(const Frame& stem, const glm::dvec3& position, double about, double down) {
  const glm::dvec3 axes[] = {stem.heading, stem.left, stem.up};
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) stem_[3 * axis + k][count_] = axes[axis][k];
    position_[axis][count_] = position[axis];
  }
  about_[count_] = about;
  down_[count_] = down;
  ++count_;
}

void LeafFrames::reckon(double bend) {
  const Columns columns{stem_, position_, about_, down_, x_, y_, z_, w_};
  const std::size_t count = (count_ + lanes - 1) / lanes * lanes;
  if (bend == 0) {
    reckon_still(columns, count);
  } else {
    reckon_lit(columns, count, bend);
  }
}

}  // namespace seedmesh::tree

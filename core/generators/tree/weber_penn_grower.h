#pragma once
/// The growth of one tree for weber_penn.h: stems wait on a stack, each is walked from its base to its tip,
/// and bears stems or leaves.
#include <algorithm>
#include <array>
#include <vector>

#include "core/generators/tree/leaf_frames.h"
#include "core/generators/tree/weber_penn_shape.h"

namespace seedmesh::tree {

struct WeberPennStem {
  Frame frame;
  glm::dvec3 position{0};
  std::uint32_t joint = Limbs::none;  ///< it grows from
  int level = 0;
  double length = 0, radius = 0;
  double offset = 0, parent_length = 0;  ///< where on its parent it stands
  double parent_length_max = 0;          ///< the Lmax that its own length was made with
  Rng rng{0};
  // Of clones: where on the stem they begin, what is left of their turn, and their share of its children.
  int segment = 0;
  double uncurve = 0;
  double share = 1;
  double readiness = 1;
  double carried_splits = 0;
  double carried_children = 0.5;
  int children_before = 0;
};

/// A child or leaf on a stem, before it is grown.
struct WeberPennBud {
  glm::dvec3 position{0};
  double offset = 0;
  std::uint32_t joint = Limbs::none;
  std::uint32_t frame = 0;  ///< of the stem there, in a list
  int number = 0;
};

class WeberPennGrower {
 public:
  WeberPennGrower(const TreeParams& params, const Chances& chances, SkeletonWriter& writer)
      : p_(params), levels_(weber_penn_levels(params)), chances_(chances), writer_(writer) {}

  void run();

 private:
  /// Stems that wait one after the other, and what grows from them.
  struct Part;
  void grow_all();
  bool grow_parts();
  const WeberPennLevel& level(int n) const { return levels_[static_cast<std::size_t>(std::min(n, 3))]; }
  bool is_last(const WeberPennStem& stem) const { return stem.level + 1 >= p_.Levels; }
  double base_length() const { return p_.BaseSize * scale_; }
  double segment_length(const WeberPennStem& stem) const { return stem.length / level(stem.level).curve_res; }

  // Along a stem.
  WeberPennStem trunk();
  void grow(const WeberPennStem& given);
  double radius_at(const WeberPennStem& stem, double z) const;
  Frame turned(const WeberPennStem& stem, const Frame& frame, int segment) const;
  Frame swayed_at(const WeberPennStem& stem, const Frame& frame, int segment) const;
  int pieces(const WeberPennStem& stem) const;
  Frame piece_frame(const WeberPennStem& stem, const Frame& axis, int piece) const;
  double walk_segment(WeberPennStem& stem, const Frame& axis, int segment, glm::dvec3& at);
  void split(WeberPennStem& stem, Frame& frame, const glm::dvec3& at, int segment, std::uint32_t joint);

  // What stands on it.
  double children_of(const WeberPennStem& stem) const;
  void bear_all(const WeberPennStem& stem, double child_max);
  void bear(const WeberPennStem& stem, const WeberPennBud& bud, double child_max);
  bool prune(WeberPennStem& child) const;
  bool fits(const WeberPennStem& stem) const;
  struct Stance {
    double about = 0, down = 0;  ///< degrees
  };
  Stance stance(const WeberPennStem& stem, const WeberPennBud& bud, const Rng& rng) const;
  /// Counts a leaf of the stem that grows. False: it is none of those that are drawn.
  bool wants_leaf(int number) const {
    return writer_.wants_leaf([&] { return leaf_chance_.at(static_cast<std::uint64_t>(number)).key(); });
  }
  /// On the last of the frames.
  void put_bud(const glm::dvec3& position, double offset, int number) {
    buds_.push_back(
        {position, offset, Limbs::none, static_cast<std::uint32_t>(bud_frames_.size() - 1), number});
  }
  void leaf(const WeberPennStem& stem, const WeberPennBud& bud);
  void fan_leaf(const WeberPennStem& stem, const WeberPennBud& bud, const Rng& rng);
  void put_leaves();

  const TreeParams& p_;
  std::array<WeberPennLevel, 4> levels_;
  const Chances& chances_;
  SkeletonWriter& writer_;
  std::vector<WeberPennStem> waiting_;
  double scale_ = 0, trunk_length_ = 0;
  LeafFrames leaf_frames_;
  std::array<Organ, LeafFrames::most> leaves_;  ///< whose frames are waited for
  // Of the stem that grows.
  std::uint32_t last_joint_ = Limbs::none;
  std::vector<WeberPennBud> buds_;
  std::vector<Frame> bud_frames_;
  std::size_t next_bud_ = 0;  ///< whose joint is not there yet
  std::vector<double> stops_;
  Rng leaf_chance_{0};
  double spacing_ = 0, bare_ = 0;
  bool starts_ = false;
};

}  // namespace seedmesh::tree

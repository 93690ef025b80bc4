#pragma once
/// The growth of one tree for weber_penn.h: stems wait on a stack, each is walked from its base to its tip,
/// and bears stems or leaves.
#include <algorithm>
#include <array>
#include <vector>

#include "core/generators/tree/leaf_frames.h"
#include "core/generators/tree/weber_penn_bends.h"
#include "core/generators/tree/weber_penn_brood.h"
#include "core/generators/tree/weber_penn_twigs.h"

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

class WeberPennGrower {
 public:
  WeberPennGrower(const TreeParams& params, const Chances& chances, SkeletonWriter& writer)
      : p_(params), levels_(weber_penn_levels(params)), chances_(chances), writer_(writer) {
    const WeberPennLevel& last = level(params.Levels - 1);
    bends_ahead_ = params.Levels > 1 && last.curve_res > 1 &&
                   last.curve_res <= WeberPennBends::most_segments && !(last.seg_splits > 0) && !sways();
    has_twigs_ = last.curve_res == 1 && last.curve_v >= 0 && params.Leaves >= 0 &&
                 params.Leaves <= static_cast<int>(WeberPennTwigs::most_leaves);
  }

  void run();

 private:
  /// Stems that wait one after the other, and what grows from them.
  struct Part;
  struct Plan;
  void plan_parts(const WeberPennGrower& from, std::size_t most, Plan& plan) const;
  static void join_steps(Plan& plan, std::size_t stems);
  void grow_all();
  bool grow_parts();
  const WeberPennLevel& level(int n) const { return levels_[static_cast<std::size_t>(std::min(n, 3))]; }
  bool is_last(const WeberPennStem& stem) const { return stem.level + 1 >= p_.Levels; }
  double base_length() const { return p_.BaseSize * scale_; }
  double segment_length(const WeberPennStem& stem) const { return stem.length / level(stem.level).curve_res; }

  // Along a stem.
  WeberPennStem trunk();
  struct Expected {
    double joints = 0, leaves = 0;
  };
  Expected expected() const;
  void make_room(double share);  ///< for so much of what is expected
  void grow(WeberPennStem& stem);
  void begin(const WeberPennStem& stem);
  double radius_at(const WeberPennStem& stem, double z) const;
  bool sways() const { return p_.sway.wind != 0 || p_.sway.gust != 0; }
  void bend_ahead();
  Frame turned(const WeberPennStem& stem, const Frame& frame, int segment) const;
  Frame swayed_at(const WeberPennStem& stem, const Frame& frame, int segment) const;
  int pieces(const WeberPennStem& stem) const;
  Frame piece_frame(const WeberPennStem& stem, const Frame& axis, int piece) const;
  void walk_segment(WeberPennStem& stem, const Frame& axis, int segment, glm::dvec3& at);
  bool add_bends(const WeberPennStem& stem, const WeberPennPiece& piece, int segment);
  void write_joints(const WeberPennStem& stem, const WeberPennPiece& piece);
  /// What is carried alone, below a half, splits nothing.
  bool may_split(const WeberPennStem& stem) const {
    return level(stem.level).seg_splits > 0 || stem.level == 0;
  }
  void split(WeberPennStem& stem, Frame& frame, const glm::dvec3& at, int segment, std::uint32_t joint);

  // What stands on it.
  double children_of(const WeberPennStem& stem) const;
  /// In metres of a stem; `first`: the number of the first.
  struct Places {
    int first;
    std::span<const double> at;
  };
  Places find_places(WeberPennStem& stem, const WeberPennPiece& piece);
  double down_at(const WeberPennStem& stem, double offset) const;
  void put_children(WeberPennStem& stem, const WeberPennPiece& piece);
  void bear(const WeberPennStem& stem, const WeberPennPiece& piece, double offset, double length);
  void settle(const WeberPennStem& stem);
  double child_length(const WeberPennStem& stem, double offset) const;
  double child_radius(const WeberPennStem& stem, double offset, double length) const;
  bool prune(WeberPennStem& child);
  bool fits(const WeberPennStem& stem, double length);
  void put_leaves(WeberPennStem& stem, const WeberPennPiece& piece);
  void put_fan(const WeberPennStem& stem, const Frame& frame, const glm::dvec3& at);
  bool is_twig(const WeberPennStem& stem) const;
  void grow_twigs();
  void write_leaves();

  const TreeParams& p_;
  std::array<WeberPennLevel, 4> levels_;
  const Chances& chances_;
  SkeletonWriter& writer_;
  std::vector<WeberPennStem> waiting_;
  double scale_ = 0, trunk_length_ = 0;
  bool bends_ahead_ = false;         ///< last stems bend, and neither split nor sway
  bool has_twigs_ = false;           ///< last stems are straight, and bear not too many leaves
  LeafFrames leaf_frames_;           ///< that are waited for
  std::vector<Frame> trial_frames_;  ///< of a stem that is pruned, segment by segment
  // Of the stem that grows.
  bool is_written_ = true;  ///< its joints; nobody looks at others
  bool marks_feet_ = true;  ///< by joints where its children stand
  std::uint32_t last_joint_ = Limbs::none;
  double last_radius_ = 0;
  std::vector<WeberPennStem> clones_;
  std::size_t first_child_ = 0, next_child_ = 0;  ///< of those that wait; whose joint is not there yet
  std::vector<double> places_;                    ///< room for those of children or leaves on a piece
  WeberPennBrood brood_;                          ///< the last of its children, not yet settled
  WeberPennTwigs twigs_;
  WeberPennBends bends_;              ///< of stems that wait, which grow one after the other
  std::size_t next_bend_ = 0;         ///< of the stem that grows, if it is one of these
  std::vector<std::uint64_t> drawn_;  ///< room for whether leaves there are drawn
  std::vector<double> stops_;         ///< of a piece
  struct Stop {
    double at;
    std::uint32_t joint;
  };
  std::vector<Stop> joints_;  ///< of a piece; of one that is not written, what its leaves move with
  Rng leaf_chance_{0}, child_chance_{0};
  int count_ = 0;  ///< of its children or leaves
  double spacing_ = 0, bare_ = 0, child_max_ = 0;
  bool starts_ = false;
};

}  // namespace seedmesh::tree

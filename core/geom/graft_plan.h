#pragma once
/// Which rings one limb has, and where others leave it.
#include <vector>

#include "core/geom/graft.h"
#include "core/geom/graft_opening.h"

namespace seedmesh {

/// A ring of a limb: at a point of its axis or between two, with the openings that lie on it.
struct Band {
  float at = 0, low = 0, high = 0;
  std::size_t piece = 0;
  bool is_bend = false;  ///< stands at the point where `piece` begins, across both pieces
  std::uint32_t first = Opening::none, last = Opening::none;  ///< of GraftPlan::opening, by Opening::next
  bool is_open() const { return first != Opening::none; }
};

struct GraftPlan {
  std::vector<Opening> opening;
  std::vector<LoopPoint> loop_point;   ///< of the openings
  std::vector<Band> band;              ///< by rising `at`; the last is the ring at the tip
  std::vector<std::uint32_t> refused;  ///< limbs that found no room

  /// `start`: the length up to which the limb's own beginning reaches; `tip`: where the last ring stands;
  /// `bulge`: how far the circle is outside the sides of a cross-section, as a share of the radius. Loops lie
  /// on the circle, so that rings of straight sides need that much distance from them.
  void begin(float start, float tip, float apart, float bulge);
  /// Asks for a way out of the axis' point for a child. False: it must be closed.
  bool open(const GraftAxis& axis, std::size_t at_point, Bud bud);
  /// Adds the rings that bends and changes of radius need, one beside the beginning where asked, and the
  /// last, unless the limb may be pointed: then where it is thick.
  void complete(const GraftAxis& axis, bool has_first, const GraftOptions& options);

 private:
  template <class Test>
  bool any_on(const Band& ring, const Test& test) const {
    for (std::uint32_t i = ring.first; i != Opening::none; i = opening[i].next) {
      if (test(opening[i])) return true;
    }
    return false;
  }
  void add(Band& ring, const Opening& wanted);
  bool put(const GraftAxis& axis, std::size_t at_point, const Opening& wanted);
  bool fits(const GraftAxis& axis, const Opening& opening, std::size_t place) const;
  /// At `at`, which is on a piece near `near`.
  float margin(const GraftAxis& axis, float at, std::size_t near) const;
  bool joins(const Opening& opening, const Band& band) const;
  /// Does it leave anything of the child?
  bool leaves_room(const Opening& wanted, const Bud& bud) const {
    return !(wanted.child_reach > bud.tip - 8 * apart_);
  }

  std::vector<Band> all_;  ///< of complete(), kept for its room
  float start_ = 0, tip_ = 0, apart_ = 0, bulge_ = 0;
};

}  // namespace seedmesh

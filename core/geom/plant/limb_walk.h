#pragma once
/// A walk along one limb that divides it into tubes. skin() walks twice: to count and to write.
#include <algorithm>
#include <cmath>

#include "core/geom/plant/chains.h"

namespace seedmesh {

/// A straight piece of bark.
struct Internode {
  glm::vec3 from{0}, to{0};
  glm::vec3 along{0};  ///< unit
  float length = 0;
  float base = 0, end = 0;  ///< radii
  std::uint32_t joint = 0;  ///< its far end
  std::uint32_t first = 0;  ///< the far end of its first part, where it goes straight on over several joints
  std::int16_t color = 0;
  bool follows = false;  ///< begins where the one before it ends
  bool at_root = false;  ///< begins at a joint without parent
};

/// The mitred ring where two internodes meet: in the plane across `tangent`.
struct Turn {
  glm::vec3 tangent{0};
  float cosine = 1;  ///< cosine of half the angle between the two
  float reach = 0;   ///< length by which the ring leans along either internode
};

enum class TubeOpening { root, branch, point };
enum class TubeClosing { tip, cap, point };

/// Reads the internodes of one limb. Leaves out those without length or radius, and repeated ones.
class InternodeReader {
 public:
  InternodeReader(const Limbs& limbs, const Chains& chains, const Scale& scale, std::uint32_t head)
      : limbs_(limbs), chains_(chains), scale_(scale), joint_(head) {
    at_root_ = limbs.parent[head] == Limbs::none;
    here_ = limbs.position[at_root_ ? head : limbs.parent[head]];
    if (at_root_) joint_ = chains.next[head];
  }

  bool read(Internode& out) {
    bool follows = !first_;
    for (; joint_ != Limbs::none; joint_ = chains_.next[joint_]) {
      const glm::vec3 to = limbs_.position[joint_];
      const glm::vec3 step = to - here_;
      const float length = std::sqrt(glm::dot(step, step));
      if (length <= scale_.shortest) continue;
      const float base = limbs_.base_radius[joint_], end = limbs_.radius[joint_];
      const bool is_skinned =
          !(chains_.mark[joint_] & drawn_before) && std::max(base, end) >= scale_.thinnest;
      if (is_skinned) {
        out = {here_,   to,      step * (1 / length),
               length,  base,    end,
               joint_,  joint_,  limbs_.color.empty() ? std::int16_t{0} : limbs_.color[joint_],
               follows, at_root_};
        if (chains_.mark[joint_] & straight_on) go_straight(out);
      }
      here_ = is_skinned ? out.to : to;
      at_root_ = false;
      if (is_skinned) {
        joint_ = chains_.next[joint_];
        first_ = false;
        return true;
      }
      follows = false;
    }
    return false;
  }

 private:
  void go_straight(Internode& out) {
    while (chains_.mark[joint_] & straight_on) joint_ = chains_.next[joint_];
    const glm::vec3 step = limbs_.position[joint_] - out.from;
    out.to = limbs_.position[joint_];
    out.length = std::sqrt(glm::dot(step, step));
    out.along = step * (1 / out.length);
    out.end = limbs_.radius[joint_];
    out.joint = joint_;
  }

  const Limbs& limbs_;
  const Chains& chains_;
  const Scale& scale_;
  std::uint32_t joint_;
  glm::vec3 here_{0};
  bool first_ = true;
  bool at_root_ = false;
};

/// Decides whether two internodes can meet in a mitred ring, which depends on the ring where the first one
/// begins.
class MitreCheck {
 public:
  MitreCheck(const Scale& scale, int sides);

  /// Has to be called before the first internode of a tube.
  void open() { last_ = {}; }

  /// Returns true where `a` and `b` can meet; sets `turn`. `radius_before`: of the ring at the near end of
  /// `a`.
  bool allows(const Internode& a, const Internode& b, float radius_before, Turn& turn);

  /// Returns the length of the last internode between the ring where it begins and its far end.
  float free_length(const Internode& a) const { return a.length - last_.turn.reach; }

 private:
  /// The ring where the current internode begins.
  struct Ring {
    Turn turn;
    float radius = 0;
    float taper = 0;        ///< taper of the bark before it: change of radius divided by the free length
    bool is_gentle = true;  ///< turn and taper are so small that no face there can face inward
  };

  bool has_length_for_rings(const Internode& a, float most, const Ring& ring) const;
  bool keeps_faces_outside(const Ring& ring, float taper_after) const;

  const Scale* scale_;
  float side_cosine_;   ///< cosine of half the angle between two corners of a cross-section
  float gentle_reach_;  ///< reach in units of the radius: turns up to it are gentle
  Ring last_;
};

/// Walks one limb and calls the sink for each tube in order: open(internode, TubeOpening), for each further
/// internode join(turn, next), and close(TubeClosing, free length of the last internode).
template <class Sink>
void walk_limb(InternodeReader reader, MitreCheck check, const Chains& chains, const Scale& scale,
               Sink& sink) {
  Internode a, b;
  bool more = reader.read(a);
  while (more) {
    check.open();
    float radius = a.base;
    sink.open(a, radius < scale.thinnest ? TubeOpening::point
                 : a.at_root             ? TubeOpening::root
                                         : TubeOpening::branch);
    Turn turn;
    while ((more = reader.read(b)) && b.follows && check.allows(a, b, radius, turn)) {
      sink.join(turn, b);
      radius = b.base;
      a = b;
    }
    const bool is_covered = (more && b.follows) || (chains.mark[a.joint] & fork);
    sink.close(a.end < scale.thinnest ? TubeClosing::point
               : is_covered           ? TubeClosing::cap
                                      : TubeClosing::tip,
               check.free_length(a));
    a = b;
  }
}

}  // namespace seedmesh

#pragma once
/// The turtle of Prusinkiewicz and Lindenmayer (The Algorithmic Beauty of Plants, 1990, sections 1.3
/// and 1.5): a position, a frame, a width and a colour that move through space, with a stack for branches and
/// another for polygons. Writes a Skeleton and measures what it drew; knows no grammar.
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/base/math.h"
#include "core/geom/frame.h"
#include "core/geom/limbs.h"
#include "core/geom/tropism.h"

namespace seedmesh {

/// What a turtle drew, in its own frame: start at the origin, heading +Y, left -X, up +Z.
struct TurtleReport {
  std::uint64_t segments = 0;
  double total_length = 0;
  std::uint64_t vertices = 0;  ///< polygon vertices set
  glm::dvec3 min{0}, max{0};   ///< of the centre lines of drawn segments; zero where there is none
};

class Turtle {
 public:
  /// Writes into `skeleton`; null: measures only.
  Turtle(Skeleton* skeleton, double width, Job& job);

  /// Moves by `length` along the heading, which may be negative. `draw` makes an internode of the present
  /// width, born at `birth`; between braces the end point becomes a vertex instead. `walk` draws nothing;
  /// between braces it sets a vertex too.
  void draw(double length, std::uint64_t key);
  void walk(double length);
  /// The same without vertices between braces.
  void draw_plain(double length, std::uint64_t key);
  void walk_plain(double length);
  void move_to(const glm::dvec3& position);

  void turn(math::SinCos angle) {
    rotate(state_.frame.heading, state_.frame.left, angle);
  }  ///< left, about up
  void pitch(math::SinCos angle) {
    rotate(state_.frame.up, state_.frame.heading, angle);
  }  ///< down, about left
  void roll(math::SinCos angle) {
    rotate(state_.frame.left, state_.frame.up, angle);
  }  ///< left, about heading
  void turn_around() { state_.frame = seedmesh::turn_around(state_.frame); }
  void upright() { state_.frame = seedmesh::upright(state_.frame); }
  void head(const glm::dvec3& direction);  ///< heads along it and rolls upright
  void face_as(const Frame& frame);        ///< any axes; heading counts first, then left
  void stand_up();                         ///< the frame of the start: heading +Y, left -X, up +Z

  /// Refuses to draw more segments than this; without a call there is no such limit.
  void set_most_segments(std::uint64_t most) { most_segments_ = most; }

  /// Turns the heading by these after every segment drawn from now on.
  void set_tropisms(std::vector<Tropism> tropisms) { tropisms_.emplace(std::move(tropisms)); }
  /// Sets the elasticity of one of them, or changes it by so many of its steps; part of the state.
  void set_elasticity(std::int64_t tropism, double elasticity);
  void change_elasticity(std::int64_t tropism, double steps);

  /// Writes of each joint where it is, its parent and, where any is not 0, its colour, and leaves the other
  /// arrays empty: enough for wires(). Before the first segment.
  void draw_wires() { draws_wires_ = true; }

  /// Writes Limbs::contour and Limbs::frame from now on. Before the first segment.
  void draw_contours() { draws_contours_ = true; }

  /// Writes Limbs::anchor from now on, for whoever moves limbs afterwards. Before the first segment.
  void track_anchors() { tracks_anchors_ = true; }

  void push();  ///< throws Stop beyond limits.bracket_depth
  void pop();   ///< without a matching push: nothing

  /// A generalized cylinder: a limb along a smooth curve (Hermite's, its slopes the headings) through control
  /// points, the first of which is here; the width changes smoothly too. Until it ends draw() sets a control
  /// point at its end instead of an internode. Branches begun meanwhile are drawn as ever; ] ends what is
  /// open.
  void begin_sweep();
  /// Draws the piece up to here in `strips` internodes; outside a sweep nothing.
  void set_control(std::int64_t strips, std::uint64_t key);
  void end_sweep(std::uint64_t key);

  void open_polygon();
  void close_polygon(std::uint64_t key);
  void set_vertex();

  /// Sets an organ here; its colour is the turtle's where `color` is below 0.
  void place_organ(std::uint32_t surface, const glm::dvec3& scale, std::int32_t color, std::uint64_t key);

  void set_width(double width) { state_.width = width > 0 ? width : 0; }
  double width() const { return state_.width; }
  /// Taken off the width of every internode drawn from now on, whatever branch it stands in; not part of the
  /// state.
  void set_thinner(double by) { thinner_ = by; }
  /// What the lengths that a caller reads off its symbols are multiplied by, the turns of bare symbols too,
  /// and to which side turns go: kept here because ] restores them.
  double scale() const { return state_.scale; }
  void set_scale(double scale) { state_.scale = scale; }
  double turn_scale() const { return state_.turn_scale; }
  void set_turn_scale(double scale) { state_.turn_scale = scale; }
  /// 1, or -1 where turns go to the other side; between the two in a plant between two steps.
  double side() const { return state_.side; }
  void mirror() { state_.side = -state_.side; }

  void set_contour(std::uint8_t contour) { state_.contour = contour; }

  void set_color(std::int64_t color);
  std::int16_t color() const { return state_.color; }
  std::uint8_t contour() const { return state_.contour; }

  /// What of the state can change by degrees.
  struct Pose {
    glm::dvec3 position{0};
    Frame frame;
    double width = 0, scale = 1, turn_scale = 1, side = 1;
    std::vector<double> elasticity;
  };
  Pose pose() const;
  /// Goes back to where only a share of what has changed since `earlier` has changed, and of its turn the
  /// share `turned`.
  void take_share(const Pose& earlier, double share, double turned);
  /// Where it has moved away from its last joint and back: goes on from that joint.
  void rejoin();
  /// How much of a segment's turn by the tropisms it has, from now on; not part of the state.
  void set_pull(double share) { pull_ = share; }
  /// Limbs::share of what is drawn from now on; not part of the state.
  void set_share(double share) { share_ = static_cast<float>(share); }

  /// What a turtle draws once to set it again wherever it comes, turned and moved as a whole.
  class Stamp;
  /// Does this turtle draw what can be a stamp? Tropisms pull each copy elsewhere, and contours and anchors
  /// are not kept.
  bool can_stamp() const {
    return skeleton_ && !tropisms_ && !draws_contours_ && !tracks_anchors_ && polygons_.empty();
  }
  /// Begins to draw into the stamp, from the origin, what `like` would draw from where it is. This turtle is
  /// new and writes into stamp.skeleton; it may turn, move and draw, branch, and change width, colour and
  /// scale, but not look at where it is or where the sky is.
  void begin_stamp(const Turtle& like, Stamp& stamp);
  void end_stamp(Stamp& stamp);
  /// Would this turtle draw just that from here, but for place and direction?
  bool matches(const Stamp& stamp) const;
  /// Draws it from here, of order and place all but the last bits of what drawing itself would give. The
  /// report's bounds leave it out.
  void press(const Stamp& stamp);

  std::uint32_t last_joint() const { return state_.last; }  ///< of this branch; none before its first segment
  bool is_joined() const { return state_.joint != Limbs::none; }  ///< does the next one grow from a joint?
  /// Does the next internode start a limb of its own?
  bool begins_limb() const { return state_.begins_branch; }
  std::size_t depth() const { return stack_.size(); }  ///< brackets open
  const glm::dvec3& position() const { return state_.position; }
  const Frame& frame() const { return state_.frame; }
  const TurtleReport& report() const { return report_; }

 private:
  static constexpr std::uint16_t rotations_until_drift = 256;
  // Beyond this, positions stored as float squared in later stages would overflow; no model of anything is so
  // far away.
  static constexpr double world = 1e15;

  struct State {
    glm::dvec3 position{0};
    Frame frame;
    double width = 0;
    double scale = 1, turn_scale = 1, side = 1;
    std::uint32_t joint = Limbs::none;  ///< where the next internode grows from; none after a move
    std::uint32_t last = Limbs::none;   ///< the last joint of this branch, moves or not
    std::uint16_t order = 0;
    std::int16_t color = 0;
    std::uint16_t rotations = 0;  ///< of `frame` since it was last made orthonormal, and more
    std::uint8_t contour = 0;
    bool is_sweeping = false;
    bool begins_branch = false;  ///< the next internode starts a limb of its own
  };

  /// The last control point of a generalized cylinder.
  struct Control {
    glm::dvec3 position{0}, heading{0}, left{0};
    double width = 0;
  };

  /// Turns one axis toward another, as turn(), pitch() and roll() of frame.h do. In place and one axis after
  /// the other, for whole frames copied right after their parts were written make the processor wait.
  void rotate(glm::dvec3& from, glm::dvec3& to, const math::SinCos& angle) {
    const glm::dvec3 turned = from * angle.cos + to * angle.sin;
    to = to * angle.cos - from * angle.sin;
    from = turned;
    if (++state_.rotations % rotations_until_drift == 0) state_.frame = reorthonormalise(state_.frame);
  }
  void advance(double length);
  void add_segment(const glm::dvec3& from, double length, std::uint64_t key);
  std::uint32_t add_joint(const glm::dvec3& at, std::uint32_t parent, std::uint64_t key);
  [[noreturn]] static void reject_place();
  [[noreturn]] static void refuse_joints();
  [[noreturn]] void refuse_segments() const;
  void press_places(const Stamp& stamp);
  void press_links(const Stamp& stamp);
  void press_bark(const Stamp& stamp);
  void press_colors(const Stamp& stamp, std::size_t before);
  void go_to_end(const Stamp& stamp, std::uint32_t first);

  Skeleton* skeleton_;
  Job& job_;
  State state_;
  std::vector<State> stack_;
  Control control_;                ///< while is_sweeping
  std::vector<Control> controls_;  ///< of the states on the stack that are
  struct Polygon {
    Array<glm::dvec3> vertices;
    std::uint32_t joint;  ///< the turtle's last one when it was opened
  };
  std::vector<Polygon> polygons_;  ///< open ones, innermost last
  TurtleReport report_;
  double thinner_ = 0;
  double pull_ = 1;
  float share_ = 1;
  std::uint64_t most_segments_ = ~std::uint64_t{0};
  std::optional<Tropisms> tropisms_;
  bool tracks_anchors_ = false;
  bool draws_wires_ = false;
  bool draws_contours_ = false;
  Array<glm::dvec3>* places_ = nullptr;  ///< while a stamp is drawn: of the joints, before they are rounded
};

/// Cost: a joint pressed takes about 4 ns, as wires half of that.
class Turtle::Stamp {
 public:
  explicit Stamp(const Job& job) : skeleton(job), places_(job) {}
  Skeleton skeleton;

 private:
  friend class Turtle;
  Array<glm::dvec3> places_;
  State start_, end_;
  float radius_ = 0;         ///< of the joint that it grows from
  std::uint32_t seeds_ = 0;  ///< 1: joint 0 stands for that joint
  double reach_ = 0;         ///< greatest sum of a joint's coordinates, taken positive
  TurtleReport report_;
};

}  // namespace seedmesh

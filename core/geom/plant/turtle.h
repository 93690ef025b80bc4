#pragma once
/// The turtle of Prusinkiewicz and Lindenmayer (The Algorithmic Beauty of Plants, 1990, sections 1.3 and
/// 1.5): a position, a frame, a width and a colour, with a stack for branches and another for polygons. It
/// writes a Skeleton and measures what it draws. It does not depend on a grammar.
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/base/math.h"
#include "core/geom/plant/frame.h"
#include "core/geom/plant/limbs.h"
#include "core/geom/plant/tropism.h"

namespace seedmesh {

/// What a turtle drew, in its own frame: start at the origin, heading +Y, left -X, up +Z.
struct TurtleReport {
  std::uint64_t segments = 0;
  double total_length = 0;
  std::uint64_t vertices = 0;  ///< polygon vertices
  glm::dvec3 min{0}, max{0};   ///< box around the axes of drawn segments; zero where there are none
};

class Turtle {
 public:
  /// Writes to `skeleton`; null: only measures.
  Turtle(Skeleton* skeleton, double width, Job& job);

  /// Moves by `length`, which may be negative, along the heading. draw() adds an internode of the current
  /// width; between braces it adds a vertex instead. walk() draws nothing, but adds a vertex between braces.
  /// `key` is that of the module that draws, for Limbs::key; 0: none.
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
  void set_heading(const glm::dvec3& direction);  ///< sets the heading and rolls upright
  void set_frame(const Frame& frame);             ///< makes the axes orthonormal: keeps heading, then left
  void reset_frame();                             ///< the frame of the start: heading +Y, left -X, up +Z

  /// Limits the number of segments; without a call there is no limit.
  void set_most_segments(std::uint64_t most) { most_segments_ = most; }

  /// Turns the heading by these after every segment from now on.
  void set_tropisms(std::vector<Tropism> tropisms) { tropisms_.emplace(std::move(tropisms)); }
  /// Sets the elasticity of one tropism, or changes it by a number of its steps. Part of the state.
  void set_elasticity(std::int64_t tropism, double elasticity);
  void change_elasticity(std::int64_t tropism, double steps);

  /// Writes only position, parent and, where any is not 0, colour of each joint: enough for wires(). Call it
  /// before the first segment.
  void draw_wires() { draws_wires_ = true; }

  /// Writes Limbs::contour and Limbs::frame from now on. Call it before the first segment.
  void draw_contours() { draws_contours_ = true; }

  /// Writes Limbs::anchor from now on, for callers that move limbs later. Call it before the first segment.
  void track_anchors() { tracks_anchors_ = true; }

  void push();  ///< throws Stop beyond limits.bracket_depth
  void pop();   ///< has no effect without a matching push

  /// A generalised cylinder: a limb along a Hermite curve through control points, with the headings as slopes
  /// and a smooth width. The first control point is here. Until it ends, draw() adds a control point and the
  /// curve up to it. Branches begun meanwhile are drawn as usual. A ] ends cylinders begun in its branch.
  void begin_sweep();
  /// Adds a control point and draws the curve up to it in `strips` internodes. No effect outside a cylinder.
  void set_control(std::int64_t strips, std::uint64_t key);
  void end_sweep(std::uint64_t key);

  void open_polygon();
  void close_polygon(std::uint64_t key);
  void set_vertex();

  /// Adds an organ here. A `color` below 0 is the turtle's.
  void place_organ(std::uint32_t surface, const glm::dvec3& scale, std::int32_t color, std::uint64_t key);

  void set_width(double width) { state_.width = width > 0 ? width : 0; }
  double width() const { return state_.width; }
  /// Sets a width that is subtracted from that of every later internode, in all branches. Not part of the
  /// state.
  void set_width_reduction(double by) { width_reduction_ = by; }
  /// State kept for callers, because ] restores it: the scale of lengths, the scale of default angles, and
  /// whether left and right are exchanged.
  double scale() const { return state_.scale; }
  void set_scale(double scale) { state_.scale = scale; }
  double turn_scale() const { return state_.turn_scale; }
  void set_turn_scale(double scale) { state_.turn_scale = scale; }
  /// 1, or -1 where left and right are exchanged. Values in between interpolate two derivation steps.
  double side() const { return state_.side; }
  void mirror() { state_.side = -state_.side; }

  void set_contour(std::uint8_t contour) { state_.contour = contour; }

  void set_color(std::int64_t color);
  std::int16_t color() const { return state_.color; }
  std::uint8_t contour() const { return state_.contour; }

  /// The parts of the state that can change gradually.
  struct Pose {
    glm::dvec3 position{0};
    Frame frame;
    double width = 0, scale = 1, turn_scale = 1, side = 1;
    std::vector<double> elasticity;
  };
  Pose pose() const;
  /// Interpolates from `earlier` to the present pose: `share` is the share of all but the rotation, `turned` that of the
  /// rotation.
  void interpolate_from(const Pose& earlier, double share, double turned);
  /// Continues from the last joint if the turtle has moved away from it and back.
  void rejoin();
  /// Sets the share of the turn by tropisms that later segments get. Not part of the state.
  void set_tropism_share(double share) { tropism_share_ = share; }
  /// Limbs::share of what is drawn from now on. Not part of the state.
  void set_share(double share) { share_ = static_cast<float>(share); }

  /// A recorded drawing, which is copied as a whole at other positions and in other directions.
  class Recording;
  /// True where drawings of this turtle can be recorded: without tropisms, which bend each copy differently,
  /// and without contours and anchors, which recordings do not keep.
  bool can_record() const {
    return skeleton_ && !tropisms_ && !draws_contours_ && !tracks_anchors_ && polygons_.empty();
  }
  /// Begins a recording. Call it on a new turtle that writes to recording.skeleton. It takes the state of
  /// `like`, but starts at the origin with the initial frame. It may turn, move, draw, branch, and change
  /// width, colour and scale, but must not depend on its position or on the vertical.
  void begin_recording(const Turtle& like, Recording& recording);
  void end_recording(Recording& recording);
  /// True if this turtle would draw exactly this recording from here, apart from position and direction.
  bool matches(const Recording& recording) const;
  /// Appends a copy of the recording from here. Order and positions are those that drawing would give, except
  /// for the last bits. TurtleReport::min and max do not include it.
  void append_copy(const Recording& recording);
  /// Goes to the end of the recording without drawing it, for callers that place its drawing themselves. The next
  /// internode then starts a limb of its own. The report counts the copy; with `is_measured`, its bounds too.
  void skip_copy(const Recording& recording, bool is_measured);

  /// Last joint of this branch; none before its first segment.
  std::uint32_t last_joint() const { return state_.last; }
  bool is_joined() const { return state_.joint != Limbs::none; }  ///< the next internode continues a joint
  /// True where the next internode starts a new limb.
  bool begins_limb() const { return state_.begins_branch; }
  std::size_t depth() const { return stack_.size(); }  ///< brackets open
  const glm::dvec3& position() const { return state_.position; }
  const Frame& frame() const { return state_.frame; }
  const TurtleReport& report() const { return report_; }

  /// Whether a command would have taken a coordinate of the position beyond 1e15 metres. The caller refuses the
  /// request, since it has the module and the text that wrote it.
  bool is_out_of_range() const { return is_out_of_range_; }
  static constexpr const char* too_far = "the turtle went further than 1e15 metres from its start";

 private:
  static constexpr std::uint16_t rotations_until_drift = 256;
  // Beyond this, squares of positions would overflow in later stages.
  static constexpr double largest_coordinate = 1e15;

  struct State {
    glm::dvec3 position{0};
    Frame frame;
    double width = 0;
    double scale = 1, turn_scale = 1, side = 1;
    std::uint32_t joint = Limbs::none;  ///< joint where the next internode begins; none after a move
    std::uint32_t last = Limbs::none;   ///< the last joint of this branch, also after a move
    std::uint16_t order = 0;
    std::int16_t color = 0;
    std::uint16_t rotations = 0;  ///< number of rotations; `frame` is made orthonormal every 256
    std::uint8_t contour = 0;
    bool is_sweeping = false;
    bool begins_branch = false;  ///< the next internode starts a limb of its own
  };

  /// The last control point of a generalised cylinder.
  struct Control {
    glm::dvec3 position{0}, heading{0}, left{0};
    double width = 0;
  };

  /// Rotates one axis toward another, as turn(), pitch() and roll() of frame.h do. In place, axis by axis:
  /// copying a whole frame right after its parts were written stalls the processor.
  void rotate(glm::dvec3& from, glm::dvec3& to, const math::SinCos& angle) {
    const glm::dvec3 turned = from * angle.cos + to * angle.sin;
    to = to * angle.cos - from * angle.sin;
    from = turned;
    if (++state_.rotations % rotations_until_drift == 0) state_.frame = reorthonormalise(state_.frame);
  }
  void advance(double length);
  void add_segment(const glm::dvec3& from, double length, std::uint64_t key);
  std::uint32_t add_joint(const glm::dvec3& at, std::uint32_t parent, std::uint64_t key);
  [[noreturn]] void refuse_joints() const;
  void check_depth(std::size_t depth, const char* what) const;
  [[noreturn]] void refuse_segments() const;
  void refuse_far(const Recording& recording) const;
  void copy_positions(const Recording& recording);
  void copy_links(const Recording& recording);
  void copy_bark(const Recording& recording);
  void copy_colors(const Recording& recording, std::size_t before);
  void go_to_end(const Recording& recording, std::uint32_t first);

  Skeleton* skeleton_;
  Job& job_;
  bool is_out_of_range_ = false;
  State state_;
  std::vector<State> stack_;
  Control control_;                ///< while is_sweeping
  std::vector<Control> controls_;  ///< control points of the states on the stack that are in a cylinder
  struct Polygon {
    Array<glm::dvec3> vertices;
    std::uint32_t joint;  ///< the turtle's last joint when it was opened
  };
  std::vector<Polygon> polygons_;  ///< open ones, innermost last
  TurtleReport report_;
  double width_reduction_ = 0;
  double tropism_share_ = 1;
  float share_ = 1;
  std::uint64_t most_segments_ = ~std::uint64_t{0};
  std::optional<Tropisms> tropisms_;
  bool tracks_anchors_ = false;
  bool draws_wires_ = false;
  bool draws_contours_ = false;
  Array<glm::dvec3>* places_ = nullptr;  ///< positions of joints before rounding, while a recording is drawn
};

/// A recorded drawing. A copy takes 4 ns a joint, or 2 ns for wires.
class Turtle::Recording {
 public:
  explicit Recording(const Job& job) : skeleton(job), places_(job) {}
  Skeleton skeleton;

 private:
  friend class Turtle;
  Array<glm::dvec3> places_;
  State start_, end_;
  float radius_ = 0;                 ///< radius of the joint that it grows from
  std::uint32_t shared_joints_ = 0;  ///< 1: joint 0 represents the joint that the drawing grows from
  double reach_ = 0;                 ///< the largest sum of the absolute coordinates of a joint
  TurtleReport report_;
};

}  // namespace seedmesh

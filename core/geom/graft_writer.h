#pragma once
/// Writes the limbs of graft() in order, parents first: rings, the triangles between them, loops for the
/// children.
#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/geom/four.h"
#include "core/geom/graft.h"
#include "core/geom/graft_plan.h"

namespace seedmesh {

/// Ribs deeper than this share of the radius take more care.
inline bool has_deep_ribs(const GraftOptions& options) {
  return options.lobes > 0 && options.lobe_depth > 0.1F;
}
/// Corners of a ring with ribs that would have so many without: at least three for each. Deep ribs have as
/// many all along the limb, at least four each, at crests, in troughs and half way.
inline int with_ribs(const GraftOptions& options, int sides) {
  if (options.lobes == 0) return sides;
  if (!has_deep_ribs(options)) return std::max({sides, 3 * options.lobes, 8});
  const int corners = std::max({sides, options.sides, 4 * options.lobes});
  return (corners + options.lobes - 1) / options.lobes * options.lobes;
}

/// How a limb may be made: grown together with its parent; closed where it begins, but with limbs of its own
/// grown to it; closed all over; by skin().
enum class Trust : std::uint8_t { full, detached, closed, none };

class GraftWriter {
 public:
  struct Context {
    const Limbs& limbs;
    const Chains& chains;
    const Scale& scale;
    const GraftOptions& options;
    const std::vector<Trust>& trust;
  };
  GraftWriter(const Context& context, Job& job);

  /// Writes all limbs; the second time and on, those for which something has changed since, behind what is
  /// there. The first time on all threads that there are, unless the tree is so large that a limit may be met
  /// or the limbs are in no order that lets it be parted.
  void write_round();

  /// Makes the normals of loops, then looks at every triangle for which something has changed. Lowers the
  /// trust in limbs with faces that look against a normal or have no area, at once to none where `is_late`;
  /// returns how many faces. Those that look against a normal without a fold, or are small, are creased
  /// instead.
  std::size_t settle(std::vector<Trust>& trust, bool is_late);

  GraftCounts counts() const;
  /// As GraftOptions::grown.
  void tell_grown(Array<std::uint8_t>& grown) const;
  /// Vertices on rings, and those of them on rings of more corners than a vertex cache holds.
  std::size_t corners() const { return sum_of(&Place::corners); }
  std::size_t wide_corners() const { return sum_of(&Place::wide_corners); }

  /// What is left of all rounds, limb by limb.
  struct Written {
    Mesh mesh;
    Array<std::uint32_t> joints;  ///< of each vertex, where options.joints wants them
    /// Of each vertex, 1: it stands where one before it does, beyond the seam or as part of another limb.
    Array<std::uint8_t> twin;
    Array<std::int16_t> colors;  ///< of each triangle, where options.colors wants them
  };
  Written take();

 private:
  static constexpr std::uint32_t none = Limbs::none;

  struct Corner {
    float angle = 0;
    std::uint32_t vertex = 0;
  };
  using Corners = std::vector<Corner>;

  /// Cosines and sines of corners all round, the first again at the end, and more up to blocks of four.
  struct Circle {
    std::vector<float> x, y;
    glm::vec2 at(int corner) const {
      return {x[static_cast<std::size_t>(corner)], y[static_cast<std::size_t>(corner)]};
    }
  };
  static std::vector<Circle> circles_up_to(int most);

  /// What all writers of a tree share.
  struct Common {
    explicit Common(const Context& context);
    std::span<const Circle> circles;   ///< by number of corners
    std::vector<Circle> own_circles;   ///< where there are more than usual
    std::vector<float> corner_radius;  ///< from which on a limb has 4, 5, ... corners
    std::vector<std::uint32_t> first_child, next_sibling;
  };
  /// For `joints` of the tree.
  GraftWriter(const Context& context, std::shared_ptr<const Common> common, std::size_t joints, Job& job);

  /// The plane of a ring.
  struct Plane {
    glm::vec3 centre{0}, u{0}, v{0}, tangent{0};
    float radius = 0, at = 0;
    float v_at = 0;   ///< texture coordinate
    float slope = 0;  ///< how much the radius falls along the limb
  };

  /// A corner of an open ring before it is a vertex: of the ring itself, or a point of a loop.
  struct Mark {
    float angle = 0;
    int corner = 0;  ///< of the ring
    const LoopPoint* point = nullptr;
    std::uint32_t group = none;
    std::uint32_t vertex[2] = {none, none};  ///< before the seam and beyond it
  };

  struct LoopVertex {
    glm::vec3 position{0};
    float angle = 0, reach = 0;
    std::uint32_t group = none;
    std::uint32_t joint = none;  ///< of the parent
  };
  /// An opening that is asked for.
  struct Wish {
    std::size_t point;
    Bud bud;
    bool is_thick;
  };

  struct Loop {
    std::uint32_t first = none, count = 0;
    float radius = 0, reach = 0;
    glm::vec3 u{0};
    bool is_fork = false;
  };

  /// The normal of a group, or the sum that it is made of, in the first lanes.
  struct GroupNormal {
    FourFloats row{};
    glm::vec3 get() const { return {row[0], row[1], row[2]}; }
    void set(const glm::vec3& normal) { row = spread_out(normal); }
  };

  /// A face at a loop: its unit normal, and the groups of its corners that have changed or none.
  struct LoopFace {
    glm::vec3 normal{0};
    std::uint32_t group[3] = {none, none, none};
  };
  /// Of each chunk of limbs, one behind another with room between them.
  struct LoopFaces {
    Array<LoopFace> all;
    std::vector<std::span<const LoopFace>> chunk;
  };

  /// A place in what is written.
  struct Place {
    std::uint32_t vertex = 0, triangle = 0, group = 0;
    std::uint32_t loop_triangle = 0;
    std::uint32_t corners = 0, wide_corners = 0;
  };
  /// What belongs to a limb; `first_end`: of the triangles at the loop that it begins with.
  struct Range {
    Place begin, end;
    std::uint32_t first_end = 0;
  };
  /// A triangle that gets vertices of its own, among those of its limb.
  struct Crease {
    std::uint32_t triangle = 0, first = 0, last = 0;
  };
  /// What of a limb has to be looked at again: nothing, the faces at the loop that it begins with, all.
  enum class Concern : std::uint8_t { nothing, loop, all };
  enum class Kind : std::uint8_t { none, root, collar, fork, closed };

  void make_room(std::size_t vertices);
  /// For `count` vertices more, and for those that blocks of four write behind the last.
  void make_room_for(std::size_t count) {
    if (vertices_ + count + Four::size > mesh_.position.size())
      make_room(vertices_ + vertices_ / 2 + count + 64);
  }
  std::vector<std::uint32_t> find_parents() const;
  void find_dirty();
  void write_anew(std::uint32_t limb);
  struct Parts;
  bool is_worth_parting() const;
  Parts find_parts() const;
  bool write_parts();
  void know_loops_of(const GraftWriter& other);
  void write_part(const Parts& parts, std::size_t number);
  void take_part(const GraftWriter& part, std::uint32_t first, std::uint32_t last);
  void take_vertices(const GraftWriter& part);
  void take_loops(const GraftWriter& part, std::uint32_t first, std::uint32_t last);
  void spend_triangles(std::uint64_t count);
  bool has_same_loop(const Loop& now, const Loop& then) const;
  void forget_loops(const Range& range);
  void keep_limb(std::uint32_t limb, const Loop& then);
  void mark_touched();
  struct FaceBlock;
  static void measure(FaceBlock& block, const glm::vec3* position);
  static void weigh(FaceBlock& block);
  bool is_first() const { return parent_.empty(); }
  template <class Each>
  void each_at_loops(std::size_t limb, const Each& each) const;
  LoopFace* add_loop_normals(std::size_t first_limb, std::size_t last_limb, std::uint32_t nowhere,
                             LoopFace* to);
  LoopFace* add_loop_faces(FaceBlock& block, std::size_t count, std::uint32_t nowhere, LoopFace* to);
  LoopFaces sum_loop_normals(std::size_t chunk);
  static bool join_four(GroupNormal* normals);
  void join_loop_normals();
  bool looks_away(const LoopFace& face, std::uint32_t group) const;
  static FourFlags strained(const LoopFace* faces, const GroupNormal* normals, std::uint32_t neutral);
  static std::size_t first_strained(std::span<const LoopFace> faces, std::span<const GroupNormal> normals,
                                    std::size_t from);
  std::vector<LoopFace> strained_faces(const LoopFaces& faces);
  void ease_loop_normals(const LoopFaces& faces);
  void put_loop_normals(std::size_t limb);
  /// A normal nearer to the plane of its face than this may be found on the other side by who reckons
  /// otherwise.
  static constexpr float least_cosine_of_face = 1e-4F;
  float least_square_of_face() const;
  struct Faces;
  Faces faces() const;
  static std::size_t sound_faces(const Faces& faces, const std::uint32_t* corner, std::size_t count);
  void look_at(std::uint32_t first, std::uint32_t last, std::vector<std::uint32_t>& bad) const;
  void find_bad(std::size_t limb, std::vector<std::uint32_t>& bad) const;
  using Seams = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  std::pair<Seams::const_iterator, Seams::const_iterator> seams_of(std::size_t limb) const;
  bool has_seams(std::size_t limb) const {
    const auto [first, last] = seams_of(limb);
    return dirty_[limb] && first != last;
  }
  bool have_seams(std::size_t begin, std::size_t end) const {
    for (std::size_t limb = begin; limb < end; ++limb) {
      if (has_seams(limb)) return true;
    }
    return false;
  }
  void settle_ribs(std::size_t limb);
  bool can_be_creased(std::uint32_t triangle, std::size_t limb) const;
  std::vector<Crease> creases_at_last() const;
  void write_creases(const std::vector<Crease>& creases, Written& to) const;
  bool blame(const std::uint32_t* corner, std::vector<Trust>& trust, bool is_late) const;
  std::size_t take_blame(const std::vector<std::vector<std::uint32_t>>& bad, std::vector<Trust>& trust,
                         bool is_late);
  void find_concerned();
  void share_out(std::size_t count, std::size_t chunk,
                 const std::function<void(std::size_t, std::size_t, std::size_t)>& body) const;
  bool is_touched(const std::uint32_t* corner) const;
  std::uint32_t last_triangle(std::size_t limb) const;
  Place here() const;
  std::uint32_t sum_of(std::uint32_t Place::*what) const;
  bool is_in_order() const;
  template <class T>
  Array<T> gathered(Array<T>& from, std::uint32_t Place::*what) const;
  Array<std::uint32_t> gathered_index() const;

  void write_limb(std::uint32_t limb);
  void plan_children(float start);
  Bud bud_of(std::uint32_t child) const;
  void tell_drawn(float start);
  glm::vec3 upward_of(std::uint32_t limb) const;
  void begin_closed(bool is_root, std::uint32_t limb);
  glm::vec3 level_foot(Plane& plane);
  void note_seam(const Corners& ring);
  void begin_loop(const Loop& loop);
  void write_band(const Band& band);
  void write_tip(float end_radius);
  void paint(float at);
  Plane plane_of(const Band& band) const;
  Plane plane_at(float at, std::size_t piece) const;
  int corners_for(float radius) const;
  int sides_for(float radius) const;
  bool has_ribs() const { return axis_.order == 0 && context_.options.lobes != 0; }
  float ribbed(float angle) const;
  std::uint32_t ring_corner(const Plane& plane, float angle, glm::vec2 direction);
  std::uint32_t loop_corner(const Mark& mark, float angle);
  glm::vec2 picture_at(float radius, float angle, float at) const;
  void stand_at(float at);
  float by_seam(float angle) const;
  void set_seam(float angle);
  std::uint32_t group_for(const LoopPoint& point, std::uint32_t child);
  std::uint32_t vertex_of(Mark& mark, const Plane& plane, bool is_beyond);
  void go_round(Corners& order, const Plane& plane, Corners& out);
  void plain_ring(const Plane& plane, Corners& out);
  /// Places and normals of corners, those of a mesh or apart.
  struct RingRoom {
    glm::vec3 *position, *normal;
    glm::vec4* tangent;  ///< null: none are wanted
  };
  bool write_ring_block(const Plane& plane, const Circle& circle, std::size_t first,
                        const RingRoom& to) const;
  bool write_ring(const Plane& plane, int sides, const RingRoom& to) const;
  void triangles_to(std::uint32_t apex, bool is_below);
  glm::vec2 turned_to_seam(const glm::vec2& c) const {
    return {c.x * seam_turn_.x - c.y * seam_turn_.y, c.x * seam_turn_.y + c.y * seam_turn_.x};
  }
  float picture_width(float radius) const { return turns_ > 0 ? turns_ : radius; }
  void open_ring(const Plane& plane, const Band& band);
  void strip(const Corners& below, const Corners& above, bool is_even);
  static void write_quads(const Corners& below, const Corners& above, const glm::vec3* position,
                          std::uint32_t* out);
  static void write_strip(const Corners& below, const Corners& above, float farthest,
                          const glm::vec3* position, std::uint32_t* out);
  void note_loop_triangles(std::size_t first);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  std::uint32_t vertex(const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv,
                       std::uint32_t group) {
    make_room_for(1);
    return put_vertex(position, normal, uv, group);
  }
  /// `tangent`: null where it is not known yet.
  std::uint32_t put_vertex(const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv,
                           std::uint32_t group, const glm::vec4* tangent = nullptr);
  void mark_twin() { twin_[vertices_ - 1] = 1; }
  bool has_tangents() const { return context_.options.tangents; }
  void stand_on(const Plane& plane) {
    along_ = plane.tangent;
    on_axis_ = plane.centre;
  }
  void lay_tangent(Mesh& mesh, std::size_t vertex) const;

  Context context_;
  std::shared_ptr<const Common> common_;
  Job& job_;
  Meter triangles_;
  Mesh mesh_;                 ///< with more room than `vertices_`, so that all can be read as four floats
  std::size_t vertices_ = 0;  ///< that are written
  Array<std::uint32_t>
      group_;  ///< of each vertex; those on a loop share a normal: even the parent's, odd the child's
  Array<GroupNormal> group_normal_;
  std::vector<std::uint32_t> group_limb_;  ///< the child of each pair of groups
  Array<std::uint32_t> loop_triangles_;    ///< those that touch a loop, rising
  std::vector<Range> range_;               ///< of each limb
  std::vector<Kind> kind_;                 ///< of each limb
  std::vector<std::uint32_t> parent_;      ///< of each limb; empty in the first round, where all are dirty
  std::vector<std::uint8_t> dirty_;        ///< limbs that were written in this round
  std::vector<std::uint8_t> touched_;      ///< pairs of groups of a dirty limb
  std::vector<Concern> concern_;           ///< of each limb
  /// First and last vertex of each ring with ribs, which stand at one place, rising.
  Seams rib_seams_;
  std::vector<std::uint32_t> creased_;  ///< triangles that get vertices of their own, unless they are no more
  bool is_much_ = true;                 ///< of what has to be looked at
  Array<std::uint32_t> joints_;         ///< as Written::joints
  Array<std::uint8_t> twin_;            ///< as Written::twin
  Array<std::int16_t> colors_;          ///< as Written::colors
  std::vector<Trust> trust_;            ///< as it was in the last round
  std::vector<Loop> loops_;
  Array<LoopVertex> loop_vertices_;

  // Of who writes a part.
  bool is_part_ = false;
  std::uint64_t made_ = 0;                                 ///< triangles, which whoever takes the part spends
  std::uint32_t first_group_ = 0, first_loop_vertex_ = 0;  ///< of the part: before are its parents'

  // Of the limb being written.
  GraftAxis axis_;
  GraftPlan plan_;
  Corners below_, lower_, upper_;
  std::vector<Mark> marks_;
  std::vector<glm::vec3> ring_position_,
      ring_normal_;  ///< of the open ring's corners, where they have no ribs
  std::vector<glm::vec4> ring_tangent_;
  bool is_ring_known_ = false;         ///< are they?
  Corners lower_order_, upper_order_;  ///< whose "vertex" is a mark
  std::vector<Wish> wishes_;
  std::vector<const LoopVertex*> loop_order_;
  Phases phases_;
  std::size_t near_piece_ = 0;  ///< of the axis, near what is written
  float seam_ = 0;
  glm::vec2 seam_turn_{1, 0};  ///< its cosine and sine
  int least_sides_ = 3, loop_sides_ = 0;
  glm::vec3 along_{0, 1, 0}, on_axis_{0};  ///< the limb's axis where it is written
  float turns_ = 0;                        ///< of the picture round the limb, by a radian; 0: u is in metres
  std::uint32_t joint_ = none;             ///< what the vertices being written move with
  bool is_at_loop_ = false;                ///< the ring `below_`
  std::size_t corners_ = 0, wide_corners_ = 0;
};

}  // namespace seedmesh

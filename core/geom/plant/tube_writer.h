#pragma once
/// A sink of walk_limb() that writes vertices and triangles to the arrays of the meshes.
///
/// Frames turn by the least rotation from one internode to the next. For straight pieces, this is the
/// rotation-minimising frame (Wang, Juettler, Zheng and Liu, "Computation of Rotation Minimizing Frames", 2008).
#include <vector>

#include "core/geom/plant/tube_count.h"

namespace seedmesh {

/// Tables that all tubes of one skin() share: there is no trigonometry for each ring and no division for each
/// index.
struct TubeTables {
  TubeTables() = default;
  TubeTables(const CrossSection& section, std::span<const Contour> outlines);

  /// Adjacent quads of a tube, six corners each, counted from the first vertex of the lower ring. Their
  /// triangles are written together along the limb, so that two rings at a time stay in the vertex cache.
  using Column = std::vector<std::uint32_t>;
  std::vector<glm::vec2> circle;  ///< cosine and sine of each corner
  /// Outlines of the circle and of SkinOptions::contours; or empty.
  std::vector<std::vector<ContourCorner>> contours;
  std::vector<glm::vec2> coarse_phases, fine_phases;  ///< the angles that a tube may start with
  glm::vec2 half_side{1, 0};                          ///< the angle of half a side
  /// For tubes that begin with a fan, which brings the first ring into the cache.
  std::vector<Column> columns;
  std::vector<Column> narrow_columns;  ///< columns for tubes that do not begin with a fan
};

/// The arrays for the tubes of one colour, and the next free vertex and index.
struct TubeCursor {
  glm::vec3* position = nullptr;
  glm::vec3* normal = nullptr;
  glm::vec2* uv = nullptr;  ///< null: no texture coordinates
  std::uint32_t* index = nullptr;
  std::size_t vertex = 0;
  std::size_t corner = 0;
  std::uint16_t* bone = nullptr;  ///< null: no bones
};

class TubeWriter {
 public:
  struct Context {
    const Limbs& limbs;
    const Chains& chains;
    const Scale& scale;
    const Palette& palette;
    const SkinOptions& options;
    /// Tables, indexed by number of sides; empty for numbers that no limb has.
    const std::vector<TubeTables>& tables;
  };

  TubeWriter(const Context& context, TubeCursor* cursors)
      : context_(context), section_(context.options, context.options.sides), cursors_(cursors) {}

  /// Begins a limb: its v starts at 0.
  void begin_limb(LimbCorners corners) {
    section_ = CrossSection(context_.options, corners.current);
    finest_sides_ = corners.finest;
    v_so_far_ = 0;
    turns_ = 0;
  }

  void open(const Internode& first, TubeOpening opening);
  void join(const Turn& turn, const Internode& next);
  void close(TubeClosing closing, float free);

 private:
  /// The flank of a cone: cosine and sine of the angle by which its normals lean toward the limb's end.
  using Slope = glm::vec2;

  struct Ring {
    glm::vec3 centre{0};
    /// Vectors to the corners at 0 and 90 degrees, radius and mitre included.
    glm::vec3 side_u{0}, side_v{0};
    glm::vec3 normal_u{0}, normal_v{0};  ///< unit vectors in the ring's plane
    glm::vec3 tangent{0};
    float radius = 0;
    float v = 0;
    std::uint32_t joint = 0;  ///< the internode that it moves with
    Slope before{0};          ///< 0: nothing before, a hard edge
    std::int16_t next_color = 0;
    std::uint8_t contour = 0, next_contour = 0;
    float blend = 0;         ///< the weight of the next contour
    float spin = 0;          ///< spin of the internode before (spin_of)
    bool is_turned = false;  ///< must still be turned by half a side
    float sides_on = 0;      ///< the number of sides that it was turned by
  };

  /// The flank of the current internode: from the ring where it begins to radius `end` at `length`. Inner
  /// rings lie between `low` and `high`.
  struct Taper {
    float end = 0, length = 0, low = 0, high = 0;
  };

  /// The triangles of one colour between two ends.
  struct Piece {
    std::size_t first_ring = 0;  ///< its first vertex
    std::uint32_t rings = 0;
    std::uint32_t start_apex = Limbs::none, end_apex = Limbs::none;
    bool is_twisted = false;
  };

  Ring plain_ring(const glm::vec3& centre, float radius, float v) const;
  void turn_on(float way, float radius);
  Ring turned(const Ring& ring) const;
  void start_frame(const glm::vec3& along, std::uint64_t hash);
  const TubeTables& tables() const { return context_.tables[section_.sides]; }
  bool has_contours() const { return !tables().contours.empty(); }
  std::uint8_t first_contour(std::uint32_t joint) const;
  std::uint8_t last_contour(std::uint32_t joint) const;
  void twist(const glm::vec3& side);
  ContourCorner corner(const Ring& ring, std::uint32_t k) const;
  void write_contour(const Ring& ring, Slope after);
  void set_texture_rate(const Internode& internode);
  void begin_piece(std::int16_t color);
  void end_piece();
  template <class WantsOther>
  void split_otherwise(std::size_t first_corner, const WantsOther& wants_other);
  void split_by_shorter(std::size_t first_corner);
  void split_by_turns(std::size_t first_corner);
  void write_disc(const Ring& ring);
  void write_flat(const Ring& ring, float way);
  void write_ring(const Ring& ring, Slope after);
  void write_pending_ring(Slope after);
  void write_inner_rings(const Taper& taper);
  std::uint32_t write_apex(const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv);
  void write_bones(std::size_t first, std::size_t count, std::uint32_t joint);
  float half_round(float radius) const;
  std::uint64_t hash_of(std::uint32_t joint) const;
  float nudge(std::uint64_t hash, float radius) const;

  Context context_;
  CrossSection section_;
  std::uint32_t finest_sides_ = 0;  ///< number of sides of the limb at the finest level
  TubeCursor* cursors_;
  TubeCursor* here_ = nullptr;
  Piece piece_;
  Ring pending_ring_;  ///< the last ring: its normals depend on what follows
  bool has_pending_ring_ = false;
  bool is_turned_ = false;            ///< was the last ring turned by half a side?
  std::vector<bool> is_ring_turned_;  ///< whether each ring of the piece is turned, where rings may be turned
  Internode internode_;               ///< the current one
  float radius_ = 0;                  ///< radius of the ring where it begins
  float reach_ = 0;                   ///< reach of that ring's mitre
  /// Direction u of the frame at the current internode's end; v is along x u.
  glm::vec3 u_{0};
  glm::vec3 first_u_{0};  ///< direction u at its beginning
  float spin_ = 0;        ///< spin of the current internode, where it is visible
  float twist_ = 1;       ///< cosine of the angle between the two, where it is visible
  /// Texture coordinate v of the limb up to the beginning of the current internode.
  float v_so_far_ = 0;
  float v_per_metre_ = 1;        ///< v of the current internode for each metre
  float first_v_per_metre_ = 1;  ///< v for each metre at the beginning of the limb
  float turns_ = 0;              ///< repetitions of a wrapped texture around the limb; 0: not chosen yet
};

}  // namespace seedmesh

#pragma once
/// The triangles of the parts of a city: their surfaces, and the walls, kerbs and quays between parts of
/// different heights. Parts share all vertices along their common edges.
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/surface.h"
#include "core/geom/polygon/triangulate.h"
#include "core/model/mesh.h"

namespace seedmesh::city {

/// Collects the triangles of one mesh of the ground, until take().
class GroundMesh {
 public:
  /// With textures, pedestrian crossings and lane lines get coordinates for the textures of their stripes.
  GroundMesh(const CityPlan& plan, const Surface& surface, bool has_textures, const Job& job);

  /// Adds the surface of a part, with texture coordinates in metres east and north.
  void add_part(std::uint32_t part);

  /// Adds a layer of the carriageway of a street: the surface without markings, stop lines, pedestrian crossings,
  /// or the lines between lanes. Texture coordinates are metres along and across the street. Along lane lines
  /// they increase by 1 for each dash and its gap, and across crossings for each bar and its gap. If the
  /// carriageway has no strips, all of it belongs to the layer `asphalt`.
  enum class StreetLayer { asphalt, stop_lines, crossings, lane_lines };
  void add_carriageway(std::uint32_t part, StreetLayer layer);

  /// Adds the upright faces along edges where the part on the other side is lower, for example kerbs. Texture
  /// coordinates are metres along the edge and upwards.
  void add_walls(std::uint32_t part);

  /// Adds the foundation below a building: upright faces from the lowest ground to its floor, 3 mm to 10 cm outside of
  /// its walls.
  void add_foundation(const Footing& footing);

  std::uint64_t triangles() const { return (welded_.index.wide.size() + mesh_.index.wide.size()) / 3; }
  bool is_empty() const { return triangles() == 0; }

  /// Merges equal vertices of the triangles that were added last, once there are many, so that they take less memory.
  void weld_if_large(Job& job);
  Mesh take(Job& job);

 private:
  /// A strip of a carriageway: the lines across it at both ends, and the vertices on each line as shares of the
  /// length of that line.
  struct StripSides {
    CrossLine start, end;
    std::vector<double> start_shares, end_shares;
    std::vector<glm::dvec2> start_corner, end_corner;  ///< nodes on the border of the area
    double station = 0, length = 0;                    ///< position and length along the street, metres
    /// Texture coordinate at the start, and its increase for each metre.
    double first_dash = 0, dashes_a_metre = 1;
    double periods_across = 0;  ///< repetitions of the texture across a crossing; 0: metres
  };
  void set_sides(const Part& part, std::size_t strip, double station);
  void add_strip(std::uint32_t part, const StripPiece& piece);
  void add_inner_points(const Part& part);
  /// An edge of a part, and what lies to the right of it.
  struct WallEdge {
    std::uint32_t beyond = 0;  ///< part on the other side; no_index: none
    bool is_left_out = false, is_short = false;
    glm::vec3 normal{0};
  };
  /// The lower and the upper end of a wall at one position.
  struct WallPoint {
    glm::dvec2 at{0};
    double low = 0, high = 0, along = 0;
    glm::vec3 normal{0};
  };
  void add_walls_of(std::uint32_t part, const CmRing& ring);
  void add_wall(WallPoint a, WallPoint b);
  double low_height(std::uint32_t part, std::uint32_t beyond, const glm::dvec2& at) const;
  std::uint32_t add_vertex(const glm::dvec2& p, double height, const glm::vec3& normal, const glm::vec2& uv);
  void add_triangles(std::uint32_t first);
  void append_last();

  const CityPlan& plan_;
  const Surface& surface_;
  bool has_textures_;
  const Job& job_;
  /// Twice the least area of a triangle seen from above, in square metres. Triangles of at most this area are left
  /// out, because corners on a straight border make triangles that cover nothing.
  float least_ = 0;
  Mesh welded_, mesh_;  ///< triangles added first, with shared vertices; triangles added last
  Triangulator triangulator_;
  // Memory that is kept from one part to the next.
  std::vector<glm::dvec2> points_, between_, inner_;
  std::vector<std::uint32_t> sizes_, corners_;
  StripSides sides_;
  std::vector<StripPiece> pieces_before_, pieces_, pieces_after_;
  std::vector<glm::vec2> uv_;
  std::vector<glm::vec3> normals_;
  std::vector<WallEdge> wall_edges_;
};

}  // namespace seedmesh::city

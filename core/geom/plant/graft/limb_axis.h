#pragma once
/// The centre line of one limb: points, lengths, radii, texture coordinates, and frames of least rotation.
///
/// The frames are rotation-minimising for straight pieces (Wang, Juettler, Zheng and Liu, "Computation of
/// Rotation Minimizing Frames", 2008).
#include <vector>

#include "core/base/quick_math.h"
#include "core/geom/plant/chains.h"
#include "core/geom/plant/tube_formulas.h"

namespace seedmesh {

struct LimbAxis {
  std::vector<glm::vec3> point;
  std::vector<float> at;             ///< length along the limb up to each point, metres
  std::vector<float> radius;         ///< radius at each point
  std::vector<float> v;              ///< texture coordinate along the limb at each point
  std::vector<std::uint32_t> joint;  ///< joint of Limbs, for each point
  std::vector<std::int16_t> color;   ///< colour of each piece; filled by read_colors()
  /// For each piece, its direction, and a unit vector at right angles to it.
  std::vector<glm::vec3> along, u;
  int order = 0;

  /// A piece is the straight part between two points; there is one piece fewer than points.
  std::size_t pieces() const { return along.size(); }
  float length() const { return at.back(); }
  glm::vec3 aside(std::size_t piece) const { return glm::cross(along[piece], u[piece]); }

  /// Returns the piece that contains the length `s`; the search starts at piece `from`.
  std::size_t piece_at(float s, std::size_t from) const;
  /// The same as piece_at(s, 0), searched near `hint`: of two pieces that meet at `s` the first.
  std::size_t first_piece_at(float s, std::size_t hint) const {
    std::size_t piece = hint < pieces() ? hint : pieces() - 1;
    while (piece > 0 && s <= at[piece]) --piece;
    while (piece + 1 < pieces() && s > at[piece + 1]) ++piece;
    return piece;
  }
  glm::vec3 point_at(float s) const {
    const std::size_t piece = piece_at(s, 0);
    return point[piece] + along[piece] * (s - at[piece]);
  }
  float radius_at(float s, std::size_t piece) const { return at_length(radius, s, piece); }
  /// The texture coordinate at `s`, extrapolated from `piece` beyond both ends.
  float v_at(float s, std::size_t piece) const { return at_length(v, s, piece); }

  /// Reads the limb that begins with `head`. Pieces shorter than `shortest` are skipped. Returns false where
  /// no piece is left.
  bool read(const Limbs& limbs, const Chains& chains, std::uint32_t head, float shortest);
  void read_colors(const Limbs& limbs);
  /// True where the limb changes its colour at an inner point.
  bool is_border(std::size_t inner) const { return !color.empty() && color[inner] != color[inner - 1]; }
  /// Sets `v`: the length itself where `turns` is 0, else the length times `turns` divided by texture_radius().
  void set_v(float turns, float least_repeats = 1);
  /// Sets `u` of all pieces from that of the first one, by the least rotation from piece to piece.
  void set_frames(const glm::vec3& first);

 private:
  float at_length(const std::vector<float>& values, float s, std::size_t piece) const {
    const float share = (s - at[piece]) / (at[piece + 1] - at[piece]);
    return values[piece] + (values[piece + 1] - values[piece]) * share;
  }
  void resize(std::size_t points);
};

/// Rotates `u`, which is at right angles to the unit vector `from`, by the least rotation that takes `from` to
/// the unit vector `to`. Returns any vector at right angles to `to` where the two are opposite.
glm::vec3 least_rotation(glm::vec3 u, const glm::vec3& from, const glm::vec3& to);

/// Normalises a vector. One that is a unit vector except for rounding takes one step of Newton's method,
/// without a root. `otherwise()` is returned for a vector without a direction.
template <class Otherwise>
glm::vec3 unit_again(const glm::vec3& v, const Otherwise& otherwise) {
  const float square = glm::dot(v, v);
  if (square > 0.999F && square < 1.001F) return v * (1.5F - 0.5F * square);
  return math::unit_or(v, otherwise);
}

}  // namespace seedmesh

#pragma once
/// The centre line of one limb for graft(): points, lengths, radii, and frames that turn the least.
#include <vector>

#include "core/base/quick_math.h"
#include "core/geom/chains.h"

namespace seedmesh {

struct GraftAxis {
  std::vector<glm::vec3> point;
  std::vector<float> at;      ///< length along the limb up to each point
  std::vector<float> radius;  ///< at each point
  std::vector<float> v;       ///< texture coordinate along the limb at each point
  std::vector<std::uint32_t> joint;
  std::vector<std::int16_t> color;  ///< of the piece after each point but the last, where it was read
  std::vector<glm::vec3> along, u;  ///< of the piece after each point but the last: unit, at right angles
  int order = 0;

  std::size_t pieces() const { return along.size(); }
  float length() const { return at.back(); }
  glm::vec3 aside(std::size_t piece) const { return glm::cross(along[piece], u[piece]); }

  /// The piece that holds `s`, looked for from piece `from`.
  std::size_t piece_at(float s, std::size_t from) const;
  /// piece_at(s, 0), looked for near `hint`: of two pieces that meet at `s` the first.
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
  float radius_at(float s, std::size_t piece) const {
    const float share = (s - at[piece]) / (at[piece + 1] - at[piece]);
    return radius[piece] + (radius[piece + 1] - radius[piece]) * share;
  }

  /// The texture coordinate at `s` of `piece`, which goes on beyond both ends.
  float v_at(float s, std::size_t piece) const {
    const float share = (s - at[piece]) / (at[piece + 1] - at[piece]);
    return v[piece] + (v[piece + 1] - v[piece]) * share;
  }

  /// Reads the limb that begins with `head`; pieces shorter than `shortest` are passed over. False: there is
  /// nothing of it.
  bool read(const Limbs& limbs, const Chains& chains, std::uint32_t head, float shortest);
  /// Reads the colours of the pieces, after read().
  void read_colors(const Limbs& limbs);
  /// Does the limb change its colour at an inner point?
  bool is_border(std::size_t point_) const { return !color.empty() && color[point_] != color[point_ - 1]; }
  /// Texture coordinates: the length itself, or for `turns` > 0 the length times that by the radius.
  void stretch(float turns);
  /// Frames from a first direction at right angles to the first piece.
  void carry(const glm::vec3& first);

 private:
  void resize(std::size_t points);
};

/// A unit vector at right angles to the unit vector `along`.
glm::vec3 any_aside(const glm::vec3& along);

/// A vector that is of unit length but for rounding, once more: by a step of Newton's, without a root or a
/// quotient to wait for. Another is made a unit one, or is otherwise() where it has no direction.
template <class Otherwise>
glm::vec3 unit_again(const glm::vec3& v, const Otherwise& otherwise) {
  const float square = glm::dot(v, v);
  if (square > 0.999F && square < 1.001F) return v * (1.5F - 0.5F * square);
  return math::unit_or(v, otherwise);
}

}  // namespace seedmesh

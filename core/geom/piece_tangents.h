#pragma once
/// Tangents of a mesh of many equal pieces with one picture, as leaves are: sixteen pieces at once, lane by
/// lane the same bits as one by one (tangents.cpp).
#include <vector>

#include "core/geom/repeats.h"
#include "core/model/mesh.h"

namespace seedmesh {

class PieceTangents {
 public:
  /// The mesh has its tangents' room.
  PieceTangents(Mesh& mesh, const Array<glm::vec2>& uv, const Repeats& one);

  static constexpr std::size_t lanes = 16;  ///< pieces of a block

  /// Writes pieces from `begin` on, in whole blocks before `end`, as long as all is ordinary; returns the
  /// first that it has not written. That and the others are the caller's.
  std::size_t write_all(std::size_t begin, std::size_t end) const;

 private:
  /// A triangle of all pieces.
  struct Triangle {
    std::uint32_t corner[3];
    glm::vec2 s, t;  ///< its sides in the picture
    float sign;      ///< of its area there, never 0
  };
  bool have_same_picture(std::size_t first_piece) const;
  bool write_block(std::size_t first_piece) const;

  Mesh& mesh_;
  const Array<glm::vec2>& uv_;
  Repeats one_;
  std::vector<Triangle> triangles_;
};

}  // namespace seedmesh

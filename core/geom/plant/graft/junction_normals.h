#pragma once
/// The normal solver for loops: normals that both surfaces of a junction share.
///
/// Rings have normals by formula; vertices on loops do not. A loop's normal is the mean of two normals,
/// one of each surface. Each of these is the mean of the faces weighted by their angle at the vertex (Thürmer
/// and Wüthrich, "Computing vertex normals from polygonal facets", 1998). It is then turned, where possible, until its
/// dot product with the normal of each of its faces is positive.
#include <span>

#include "core/geom/plant/graft/bark_rounds.h"

namespace seedmesh {

/// A face at a loop: its unit normal, and the groups of its corners on changed loops or Limbs::none.
struct LoopFace {
  glm::vec3 normal{0};
  std::uint32_t group[3] = {Limbs::none, Limbs::none, Limbs::none};
};

/// Faces and their corner angles, sixteen at a time.
struct FaceBlock {
  static constexpr std::size_t most = 16;
  std::uint32_t corner[3 * most];  ///< input: 16 faces; the caller repeats one where there are fewer
  Float4 normal[most],
      unit[most];         ///< output: `normal` has the length of twice the area, `unit` the length 1
  float size[most];       ///< output: twice the area
  float weight[3][most];  ///< output: the angle at each corner in radians, divided by `size`
};

/// Fills a block. Angles are exact within 2e-5 radians. Reads one float beyond the end of each position, which must be
/// readable memory.
void measure_faces(FaceBlock& block, const glm::vec3* position);

/// Turns normals, each of which belongs to several faces, until none faces away from one of its faces. There are at
/// most 24 passes over the faces. `normals` is indexed by group; entries of odd groups are not used. Linear time
/// where no normal has to turn.
void relax_normals(std::span<const LoopFace> faces, std::span<GroupNormal> normals);

/// Computes the normals of all changed loops (BarkRounds::touched), as group normals.
void solve_junction_normals(BarkBuffers& bark, const BarkRounds& rounds, const Job& job);

/// Writes the group normals to the vertices of a limb, and their tangents.
void store_junction_normals(BarkBuffers& bark, const BarkRounds& rounds, std::size_t limb);

/// Returns the number of limbs in one task, for `limbs` limbs in all.
std::size_t limbs_a_chunk(std::size_t limbs);

}  // namespace seedmesh

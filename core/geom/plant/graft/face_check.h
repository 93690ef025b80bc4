#pragma once
/// Finds triangles that are too small or face away from a normal, and decides which limbs are written again.
#include <vector>

#include "core/geom/plant/graft/bark_rounds.h"

namespace seedmesh {

/// The least cosine between a face and its normals. The margin is large enough that programs with other
/// rounding still find the normal on the same side of the face.
constexpr float least_face_cosine = 1e-4F;

/// A face is sound if (2 * area)^2 is above `least_square`, and the cosine between it and each of its vertex
/// normals is at least least_face_cosine.
struct FaceCheck {
  const glm::vec3 *position, *normal;
  float least_square;
};

/// Returns the least squared size of a face (twice its area) for a model of this size, Scale::size.
float least_face_square(float model_size);

/// Adds to `bad` the numbers of those triangles from `first` to `last - 1` that are not sound. `index` has
/// the corners of all triangles. Requires a readable float after each element of `position`, because four
/// floats are loaded. 2 ns a triangle.
void find_bad_faces(const FaceCheck& check, const std::uint32_t* index, std::uint32_t first,
                    std::uint32_t last, std::vector<std::uint32_t>& bad);

/// The results of checks so far, which check_round() extends.
struct BarkRepairs {
  std::vector<JoinMode>& join;          ///< by limb
  std::vector<std::uint32_t>& creased;  ///< faces with vertices of their own
  bool is_late = false;                 ///< whether limbs with defects get the simplest join mode
};

/// Computes and stores the normals of changed loops, then checks the faces for which something has changed.
/// Bad faces that are not folded over, or are too small to be seen, are added to `creased` and get vertices
/// of their own. Any other bad face changes join modes. If it touches loops, their child limbs become at
/// least `detached` (`closed` if `is_late`); otherwise its own limb becomes `closed`, or `none` if it is
/// closed or `is_late`. Returns the number of these faces; 0: the bark is sound except for creases.
std::size_t check_round(const GraftInput& in, BarkBuffers& bark, const BarkRounds& rounds,
                        const BarkRepairs& repairs, const Job& job);

}  // namespace seedmesh

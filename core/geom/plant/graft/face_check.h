#pragma once
/// The checker: finds faces that are too small or face away from a normal, and decides what is made anew.
#include <vector>

#include "core/geom/plant/graft/bark_rounds.h"

namespace seedmesh {

/// The least cosine between a face and its normals. Readers of the file with other rounding find the same
/// side.
constexpr float least_face_cosine = 1e-4F;

/// What makes a face sound: twice its area squared is above `least_square`, and its normals have at least
/// least_face_cosine to it.
struct FaceCheck {
  const glm::vec3 *position, *normal;
  float least_square;
};

/// The least squared size of a face (twice its area) for a model of this size, Scale::size.
float least_face_square(float model_size);

/// Adds to `bad` the numbers of those triangles from `first` to `last - 1` that are not sound. `index` holds
/// the corners of all triangles. Reads a float behind each position. 2 ns a triangle.
void find_bad_faces(const FaceCheck& check, const std::uint32_t* index, std::uint32_t first,
                    std::uint32_t last, std::vector<std::uint32_t>& bad);

/// Checks all faces for which something has changed, after their loops' normals have been computed and
/// stored. Bad faces without a fold, or too small to be seen, are added to `creased`. Other bad faces lower
/// the join mode of their limbs: to the next mode, or where `is_late` at once to JoinMode::none. Returns the
/// number of the latter faces; 0: the bark is sound except for creases.
std::size_t check_round(const GraftInput& in, BarkBuffers& bark, const BarkRounds& rounds,
                        std::vector<JoinMode>& join, std::vector<std::uint32_t>& creased, bool is_late,
                        const Job& job);

}  // namespace seedmesh

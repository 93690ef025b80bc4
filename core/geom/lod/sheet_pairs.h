#pragma once
/// The leaves of a mesh, and which of them two levels of detail have in common.
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// The pieces of a mesh of leaves: triangles that share vertices. Texture coordinates span each leaf, with v = 1 at the
/// stalk. The mesh is borrowed.
class Sheets {
 public:
  Sheets(const Mesh& mesh, const Job& job);

  /// The frame of a leaf. Levels of detail scale leaves about their stalk and may flatten them.
  struct Frame {
    glm::vec3 stalk{0}, along{0}, across{0}, face{0};  ///< all but the stalk have unit length
    float length = 0;
  };

  std::size_t size() const { return begin_.size() - 1; }
  std::span<const std::uint32_t> triangles(std::size_t sheet) const {
    return {triangle_.data() + begin_[sheet], begin_[sheet + 1] - begin_[sheet]};
  }
  /// Returns the point with these texture coordinates. Outside of the leaf the nearest triangle continues.
  glm::vec3 at(std::size_t sheet, const glm::vec2& uv) const;
  Frame frame(std::size_t sheet) const;

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> begin_;     ///< start of each sheet in `triangle_`, and the end
  std::vector<std::uint32_t> triangle_;  ///< numbers of triangles, sheet by sheet
};

/// Returns, for each leaf of `fine`, the same leaf of `coarse`, or coarse.size() if there is none. Each leaf is used
/// once. Leaves are compared by their frames, the most similar ones first.
std::vector<std::uint32_t> paired_sheets(const Sheets& fine, const Sheets& coarse, const Job& job);

}  // namespace seedmesh

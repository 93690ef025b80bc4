#include "core/generators/fractal/sides.h"

namespace seedmesh::fractal {

void CornerRows::write(const Solid& solid, int slice, const SideColors* colors, Mesh& mesh, std::size_t at) {
  const int normal = side_.world_normal(), rows = side_.world_rows(), bits = side_.world_bits();
  glm::vec3 up(0);
  up[normal] = static_cast<float>(side_.step);
  const auto along = [&](int axis, int index) {
    return static_cast<float>(solid.origin[axis] + solid.cell[axis] * index);
  };
  numbers_.resize(bits_.size());
  glm::vec3 p(0);
  p[normal] = along(normal, slice + (side_.step > 0 ? 1 : 0));
  for (int r = 0; r < static_cast<int>(rows_); ++r) {
    p[rows] = along(rows, r);
    const std::uint64_t* corners = row(r);
    for (std::size_t w = 0; w < words_; ++w) {
      numbers_[static_cast<std::size_t>(r) * words_ + w] = static_cast<std::uint32_t>(at);
      for (std::uint64_t left = corners[w]; left != 0; left &= left - 1) {
        p[bits] = along(bits, static_cast<int>(w) * 64 + std::countr_zero(left));
        mesh.position[at] = p;
        mesh.normal[at] = up;
        if (colors) mesh.color[at] = (*colors)[side_.number()];
        ++at;
      }
    }
  }
}

}  // namespace seedmesh::fractal

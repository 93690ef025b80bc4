#pragma once
/// The materials of a model, ready for drawing.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"
#include "core/texture/texels.h"

namespace seedmesh::render {

struct Surface {
  glm::vec3 color{1};  ///< linear; multiplies the texels
  float alpha = 1;
  const texture::Texels* texels = nullptr;  ///< null: none
  int uv_set = 0;
  bool repeat = true;
  bool both_sides = false;
  bool blends = false;  ///< what is behind shines through
  bool unlit = false;
  float roughness = 1, metallic = 0, transmission = 0;
  glm::vec3 emissive{0};
};

/// Surfaces by the number of their material, and a last one for primitives without material. Decodes each colour
/// texture once: PNG, JPEG and WebP. Images that cannot be read are left out. Cost: about 60 ns a texel.
class Surfaces {
 public:
  Surfaces(const Model& model, const Job& job);
  const Surface& operator[](std::size_t number) const { return list_[number]; }
  std::size_t number_of(const Primitive& primitive) const {
    return primitive.material < 0 ? list_.size() - 1 : static_cast<std::size_t>(primitive.material);
  }
  std::size_t size() const { return list_.size(); }

 private:
  std::vector<Surface> list_;
  std::vector<std::unique_ptr<const texture::Texels>> texels_;
};

}  // namespace seedmesh::render

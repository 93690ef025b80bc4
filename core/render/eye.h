#pragma once
/// How items appear to a camera or to the sun. For core/render only.
#include <vector>

#include "core/render/samples.h"
#include "core/texture/scan.h"

namespace seedmesh::render {

struct Projected {
  texture::ScanPoint point;
  double depth = 0;  ///< greater is nearer
};

/// Maps positions to samples: by the camera, or in parallel towards the sun.
class Eye {
 public:
  Eye(const Camera& camera, std::uint32_t size) : camera_(&camera), size_(size) {}
  explicit Eye(const ShadowMap& map) : map_(&map), size_(map.size) {}

  Projected operator()(const glm::dvec3& p) const {
    if (map_) {
      const double x = (glm::dot(p, map_->frame.right) - map_->low.x) / map_->step;
      const double y = (glm::dot(p, map_->frame.up) - map_->low.y) / map_->step;
      return {{texture::fixed(x), texture::fixed(y)}, glm::dot(p, map_->frame.towards)};
    }
    const Seen at = seen(*camera_, p);
    const double half = 0.5 * size_;
    return {{texture::fixed(half + half * at.x), texture::fixed(half - half * at.y)}, at.near};
  }
  /// The rows of the map run upwards, those of pictures downwards.
  bool is_mirrored() const { return map_ != nullptr; }
  std::uint32_t size() const { return size_; }

 private:
  const Camera* camera_ = nullptr;
  const ShadowMap* map_ = nullptr;
  std::uint32_t size_;
};

struct Scene {
  const Model& model;
  const Items& items;
  const Surfaces& surfaces;
  std::vector<Box> boxes;  ///< of mesh groups
  std::vector<Array<Projected>>
      seen{};  ///< vertices of all primitives of all items in order; empty: too many
};

Scene scene_of(const Model& model, const Items& items, const Surfaces& surfaces);

/// Vertex `i` of a mesh as the eye sees it.
inline Projected projected(const Eye& eye, const Item& item, const Mesh& mesh, std::size_t i) {
  return eye(glm::dvec3(glm::vec3(item.at * glm::vec4(mesh.position[i], 1))));
}

/// Projects the vertices of all items, so that not every band has to. Scenes of many copies do without.
void project(Scene& scene, const Eye& eye, const Job& job);

/// Whether an item may touch the rows of a window.
bool touches(const Scene& scene, const Item& item, const Eye& eye, const texture::ScanWindow& rows);

}  // namespace seedmesh::render

#include "core/model/transform.h"

namespace seedmesh {

bool is_identity(const Transform& transform) {
  return transform.translation == glm::vec3(0) && transform.rotation == glm::quat(1, 0, 0, 0) &&
         transform.scale == glm::vec3(1);
}

}  // namespace seedmesh

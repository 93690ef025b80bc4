/// A GLB of any bytes: it is refused with a reason, or gives a mesh whose numbers are whole.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/gltf/read/read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  Job::Options options;
  options.limits.memory_bytes = std::uint64_t{1} << 28U;
  options.limits.triangles = 100'000;
  Job job(0, options);
  try {
    const Result<Model> model = read_glb(std::as_bytes(std::span(data, size)), "/glb", job);
    if (!model) {
      if (model.error().issues.empty()) std::abort();
      return 0;
    }
    for (const Primitive& primitive : model->meshes.at(0).primitives) {
      const Mesh& mesh = primitive.mesh;
      for (std::size_t i = 0; i < mesh.index.size(); ++i) {
        if (mesh.index.at(i) >= mesh.position.size()) std::abort();
      }
      for (const glm::vec3& normal : mesh.normal) {
        if (!(std::abs(glm::length(normal) - 1) < 0.001F)) std::abort();
      }
    }
  } catch (const Stop&) {
    return 0;
  }
  return 0;
}

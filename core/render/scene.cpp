#include "core/render/scene.h"

#include "core/base/parallel.h"

namespace seedmesh::render {
namespace {

constexpr std::size_t most_vertices = 2'000'000;  ///< that are kept
constexpr std::size_t vertices_of_chunk = 16'384;

}  // namespace

Scene scene_of(const Model& model, const Items& items, const Surfaces& surfaces, const Job& job) {
  Scene scene{model, items, surfaces, Array<Drawing>(job)};
  for (std::size_t i = 0; i < items.list.size(); ++i) {
    for (const Primitive& primitive : model.meshes[items.list[i].group].primitives) {
      const std::size_t surface = surfaces.number_of(primitive);
      scene.drawings.push_back({&primitive.mesh, static_cast<std::uint32_t>(i),
                                static_cast<std::uint32_t>(surface), scene.vertices});
      scene.vertices += primitive.mesh.position.size();
      scene.has_blending = scene.has_blending || surfaces[surface].blends;
    }
  }
  return scene;
}

ProjectedScene project(const Scene& scene, const Eye& eye, const Job& job) {
  ProjectedScene shown{scene, eye, Array<Projected>(job)};
  if (scene.vertices > most_vertices) return shown;
  shown.vertices.resize(scene.vertices);
  for (const Drawing& drawing : scene.drawings) {
    const Lens lens = shown.lens_of(drawing);
    const std::span<const glm::vec3> from = drawing.mesh->position.span();
    Projected* const to = shown.vertices.data() + drawing.first;
    if (from.size() <= vertices_of_chunk) {
      for (std::size_t i = 0; i < from.size(); ++i) to[i] = lens(from[i]);
      continue;
    }
    parallel_for(job, from.size(), vertices_of_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
      job.check();
      for (std::size_t i = begin; i < end; ++i) to[i] = lens(from[i]);
    });
  }
  job.check();
  return shown;
}

const Array<glm::vec2>* uv_of(const Mesh& mesh, const Surface& surface) {
  if (!surface.texels || static_cast<std::size_t>(surface.uv_set) >= mesh.uv.size()) return nullptr;
  const Array<glm::vec2>& uv = mesh.uv[static_cast<std::size_t>(surface.uv_set)];
  return uv.empty() ? nullptr : &uv;
}

bool is_mirrored(const glm::mat4& at) { return glm::determinant(glm::dmat3(glm::mat3(at))) < 0; }

}  // namespace seedmesh::render

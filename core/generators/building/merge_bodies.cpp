#include "core/generators/building/merge_bodies.h"

#include "core/generators/building/coplanar_rectangles.h"
#include "core/generators/building/layers.h"
#include "core/generators/building/mesh_writer.h"
#include "core/geom/mesh/weld.h"

namespace seedmesh::building {
namespace {

/// The bodies of one material in one layer.
struct Bucket {
  std::size_t vertices = 0, indices = 0;
  bool has_neighbours = false;  ///< vertices may be equal
  Mesh mesh;
};

class Merger {
 public:
  Merger(const Model& model, const MergeInput& merging, std::vector<DrawnBody>& bodies, Job& job)
      : merging_(merging), bodies_(bodies), job_(job) {
    for (const DrawnBody& body : bodies) {
      const Shape& shape = merging.source.shape_of(body);
      if (merging.source.is_part(shape)) merging.source.asset_of(shape);  // makes its materials
      drawn_.push_back(body.shape);
    }
    materials_ = model.materials.size();
  }

  std::vector<MeshGroup> run(std::size_t least) {
    const CoplanarRectangles rectangles(merging_.shapes, drawn_, merging_.diagonal, job_);
    std::vector<std::uint8_t> layer_of =
        layers_of(merging_.shapes, drawn_, rectangles, merging_.low, merging_.diagonal, job_);
    layers_ = spread(layer_of, least);
    for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].layer = layer_of[i];
    measure(rectangles);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if ((i & 4095U) == 4095) job_.check();
      write(i, rectangles);
    }
    return groups();
  }

 private:
  Bucket& bucket_of(const DrawnBody& body, int material) {
    return buckets_[body.layer * materials_ + static_cast<std::size_t>(material)];
  }

  /// Spends all triangles and reserves memory for them.
  void measure(const CoplanarRectangles& rectangles) {
    buckets_.resize(layers_ * materials_);
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const DrawnBody& body = bodies_[i];
      const Shape& shape = merging_.source.shape_of(body);
      const BodyCost cost = merging_.source.cost_of(shape);
      const std::size_t more = rectangles.extra_triangles(i);
      triangles += cost.triangles + more;
      if (merging_.source.is_asset(shape)) continue;
      Bucket& bucket = bucket_of(body, body.material);
      bucket.vertices += cost.vertices + 2 * more;  // strips have two a triangle
      bucket.indices += 3 * (cost.triangles + more);
      bucket.has_neighbours |= shape.geometry != box_geometry || dimension(shape.size) < 3;
    }
    job_.spend(Resource::triangles, triangles);
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
      Bucket& bucket = buckets_[i];
      bucket.mesh = empty_mesh(merging_.materials.tile_of(static_cast<int>(i % materials_)) != nullptr, job_);
      bucket.mesh.position.reserve(bucket.vertices);
      bucket.mesh.normal.reserve(bucket.vertices);
      bucket.mesh.index.wide.reserve(bucket.indices);
    }
  }

  TextureMapping texturing_of(const Shape& shape, int material) const {
    const std::uint32_t projection = merging_.shapes.styles[shape.style].projection;
    return {merging_.materials.tile_of(material),
            projection == 0 ? nullptr : &merging_.shapes.projections[projection - 1]};
  }

  void write(std::size_t i, const CoplanarRectangles& rectangles) {
    const DrawnBody& body = bodies_[i];
    const Shape& shape = merging_.source.shape_of(body);
    const glm::dmat3& axes = merging_.shapes.axes[shape.axes];
    if (merging_.source.is_asset(shape)) {
      for (const Primitive& primitive : merging_.source.asset_of(shape).primitives) {
        Bucket& bucket = bucket_of(body, primitive.material);
        append_part(primitive.mesh, bucket.mesh, axes, shape.origin,
                    merging_.materials.tile_of(primitive.material));
        bucket.has_neighbours = true;
      }
      return;
    }
    Mesh& mesh = bucket_of(body, body.material).mesh;
    if (rectangles.fill(i, surface_)) {
      append(surface_, mesh, rectangles.axes(i), glm::dvec3(0), texturing_of(shape, body.material));
    } else {
      merging_.source.fill(shape, surface_);
      append(surface_, mesh, axes, shape.origin, texturing_of(shape, body.material));
    }
  }

  std::vector<MeshGroup> groups() {
    std::vector<MeshGroup> groups;
    for (std::uint32_t layer = 0; layer < layers_; ++layer) {
      MeshGroup group;
      group.name = "layer";
      for (std::size_t m = 0; m < materials_; ++m) {
        Bucket& bucket = buckets_[layer * materials_ + m];
        if (bucket.mesh.index.wide.empty()) continue;
        if (bucket.has_neighbours) weld(bucket.mesh, job_);
        bucket.mesh.cache_ordered = !bucket.has_neighbours;
        group.primitives.push_back({std::move(bucket.mesh), static_cast<int>(m), {}});
      }
      if (!group.primitives.empty()) groups.push_back(std::move(group));
    }
    return groups;
  }

  const MergeInput& merging_;
  std::vector<DrawnBody>& bodies_;
  Job& job_;
  std::vector<std::uint32_t> drawn_;
  std::size_t materials_ = 0;
  std::uint32_t layers_ = 0;
  std::vector<Bucket> buckets_;
  BodySurface surface_;
};

}  // namespace

std::vector<MeshGroup> merged_bodies(const Model& model, const MergeInput& merging,
                                     std::vector<DrawnBody>& bodies, std::size_t least, Job& job) {
  return Merger(model, merging, bodies, job).run(least);
}

}  // namespace seedmesh::building

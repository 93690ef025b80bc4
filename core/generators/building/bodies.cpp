#include "core/generators/building/bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "core/generators/building/body_source.h"
#include "core/generators/building/merge_bodies.h"
#include "core/generators/building/mesh_writer.h"
#include "core/geom/mesh/weld.h"
#include "core/model/build.h"

namespace seedmesh::building {
namespace {

constexpr double least_area = 4e-12;  ///< of a triangle, by the square of the model's diagonal

class Assembly {
 public:
  Assembly(Model& model, const Shapes& shapes, MaterialTable& materials, std::span<Asset> assets, Job& job)
      : model_(model),
        shapes_(shapes),
        materials_(materials),
        source_(shapes, materials, assets, job),
        job_(job) {}

  void run(Sharing sharing) {
    gather();
    begin();
    const bool all = sharing == Sharing::nodes;
    if (sharing == Sharing::if_smaller) count_costly();
    std::vector<DrawnBody> merged, single;
    for (const DrawnBody& body : bodies_) {
      const Shape& shape = shapes_.shapes[body.shape];
      const bool is_textured = body.material >= 0 && materials_.tile_of(body.material) != nullptr;
      const bool is_single = source_.is_own(shape) || (!is_textured && (all || is_smaller_shared(body)));
      (is_single ? single : merged).push_back(body);
    }
    share(single);
    if (merged.empty()) return;
    for (MeshGroup& group :
         merged_bodies(model_, {shapes_, materials_, source_, low_, diagonal_}, merged, 0, job_)) {
      add_node(model_, "layer", root_, add_mesh(model_, std::move(group)));
    }
  }

  /// Adds a mesh for each layer.
  std::vector<int> level(Sharing sharing, std::size_t least) {
    gather();
    std::vector<DrawnBody> merged, single;
    for (const DrawnBody& body : bodies_)
      (source_.is_own(shapes_.shapes[body.shape]) ? single : merged).push_back(body);
    if (sharing != Sharing::merged) {
      begin();
      share(single);
    }
    std::vector<int> layers;
    for (MeshGroup& group :
         merged_bodies(model_, {shapes_, materials_, source_, low_, diagonal_}, merged, least, job_)) {
      layers.push_back(add_mesh(model_, std::move(group)));
    }
    return layers;
  }

 private:
  void begin() {
    add_node(model_, "building", -1);
    root_ = static_cast<int>(model_.nodes.size()) - 1;
  }

  struct Key {
    std::uint32_t geometry;
    std::array<std::int64_t, 3> size;
    std::int32_t material;
    std::uint32_t options;  ///< of a part
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  Key key_of(const DrawnBody& body) {
    const Shape& shape = source_.shape_of(body);
    const bool is_part = source_.is_part(shape);
    // The node of a body rotates it; the node of an asset of the request scales it as well.
    return {shape.geometry, source_.is_own(shape) ? std::array<std::int64_t, 3>{} : rounded(shape.size),
            body.material, is_part ? shapes_.styles[shape.style].options : 0U};
  }

  /// Counts the copies of bodies that are large enough to share a mesh.
  void count_costly() {
    for (const DrawnBody& body : bodies_) {
      if (is_costly(body)) ++costly_[key_of(body)];
    }
  }
  bool is_costly(const DrawnBody& body) {
    const Shape& shape = source_.shape_of(body);
    return shape.geometry != box_geometry && source_.cost_of(shape).saves_if_shared(~std::uint32_t{0});
  }
  bool is_smaller_shared(const DrawnBody& body) {
    return !costly_.empty() && is_costly(body) &&
           source_.cost_of(source_.shape_of(body)).saves_if_shared(costly_[key_of(body)]);
  }

  /// Collects the drawn bodies with their materials, and the box around them.
  void gather() {
    glm::dvec3 low(1e300), high(-1e300);
    for (std::uint32_t i = 0; i < shapes_.shapes.size(); ++i) {
      const Shape& shape = shapes_.shapes[i];
      if (!shape.is_active || dimension(shape.size) < 2) continue;
      const glm::dmat3& axes = shapes_.axes[shape.axes];
      glm::dvec3 reach(0);
      for (int axis = 0; axis < 3; ++axis) reach += 0.5 * shape.size[axis] * glm::abs(axes[axis]);
      const glm::dvec3 middle = shape.origin + axes * (0.5 * shape.size);
      low = glm::min(low, middle - reach);
      high = glm::max(high, middle + reach);
      bodies_.push_back({i, 0, 0});
      if ((i & 4095U) == 0) job_.check();
    }
    if (bodies_.empty()) return;
    diagonal_ = glm::length(high - low);
    low_ = low;
    least_ = least_area * diagonal_ * diagonal_;
    std::size_t thin = 0;
    std::erase_if(bodies_, [&](const DrawnBody& body) {
      const glm::dvec3& s = shapes_.shapes[body.shape].size;
      double smallest = 1e300;
      for (int axis = 0; axis < 3; ++axis) {
        const double a = s[(axis + 1) % 3], b = s[(axis + 2) % 3];
        if (a != 0 && b != 0) smallest = std::min(smallest, a * b);
      }
      const bool is_thin =
          smallest * 0.5 <= least_ || std::min({s.x != 0 ? s.x : 1e300, s.y != 0 ? s.y : 1e300,
                                                s.z != 0 ? s.z : 1e300}) < 4e-6 * diagonal_;
      thin += is_thin;
      return is_thin;
    });
    if (thin > 0) {
      model_.warnings.push_back(
          {"/rules",
           std::to_string(thin) +
               " shapes are too thin to be drawn, compared with the whole, and are left out",
           0, 0});
    }
    for (DrawnBody& body : bodies_) {
      body.material = source_.is_asset(shapes_.shapes[body.shape])
                          ? -1
                          : materials_.material_of(shapes_.shapes[body.shape]);
    }
  }

  // Shared meshes

  void share(const std::vector<DrawnBody>& bodies) {
    std::map<Key, std::size_t> places;
    std::vector<std::pair<std::uint32_t, std::vector<Transform>>> groups;
    for (const DrawnBody& body : bodies) {
      const Shape& shape = shapes_.shapes[body.shape];
      const auto [found, is_new] = places.try_emplace(key_of(body), groups.size());
      if (is_new) groups.emplace_back(body.shape, std::vector<Transform>{});
      groups[found->second].second.push_back(transform_of(shape));
    }
    job_.spend(Resource::shapes, groups.size());
    for (auto& [first, transforms] : groups) {
      const Shape& shape = shapes_.shapes[first];
      const std::uint64_t triangles = source_.cost_of(shape).triangles;
      job_.spend(Resource::triangles, triangles * transforms.size());
      const int mesh = source_.is_asset(shape) ? add_asset_mesh(shape) : add_shared_mesh(shape);
      if (mesh < 0) continue;
      Node node;
      node.name = source_.is_asset(shape) ? std::string(shapes_.asset_names[shape.geometry & ~asset_bit])
                                          : materials_.symbol(shape);
      node.parent = root_;
      node.mesh = mesh;
      if (transforms.size() == 1) {
        node.transform = transforms[0];
      } else {
        node.instances.transforms = std::move(transforms);
      }
      model_.nodes.push_back(std::move(node));
    }
  }

  Transform transform_of(const Shape& shape) {
    const glm::dmat3& axes = shapes_.axes[shape.axes];
    Transform transform;
    transform.rotation = glm::quat(glm::quat_cast(axes));
    glm::dvec3 at = shape.origin;
    if (source_.is_asset(shape)) {
      const Asset& asset = source_.asset_of(shape);
      const glm::dvec3 scale = scale_of(shape, asset);
      transform.scale = glm::vec3(scale);
      at -= axes * (scale * asset.low);
    }
    transform.translation = glm::vec3(at);
    return transform;
  }

  static glm::dvec3 scale_of(const Shape& shape, const Asset& asset) {
    glm::dvec3 scale(1);
    for (int axis = 0; axis < 3; ++axis) {
      if (asset.size[axis] > 0 && shape.size[axis] > 0) scale[axis] = shape.size[axis] / asset.size[axis];
    }
    return scale;
  }

  /// Adds one mesh for an asset, or for a part of one size. Its primitives move to the model.
  int add_asset_mesh(const Shape& shape) {
    MeshGroup group;
    group.name = shapes_.asset_names[shape.geometry & ~asset_bit];
    Asset& asset = source_.asset_of(shape);
    group.primitives = std::move(asset.primitives);
    if (source_.is_part(shape)) {
      for (Primitive& primitive : group.primitives) {
        const glm::dvec2* const tile = materials_.tile_of(primitive.material);
        if (tile == nullptr) {
          primitive.mesh.uv[0] = {};
          weld(primitive.mesh, job_);  // where only the texture had differed
        }
        for (glm::vec2& uv : primitive.mesh.uv[0]) uv /= glm::vec2(*tile);
      }
    }
    return add_mesh(model_, std::move(group));
  }

  int add_shared_mesh(const Shape& shape) {
    source_.fill(shape, surface_);
    if (surface_.index.empty()) return -1;
    Primitive primitive;
    primitive.material = materials_.material_of(shape);
    primitive.mesh = empty_mesh(false, job_);
    append(surface_, primitive.mesh, glm::dmat3(1), glm::dvec3(0), {});
    if (shape.geometry != box_geometry) weld(primitive.mesh, job_);
    return add_mesh(model_, materials_.symbol(shape), std::move(primitive.mesh), primitive.material);
  }

  Model& model_;
  const Shapes& shapes_;
  MaterialTable& materials_;
  BodySource source_;
  Job& job_;
  int root_ = -1;
  std::vector<DrawnBody> bodies_;
  double diagonal_ = 1, least_ = 0;
  glm::dvec3 low_{0};
  BodySurface surface_;
  std::map<Key, std::uint64_t> costly_;
};

}  // namespace

void add_bodies(Model& model, const Shapes& shapes, MaterialTable& materials, std::span<Asset> assets,
                Sharing sharing, Job& job) {
  Assembly(model, shapes, materials, assets, job).run(sharing);
}

std::vector<int> add_level(Model& model, const Shapes& shapes, MaterialTable& materials,
                           std::span<Asset> assets, const LevelLayers& layers, Job& job) {
  return Assembly(model, shapes, materials, assets, job).level(layers.sharing, layers.least);
}

}  // namespace seedmesh::building

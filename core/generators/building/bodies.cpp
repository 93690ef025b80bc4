#include "core/generators/building/bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "core/base/math.h"
#include "core/generators/building/layers.h"
#include "core/generators/building/mesh_writer.h"
#include "core/generators/building/patch.h"
#include "core/geom/weld.h"

namespace seedmesh::building {
namespace {

constexpr double least_area = 4e-12;  ///< of a triangle, by the square of the model's diagonal

/// A shape that is drawn.
struct Body {
  std::uint32_t shape = 0;
  std::uint16_t layer = 0;
  std::int32_t material = 0;
};

struct Bucket {
  std::size_t vertices = 0, indices = 0;
  bool has_solids = false;
  Mesh mesh;
};

class Assembly {
 public:
  Assembly(Model& model, const Shapes& shapes, Looks& looks, std::span<Asset> assets, Job& job)
      : model_(model), shapes_(shapes), looks_(looks), assets_(assets), job_(job) {}

  void run(Sharing sharing) {
    gather();
    begin();
    const bool few = sharing == Sharing::few && draws() <= most_nodes;
    std::vector<Body> merged, single;
    for (const Body& body : bodies_) {
      const Shape& shape = shapes_.shapes[body.shape];
      const bool is_textured = body.material >= 0 && looks_.tile_of(body.material) != nullptr;
      (is_own(shape) || ((sharing == Sharing::nodes || few) && !is_textured) ? single : merged)
          .push_back(body);
    }
    share(single);
    if (merged.empty()) return;
    for (MeshGroup& group : merge(merged, 0)) {
      Node node;
      node.name = "layer";
      node.parent = root_;
      node.mesh = static_cast<int>(model_.meshes.size());
      model_.meshes.push_back(std::move(group));
      model_.nodes.push_back(std::move(node));
    }
  }

  /// A mesh a layer.
  std::vector<int> level(Sharing sharing, std::size_t least) {
    gather();
    std::vector<Body> merged, single;
    for (const Body& body : bodies_) (is_own(shapes_.shapes[body.shape]) ? single : merged).push_back(body);
    if (sharing != Sharing::merged) {
      begin();
      share(single);
    }
    std::vector<int> layers;
    for (MeshGroup& group : merge(merged, least)) {
      layers.push_back(static_cast<int>(model_.meshes.size()));
      model_.meshes.push_back(std::move(group));
    }
    return layers;
  }

 private:
  void begin() {
    Node root;
    root.name = "building";
    model_.nodes.push_back(std::move(root));
    root_ = static_cast<int>(model_.nodes.size()) - 1;
  }

  /// The request's own models keep their form.
  bool is_own(const Shape& shape) const { return is_asset(shape) && !is_part(shape); }
  bool is_asset(const Shape& shape) const { return (shape.geometry & asset_bit) != 0; }
  bool is_part(const Shape& shape) const {
    return is_asset(shape) && assets_[shape.geometry & ~asset_bit].row != nullptr;
  }
  /// A built-in part is made for the size of the scope, and once for equal ones.
  Asset& asset_of(const Shape& shape) {
    Asset& asset = assets_[shape.geometry & ~asset_bit];
    if (asset.row == nullptr) return asset;
    const std::uint32_t options = shapes_.styles[shape.style].options;
    const auto [found, is_new] = parts_.try_emplace({shape.geometry, options, rounded(shape.size)});
    if (!is_new) return found->second;
    Asset& made = found->second;
    made.size = shape.size;
    for (PartPiece& piece : make_part(*asset.row, shape.size, shapes_.part_options[options], job_))
      made.primitives.push_back({std::move(piece.mesh), looks_.material_of_role(piece.role), {}});
    return made;
  }

  /// How many primitives nodes would show.
  std::size_t draws() {
    if (bodies_.size() > most_nodes) return bodies_.size();
    std::size_t sum = 0;
    for (const Body& body : bodies_) {
      const Shape& shape = shapes_.shapes[body.shape];
      sum += is_asset(shape) ? asset_of(shape).primitives.size() : 1;
    }
    return sum;
  }

  /// What is drawn, its material, and the extent of all.
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
    std::erase_if(bodies_, [&](const Body& body) {
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
    if (thin > 0)
      model_.warnings.push_back(
          {"/rules",
           std::to_string(thin) + " shapes are too thin beside the whole to be drawn and are left out", 0,
           0});
    for (Body& body : bodies_)
      body.material =
          is_asset(shapes_.shapes[body.shape]) ? -1 : looks_.material_of(shapes_.shapes[body.shape]);
  }

  /// The body in the frame of its scope.
  void fill(const Shape& shape, Patch& patch) {
    patch.clear();
    if (shape.geometry == box_geometry)
      patches_.box(shape.size, patch);
    else
      patches_.solid(shapes_.solid_of(shape.geometry), shape.size, patch);
  }

  std::size_t triangles_of(const Shape& shape) {
    if (is_asset(shape)) {
      std::size_t sum = 0;
      for (const Primitive& primitive : asset_of(shape).primitives) sum += primitive.mesh.elements();
      return sum;
    }
    if (shape.geometry == box_geometry) return dimension(shape.size) == 3 ? 12 : 2;
    return shapes_.solid_of(shape.geometry).corners.size();
  }

  Mesh empty_mesh(bool has_uv) const {
    Mesh mesh;
    mesh.position = Array<glm::vec3>(job_);
    mesh.normal = Array<glm::vec3>(job_);
    if (has_uv) mesh.uv[0] = Array<glm::vec2>(job_);
    mesh.index.wide = Array<std::uint32_t>(job_);
    return mesh;
  }

  // Shared meshes

  struct Key {
    std::uint32_t geometry;
    std::array<std::int64_t, 3> size;
    std::int32_t material;
    std::uint32_t options;  ///< of a part
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  /// Metres in micrometres: bodies equal to that are one.
  static std::array<std::int64_t, 3> rounded(const glm::dvec3& size) {
    return {math::to_int64(size.x * 1e6 + 0.5), math::to_int64(size.y * 1e6 + 0.5),
            math::to_int64(size.z * 1e6 + 0.5)};
  }

  void share(const std::vector<Body>& bodies) {
    std::map<Key, std::size_t> places;
    std::vector<std::pair<std::uint32_t, std::vector<Transform>>> groups;
    for (const Body& body : bodies) {
      const Shape& shape = shapes_.shapes[body.shape];
      // A turned box is the same box; an asset is scaled by its node.
      const bool is_scaled = is_asset(shape) && !is_part(shape);
      const Key key{shape.geometry, is_scaled ? std::array<std::int64_t, 3>{} : rounded(shape.size),
                    body.material, is_part(shape) ? shapes_.styles[shape.style].options : 0U};
      const auto [found, is_new] = places.try_emplace(key, groups.size());
      if (is_new) groups.emplace_back(body.shape, std::vector<Transform>{});
      groups[found->second].second.push_back(transform_of(shape));
    }
    job_.spend(Resource::shapes, groups.size());
    for (auto& [first, transforms] : groups) {
      const Shape& shape = shapes_.shapes[first];
      const std::size_t triangles = triangles_of(shape);
      job_.spend(Resource::triangles, triangles * transforms.size());
      const int mesh = is_asset(shape) ? add_asset_mesh(shape) : add_shared_mesh(shape);
      if (mesh < 0) continue;
      Node node;
      node.name = is_asset(shape) ? shapes_.asset_names[shape.geometry & ~asset_bit] : looks_.symbol(shape);
      node.parent = root_;
      node.mesh = mesh;
      if (transforms.size() == 1)
        node.transform = transforms[0];
      else
        node.instances.transforms = std::move(transforms);
      model_.nodes.push_back(std::move(node));
    }
  }

  Transform transform_of(const Shape& shape) {
    const glm::dmat3& axes = shapes_.axes[shape.axes];
    Transform transform;
    transform.rotation = glm::quat(glm::quat_cast(axes));
    glm::dvec3 at = shape.origin;
    if (is_asset(shape)) {
      const Asset& asset = asset_of(shape);
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

  /// Each asset is shown by one mesh, each part by one for each size: what was made moves there.
  int add_asset_mesh(const Shape& shape) {
    MeshGroup group;
    group.name = shapes_.asset_names[shape.geometry & ~asset_bit];
    Asset& asset = asset_of(shape);
    group.primitives = std::move(asset.primitives);
    if (is_part(shape)) {
      for (Primitive& primitive : group.primitives) {
        const glm::dvec2* const tile = looks_.tile_of(primitive.material);
        if (tile == nullptr) {
          primitive.mesh.uv[0] = {};
          weld(primitive.mesh, job_);  // where only the texture had differed
        }
        for (glm::vec2& uv : primitive.mesh.uv[0]) uv /= glm::vec2(*tile);
      }
    }
    model_.meshes.push_back(std::move(group));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  int add_shared_mesh(const Shape& shape) {
    fill(shape, patch_);
    if (patch_.index.empty()) return -1;
    Primitive primitive;
    primitive.material = looks_.material_of(shape);
    primitive.mesh = empty_mesh(false);
    append(patch_, primitive.mesh, glm::dmat3(1), glm::dvec3(0), {});
    if (shape.geometry != box_geometry) weld(primitive.mesh, job_);
    MeshGroup group;
    group.name = looks_.symbol(shape);
    group.primitives.push_back(std::move(primitive));
    model_.meshes.push_back(std::move(group));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  Texturing texturing_of(const Shape& shape, int material) const {
    const std::uint32_t projection = shapes_.styles[shape.style].projection;
    return {looks_.tile_of(material), projection == 0 ? nullptr : &shapes_.projections[projection - 1]};
  }

  // Merged meshes

  /// A group a layer; none where nothing is drawn.
  std::vector<MeshGroup> merge(std::vector<Body>& bodies, std::size_t least) {
    std::vector<MeshGroup> groups;
    for (const Body& body : bodies) {
      if (is_part(shapes_.shapes[body.shape]))
        asset_of(shapes_.shapes[body.shape]);  // its materials come to be
    }
    std::vector<std::uint32_t> drawn;
    for (const Body& body : bodies) drawn.push_back(body.shape);
    std::vector<std::uint8_t> layer_of = layers_of(shapes_, drawn, low_, diagonal_, job_);
    const std::uint32_t layers = spread(layer_of, least);
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i].layer = layer_of[i];
    const std::size_t materials = model_.materials.size();
    std::vector<Bucket> buckets(layers * materials);
    std::size_t triangles = 0;
    for (const Body& body : bodies) {
      const Shape& shape = shapes_.shapes[body.shape];
      triangles += triangles_of(shape);
      if (is_asset(shape)) continue;
      Bucket& bucket = buckets[body.layer * materials + static_cast<std::size_t>(body.material)];
      const bool is_box = shape.geometry == box_geometry;
      const std::size_t count =
          is_box ? (dimension(shape.size) == 3 ? 24 : 4) : shapes_.solid_of(shape.geometry).corners.size();
      bucket.vertices += count;
      bucket.indices += is_box ? count / 4 * 6 : 0;
      bucket.has_solids |= !is_box;
    }
    job_.spend(Resource::triangles, triangles);
    for (std::size_t i = 0; i < buckets.size(); ++i) {
      Bucket& bucket = buckets[i];
      const bool has_uv = looks_.tile_of(static_cast<int>(i % materials)) != nullptr;
      bucket.mesh = empty_mesh(has_uv);
      bucket.mesh.position.reserve(bucket.vertices);
      bucket.mesh.normal.reserve(bucket.vertices);
      bucket.mesh.index.wide.reserve(bucket.indices);
    }
    std::size_t done = 0;
    for (const Body& body : bodies) {
      const Shape& shape = shapes_.shapes[body.shape];
      const glm::dmat3& axes = shapes_.axes[shape.axes];
      if ((++done & 4095U) == 0) job_.check();
      if (is_asset(shape)) {
        for (const Primitive& primitive : asset_of(shape).primitives) {
          Bucket& bucket = buckets[body.layer * materials + static_cast<std::size_t>(primitive.material)];
          append_part(primitive.mesh, bucket.mesh, axes, shape.origin, looks_.tile_of(primitive.material));
          bucket.has_solids = true;
        }
        continue;
      }
      Bucket& bucket = buckets[body.layer * materials + static_cast<std::size_t>(body.material)];
      fill(shape, patch_);
      append(patch_, bucket.mesh, axes, shape.origin, texturing_of(shape, body.material));
    }
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      MeshGroup group;
      group.name = "layer";
      for (std::size_t m = 0; m < materials; ++m) {
        Bucket& bucket = buckets[layer * materials + m];
        if (bucket.mesh.index.wide.empty()) continue;
        if (bucket.has_solids) weld(bucket.mesh, job_);
        bucket.mesh.cache_ordered = !bucket.has_solids;
        group.primitives.push_back({std::move(bucket.mesh), static_cast<int>(m), {}});
      }
      if (!group.primitives.empty()) groups.push_back(std::move(group));
    }
    return groups;
  }

  Model& model_;
  const Shapes& shapes_;
  Looks& looks_;
  std::span<Asset> assets_;
  Job& job_;
  int root_ = -1;
  std::vector<Body> bodies_;
  double diagonal_ = 1, least_ = 0;
  glm::dvec3 low_{0};
  Patch patch_;
  PatchMaker patches_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::array<std::int64_t, 3>>, Asset> parts_;
};

}  // namespace

void add_bodies(Model& model, const Shapes& shapes, Looks& looks, std::span<Asset> assets, Sharing sharing,
                Job& job) {
  Assembly(model, shapes, looks, assets, job).run(sharing);
}

std::vector<int> add_level(Model& model, const Shapes& shapes, Looks& looks, std::span<Asset> assets,
                           Sharing sharing, std::size_t least, Job& job) {
  return Assembly(model, shapes, looks, assets, job).level(sharing, least);
}

}  // namespace seedmesh::building

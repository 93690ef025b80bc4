#include "core/generators/building/body_source.h"

#include "core/base/math.h"

namespace seedmesh::building {

std::array<std::int64_t, 3> rounded(const glm::dvec3& size) {
  return {math::to_int64(size.x * 1e6 + 0.5), math::to_int64(size.y * 1e6 + 0.5),
          math::to_int64(size.z * 1e6 + 0.5)};
}

Asset& BodySource::asset_of(const Shape& shape) {
  Asset& asset = assets_[shape.geometry & ~asset_bit];
  if (asset.row == nullptr) return asset;
  const Style& style = shapes_.styles[shape.style];
  const auto [found, is_new] =
      parts_.try_emplace({shape.geometry, style.options, rounded(shape.size), style.color, style.material});
  if (!is_new) return found->second;
  Asset& made = found->second;
  made.size = shape.size;
  for (PartPiece& piece : make_part(*asset.row, shape.size, shapes_.part_options[style.options], job_)) {
    const int material = materials_.material_of_part(piece.role, style);
    if (materials_.tile_of(material) != nullptr) {
      for (glm::vec2& uv : piece.mesh.uv[0]) uv.y = 0.0F - uv.y;  // down, as that of walls
    }
    made.primitives.push_back({std::move(piece.mesh), material, {}});
  }
  return made;
}

void BodySource::fill(const Shape& shape, BodySurface& surface) {
  surface.clear();
  if (shape.geometry == box_geometry) {
    surfaces_.box(shape.size, surface);
    surface.has_face_normals = true;
  } else {
    surfaces_.solid(shapes_.solid_of(shape.geometry), shape.size, surface);
  }
}

BodyCost BodySource::cost_of(const Shape& shape) {
  BodyCost cost;
  if (is_asset(shape)) {
    cost.primitives = 0;
    for (const Primitive& primitive : asset_of(shape).primitives) {
      cost.triangles += primitive.mesh.elements();
      cost.vertices += primitive.mesh.position.size();
      ++cost.primitives;
    }
  } else if (shape.geometry == box_geometry) {
    const std::uint64_t sides = dimension(shape.size) == 3 ? 6 : 1;
    cost = {2 * sides, 4 * sides, 1};
  } else {
    cost.triangles = cost.vertices = shapes_.solid_of(shape.geometry).corners.size();
  }
  return cost;
}

}  // namespace seedmesh::building

#pragma once
/// Built-in parts of buildings (windows, doors, columns, ...), made for the size of a scope.
///
/// Frame: a part fills the box from the origin to `size`. x points to the right, y up and z to the front; the
/// handle of a door is on +z. Parts are closed solids with texture coordinates in metres. Normals are flat, and smooth
/// on round faces.
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "core/model/model.h"

namespace seedmesh::building {

/// The triangles of a part that have one material.
struct PartPiece {
  std::string_view role;  ///< name of a material in part_materials(), such as "glass"
  Mesh mesh;
};

/// Options of a part besides its size. A part ignores options that it does not have.
struct PartOptions {
  /// Slope of the roof of a tower or dormer, in radians. 0 selects a default.
  double angle = 0;
  /// Number of sides, steps, panes, or teeth of a factory roof, depending on the part. 0 derives it from the size or
  /// selects a default.
  int count = 0;
  /// Width of the frame of a window or door, or of a balcony rail, in metres. 0 derives it from the size.
  double frame = 0;
  /// Number of the room that is visible behind a window, as in core/texture/rooms.h: 0 a dark room, 1 curtains, 2 a
  /// blind, 3 a short curtain; 4 to 10 more dark rooms, 11 and 12 curtains, 13 and 14 blinds, 15 a short curtain.
  int room = 0;

  friend auto operator<=>(const PartOptions&, const PartOptions&) = default;
};

/// A built-in part, and the function that makes it.
struct PartRow {
  std::string_view name;
  std::string_view text;  ///< description in one sentence, for GET /v1/vocabulary
  glm::dvec3 size;        ///< the size of the part where the scope has size 0 along all axes
  std::vector<PartPiece> (*make)(const glm::dvec3& size, const PartOptions& options, Job& job);
};

/// Returns all parts, sorted by name.
std::span<const PartRow> part_rows();

/// Returns the part of this name, or null if there is none.
const PartRow* part_named(std::string_view name);

/// Makes a part, or a box of its first role if the scope is too flat for it. Each size must be above 0.
/// Spends Resource::triangles before it allocates.
std::vector<PartPiece> make_part(const PartRow& row, const glm::dvec3& size, const PartOptions& options,
                                 Job& job);

/// The default material of a role. A material of that name in the request replaces it.
struct PartMaterial {
  std::string_view role;
  std::string_view color;  ///< "#rrggbb"
  float metallic = 0, roughness = 1;
};
/// Returns the default materials of all roles.
std::span<const PartMaterial> part_materials();

}  // namespace seedmesh::building

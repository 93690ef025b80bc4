#pragma once
/// Ready parts of buildings, made for the size of a scope.
///
/// Frame: a part fills the box from the origin to `size` exactly; x to the right, y up, z towards who stands
/// before it (a door's handle is on +z). Closed solids, flat normals (round ones smooth), UV in metres.
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "core/model/model.h"

namespace seedmesh::building {

/// The triangles of a part that have one material.
struct PartPiece {
  std::string_view role;  ///< of part_materials(), as "glass"
  Mesh mesh;
};

/// What can be turned about a part besides its size. Each part reads what its row names.
struct PartOptions {
  double angle =
      0;  ///< radians: pyramid and prism none; roofs of tower, dormer: of their slope (0: 45 degrees)
  int count =
      0;  ///< sides of cylinder, column, bell; steps of stairs; panes of a window; saw teeth; 0: by size
  double frame = 0;  ///< metres: of a window's or door's frame, a balcony's rail; 0: by size

  friend auto operator<=>(const PartOptions&, const PartOptions&) = default;
};

struct PartRow {
  std::string_view name;
  std::string_view text;  ///< one sentence for the vocabulary
  glm::dvec3 size;        ///< that it has by itself, for scopes that leave sizes open
  std::vector<PartPiece> (*make)(const glm::dvec3& size, const PartOptions& options, Job& job);
};

/// box, cylinder, prism, pyramid, triangular_prism, wall, floor, door, window, tower, bell, factory_roof,
/// chimney, ledge, balcony, column, dormer, stairs; by name.
std::span<const PartRow> part_rows();

/// Null for a name that is none.
const PartRow* part_named(std::string_view name);

/// Makes a part; a plain box of its first role where the scope is too flat for it. Each size must be
/// positive. Spends Resource::triangles before it allocates.
std::vector<PartPiece> make_part(const PartRow& row, const glm::dvec3& size, const PartOptions& options,
                                 Job& job);

/// What a role looks like unless the request says otherwise.
struct PartMaterial {
  std::string_view role;
  std::string_view color;  ///< "#rrggbb"
  float metallic = 0, roughness = 1;
};
std::span<const PartMaterial> part_materials();

}  // namespace seedmesh::building

#include "core/generators/building/parts/parts.h"

#include <algorithm>
#include <array>

#include "core/generators/building/parts/part_makers.h"
#include "core/generators/building/parts/part_writer.h"
#include "core/geom/mesh/weld.h"

namespace seedmesh::building {
namespace {

constexpr std::array<PartRow, 18> rows{{
    {"balcony",
     "A slab with a railing on three sides; its back touches the wall.",
     {2.4, 1.15, 1},
     make_balcony},
    {"bell", "A church bell with clapper and yoke.", {1, 1.1, 1}, make_bell},
    {"box", "A box.", {1, 1, 1}, make_box},
    {"chimney",
     "A brick chimney with a slab and pots; a round stack if its height is more than five times its width.",
     {0.8, 1.6, 0.6},
     make_chimney},
    {"column", "A round column with base and capital.", {0.6, 4, 0.6}, make_column},
    {"cylinder", "An upright cylinder.", {1, 1, 1}, make_cylinder},
    {"door", "A door in its frame, with a handle; two leaves if it is wide.", {1, 2.1, 0.2}, make_door},
    {"dormer", "A window with walls and a roof of its own, for a roof slope.", {1.6, 2, 2}, make_dormer},
    {"factory_roof", "Four saw teeth with glass on their vertical side.", {20, 3, 10}, make_factory_roof},
    {"floor", "A slab.", {4, 0.3, 4}, make_floor},
    {"ledge", "A moulding along a wall; its back touches the wall.", {4, 0.3, 0.3}, make_ledge},
    {"prism", "A frustum whose top is half as wide as its base.", {1, 1, 1}, make_prism},
    {"pyramid", "A pyramid over a rectangle.", {1, 1, 1}, make_pyramid},
    {"stairs", "Steps that rise from front to back.", {1.6, 1, 1.8}, make_stairs},
    {"tower", "A shaft with arcades, a cornice and a spire.", {4, 16, 4}, make_tower},
    {"triangular_prism", "A prism with a ridge along the longer side.", {1, 1, 1}, make_triangular_prism},
    {"wall", "A thin wall.", {4, 3, 0.3}, make_wall},
    {"window", "A frame, glazing bars by its width, and glass.", {1.2, 1.5, 0.12}, make_window},
}};

constexpr std::array<PartMaterial, 17> materials{{
    {"brick", "#96594a", 0, 0.95F},
    {"bronze", "#8f6b3e", 0.9F, 0.45F},
    {"clay", "#a8623f", 0, 0.9F},
    {"concrete", "#a9a8a3", 0, 0.95F},
    {"door", "#5c3b26", 0, 0.7F},
    {"floor", "#9d978d", 0, 0.9F},
    {"frame", "#dedbd2", 0, 0.6F},
    {"gable", "#ded4c3", 0, 0.95F},
    {"glass", "#2c3236", 0, 0.06F},
    {"glass_curtained", "#35322d", 0, 0.05F},
    {"glass_shaded", "#2a3638", 0, 0.09F},
    {"metal", "#43474c", 0.8F, 0.45F},
    {"roof", "#8b4b3b", 0, 0.9F},
    {"stone", "#bdb6a8", 0, 0.95F},
    {"wall", "#ded4c3", 0, 0.95F},
    {"wood", "#7b5b3d", 0, 0.85F},
}};

/// Whether a part lies within its scope. Some details do not fit into a scope that is almost flat.
bool is_within(const std::vector<PartPiece>& pieces, const glm::dvec3& size) {
  constexpr double reach = 1e-4;
  for (const PartPiece& piece : pieces) {
    const Box box = bounds_of(piece.mesh.position.span());
    for (int axis = 0; axis < 3; ++axis) {
      const double slack = reach * size[axis];
      if (static_cast<double>(box.min[axis]) < -slack ||
          static_cast<double>(box.max[axis]) > size[axis] + slack)
        return false;
    }
  }
  return true;
}

}  // namespace

std::span<const PartRow> part_rows() { return rows; }

const PartRow* part_named(std::string_view name) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const PartRow& each) { return each.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

std::vector<PartPiece> make_part(const PartRow& row, const glm::dvec3& size, const PartOptions& options,
                                 Job& job) {
  std::vector<PartPiece> pieces = row.make(size, options, job);
  if (!is_within(pieces, size)) {
    PartWriter plain(job);
    plain.box(pieces.front().role, glm::dvec3(0), size);
    pieces = plain.take();
  }
  for (PartPiece& piece : pieces) weld(piece.mesh, job);
  return pieces;
}

std::span<const PartMaterial> part_materials() { return materials; }

}  // namespace seedmesh::building

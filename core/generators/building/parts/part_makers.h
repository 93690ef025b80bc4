#pragma once
/// One function for each part; parts.cpp has the table.
#include "core/generators/building/parts/part_writer.h"

namespace seedmesh::building {

using PartMaker = std::vector<PartPiece>(const glm::dvec3& size, const PartOptions& options, Job& job);

PartMaker make_window, make_door, make_dormer;
PartMaker make_box, make_wall, make_floor, make_cylinder, make_prism, make_pyramid, make_triangular_prism;
PartMaker make_tower, make_bell, make_factory_roof, make_chimney, make_ledge, make_balcony, make_column,
    make_stairs;

}  // namespace seedmesh::building

#include "core/generators/building/roof_solid.h"

#include <glm/geometric.hpp>

namespace seedmesh::building {
namespace {

using glm::dvec2;
using glm::dvec3;

// Corners nearer than this share of the diagonal are one.
constexpr double same_corner = 2e-6;

/// The loops of a flat face as a plan, seen against its normal.
seedmesh::Plan plan_of(const Solid& face, int axis, const dvec3& size) {
  seedmesh::Plan plan;
  if (face.faces.empty()) return plan;
  const Face& first = face.faces[0];
  const dvec2 extent{size.x, axis == 1 ? size.z : size.y};
  const double reach = same_corner * glm::length(extent);
  for (std::uint32_t l = first.first_loop; l < first.first_loop + first.loop_count; ++l) {
    const Loop& loop = face.loops[l];
    PlanRing ring;
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      const dvec3 p = face.points[face.corners[loop.first + i]] * size;
      const dvec2 flat{p.x, axis == 1 ? -p.z : p.y};
      if (ring.empty() || glm::length(flat - ring.back()) > reach) ring.push_back(flat);
    }
    while (ring.size() > 1 && glm::length(ring.front() - ring.back()) <= reach) ring.pop_back();
    if (ring.size() > 2) plan.rings.push_back(std::move(ring));
  }
  return plan;
}

RoofPiece piece_of(const Roof& roof, bool is_cover, int axis) {
  RoofPiece piece;
  constexpr std::uint32_t unused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> number(roof.point.size(), unused);
  for (const RoofFace& face : roof.faces) {
    if (face.is_cover != is_cover) continue;
    Face added;
    added.first_loop = static_cast<std::uint32_t>(piece.solid.loops.size());
    added.loop_count = static_cast<std::uint32_t>(1 + face.holes.size());
    const auto add = [&](const std::vector<std::uint32_t>& loop) {
      piece.solid.loops.push_back(
          {static_cast<std::uint32_t>(piece.solid.corners.size()), static_cast<std::uint32_t>(loop.size())});
      for (const std::uint32_t i : loop) {
        if (number[i] == unused) {
          number[i] = static_cast<std::uint32_t>(piece.solid.points.size());
          const dvec3 p = roof.point[i];
          piece.solid.points.push_back(axis == 1 ? p : dvec3(p.x, -p.z, p.y));
        }
        piece.solid.corners.push_back(number[i]);
      }
    };
    add(face.outline);
    for (const auto& hole : face.holes) add(hole);
    piece.solid.faces.push_back(added);
  }
  piece.solid.is_closed = !piece.solid.faces.empty();
  if (piece.solid.is_closed) fit(piece.solid, piece.low, piece.size);
  return piece;
}

}  // namespace

RoofPieces roof_pieces(const Solid& face, int axis, const dvec3& size, const RoofOptions& options,
                       const Job& job) {
  RoofPieces pieces;
  const seedmesh::Plan plan = plan_of(face, axis, size);
  if (const std::vector<PlanFault> faults = faults_of(plan); !faults.empty()) {
    pieces.warnings.push_back("no roof over an outline that touches itself: " + faults[0].message);
    return pieces;
  }
  Roof made = roof(plan, options, job);
  pieces.warnings = std::move(made.warnings);
  if (made.height > 0 && options.kind != RoofKind::flat) pieces.body = piece_of(made, false, axis);
  pieces.cover = piece_of(made, true, axis);
  return pieces;
}

}  // namespace seedmesh::building

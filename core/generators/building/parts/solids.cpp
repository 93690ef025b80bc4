// Boxes, cylinders, prisms and pyramids.
#include "core/generators/building/parts/part_makers.h"

namespace seedmesh::building {

using glm::dvec2;
using glm::dvec3;

namespace {

std::vector<PartPiece> plain_box(std::string_view role, const dvec3& size, Job& job) {
  PartWriter out(job);
  out.box(role, dvec3(0), size);
  return out.take();
}

}  // namespace

std::vector<PartPiece> make_box(const dvec3& size, const PartOptions&, Job& job) {
  return plain_box("wall", size, job);
}

std::vector<PartPiece> make_wall(const dvec3& size, const PartOptions&, Job& job) {
  return plain_box("wall", size, job);
}

std::vector<PartPiece> make_floor(const dvec3& size, const PartOptions&, Job& job) {
  return plain_box("floor", size, job);
}

std::vector<PartPiece> make_cylinder(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  out.revolve("wall", {{0, 0}, {1, 0}, {1, size.y}, {0, size.y}},
              {{0.5 * size.x, 0, 0.5 * size.z},
               {0.5 * size.x, 0.5 * size.z},
               options.count > 0 ? options.count : 24});
  return out.take();
}

/// Four trapezia between a floor and a top half as wide.
std::vector<PartPiece> make_prism(const dvec3& size, const PartOptions&, Job& job) {
  PartWriter out(job);
  const PlanRing low = rectangle({0, -size.z}, {size.x, 0});
  const PlanRing high = rectangle({0.25 * size.x, -0.75 * size.z}, {0.75 * size.x, -0.25 * size.z});
  std::vector<dvec3> floor, top;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    out.face("roof",
             {raised(low[i], 0), raised(low[next], 0), raised(high[next], size.y), raised(high[i], size.y)});
    floor.insert(floor.begin(), raised(low[i], 0));
    top.push_back(raised(high[i], size.y));
  }
  out.face("roof", top);
  out.face("roof", floor);
  return out.take();
}

std::vector<PartPiece> make_pyramid(const dvec3& size, const PartOptions&, Job& job) {
  PartWriter out(job);
  const PlanRing low = rectangle({0, -size.z}, {size.x, 0});
  const dvec3 apex{0.5 * size.x, size.y, 0.5 * size.z};
  std::vector<dvec3> floor;
  for (std::size_t i = 0; i < 4; ++i) {
    out.face("roof", {raised(low[i], 0), raised(low[(i + 1) % 4], 0), apex});
    floor.insert(floor.begin(), raised(low[i], 0));
  }
  out.face("roof", floor);
  return out.take();
}

std::vector<PartPiece> make_triangular_prism(const dvec3& size, const PartOptions&, Job& job) {
  PartWriter out(job);
  if (size.x >= size.z) {
    out.extrude("roof", Plan{{{{-size.z, 0}, {0, 0}, {-0.5 * size.z, size.y}}}},
                {ExtrusionAxis::x, 0, size.x});
  } else {
    out.extrude("roof", Plan{{{{0, 0}, {size.x, 0}, {0.5 * size.x, size.y}}}}, {ExtrusionAxis::z, 0, size.z});
  }
  return out.take();
}

}  // namespace seedmesh::building

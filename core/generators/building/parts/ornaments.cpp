// Towers, bells, roofs of factories, chimneys, ledges, balconies, columns, stairs.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/parts/part_makers.h"

namespace seedmesh::building {

using glm::dvec2;
using glm::dvec3;

namespace {

/// A whole number near size / step, within bounds.
int count_of(double size, double step, int least, int most) {
  return std::clamp(math::to_int32(std::floor(size / step + 0.5)), least, most);
}

void add_pyramid(PartWriter& out, const dvec3& low, const dvec3& high) {
  const PlanRing ring = rectangle({low.x, -high.z}, {high.x, -low.z});
  const dvec3 apex{0.5 * (low.x + high.x), high.y, 0.5 * (low.z + high.z)};
  std::vector<dvec3> floor;
  for (std::size_t i = 0; i < 4; ++i) {
    out.face("roof", {raised(ring[i], low.y), raised(ring[(i + 1) % 4], low.y), apex});
    floor.insert(floor.begin(), raised(ring[i], low.y));
  }
  out.face("roof", floor);
}

}  // namespace

/// A shaft, open arcades under a cornice, and a spire.
std::vector<PartPiece> make_tower(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  const double angle = options.angle > 0 ? options.angle : math::radians(55);
  const double inset = 0.06 * std::min(size.x, size.z);
  const double spire = std::min(0.5 * std::min(size.x, size.z) * math::tan(angle), 0.45 * size.y);
  const double eave = size.y - spire, arcade = 0.18 * size.y, floor = eave - arcade, slab = 0.02 * size.y;
  out.box("wall", {inset, 0, inset}, {size.x - inset, floor, size.z - inset});
  out.box("stone", {0.4 * inset, floor - slab, 0.4 * inset},
          {size.x - 0.4 * inset, floor + 0.5 * slab, size.z - 0.4 * inset});
  const double pier = 0.2 * std::min(size.x, size.z);
  for (const dvec2 corner : {dvec2(0, 0), dvec2(1, 0), dvec2(0, 1), dvec2(1, 1)}) {
    const double x = inset + corner.x * (size.x - 2 * inset - pier),
                 z = inset + corner.y * (size.z - 2 * inset - pier);
    out.box("wall", {x, floor, z}, {x + pier, eave, z + pier});
  }
  out.box("stone", {0.2 * inset, eave - slab, 0.2 * inset},
          {size.x - 0.2 * inset, eave + 0.5 * slab, size.z - 0.2 * inset});
  add_pyramid(out, {0, eave, 0}, size);
  return out.take();
}

/// Bronze with a hollow inside, a clapper, and a yoke of wood.
std::vector<PartPiece> make_bell(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  const double h = 0.86 * size.y;
  const dvec3 foot{0.5 * size.x, 0, 0.5 * size.z};
  const dvec2 half{0.5 * size.x, 0.5 * size.z};
  const int sides = options.count > 0 ? options.count : 32;
  out.revolve("bronze",
              {{0, 0.82 * h},
               {0.4, 0.78 * h},
               {0.5, 0.6 * h},
               {0.58, 0.35 * h},
               {0.72, 0.14 * h},
               {0.9, 0.01 * h},
               {0.97, 0},
               {1, 0.03 * h},
               {0.84, 0.17 * h},
               {0.68, 0.38 * h},
               {0.6, 0.62 * h},
               {0.52, 0.83 * h},
               {0.4, 0.93 * h},
               {0.2, 0.98 * h},
               {0, h}},
              {foot, half, sides});
  out.revolve("metal",
              {{0, 0.03 * h},
               {0.1, 0.06 * h},
               {0.14, 0.14 * h},
               {0.1, 0.2 * h},
               {0.035, 0.24 * h},
               {0.035, 0.84 * h},
               {0, 0.88 * h}},
              {foot, half, 12});
  out.box("wood", {0.06 * size.x, 0.95 * h, 0.4 * size.z}, {0.94 * size.x, size.y, 0.6 * size.z});
  return out.take();
}

/// Saw teeth with glass on their vertical side, to the right.
std::vector<PartPiece> make_factory_roof(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  const int teeth = options.count > 0 ? std::min(options.count, 64) : 4;
  const double valley = 0.18 * size.y;
  PlanRing ring{{0, 0}, {size.x, 0}};
  for (int tooth = teeth; tooth-- > 0;) {
    ring.emplace_back(size.x * (tooth + 1) / teeth, valley);
    ring.emplace_back(size.x * (tooth + 1) / teeth, size.y);
  }
  ring.emplace_back(0, valley);
  const auto last = static_cast<std::uint32_t>(ring.size() - 1);
  const auto side = [last](std::uint32_t edge) -> std::string_view {
    if (edge < 2 || edge == last) return "wall";
    return edge % 2 == 0 ? "glass" : "roof";
  };
  out.extrude("wall", Plan{{ring}}, {ExtrusionAxis::z, 0, size.z, side});
  return out.take();
}

/// A round stack if the height is more than five times the width, else bricks with a slab and pots.
std::vector<PartPiece> make_chimney(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  if (size.y > 5 * std::max(size.x, size.z)) {
    const double h = size.y;
    out.revolve("brick",
                {{0, 0},
                 {1, 0},
                 {1, 0.04 * h},
                 {0.9, 0.05 * h},
                 {0.66, 0.94 * h},
                 {0.78, 0.955 * h},
                 {0.78, 0.985 * h},
                 {0.7, h},
                 {0.52, h},
                 {0.5, 0.93 * h},
                 {0, 0.93 * h}},
                {{0.5 * size.x, 0, 0.5 * size.z},
                 {0.5 * size.x, 0.5 * size.z},
                 options.count > 0 ? options.count : 24});
    return out.take();
  }
  const double inset = 0.1 * std::min(size.x, size.z), cap = 0.78 * size.y, slab = 0.06 * size.y;
  out.box("brick", {inset, 0, inset}, {size.x - inset, cap + 0.5 * slab, size.z - inset});
  out.box("stone", {0, cap, 0}, {size.x, cap + slab, size.z});
  const bool is_wide = size.x >= size.z;
  const double across = std::min(size.x, size.z), along = std::max(size.x, size.z);
  const int pots = count_of(along, across, 1, 6);
  const double radius = 0.26 * across, foot = cap + 0.5 * slab, rise = size.y - foot;
  for (int pot = 0; pot < pots; ++pot) {
    const double at = along * (pot + 0.5) / pots;
    out.revolve("clay",
                {{0, 0},
                 {1, 0},
                 {0.85, 0.8 * rise},
                 {1, 0.85 * rise},
                 {1, rise},
                 {0.72, rise},
                 {0.7, 0.6 * rise},
                 {0, 0.6 * rise}},
                {{is_wide ? at : 0.5 * size.x, foot, is_wide ? 0.5 * size.z : at}, {radius, radius}, 12});
  }
  return out.take();
}

/// A moulding that projects from the wall at z = 0.
std::vector<PartPiece> make_ledge(const dvec3& size, const PartOptions&, Job& job) {
  PartWriter out(job);
  const double d = size.z, h = size.y;
  out.extrude("stone",
              Plan{{{{-0.35 * d, 0},
                     {0, 0},
                     {0, h},
                     {-d, 0.94 * h},
                     {-d, 0.6 * h},
                     {-0.7 * d, 0.5 * h},
                     {-0.5 * d, 0.3 * h},
                     {-0.35 * d, 0.2 * h}}}},
              {ExtrusionAxis::x, 0, size.x});
  return out.take();
}

std::vector<PartPiece> make_balcony(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  const double slab = 0.13 * size.y, rail = std::min({options.frame > 0 ? options.frame : 0.05,
                                                      0.2 * std::min(size.x, size.z), 0.4 * size.y});
  out.box("stone", dvec3(0), {size.x, slab, size.z});
  // A hand rail on three sides, a little inside the edge of the slab.
  const double edge = 0.2 * rail, low = size.y - rail;
  const Plan top{{{{edge, 0},
                   {edge, -size.z + edge},
                   {size.x - edge, -size.z + edge},
                   {size.x - edge, 0},
                   {size.x - edge - rail, 0},
                   {size.x - edge - rail, -size.z + edge + rail},
                   {edge + rail, -size.z + edge + rail},
                   {edge + rail, 0}}}};
  out.extrude("metal", top, {ExtrusionAxis::y, low, size.y});
  const double bar = 0.3 * rail, middle = edge + 0.5 * rail;
  const auto post = [&](double x, double z, double half) {
    out.box("metal", {x - half, 0.5 * slab, z - half}, {x + half, low + 0.5 * rail, z + half});
  };
  const int across = count_of(size.x - 2 * middle, 0.2, 1, 200),
            along = count_of(size.z - middle, 0.2, 1, 60);
  for (int i = 0; i <= across; ++i) {
    post(middle + (size.x - 2 * middle) * i / across, size.z - middle,
         i == 0 || i == across ? 2 * bar / 1.5 : bar);
  }
  for (int i = 0; i < along; ++i) {
    const double z = 0.5 * rail + (size.z - middle - 0.5 * rail) * i / along;
    post(middle, z, bar);
    post(size.x - middle, z, bar);
  }
  return out.take();
}

/// After the Tuscan order: plinth, base, a shaft with entasis, and a capital.
std::vector<PartPiece> make_column(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  const double h = size.y, plinth = 0.05 * h, abacus = 0.045 * h;
  out.box("stone", dvec3(0), {size.x, plinth, size.z});
  out.box("stone", {0.04 * size.x, h - abacus, 0.04 * size.z}, {0.96 * size.x, h, 0.96 * size.z});
  std::vector<ProfilePoint> profile{{0, 0.5 * plinth},          {0.9, 0.5 * plinth},
                                    {0.97, plinth + 0.012 * h}, {0.95, plinth + 0.028 * h},
                                    {0.84, plinth + 0.036 * h}, {0.8, plinth + 0.05 * h}};
  const double from = plinth + 0.05 * h, to = h - abacus - 0.075 * h;
  for (int i = 1; i <= 6; ++i) {
    const double share = i / 6.0, swell = share < 0.33 ? 0 : (share - 0.33) / 0.67;
    profile.push_back({0.8 - 0.14 * swell * swell, from + share * (to - from)});
  }
  for (const ProfilePoint p : {ProfilePoint{0.74, to + 0.006 * h},
                               {0.74, to + 0.016 * h},
                               {0.67, to + 0.022 * h},
                               {0.68, to + 0.042 * h},
                               {0.88, h - abacus - 0.004 * h},
                               {0.88, h - 0.5 * abacus},
                               {0, h - 0.5 * abacus}})
    profile.push_back(p);
  out.revolve("stone", profile,
              {{0.5 * size.x, 0, 0.5 * size.z},
               {0.5 * size.x, 0.5 * size.z},
               options.count > 0 ? options.count : 20});
  return out.take();
}

/// Steps that rise from the front to the back.
std::vector<PartPiece> make_stairs(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  const int steps = options.count > 0 ? std::min(options.count, 1000) : count_of(size.y, 0.17, 1, 1000);
  PlanRing ring{{-size.z, 0}, {0, 0}, {0, size.y}};
  for (int step = steps; step-- > 0;) {
    const double z = size.z * (steps - step) / steps;
    ring.emplace_back(-z, size.y * (step + 1) / steps);
    if (step > 0) ring.emplace_back(-z, size.y * step / steps);
  }
  out.extrude("stone", Plan{{ring}}, {ExtrusionAxis::x, 0, size.x});
  return out.take();
}

}  // namespace seedmesh::building

// Doors, windows, dormers.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/parts/part_makers.h"
#include "core/texture/joinery.h"
#include "core/texture/rooms.h"

namespace seedmesh::building {

using glm::dvec2;
using glm::dvec3;

/// The width of a frame: the requested width or a share of the size, at most a third of it.
double frame_width(const dvec3& size, const PartOptions& options, double share) {
  const double least = std::min(size.x, size.y);
  return std::min(options.frame > 0 ? options.frame : std::min(share * least, 0.12), least / 3);
}

/// The number of a room in the texture of rooms.
int room_of(const PartOptions& options) { return std::clamp(options.room, 0, texture::room_count - 1); }

/// What lies behind the glass shows in it.
std::string_view glass_of(int room) {
  switch (texture::room_kind(room)) {
    case texture::RoomKind::dark:
      return "glass";
    case texture::RoomKind::blind:
      return "glass_shaded";
    default:
      return "glass_curtained";
  }
}

/// A frame with openings, and glass in the middle of its depth.
void add_window(PartWriter& out, const dvec3& low, const dvec3& high, const PartOptions& options) {
  const dvec3 size = high - low;
  const double frame = frame_width(size, options, 0.08), bar = 0.5 * frame;
  // Panes are at least as wide as the bars between them.
  const int most = std::clamp(math::to_int32((size.x - 2 * frame + bar) / (2 * bar)), 1, 64);
  const int wanted = options.count > 0 ? options.count : math::to_int32(std::floor(size.x / 0.75 + 0.5));
  const int columns = std::clamp(wanted, 1, most);
  const int rows = size.y > 1.4 * size.x / columns ? 2 : 1;
  const double width = (size.x - 2 * frame - (columns - 1) * bar) / columns;
  // Of two rows of panes the upper one is smaller.
  const double height = size.y - 2 * frame, split = rows == 2 ? 0.68 * (height - bar) : height;
  Plan outline{{rectangle(dvec2(low), dvec2(high))}};
  for (int column = 0; column < columns; ++column) {
    const double x = low.x + frame + column * (width + bar), y = low.y + frame;
    PlanRing hole = rectangle({x, y}, {x + width, y + split});
    outline.rings.emplace_back(hole.rbegin(), hole.rend());
    if (rows == 1) continue;
    hole = rectangle({x, y + split + bar}, {x + width, y + height});
    outline.rings.emplace_back(hole.rbegin(), hole.rend());
  }
  out.extrude("frame", outline, {ExtrusionAxis::z, low.z, high.z});
  const double inset = 0.5 * frame;
  const dvec3 glass_low{low.x + inset, low.y + inset, low.z + 0.4 * size.z},
      glass_high{high.x - inset, high.y - inset, low.z + 0.55 * size.z};
  const int room = room_of(options);
  constexpr int across = texture::rooms_across;
  out.picture_box(glass_of(room), glass_low, glass_high,
                  {dvec2(room % across, room / across) / double(across), dvec2(1.0 / across)});
}

std::vector<PartPiece> make_window(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  add_window(out, dvec3(0), size, options);
  return out.take();
}

/// The leaf of a door by its number from 1; 0: boards for wide leaves, panels for others.
PartWriter::PictureWindow leaf_picture(int number, double width) {
  constexpr double widest_panelled = 1.15;
  using texture::Joinery;
  const Joinery kind = number > 0                ? static_cast<Joinery>((number - 1) % 3)
                       : width > widest_panelled ? Joinery::planks
                                                 : Joinery::six_panels;
  const int at = static_cast<int>(kind);
  constexpr int across = texture::joinery_across;
  return {dvec2(at % across, at / across) / double(across), dvec2(1.0 / across)};
}

std::vector<PartPiece> make_door(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  const double frame = frame_width(size, options, 0.08), depth = 0.7 * size.z;
  const double right = size.x - frame, top = size.y - frame;
  out.extrude("frame",
              Plan{{{{0, 0},
                     {frame, 0},
                     {frame, top},
                     {right, top},
                     {right, 0},
                     {size.x, 0},
                     {size.x, size.y},
                     {0, size.y}}}},
              {ExtrusionAxis::z, 0, depth});
  // One leaf, or two if the door is wide.
  const int leaves = size.x > 0.75 * size.y ? 2 : 1;
  const double gap = 0.1 * frame, width = (right - frame) / leaves, leaf_back = 0.25 * depth,
               leaf_front = 0.75 * depth;
  for (int leaf = 0; leaf < leaves; ++leaf) {
    const double x = frame + leaf * width, inner = leaf > 0 ? gap : -0.3 * frame;
    const double outer = leaf + 1 < leaves ? gap : -0.3 * frame;
    const dvec3 low{x + inner, 0.004 * size.y, leaf_back},
        high{x + width - outer, top + 0.3 * frame, leaf_front};
    out.picture_box("door", low, high, leaf_picture(options.count, width));
    // The handle: a stem from the leaf, and a square bar.
    const double side_of_lock = leaf % 2 == 0 ? x + 0.93 * width : x + 0.07 * width;
    const double thick = std::min(0.012 * size.y, 0.025), reach = leaf % 2 == 0 ? -5 * thick : 5 * thick;
    const double y = 0.48 * size.y, front = size.z, stem = depth + 0.3 * (front - depth);
    out.box("metal", {side_of_lock - 0.5 * thick, y, leaf_front - 0.1 * depth},
            {side_of_lock + 0.5 * thick, y + 0.8 * thick, stem + 0.2 * (front - stem)});
    out.box("metal", {std::min(side_of_lock + reach, side_of_lock - thick), y - 0.1 * thick, stem},
            {std::max(side_of_lock + reach, side_of_lock + thick), y + 0.9 * thick, front});
  }
  return out.take();
}

std::vector<PartPiece> make_dormer(const dvec3& size, const PartOptions& options, Job& job) {
  PartWriter out(job);
  const double angle = options.angle > 0 ? options.angle : math::pi / 4;
  const double middle = 0.5 * size.x, rise = std::min(middle * math::tan(angle), 0.6 * size.y);
  const double eave = size.y - rise, thick = 0.06 * size.y, inset = 0.06 * size.x, front = 0.93 * size.z;
  out.extrude("roof",
              Plan{{{{0, eave - thick},
                     {middle, size.y - thick},
                     {size.x, eave - thick},
                     {size.x, eave},
                     {middle, size.y},
                     {0, eave}}}},
              {ExtrusionAxis::z, 0, size.z});
  // Walls end in the middle of the roof's thickness.
  const double slope = rise / middle, shoulder = eave - 0.5 * thick + slope * inset;
  out.extrude("wall",
              Plan{{{{inset, 0},
                     {size.x - inset, 0},
                     {size.x - inset, shoulder},
                     {middle, size.y - 0.5 * thick},
                     {inset, shoulder}}}},
              {ExtrusionAxis::z, 0.02 * size.z, front});
  const double left = 0.25 * size.x, sill = 0.12 * size.y, head = std::min(shoulder, 0.75 * size.y);
  add_window(out, {left, sill, front - 0.04 * size.z}, {size.x - left, head, 0.98 * size.z}, options);
  return out.take();
}

}  // namespace seedmesh::building

#include "core/texture/rooms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/quick_math.h"

namespace seedmesh::texture {
namespace {

// Tones of the surfaces of a room, from the window to its back.
constexpr float ceiling_tone = 0.5F, wall_tone = 0.4F, floor_tone = 0.3F, back_tone = 0.26F, fade = 0.62F;
// This room has no things.
constexpr int empty_room = 10;
constexpr float cloth_tone = 0.82F, blind_tone = 0.78F;

/// A rectangle on the back wall or before it; coordinates are 0 to 1 across and up the window.
struct Thing {
  float x0, y0, x1, y1, tone;
};

struct Room {
  RoomKind kind = RoomKind::dark;
  glm::vec2 far_low{0.25F}, far_high{0.75F};  ///< the back wall
  std::array<Thing, 4> things{};
  float warm = 0;  ///< share of the accent colour: light of a lamp
  glm::vec2 lamp{0.5F};
  float lamp_size = 0;              ///< 0: no lamp
  float left = 0.2F, right = 0.8F;  ///< inner edges of the curtains
  float drop = 0.5F;                ///< lower edge of the blind, or upper edge of the short curtain
  float pleats = 9, brightness = 1;
};

float draw(Rng& rng, double low, double high) { return static_cast<float>(rng.uniform(low, high)); }

Room room_of(int number, Rng rng) {
  Room room;
  room.kind = room_kind(number);
  const float middle = draw(rng, 0.4, 0.6), deep = draw(rng, 0.16, 0.27);
  room.far_low = {middle - deep, 0.4F - deep};
  room.far_high = {middle + deep, 0.52F + 0.8F * deep};
  room.brightness = draw(rng, 0.65, 1.15);
  const float wide = room.far_high.x - room.far_low.x, high = room.far_high.y - room.far_low.y;
  const auto on_back = [&](float x0, float y0, float x1, float y1, float tone) {
    return Thing{room.far_low.x + x0 * wide, room.far_low.y + y0 * high, room.far_low.x + x1 * wide,
                 room.far_low.y + y1 * high, tone};
  };
  const float door = draw(rng, 0.05, 0.6);
  const float door_tone = draw(rng, 0.05, 0.5);
  if (number == empty_room) return room;
  room.things[0] = on_back(door, 0, door + 0.26F, 0.78F, door_tone);
  const float picture = draw(rng, 0.1, 0.65), picture_end = picture + draw(rng, 0.15, 0.3);
  const float picture_tone = draw(rng, 0.05, 0.75);
  room.things[1] = on_back(picture, 0.5F, picture_end, 0.8F, picture_tone);
  // Furniture stands in the room, and plants on the sill.
  const float chair = draw(rng, 0.05, 0.7), width = draw(rng, 0.12, 0.3);
  room.things[2] = {chair, 0, chair + width, draw(rng, 0.15, 0.4), draw(rng, 0.04, 0.2)};
  const float pot = draw(rng, 0.05, 0.9);
  room.things[3] = {pot, 0, pot + draw(rng, 0.04, 0.1), draw(rng, 0.06, 0.2), draw(rng, 0.05, 0.35)};
  if (draw(rng, 0, 1) < 0.35F) {
    room.warm = draw(rng, 0.15, 0.45);
    room.lamp = {draw(rng, 0.35, 0.65), draw(rng, 0.62, 0.8)};
    room.lamp_size = draw(rng, 0.03, 0.06);
  }
  room.left = draw(rng, 0.14, 0.34);
  room.right = 1 - draw(rng, 0.14, 0.34);
  room.drop = room.kind == RoomKind::blind ? draw(rng, 0.15, 0.7) : draw(rng, 0.35, 0.55);
  room.pleats = draw(rng, 7, 13);
  return room;
}

/// The tone of floor, ceiling, walls or back at a point.
float box_tone(const Room& room, const glm::vec2& p) {
  const float left = p.x / room.far_low.x, right = (1 - p.x) / (1 - room.far_high.x),
              down = p.y / room.far_low.y, up = (1 - p.y) / (1 - room.far_high.y);
  const float depth = std::min({left, right, down, up});  // 0 at the window, 1 at the back
  if (depth >= 1) return back_tone;
  const float lit = 1 - fade * depth;
  if (depth == up) return ceiling_tone * lit;
  return (depth == down ? floor_tone : wall_tone) * lit;
}

struct Seen {
  float tone, accent;
};

/// What is the same in all rows of a room: the tones of cloth at each texel of a row.
struct Drapery {
  std::vector<float> long_cloth, short_cloth;
};

Drapery drapery_of(const Room& room, int cell) {
  Drapery made;
  for (int x = 0; x < cell; ++x) {
    const float across = (static_cast<float>(x) + 0.5F) / static_cast<float>(cell);
    const math::SinCos fold = math::quick_sincos(2 * math::pi * static_cast<double>(across * room.pleats));
    const float tone = cloth_tone + 0.16F * static_cast<float>(fold.sin);
    made.long_cloth.push_back(clamp_share(tone));
    made.short_cloth.push_back(clamp_share(tone * 0.95F));
  }
  return made;
}

/// The things that a row of texels crosses, in their order.
struct Crossed {
  std::array<Thing, 4> things{};
  std::size_t count = 0;
};

Crossed crossed(const Room& room, float up) {
  Crossed found;
  for (const Thing& thing : room.things) {
    if (up >= thing.y0 && up < thing.y1) found.things[found.count++] = thing;
  }
  return found;
}

Seen seen_in(const Room& room, const Crossed& crossed, const glm::vec2& p) {
  float tone = box_tone(room, p);
  for (std::size_t i = 0; i < crossed.count; ++i) {
    const Thing& thing = crossed.things[i];
    if (p.x >= thing.x0 && p.x < thing.x1) tone = thing.tone * 0.8F;
  }
  if (room.lamp_size <= 0) return {clamp_share(tone * room.brightness), 0};
  const glm::vec2 off = p - room.lamp;
  const float apart = std::sqrt(off.x * off.x + off.y * off.y);
  const float glow = room.warm / (1 + 60 * apart * apart);
  if (apart < room.lamp_size) return {0.95F, 1};
  return {clamp_share((tone + 0.5F * glow) * room.brightness), 0};
}

/// Writes the texels of a row that show one room. `up`: position in the room, from 0 at its floor to 1.
void paint_row(const Room& room, const Drapery& drapery, float up, int cell, const ReliefRow& out) {
  const Crossed things = crossed(room, up);
  const bool is_short_cloth = room.kind == RoomKind::short_curtain && up < room.drop;
  const bool is_blind = room.kind == RoomKind::blind && up > room.drop;
  const float slat = up * 28 - std::floor(up * 28);
  for (int x = 0; x < cell; ++x) {
    const auto column = static_cast<std::size_t>(x);
    const float across = (static_cast<float>(x) + 0.5F) / static_cast<float>(cell);
    Seen seen{};
    if (room.kind == RoomKind::curtains && (across < room.left || across > room.right)) {
      seen = {drapery.long_cloth[column], 0.5F * room.warm};
    } else if (is_short_cloth) {
      seen = {drapery.short_cloth[column], 0.5F * room.warm};
    } else if (is_blind) {
      seen = {slat < 0.25F ? 0.5F * blind_tone : blind_tone - 0.14F * slat, 0.4F * room.warm};
    } else {
      seen = seen_in(room, things, {across, up});
    }
    out.height[x] = 0.5F;
    out.tone[x] = seen.tone;
    out.accent[x] = seen.accent;
  }
}

}  // namespace

RoomKind room_kind(int room) {
  constexpr std::array<RoomKind, room_count> kinds{
      RoomKind::dark,     RoomKind::curtains, RoomKind::blind, RoomKind::short_curtain,
      RoomKind::dark,     RoomKind::dark,     RoomKind::dark,  RoomKind::dark,
      RoomKind::dark,     RoomKind::dark,     RoomKind::dark,  RoomKind::curtains,
      RoomKind::curtains, RoomKind::blind,    RoomKind::blind, RoomKind::short_curtain};
  return kinds[static_cast<std::size_t>(room)];
}

Relief rooms(int size, Rng rng, const Job& job) {
  const int cell = size / rooms_across;
  std::vector<Room> all;
  std::vector<Drapery> draperies;
  for (int i = 0; i < room_count; ++i) {
    all.push_back(room_of(i, rng.at(static_cast<std::uint64_t>(i))));
    draperies.push_back(drapery_of(all.back(), cell));
  }
  return paint_rows(size, Accent::painted, job, [&](int begin, int end, const auto& row_at) {
    for (int y = begin; y < end; ++y) {
      const ReliefRow out = row_at(y);
      const float up = 1 - (static_cast<float>(y % cell) + 0.5F) / static_cast<float>(cell);
      for (int i = 0; i < rooms_across; ++i) {
        const auto number = static_cast<std::size_t>(y / cell * rooms_across + i);
        const int first = i * cell;
        paint_row(all[number], draperies[number], up, cell,
                  {out.height + first, out.tone + first, out.accent + first});
      }
    }
  });
}

}  // namespace seedmesh::texture

#pragma once
/// What shows behind window panes: rooms_across by rooms_across rooms in perspective, as one dark texture.
///
/// The first half are dark rooms, then come rooms with curtains, with a blind and with a short curtain.
#include "core/base/rng.h"
#include "core/texture/relief.h"

namespace seedmesh::texture {

constexpr int rooms_across = 4, room_count = rooms_across * rooms_across;

/// What hangs in a window.
enum class RoomKind { dark, curtains, blind, short_curtain };

/// Returns the kind of a room, 0 to room_count - 1. The first four rooms have one kind each.
RoomKind room_kind(int room);

/// Paints the rooms, in rows from the upper left. Tones are low, as glass reflects little from within. Cost: about 15 ns
/// a texel.
Relief rooms(int size, Rng rng, const Job& job);

}  // namespace seedmesh::texture

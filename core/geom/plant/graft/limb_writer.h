#pragma once
/// Writes one limb of graft(): plan, first ring, strips from ring to ring, tip.
#include "core/geom/plant/graft/ring_writer.h"

namespace seedmesh {

/// The least length of a closed limb, as a multiple of the least vertex distance (Scale::apart): 4 mm in a
/// tree of 17 m.
constexpr float least_closed_length = 60;

/// Appends a limb to the buffers, joined by GraftInput::join, and records its range, its start and the
/// loops of its side limbs. Parents must be written before their children. Limbs that are too thin, too short
/// or hidden inside their parent are left out; their range is empty.
void write_limb(LimbWriter& w, std::uint32_t limb);

}  // namespace seedmesh

#include "core/generators/tree/weber_penn_bends.h"

#include "core/base/wide.h"
#include "core/generators/tree/wide_chance.h"

namespace seedmesh::tree {
namespace {

// Lanes of the widest vectors of doubles; a few stems too many are reckoned rather than one by one.
constexpr std::size_t lanes = 8;
constexpr std::size_t most = WeberPennBends::most;

/// The same of all stems.
struct Bend {
  double curve, curve_v, attraction;
  int segments;
  std::uint64_t segment;
};

/// As WeberPennGrower::turned() does it.
SEEDMESH_WIDE void bend_all(const Bend how, std::size_t count, const std::uint64_t* __restrict key,
                            const double (*__restrict from)[most], double (*__restrict to)[most]) {
  for (std::size_t i = 0; i < count; ++i) {
    const Frame frame = frame_in(from, i);
    const double chance =
        drawn_at(key_at(key[i], place_of("curve")), how.segment, how.curve_v) / how.segments;
    const double varied = how.curve_v > 0 ? how.curve + chance : how.curve;
    const double lifted = how.attraction != 0 ? varied - lift(frame, how.attraction, how.segments) : varied;
    put_frame(to, i, pitch(frame, math::quick_sincos_degrees(std::clamp(lifted, -170.0, 170.0))));
  }
}

}  // namespace

void WeberPennBends::reckon(const WeberPennLevel& level, double attraction) {
  const std::size_t count = (size_ + lanes - 1) / lanes * lanes;
  for (int segment = 1; segment < level.curve_res; ++segment) {
    const Bend how{curve_before(level, segment), std::max(0.0, level.curve_v), attraction, level.curve_res,
                   static_cast<std::uint64_t>(segment)};
    bend_all(how, count, key_, axis_[segment - 1], axis_[segment]);
  }
}

}  // namespace seedmesh::tree

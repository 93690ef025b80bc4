#include "core/geom/plant/graft/bark_rounds.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/geom/plant/graft/limb_writer.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
// With fewer triangles to check, one thread is faster.
constexpr std::size_t many_triangles = 4096;

/// Limbs whose join mode has changed, and the limbs that they grow from.
void find_dirty(const GraftInput& in, BarkRounds& rounds) {
  if (rounds.parent.empty()) rounds.parent = parent_limbs(in);
  std::fill(rounds.dirty.begin(), rounds.dirty.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < rounds.dirty.size(); ++i) {
    if (in.join[i] == rounds.written[i]) continue;
    rounds.dirty[i] = 1;
    if (rounds.parent[i] != none) rounds.dirty[rounds.parent[i]] = 1;
  }
}

bool is_same_loop(const BarkBuffers& bark, const Loop& now, const Loop& before) {
  if (now.first == before.first) return true;
  if (now.first == none || before.first == none) return false;
  if (now.count != before.count || now.radius != before.radius || now.reach != before.reach ||
      now.u != before.u || now.is_fork != before.is_fork) {
    return false;
  }
  for (std::uint32_t i = 0; i < now.count; ++i) {
    const LoopVertex &a = bark.loop_vertices[now.first + i], &b = bark.loop_vertices[before.first + i];
    if (a.position != b.position || a.angle != b.angle || a.reach != b.reach || a.joint != b.joint)
      return false;
  }
  return true;
}

/// Keeps a limb as it is. Its parent may have written its loop again: then it gets the groups of the new
/// loop.
void keep_limb(BarkBuffers& bark, std::uint32_t limb, const Loop& before) {
  const Loop& now = bark.loops[limb];
  const LimbRange& range = bark.range[limb];
  if (now.first == before.first || range.begin.vertex == range.end.vertex) return;
  const std::uint32_t old_group = bark.loop_vertices[before.first].group;
  const std::uint32_t new_group = bark.loop_vertices[now.first].group;
  for (std::uint32_t i = 0; i <= now.count; ++i) {
    std::uint32_t& group = bark.group[range.begin.vertex + i];
    group = group - old_group + new_group;
  }
}

/// Forgets the loops that a limb has made for its side limbs.
void forget_loops(BarkBuffers& bark, const LimbRange& range) {
  for (std::size_t pair = range.begin.group / 2; pair < range.end.group / 2; ++pair)
    bark.loops[bark.group_limb[pair]] = {};
}

void write_dirty_limbs(const GraftInput& in, BarkBuffers& bark, BarkRounds& rounds, bool is_first, Job& job) {
  const std::vector<Loop> before = is_first ? std::vector<Loop>{} : bark.loops;
  LimbWriter writer(in, bark);
  for (std::uint32_t limb = 0; limb < bark.range.size(); ++limb) {
    if (limb % 64 == 0) job.check();
    if (!rounds.dirty[limb]) {
      if (is_same_loop(bark, bark.loops[limb], before[limb])) {
        keep_limb(bark, limb, before[limb]);
        continue;
      }
      rounds.dirty[limb] = 1;
    }
    if (!is_first) forget_loops(bark, bark.range[limb]);
    write_limb(writer, limb);
  }
}

/// Dirty limbs, the limbs that they grow from, and those that begin at one of them.
void find_rechecks(const BarkBuffers& bark, BarkRounds& rounds) {
  rounds.touched.assign(bark.group_limb.size(), 0);
  rounds.recheck.assign(bark.range.size(), Recheck::nothing);
  for (std::size_t limb = 0; limb < bark.range.size(); ++limb) {
    const LimbRange& range = bark.range[limb];
    for (std::size_t pair = range.begin.group / 2; pair < range.end.group / 2; ++pair)
      rounds.touched[pair] = rounds.dirty[limb] | rounds.dirty[bark.group_limb[pair]];
    const std::uint32_t parent = rounds.is_first() ? none : rounds.parent[limb];
    if (parent != none && rounds.dirty[parent])
      rounds.recheck[limb] = std::max(rounds.recheck[limb], Recheck::loop);
    if (!rounds.dirty[limb]) continue;
    rounds.recheck[limb] = Recheck::all;
    if (parent != none) rounds.recheck[parent] = Recheck::all;
  }
  std::size_t triangles = 0;
  for (std::size_t limb = 0; limb < bark.range.size(); ++limb)
    triangles += recheck_end(bark, rounds, limb) - bark.range[limb].begin.triangle;
  rounds.is_large = rounds.is_first() || triangles >= many_triangles;
}

}  // namespace

void write_round(const GraftInput& in, BarkBuffers& bark, BarkRounds& rounds, Job& job) {
  const bool is_first = rounds.written.empty();
  if (is_first) {
    rounds.dirty.assign(bark.range.size(), 1);
  } else {
    find_dirty(in, rounds);
  }
  rounds.written = in.join;
  if (!is_first || !write_in_parts(in, bark, job)) write_dirty_limbs(in, bark, rounds, is_first, job);
  find_rechecks(bark, rounds);
}

void for_chunks(const BarkRounds& rounds, const Job& job, std::size_t count, std::size_t chunk,
                const std::function<void(std::size_t, std::size_t, std::size_t)>& body) {
  if (rounds.is_large) return parallel_for(job, count, chunk, body);
  for (std::size_t i = 0; i < chunk_count(count, chunk); ++i)
    body(i * chunk, std::min(count, (i + 1) * chunk), i);
}

std::uint32_t recheck_end(const BarkBuffers& bark, const BarkRounds& rounds, std::size_t limb) {
  const LimbRange& range = bark.range[limb];
  return rounds.recheck[limb] == Recheck::all    ? range.end.triangle
         : rounds.recheck[limb] == Recheck::loop ? range.first_end
                                                 : range.begin.triangle;
}

bool is_touched(const BarkBuffers& bark, const BarkRounds& rounds, std::uint32_t triangle) {
  const std::uint32_t* corner = bark.corners_of(triangle);
  return std::any_of(corner, corner + 3, [&](std::uint32_t vertex) {
    return bark.group[vertex] != none && rounds.touched[bark.group[vertex] / 2];
  });
}

}  // namespace seedmesh

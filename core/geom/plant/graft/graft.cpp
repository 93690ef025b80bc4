#include "core/geom/plant/graft/graft.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>

#include "core/base/parallel.h"
#include "core/geom/mesh/fixed_radius.h"
#include "core/geom/mesh/manifold_check.h"
#include "core/geom/plant/graft/bark_rounds.h"
#include "core/geom/plant/graft/creases.h"
#include "core/geom/plant/graft/face_check.h"
#include "core/geom/plant/graft/fallback_skin.h"

namespace seedmesh {
namespace {

// From this round on a limb with defects is made by skin(), and after twice as many rounds all limbs are.
constexpr int patient_rounds = 4;
constexpr std::size_t points_a_chunk = std::size_t{1} << 14U;

/// The triangles with a marked vertex. Vertices keep their order, on which welding depends.
Mesh part_with(const Mesh& mesh, const Array<std::uint8_t>& marked, const Job& job) {
  Mesh part;
  part.position = Array<glm::vec3>(job);
  part.index.wide = Array<std::uint32_t>(job);
  const Array<std::uint32_t>& index = mesh.index.wide;
  Array<std::uint32_t> number(job, mesh.position.size(), Limbs::none);
  constexpr std::size_t check_interval = 3 * 16'384;
  const auto is_wanted = [&](std::size_t t) {
    if (t % check_interval == 0) job.check();
    return (marked[index[t]] | marked[index[t + 1]] | marked[index[t + 2]]) != 0;
  };
  for (std::size_t t = 0; t < index.size(); t += 3) {
    for (std::size_t k = 0; k < 3 && is_wanted(t); ++k) number[index[t + k]] = 0;
  }
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == Limbs::none) continue;
    number[i] = static_cast<std::uint32_t>(part.position.size());
    part.position.push_back(mesh.position[i]);
  }
  for (std::size_t t = 0; t < index.size(); t += 3) {
    for (std::size_t k = 0; k < 3 && is_wanted(t); ++k) part.index.wide.push_back(number[index[t + k]]);
  }
  return part;
}

Box box_of(std::span<const glm::vec3> points, const Job& job) {
  std::vector<Box> boxes(chunk_count(points.size(), points_a_chunk));
  parallel_for(job, points.size(), points_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                 job.check();
                 boxes[chunk] = bounds_of(points.subspan(begin, end - begin));
               });
  Box box = boxes.empty() ? Box{} : boxes.front();
  for (const Box& each : boxes) box = {glm::min(box.min, each.min), glm::max(box.max, each.max)};
  return box;
}

/// Limbs that cross may touch in points that a reader of the file welds. The surface of each limb is closed,
/// so only triangles near the vertices of others can become non-manifold.
void refuse_overlapping_clusters(const JoinedBark& bark, const Scale& scale, const GraftOptions& options,
                                 const Job& job) {
  const std::span<const glm::vec3> points = bark.mesh.position.span();
  const Box box = box_of(points, job);
  const float reach = 1e-6F * std::min(scale.size, glm::length(box.max - box.min));
  const Array<std::uint8_t> near = near_others(points, bark.twin.span(), box, reach, job);
  if (near.empty() || !has_nonmanifold_edges(part_with(bark.mesh, near, job), reach, job)) return;
  refuse_bark(options,
              "the limbs are less than a millionth of the tree's size apart, so their bark is no surface; "
              "expected fewer or thicker limbs",
              job);
}

GraftCounts counts_of(const BarkBuffers& bark, const std::vector<Crease>& creases,
                      const std::vector<JoinMode>& join) {
  const auto count = [&](LimbStart start) {
    return static_cast<std::uint32_t>(std::count(bark.start.begin(), bark.start.end(), start));
  };
  GraftCounts counts;
  counts.collars = count(LimbStart::collar);
  counts.forks = count(LimbStart::fork);
  counts.closed = count(LimbStart::closed);
  counts.creases = static_cast<std::uint32_t>(creases.size());
  counts.limbs = count(LimbStart::root) + counts.collars + counts.forks + counts.closed;
  counts.fallen_back = static_cast<std::uint32_t>(std::count(join.begin(), join.end(), JoinMode::none));
  return counts;
}

/// GraftOptions::grown.
void record_grown(const GraftInput& in, const BarkBuffers& bark, Array<std::uint8_t>& grown) {
  grown.resize(in.limbs.size());
  std::fill(grown.begin(), grown.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < bark.start.size(); ++i) {
    if (bark.start[i] == LimbStart::collar || bark.start[i] == LimbStart::fork) grown[in.chains.head[i]] = 1;
  }
}

/// Writes and checks the bark, round after round, until it is sound.
std::vector<Crease> write_sound_bark(const GraftInput& in, BarkBuffers& bark, std::vector<JoinMode>& join,
                                     Job& job) {
  BarkRounds rounds;
  std::vector<std::uint32_t> creased;
  for (int round = 0;; ++round) {
    write_round(in, bark, rounds, job);
    if (check_round(in, bark, rounds, {join, creased, round >= patient_rounds}, job) == 0) break;
    if (round + 1 == 2 * patient_rounds) std::fill(join.begin(), join.end(), JoinMode::none);
  }
  return remaining_creases(bark, std::move(creased));
}

JoinedBark take_with_creases(BarkBuffers& bark, const std::vector<Crease>& creases, const Job& job) {
  JoinedBark joined = take_bark(bark, creases.size(), job);
  write_creases(creases, joined);
  Mesh& mesh = joined.mesh;
  const auto shrink = [&job](auto& array) {
    job.check();
    array.shrink_to_fit();
  };
  shrink(mesh.position);
  shrink(mesh.normal);
  shrink(mesh.tangent);
  shrink(mesh.uv[0]);
  shrink(mesh.index.wide);
  mesh.no_minus_zero = true;
  // A ring with more corners than a vertex cache has entries is loaded twice.
  mesh.cache_ordered =
      10 * sum_of(bark.range, &BarkSizes::wide_corners) < sum_of(bark.range, &BarkSizes::corners);
  return joined;
}

}  // namespace

Mesh graft(const Limbs& limbs, const GraftOptions& options, Job& job, GraftCounts* counts) {
  assert(options.sides >= 3 && options.sides <= 64);
  if (limbs.size() == 0) return {};
  // By the ring with the most corners, whose vertices must keep a distance as well.
  const Scale scale = scale_of(limbs, ribbed_corners(options, options.sides));
  const Chains chains = link_chains(limbs, job);
  std::vector<JoinMode> join(chains.head.size(), options.weld ? JoinMode::full : JoinMode::closed);
  std::optional<GraftInput> in;
  std::optional<BarkBuffers> bark;
  const std::function<void()> tasks[] = {
      [&] {
        in.emplace(limbs, chains, scale, options, join);
        bark.emplace(options, chains.head.size(), limbs.size(), job);
      },
      [&] { find_fallback_limbs(limbs, chains, scale, options, job, join); },
  };
  parallel_for(job, std::size(tasks), 1, [&](std::size_t i, std::size_t, std::size_t) { tasks[i](); });
  const std::vector<Crease> creases = write_sound_bark(*in, *bark, join, job);
  if (counts) *counts = counts_of(*bark, creases, join);
  if (options.grown) record_grown(*in, *bark, *options.grown);
  JoinedBark joined = take_with_creases(*bark, creases, job);
  bark.reset();  // its memory is needed by what follows
  append_skinned(*in, joined, job);
  if (options.joints) *options.joints = std::move(joined.joints);
  if (options.colors) *options.colors = std::move(joined.colors);
  refuse_overlapping_clusters(joined, scale, options, job);
  return std::move(joined.mesh);
}

}  // namespace seedmesh

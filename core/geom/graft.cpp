#include "core/geom/graft.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/graft_plan.h"
#include "core/geom/graft_writer.h"
#include "core/geom/skin.h"

namespace seedmesh {
namespace {

// A limb whose faces look inward is made again closed, and if that does not help by skin(); from this round
// on at once by skin(), and after twice as many the whole.
constexpr int rounds = 4;

/// The limbs that skin() must make, each with a root of its own where it begins.
Limbs separate(const Limbs& limbs, const Chains& chains, const std::vector<Trust>& trust, const Box& box,
               const Job& job) {
  Limbs out(job);
  const auto add = [&](std::uint32_t joint, std::uint32_t parent) {
    out.position.push_back(limbs.position[joint]);
    out.radius.push_back(limbs.radius[joint]);
    out.base_radius.push_back(limbs.base_radius[joint]);
    out.parent.push_back(parent);
    out.starts_limb.push_back(0);
    out.color.push_back(0);
    out.order.push_back(0);
    out.key.push_back(limbs.key.empty() ? joint : limbs.key[joint]);
    return static_cast<std::uint32_t>(out.size() - 1);
  };
  if (std::count(trust.begin(), trust.end(), Trust::none) == 0) return out;
  // Two joints without limbs give it the extent of the whole, by which skin() tells what is too small.
  for (const glm::vec3& corner : {box.min, box.max}) {
    add(0, Limbs::none);
    out.position.back() = corner;
  }
  for (std::size_t i = 0; i < chains.head.size(); ++i) {
    if (trust[i] != Trust::none) continue;
    const std::uint32_t head = chains.head[i];
    const bool is_root = limbs.parent[head] == Limbs::none;
    std::uint32_t last = add(is_root ? head : limbs.parent[head], Limbs::none);
    for (std::uint32_t joint = is_root ? chains.next[head] : head; joint != Limbs::none;
         joint = chains.next[joint])
      last = add(joint, last);
  }
  return out;
}

/// Limbs with a piece that lies on another's go to skin(), which knows how to draw it once.
void distrust_overlaps(const Limbs& limbs, const Chains& chains, const Scale& scale, Job& job,
                       std::vector<Trust>& trust) {
  const Chains found = find_chains(limbs, scale, job);
  for (std::size_t i = 0; i < chains.head.size(); ++i) {
    for (std::uint32_t joint = chains.head[i]; joint != Limbs::none; joint = chains.next[joint]) {
      if (found.mark[joint] & drawn_before) trust[i] = Trust::none;
    }
  }
}

template <class T>
void append(Array<T>& to, const Array<T>& from) {
  to.append(from.span());
}

void append(Mesh& to, const Mesh& from) {
  const auto first = static_cast<std::uint32_t>(to.position.size());
  append(to.position, from.position);
  append(to.normal, from.normal);
  append(to.uv[0], from.uv[0]);
  for (const std::uint32_t index : from.index.wide) to.index.wide.push_back(first + index);
}

}  // namespace

Mesh graft(const Limbs& limbs, const GraftOptions& options, Job& job, GraftCounts* counts) {
  assert(options.sides >= 3 && options.sides <= 64);
  if (limbs.size() == 0) return {};
  // By the ring with the most corners: those must stay apart too.
  const Scale scale = scale_of(limbs, std::max(options.sides, corners_a_rib * options.lobes));
  const Chains chains = link_chains(limbs, job);
  std::vector<Trust> trust(chains.head.size(), options.weld ? Trust::full : Trust::closed);
  if (options.overlaps) distrust_overlaps(limbs, chains, scale, job, trust);
  for (int round = 0;; ++round) {
    if (round == 2 * rounds) std::fill(trust.begin(), trust.end(), Trust::none);
    GraftWriter writer({limbs, chains, scale, options, trust}, job);
    writer.write_all();
    if (writer.settle(trust, round >= rounds) == 0) {
      if (counts) *counts = writer.counts();
      Mesh mesh = writer.take();
      const Limbs others = separate(limbs, chains, trust, scale.box, job);
      SkinOptions plain;
      plain.sides = std::clamp(options.sides, 3, 8);
      for (const Bark& bark : skin(others, plain, job)) append(mesh, bark.mesh);
      if (counts)
        counts->fallen_back = static_cast<std::uint32_t>(std::count(trust.begin(), trust.end(), Trust::none));
      // Rings of more corners than a cache has entries come in once more.
      mesh.cache_ordered = options.sides <= 12 && options.lobes <= 4;
      return mesh;
    }
  }
}

}  // namespace seedmesh

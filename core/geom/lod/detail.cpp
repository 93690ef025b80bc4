#include "core/geom/lod/detail.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/plant/chains.h"

namespace seedmesh {
namespace {

constexpr double bark_power = 0.3, seen_power = 0.65;

/// floor(most / sqrt(level + 1)) by exact integer arithmetic.
int shared_out(int most, int level) {
  int count = 0;
  while ((count + 1) * (count + 1) * (level + 1) <= most * most) ++count;
  return count;
}

template <class T>
Array<T> chosen(const Array<T>& values, const Array<std::uint32_t>& new_index, std::uint32_t count,
                const Job& job) {
  Array<T> kept(job);
  if (values.empty()) return kept;
  kept.resize(count);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (new_index[i] != Limbs::none) kept[new_index[i]] = values[i];
  }
  return kept;
}

}  // namespace

int Detail::sides(int most) const { return std::max(3, shared_out(most, level_)); }
int Detail::bark_sides(int most) const {
  return std::max(3, math::to_int32(most * math::pow(level_ + 1.0, -bark_power)));
}
int Detail::stacks(int most) const { return std::max(1, shared_out(most, level_)); }

double Detail::organs() const { return 1 / std::sqrt(level_ + 1.0); }

std::uint64_t Detail::bark(std::uint64_t finest, double seen) const {
  const double share = seen * math::pow(level_ + 1.0, -seen_power) + (1 - seen) / (2 * (level_ + 1.0));
  return static_cast<std::uint64_t>(static_cast<double>(finest) * std::min(share, 1.0));
}

float thickest(const Limbs& limbs) {
  float most = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] != Limbs::none) most = std::max({most, limbs.radius[i], limbs.base_radius[i]});
  }
  return most;
}

KeptLimbs keep(const Limbs& limbs, const Array<std::uint8_t>& stays, Job& job) {
  const std::size_t size = limbs.size();
  Array<std::uint32_t> new_index(job, size);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < size; ++i) new_index[i] = stays[i] ? count++ : Limbs::none;
  Limbs kept(job);
  kept.position = chosen(limbs.position, new_index, count, job);
  kept.radius = chosen(limbs.radius, new_index, count, job);
  kept.base_radius = chosen(limbs.base_radius, new_index, count, job);
  kept.parent = chosen(limbs.parent, new_index, count, job);
  kept.starts_limb = chosen(limbs.starts_limb, new_index, count, job);
  kept.color = chosen(limbs.color, new_index, count, job);
  kept.order = chosen(limbs.order, new_index, count, job);
  kept.frame = chosen(limbs.frame, new_index, count, job);
  kept.contour = chosen(limbs.contour, new_index, count, job);
  kept.birth = chosen(limbs.birth, new_index, count, job);
  kept.key = chosen(limbs.key, new_index, count, job);
  const auto moved = [&](std::uint32_t& joint) { joint = joint == Limbs::none ? joint : new_index[joint]; };
  for (std::uint32_t& parent : kept.parent) moved(parent);
  kept.anchor = chosen(limbs.anchor, new_index, count, job);
  for (std::uint32_t& anchor : kept.anchor) moved(anchor);
  return {std::move(kept), std::move(new_index)};
}

KeptLimbs without_repeats(const Limbs& limbs, int sides, Job& job) {
  const Array<std::uint32_t> original = originals_of(limbs, scale_of(limbs, sides), job);
  Array<std::uint8_t> stays(job, limbs.size());
  for (std::size_t i = 0; i < limbs.size(); ++i) stays[i] = original[i] == i ? 1 : 0;
  KeptLimbs kept = keep(limbs, stays, job);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (stays[i] && limbs.parent[i] != Limbs::none)
      kept.limbs.parent[kept.new_index[i]] = kept.new_index[original[limbs.parent[i]]];
  }
  return kept;
}

}  // namespace seedmesh

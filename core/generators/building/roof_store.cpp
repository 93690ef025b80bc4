#include "core/generators/building/roof_store.h"

#include <bit>

namespace seedmesh::building {
namespace {

constexpr std::size_t most_roofs = 1000, most_points = 32;

std::vector<std::uint64_t> key_of(const Plan& plan, const RoofOptions& options) {
  std::vector<std::uint64_t> key = {static_cast<std::uint64_t>(options.kind),
                                    options.low_edge,
                                    options.height.has_value(),
                                    options.flat_top.has_value(),
                                    options.gables.size(),
                                    options.edge_angles.size()};
  const auto add = [&key](double value) { key.push_back(std::bit_cast<std::uint64_t>(value)); };
  for (const double value :
       {options.angle, options.height.value_or(0), options.upper_angle, options.break_height,
        options.overhang, options.verge, options.thickness, options.flat_top.value_or(0)})
    add(value);
  key.insert(key.end(), options.gables.begin(), options.gables.end());
  for (const double angle : options.edge_angles) add(angle);
  for (const PlanRing& ring : plan.rings) {
    key.push_back(ring.size());
    for (const glm::dvec2& p : ring) {
      add(p.x);
      add(p.y);
    }
  }
  return key;
}

}  // namespace

std::shared_ptr<const Roof> RoofStore::roof(const Plan& plan, const RoofOptions& options, const Job& job) {
  std::size_t points = 0;
  for (const PlanRing& ring : plan.rings) points += ring.size();
  if (points > most_points) return std::make_shared<const Roof>(seedmesh::roof(plan, options, job));
  Key key = key_of(plan, options);
  {
    const std::lock_guard lock(mutex_);
    const auto found = made_.find(key);
    if (found != made_.end()) return found->second;
  }
  auto made = std::make_shared<const Roof>(seedmesh::roof(plan, options, job));
  const std::lock_guard lock(mutex_);
  if (made_.size() < most_roofs) made_.try_emplace(std::move(key), made);
  return made;
}

}  // namespace seedmesh::building

#pragma once
/// A store of roofs that were made before. The houses of a city stand on few different plans, and a roof costs more
/// than all other shapes of a simple house.
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/geom/polygon/roof.h"

namespace seedmesh::building {

/// Thread-safe. A roof depends on its plan and options alone, so all requests may share it.
class RoofStore {
 public:
  /// Returns what roof() returns for these arguments. Keeps the first 1,000 roofs over at most 32 points.
  std::shared_ptr<const Roof> roof(const Plan& plan, const RoofOptions& options, const Job& job);

 private:
  using Key = std::vector<std::uint64_t>;  ///< the bits of all numbers

  std::mutex mutex_;
  std::map<Key, std::shared_ptr<const Roof>> made_;
};

}  // namespace seedmesh::building

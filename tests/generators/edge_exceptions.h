#pragma once
/// Presets whose meshes may fail a check of edges of tests/support/mesh_faults.h, each with the reason. A
/// preset that does not need its exception fails the test, so the list can only shrink.
#include <string_view>
#include <vector>

namespace seedmesh {

struct EdgeException {
  std::string_view preset;
  std::string_view check;   ///< the words of the fault that are accepted
  std::string_view reason;  ///< why the model is right nevertheless
};

inline constexpr std::string_view over_used = "edges in more than two triangles";
inline constexpr std::string_view meet_at_an_edge =
    "cells meet at an edge with no cell on the other two sides, so four faces share the edge";

inline constexpr EdgeException edge_exceptions[] = {
    {"dragon_of_cubes", over_used, meet_at_an_edge}, {"fern_relief", over_used, meet_at_an_edge},
    {"kogovsek_2_11", over_used, meet_at_an_edge},   {"kogovsek_2_9", over_used, meet_at_an_edge},
    {"pascal_parity", over_used, meet_at_an_edge},
};

inline std::vector<EdgeException> edge_exceptions_of(std::string_view preset) {
  std::vector<EdgeException> found;
  for (const EdgeException& each : edge_exceptions) {
    if (each.preset == preset) found.push_back(each);
  }
  return found;
}

}  // namespace seedmesh

#include "core/generators/terrain/game_engines.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace seedmesh::terrain {
namespace {

constexpr std::array<int, 6> quads_of_a_section{7, 15, 31, 63, 127, 255};
constexpr int most_sections = 2, most_components = 32;  // along a side
constexpr int least_of_unity = 33, most_of_unity = 4097;

// Unreal's value 0 is 32768 steps of 1/128 m below height 0, at a Z scale of 100.
constexpr double below = 256, whole = 65'535.0 / 128, plain_scale = 100, centimetres = 100;

/// Returns every side that an engine supports, in rising order.
std::vector<int> sides_of(GameEngine engine) {
  std::vector<int> sides;
  if (engine == GameEngine::unity) {
    for (int side = least_of_unity; side <= most_of_unity; side = 2 * side - 1) sides.push_back(side);
    return sides;
  }
  for (const int quads : quads_of_a_section) {
    for (int sections = 1; sections <= most_sections; ++sections) {
      for (int components = 1; components <= most_components; ++components)
        sides.push_back(quads * sections * components + 1);
    }
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

constexpr std::string_view name_of(GameEngine engine) {
  return engine == GameEngine::unreal ? "Unreal" : "Unity";
}

}  // namespace

std::optional<GameEngine> game_engine_of(std::string_view profile) {
  if (profile == "unreal") return GameEngine::unreal;
  if (profile == "unity") return GameEngine::unity;
  return std::nullopt;
}

bool supports_side(GameEngine engine, int side) {
  const std::vector<int> sides = sides_of(engine);
  return std::binary_search(sides.begin(), sides.end(), side);
}

std::vector<int> nearest_sides(GameEngine engine, int side) {
  const std::vector<int> sides = sides_of(engine);
  const auto above = std::lower_bound(sides.begin(), sides.end(), side);
  if (above != sides.end() && *above == side) return {side};
  std::vector<int> nearest;
  if (above != sides.begin()) nearest.push_back(*(above - 1));
  if (above != sides.end()) nearest.push_back(*above);
  return nearest;
}

std::string size_error(GameEngine engine, int width, int depth) {
  const bool square = engine == GameEngine::unreal || width == depth;
  if (square && supports_side(engine, width) && supports_side(engine, depth)) return "";
  std::string text = "found " + std::to_string(width);
  if (width != depth) text += " x " + std::to_string(depth);
  text += " samples; " + std::string(name_of(engine)) + " needs ";
  text += engine == GameEngine::unreal ? "127, 253, 505, 1009, 2017, 4033 or 8129 along a side, or another "
                                         "multiple of its sections plus one"
                                       : "squares of 33, 65, 129, 257, 513, 1025, 2049 or 4097 samples";
  text += "; resample to ";
  const std::vector<int> nearest = nearest_sides(engine, width);
  for (std::size_t i = 0; i < nearest.size(); ++i) text += (i > 0 ? " or " : "") + std::to_string(nearest[i]);
  return text;
}

Json engine_settings(const HeightMapScale& relief) {
  const auto fits = [&](GameEngine engine) {
    return Json{{"fits", size_error(engine, relief.width, relief.depth).empty()},
                {"nearest", nearest_sides(engine, relief.width)}};
  };
  const double span = relief.high - relief.low;
  const double scale = span > 0 ? span * plain_scale / whole : plain_scale;
  const double quad = relief.cell * centimetres;
  Json unreal = fits(GameEngine::unreal);
  unreal["scale"] = {quad, quad, scale};
  unreal["location_z"] = (relief.low + below * scale / plain_scale) * centimetres;
  Json unity = fits(GameEngine::unity);
  unity["size"] = {relief.cell * (relief.width - 1), span, relief.cell * (relief.depth - 1)};
  unity["position_y"] = relief.low;
  return {{"unreal", std::move(unreal)}, {"unity", std::move(unity)}};
}

}  // namespace seedmesh::terrain

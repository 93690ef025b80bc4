#pragma once
/// Height map conventions of game engines: supported sizes, and the import settings that belong to a file.
///
/// Sources: Unreal's Landscape Technical Guide. A side has quads per section * sections per component *
/// components + 1 samples. The value 32768 is height 0. At a Z scale of 100, a metre has 128 values. X and Y
/// scales are centimetres per quad. Unity's terrain settings: resolutions 2^n + 1 from 33 to 4097; a raw file
/// starts with the southern row.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/json.h"

namespace seedmesh::terrain {

enum class GameEngine { unreal, unity };

/// Returns the engine of a value of output.profile, or nullopt for core and other profiles.
std::optional<GameEngine> game_engine_of(std::string_view profile);

bool supports_side(GameEngine engine, int side);

/// Returns the nearest supported sides: the largest that is at most `side` and the smallest that is at least
/// `side`, as far as they exist.
std::vector<int> nearest_sides(GameEngine engine, int side);

/// Returns why the engine cannot import a field of `width` by `depth` samples, with sides that fit. Returns
/// "" for a supported size.
std::string size_error(GameEngine engine, int width, int depth);

/// The scale of a height map file: metres between samples, and the heights of its smallest and largest value.
struct HeightMapScale {
  int width = 0, depth = 0;
  double cell = 1, low = 0, high = 0;
};

/// Returns {unreal: {fits, nearest, scale: [x, y, z], location_z}, unity: {fits, nearest, size: [x, y, z],
/// position_y}}. Unreal's numbers use its units (scale; centimetres), Unity's use metres.
Json engine_settings(const HeightMapScale& relief);

}  // namespace seedmesh::terrain

#pragma once
/// How engines take height maps: the sizes that they know and the numbers that are typed in beside the file.
///
/// Sources: Unreal's Landscape Technical Guide (sizes are quads of a section times sections of a component
/// times components, and one more; the value 32768 is height 0, and 128 steps are a metre at a Z scale of
/// 100, X and Y scales being centimetres a quad); Unity's terrain settings (resolutions 2^n + 1 from 33 to
/// 4097; a raw file starts with the southern row).
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/json.h"

namespace seedmesh::terrain {

enum class Engine { unreal, unity };

/// Of the values of output.profile; none: another, or core.
std::optional<Engine> engine_of(std::string_view profile);

bool takes_side(Engine engine, int side);

/// The greatest side that the engine takes and that is at most `side`, and the least that is at least so
/// long, as far as there are such.
std::vector<int> nearest_sides(Engine engine, int side);

/// What is wrong with a field of `width` by `depth` samples, in words that name sides that fit; empty:
/// nothing.
std::string misfit(Engine engine, int width, int depth);

/// What the file of a field means: metres between samples, heights of the least and the greatest value.
struct Relief {
  int width = 0, depth = 0;
  double cell = 1, low = 0, high = 0;
};

/// {unreal: {fits, nearest, scale: [x, y, z], location_z}, unity: {fits, nearest, size: [x, y, z],
/// position_y}}: Unreal's numbers in its units (scale; centimetres), Unity's in metres.
Json engine_settings(const Relief& relief);

}  // namespace seedmesh::terrain

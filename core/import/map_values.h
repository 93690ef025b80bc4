#pragma once
/// Values of tags: lengths, angles, directions, colours and materials, as the OpenStreetMap wiki defines them.
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

/// Returns a length in metres: "12", "12.5 m", "40 ft", "40'", "40'6\"", "1.2 km". Nullopt for anything else.
std::optional<double> map_length(std::string_view text);

/// Returns a number without a unit; of a list such as "2;3" the first.
std::optional<double> map_number(std::string_view text);

/// Returns a number of degrees, with or without the sign.
std::optional<double> map_degrees(std::string_view text);

/// Returns degrees clockwise from north, for a number or a point of the compass such as "NNE" or "south".
std::optional<double> map_direction(std::string_view text);

/// Returns "#rrggbb" for "#rgb", "#rrggbb", "rrggbb", "rgb(r, g, b)" or a name of CSS, whose words "_", "-" and
/// blanks may separate.
std::optional<std::string> map_color(std::string_view text);

/// Returns the usual colour of a building material, as #rrggbb; empty for an unknown one.
std::string_view map_material_color(std::string_view material);

/// Returns the surface of a scene for a material: "glass", "metal" or "plain".
std::string_view map_surface(std::string_view material);

}  // namespace seedmesh

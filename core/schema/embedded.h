#pragma once
/// The texts of api_schema inside the program, made at build time (generated/embedded.cpp).
#include <span>
#include <string_view>

namespace seedmesh {

struct EmbeddedText {
  std::string_view name;
  std::string_view text;  ///< JSON
};

/// Schemas without references, sorted by name: "lsystem", "output", "problem", "request", ...
std::span<const EmbeddedText> embedded_schemas();

/// Preset files, sorted by name: {title, description, tags, generator, seed?, parameters, output?}.
std::span<const EmbeddedText> embedded_presets();

/// OpenAPI 3.1 with the schemas as components.
std::string_view embedded_openapi();

}  // namespace seedmesh

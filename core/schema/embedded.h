#pragma once
/// The files of api_schema as texts inside the program. The build generates them (generated/embedded.cpp).
#include <span>
#include <string_view>

namespace seedmesh {

struct EmbeddedText {
  std::string_view name;
  std::string_view text;  ///< JSON
};

/// The schemas with all references resolved, sorted by name: "lsystem", "output", "problem", "request", ...
std::span<const EmbeddedText> embedded_schemas();

/// The preset files, sorted by name: {title, description, tags, generator, seed?, parameters, output?}.
std::span<const EmbeddedText> embedded_presets();

/// Returns the OpenAPI 3.1 document, with the schemas as components.
std::string_view embedded_openapi();

}  // namespace seedmesh

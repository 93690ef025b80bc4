#pragma once
/// The element that is copied. Its frame is the unit cube around the origin.
#include <vector>

#include "core/generators/api.h"
#include "core/model/model.h"

namespace seedmesh {
struct FractalParams;
enum class FractalElement;
}  // namespace seedmesh

namespace seedmesh::fractal {

struct Element {
  std::vector<Primitive> primitives;
  std::vector<Material> materials;
  std::vector<Warning> warnings;
  std::uint64_t bytes = 0;     ///< bytes of vertices and indices
  std::uint64_t elements = 0;  ///< triangles, or lines
};

/// Makes the element of a request. Solids are closed, counter-clockwise from outside, with flat normals except
/// for the sphere. Spends the triangles. Errors: those of the model or the GLB, or that it has no extent.
Result<Element> element_of(const FractalParams& params, const GenerateContext& context);

/// Whether the element of a request is the named one, or a cube.
bool is_named(const FractalParams& params, FractalElement name);
bool is_cube(const FractalParams& params);

/// Returns the sides of the rainbow cube: -X, +X, -Y, +Y, -Z, +Z.
std::array<glm::u8vec4, 6> rainbow();

/// Converts an sRGB colour to linear bytes.
glm::u8vec4 linear_color(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

/// Returns the material of everything that has no material of its own.
Material plain_material(const FractalParams& params);

/// Area and volume of a named solid; nullopt for other elements.
struct Measures {
  double area, volume;
};
/// Returns the measures of the element of a request.
std::optional<Measures> measures_of(const FractalParams& params);

}  // namespace seedmesh::fractal

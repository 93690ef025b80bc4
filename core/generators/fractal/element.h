#pragma once
/// What a copy machine copies, in its frame: the unit cube round the origin.
#include <string>
#include <vector>

#include "core/generators/appraisal.h"
#include "core/model/model.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

struct Element {
  std::vector<Primitive> primitives;
  std::vector<Material> materials;
  std::vector<Warning> warnings;
  std::uint64_t bytes = 0;     ///< of vertices and indices
  std::uint64_t elements = 0;  ///< triangles, or lines
};

/// Solids are closed, counter-clockwise from outside, with flat normals but for the sphere. Spends its
/// triangles. Errors: of the model inside, of the GLB, or that there is nothing to see of it.
Result<Element> element_of(const FractalParams& params, Job& job);

/// The sides of the rainbow cube: -X, +X, -Y, +Y, -Z, +Z.
std::array<glm::u8vec4, 6> rainbow();

glm::u8vec4 linear_color(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

/// The material of everything that brings none of its own.
Material plain_material(const FractalParams& params);

/// Area and volume of a named solid, nullopt where they are not of that kind.
struct Measures {
  double area, volume;
};
std::optional<Measures> measures_of(const FractalParams& params);

}  // namespace seedmesh::fractal

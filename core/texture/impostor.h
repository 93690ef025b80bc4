#pragma once
/// Impostors: pictures that stand for a plant that is far away. Three upright quads cross in its axis; each
/// shows the plant from its own side, and another one behind it, which looks the other way, the same
/// mirrored. One atlas holds the three pictures; alpha cuts them out. A second one holds their normals, so
/// that light from anywhere falls on them as on the plant; where a picture is seen mirrored, so are these.
///
/// After Maciel and Shirley, "Visual navigation of large environments using textured clusters", 1995, in the
/// form that engines draw without a shader of their own.
///
///   add_impostor()       quads, and a material with the recipe of its picture
///   paint()              the textures of what is shown
///   draw_impostors()     the recipes as pictures
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::texture {

constexpr std::uint64_t triangles_of_impostor = 12;

/// Adds a mesh of 12 triangles that stands for `parts`, in their frame, and its material. Returns the mesh's
/// number; -1 where the parts have no triangles, or no extent. Linear in the vertices of the parts.
int add_impostor(Model& model, std::vector<ImpostorRecipe::Part> parts, const std::string& name, Job& job);

/// Gives everything below each root its impostor as one more level of detail: the first node that stands
/// still shows it, the others show nothing there. All get as many levels as the one that has most, their
/// coarsest again. What is skinned or a collision shape is left as it is. How many impostors there are now.
std::size_t add_impostor_levels(Model& model, Job& job);

/// Draws all recipes, as atlases of `size` by `size` texels (a power of two, 64 or more), and lets the
/// materials use them: base colour, cut out by alpha, and normals in half as many texels a side. Colours are
/// those of the surface, a little darker where it lies behind. Meshes that no node shows lose their
/// primitives. About 15 ms for 256 texels and 20,000 triangles on one thread; pictures are drawn side by
/// side.
void draw_impostors(Model& model, int size, Job& job);

}  // namespace seedmesh::texture

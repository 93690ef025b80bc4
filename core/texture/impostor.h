#pragma once
/// Impostors: images that replace a distant plant. Three vertical quads cross in its axis. Each quad shows
/// the plant from one side, and a second quad behind it shows the mirrored image to the other side. One atlas
/// contains the three images, cut out by alpha. A second atlas contains their normals, so that lighting matches the
/// plant.
///
/// After Maciel and Shirley, "Visual navigation of large environments using textured clusters", 1995, in a
/// form that engines draw without special shaders.
///
///   add_impostor()       adds the quads, and a material with the recipe of its image
///   paint()              makes the textures of the model that is shown
///   draw_impostors()     renders the recipes
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::texture {

constexpr std::uint64_t triangles_of_impostor = 12;

/// Adds a mesh of 12 triangles that replaces `parts`, in their frame, and its material. Returns the number of
/// the mesh, or -1 if the parts have no triangles or no extent. Cost: linear in the vertices of the parts.
int add_impostor(Model& model, std::vector<ImpostorRecipe::Part> parts, const std::string& name, Job& job);

/// Adds an impostor of everything below each root as one more level of detail. The first static node shows
/// it, and the other nodes show nothing at that level. All nodes get the same number of levels by repeating
/// their coarsest. Skinned meshes and collision shapes do not change. Returns the number of impostors.
std::size_t add_impostor_levels(Model& model, Job& job);

/// Renders all recipes to atlases of `size` by `size` texels (a power of two, at least 64), and sets them as
/// textures of their materials: base colour with alpha, and normals with half as many texels along a side.
/// Colours are unlit, and a little darker at the back. Meshes that no node shows lose their primitives.
/// Images are rendered in parallel. Cost: about 15 ms for 256 texels and 20,000 triangles on one thread.
void draw_impostors(Model& model, int size, Job& job);

}  // namespace seedmesh::texture

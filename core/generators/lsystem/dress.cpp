#include "core/generators/lsystem/dress.h"

#include <algorithm>

#include "core/generators/lsystem/looks.h"
#include "core/geom/polygons.h"
#include "core/geom/skin.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::uint64_t bytes_a_vertex = 32;  // position, normal, uv
constexpr std::uint64_t bytes_a_triangle = 12;

/// What looks alike becomes one primitive.
void choose_looks(Skeleton& skeleton, const Wardrobe& wardrobe) {
  for (std::int16_t& color : skeleton.limbs.color) color = wardrobe.look_of(color);
  for (Outline& outline : skeleton.outlines.outline) outline.color = wardrobe.look_of(outline.color);
}

/// One node and mesh for each layer, one primitive for each look.
void add_meshes(Model& model, const char* name, std::vector<Bark> parts, Sides sides, Wardrobe& wardrobe) {
  int layer = -1;
  for (Bark& part : parts) {
    if (part.layer != layer) {
      layer = part.layer;
      Node node;
      node.name = layer == 0 ? name : name + ("_" + std::to_string(layer));
      node.parent = 0;
      node.mesh = static_cast<int>(model.meshes.size());
      model.meshes.push_back({node.name, {}});
      model.nodes.push_back(std::move(node));
    }
    model.meshes.back().primitives.push_back(
        {std::move(part.mesh), wardrobe.material(part.color, sides), {}});
  }
}

SkinOptions skin_options(const LsystemParams& params) {
  SkinOptions options;
  options.sides = static_cast<int>(params.sides);
  options.stacks = static_cast<int>(params.stacks);
  options.wrap = wraps_pictures(params);
  return options;
}

}  // namespace

Model dress(Skeleton skeleton, const LsystemParams& params, Job& job) {
  Model model;
  model.name = "lsystem";
  Node root;
  root.name = "lsystem";
  model.nodes.push_back(std::move(root));
  Wardrobe wardrobe(model, params, job);
  choose_looks(skeleton, wardrobe);
  const bool tubes = params.style == LsystemParams::Style::tubes;
  const bool empty = skeleton.limbs.size() == 0 && skeleton.outlines.outline.empty();
  std::vector<Bark> bark =
      tubes ? skin(skeleton.limbs, skin_options(params), job) : wires(skeleton.limbs, job);
  skeleton.limbs = Limbs(job);  // its memory goes back before polygons and writer need theirs
  add_meshes(model, tubes ? "bark" : "lines", std::move(bark), Sides::one, wardrobe);
  add_meshes(model, "surfaces", polygons(skeleton.outlines, job), Sides::both, wardrobe);
  if (empty) {
    model.warnings.push_back(
        {"/axiom", "nothing was drawn: the last word has no F or G and no polygon", 0, 0});
  }
  return model;
}

std::uint64_t most_segments(const LsystemParams& params, const Limits& limits) {
  if (params.style == LsystemParams::Style::lines) return limits.triangles;
  return limits.triangles /
         (2 * static_cast<std::uint64_t>(params.sides) * static_cast<std::uint64_t>(params.stacks));
}

Estimate estimate_of(std::uint64_t segments, const LsystemParams& params) {
  constexpr std::uint64_t document = 1500;  // the JSON part of a small model
  if (params.style == LsystemParams::Style::lines) return {segments, document + segments * 20, false};
  const auto sides = static_cast<std::uint64_t>(params.sides);
  const std::uint64_t rings = segments * static_cast<std::uint64_t>(params.stacks);
  const std::uint64_t triangles = 2 * sides * rings;
  return {triangles, document + triangles * bytes_a_triangle + rings * (sides + 1) * bytes_a_vertex, false};
}

}  // namespace seedmesh::lsystem

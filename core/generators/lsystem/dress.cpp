#include "core/generators/lsystem/dress.h"

#include <algorithm>
#include <optional>

#include "core/geom/grow.h"
#include "core/geom/polygons.h"
#include "core/geom/skin.h"

namespace seedmesh::lsystem {
namespace {

struct Look {
  const char* name;
  Color color;
  double roughness;
};

// What the colour index chooses from when the request names no materials: bark, three greens, and colours for
// flowers.
constexpr Look palette[] = {
    {"bark", {107, 79, 53}, 0.9},    {"leaf", {79, 138, 60}, 0.6},     {"young_leaf", {142, 184, 82}, 0.6},
    {"old_leaf", {53, 96, 48}, 0.7}, {"petal", {232, 160, 191}, 0.5},  {"stamen", {240, 200, 80}, 0.6},
    {"berry", {178, 34, 52}, 0.4},   {"stone", {136, 136, 132}, 0.95},
};

constexpr std::uint64_t bytes_a_vertex = 32;  // position, normal, uv
constexpr std::uint64_t bytes_a_triangle = 12;

enum class Sides { one, both };

/// Materials made as they are asked for: one for each colour index and for whether both sides are seen.
class Wardrobe {
 public:
  Wardrobe(Model& model, const LsystemParams& params) : model_(model), params_(params) {}

  /// Indices past the end of the list keep its last look; what looks alike becomes one primitive.
  void choose_looks(Skeleton& skeleton) const {
    const std::size_t count = params_.materials.empty() ? std::size(palette) : params_.materials.size();
    const auto last = static_cast<std::int16_t>(count - 1);
    for (std::int16_t& color : skeleton.limbs.color) color = std::min(color, last);
    for (Outline& outline : skeleton.outlines.outline) outline.color = std::min(outline.color, last);
  }

  int material(std::int16_t color, Sides sides) {
    const auto index = static_cast<std::size_t>(color);
    for (const Made& each : made_) {
      if (each.index == index && each.sides == sides) return each.material;
    }
    Material material = look(index);
    material.double_sided = sides == Sides::both;
    if (sides == Sides::both) material.name += "_surface";
    model_.materials.push_back(std::move(material));
    made_.push_back({index, sides, static_cast<int>(model_.materials.size()) - 1});
    return made_.back().material;
  }

 private:
  struct Made {
    std::size_t index;
    Sides sides;
    int material;
  };

  Material look(std::size_t index) const {
    Material material;
    if (params_.materials.empty()) {
      material.name = palette[index].name;
      paint(material, palette[index].color, palette[index].roughness, 0);
    } else {
      const auto& given = params_.materials[index];
      material.name = given.name.empty() ? "color_" + std::to_string(index) : given.name;
      paint(material, given.color, given.roughness, given.metallic);
    }
    return material;
  }

  static void paint(Material& material, const Color& color, double roughness, double metallic) {
    material.base_color = {linear_of_srgb(color.red), linear_of_srgb(color.green), linear_of_srgb(color.blue),
                           1};
    material.roughness = static_cast<float>(roughness);
    material.metallic = static_cast<float>(metallic);
  }

  Model& model_;
  const LsystemParams& params_;
  std::vector<Made> made_;
};

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
  return options;
}

/// Lines have no bark that bones could move.
std::optional<GrowthPlan> growth_of(const Limbs& limbs, const LsystemParams& params, Job& job) {
  if (!job.wanted().growth) return std::nullopt;
  if (params.style == LsystemParams::Style::lines) {
    Job::reject({"/style", "found lines, which do not grow; the growth animation needs tubes"});
  }
  return plan_growth(limbs, {}, job);
}

}  // namespace

Model dress(Skeleton skeleton, const LsystemParams& params, Job& job) {
  Model model;
  model.name = "lsystem";
  Node root;
  root.name = "lsystem";
  model.nodes.push_back(std::move(root));
  Wardrobe wardrobe(model, params);
  wardrobe.choose_looks(skeleton);
  const bool tubes = params.style == LsystemParams::Style::tubes;
  const bool empty = skeleton.limbs.size() == 0 && skeleton.outlines.outline.empty();
  const std::optional<GrowthPlan> growth = growth_of(skeleton.limbs, params, job);
  SkinOptions options = skin_options(params);
  if (growth) options.bones = growth->bone.span();
  std::vector<Bark> bark = tubes ? skin(skeleton.limbs, options, job) : wires(skeleton.limbs, job);
  skeleton.limbs = Limbs(job);  // its memory goes back before polygons and writer need theirs
  add_meshes(model, tubes ? "bark" : "lines", std::move(bark), Sides::one, wardrobe);
  add_meshes(model, "surfaces", polygons(skeleton.outlines, job, options.bones), Sides::both, wardrobe);
  if (growth) add_growth(model, *growth);
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

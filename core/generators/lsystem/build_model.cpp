#include "core/generators/lsystem/build_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/math.h"
#include "core/generators/limb_bodies/limb_bodies.h"
#include "core/generators/lsystem/contours.h"
#include "core/generators/lsystem/surfaces.h"
#include "core/generators/lsystem/welded.h"
#include "core/geom/lod/coarse_limbs.h"
#include "core/geom/lod/detail.h"
#include "core/geom/lod/foliage_levels.h"
#include "core/geom/plant/grow.h"
#include "core/geom/plant/polygons.h"
#include "core/geom/plant/skin.h"
#include "core/model/build.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::uint64_t bytes_a_vertex = 32;  // position, normal, uv
constexpr std::uint64_t bytes_a_triangle = 12;
constexpr std::uint64_t document = 1500;    // the JSON part of a small model
constexpr double welded_vertices = 0.71;    // vertices for each triangle, measured
constexpr std::uint64_t worth_a_word = 10;  // warn where at least one of 10 internodes is missing
constexpr int attempts = 6;                 ///< attempts to find a level with its number of triangles

/// Replaces colours by material indices, so that equal materials become one primitive.
void choose_materials(Skeleton& skeleton, const MaterialSet& material_set) {
  for (std::int16_t& color : skeleton.limbs.color) color = material_set.index_of(color);
  for (Outline& outline : skeleton.outlines.outline) outline.color = material_set.index_of(outline.color);
}

/// Adds one node and mesh for each layer, with one primitive for each material.
void add_meshes(Model& model, const char* name, std::vector<Bark> parts, Sides sides,
                MaterialSet& material_set) {
  int layer = -1;
  for (Bark& part : parts) {
    if (part.layer != layer) {
      layer = part.layer;
      const std::string own = layer == 0 ? name : name + ("_" + std::to_string(layer));
      add_node(model, own, 0, add_mesh(model, {own, {}}));
    }
    model.meshes.back().primitives.push_back(
        {std::move(part.mesh), material_set.material(part.color, sides), {}});
  }
}

SkinOptions skin_options(const LsystemParams& params, std::span<const Contour> contours,
                         const Detail& detail) {
  SkinOptions options;
  options.contours = contours;
  options.sides = std::max(params.sides, least_sides_of(options));
  options.stacks = detail.stacks(params.stacks);
  options.cuts_all = params.levels == LsystemParams::Levels::slices;
  options.wrap = wraps_images(params);
  options.adapt = params.adapt;
  return options;
}

/// Bones can move neither lines, nor a mesh that several nodes share.
std::optional<GrowthPlan> growth_of(const Skeleton& skeleton, const LsystemParams& params,
                                    const GenerateContext& context) {
  Job& job = context.job;
  if (!context.demand.growth) return std::nullopt;
  if (params.style == LsystemParams::Style::lines) {
    job.refuse({conflict_with({"animation"}), "/style",
                "found lines, which bones cannot move; the growth animation needs tubes"});
  }
  if (!skeleton.organs.organ.empty() && context.demand.share_organs) {
    job.refuse({conflict_with({"animation"}), "/output/instancing",
                "found organs that share a mesh, which bones cannot move; the growth animation needs auto or "
                "merge"});
  }
  return plan_growth(skeleton.limbs, {.most_bones = context.demand.most_bones}, job);
}

std::uint64_t triangles_of(const std::vector<Primitive>& primitives) {
  std::uint64_t triangles = 0;
  for (const Primitive& primitive : primitives) triangles += primitive.mesh.elements();
  return triangles;
}

/// The largest number of triangles of a level, and how repeated internodes count.
struct TriangleLimit {
  std::uint64_t triangles = 0;
  RepeatMode repeats = RepeatMode::counted;
};

/// Returns fewer limbs and joints, with about `wanted.triangles` triangles and at most `most`. Where that
/// fails, all limbs with fewer sides.
CoarseLimbs coarse_limbs(const Limbs& limbs, const CoarseOptions& wanted, const TriangleLimit& most,
                         SkinOptions options, Job& job) {
  CoarseOptions coarse = wanted;
  CoarseLimbs kept;
  // `low` and `high`: requested numbers that gave too few and too many
  std::uint64_t kept_made = 0, low = 0, high = 0;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    CoarseLimbs next = coarsen(limbs, coarse, job);
    // Stacks add triangles to the tubes that coarsen() counts.
    options.corners = next.corners;
    const std::uint64_t made = skin_count(next.limbs, options, job, most.repeats).triangles;
    const bool is_good =
        made >= wanted.triangles - wanted.triangles / 10 && made <= wanted.triangles + wanted.triangles / 100;
    if (is_good || (made > kept_made && made <= most.triangles)) {
      kept = std::move(next);
      kept_made = made;
    }
    if (is_good) break;
    (made > wanted.triangles ? high : low) = coarse.triangles;
    if (high > 0 && low > 0) {
      if (high - low <= high / 100) break;
      coarse.triangles = low + (high - low) / 2;
    } else {
      const std::uint64_t by_ratio = coarse.triangles * wanted.triangles / std::max<std::uint64_t>(made, 1);
      coarse.triangles = std::clamp<std::uint64_t>(by_ratio, coarse.triangles / 4, 4 * coarse.triangles) + 1;
    }
  }
  if (kept_made > 0) return kept;
  coarse.triangles = std::numeric_limits<std::uint32_t>::max();
  return coarsen(limbs, coarse, job);
}

/// Returns for each joint the share that is visible between the others.
Array<float> shown_of(const Limbs& limbs, Job& job) {
  const Organs none(job);
  return FoliageLevels({none, {}, limbs, 1}, job).shown(limbs, job);
}

/// Returns true where a face points away from one of its vertex normals.
bool faces_inward(const Mesh& mesh) {
  for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
    const std::uint32_t corner[3] = {mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)};
    const glm::vec3& a = mesh.position[corner[0]];
    const glm::vec3 face = glm::cross(mesh.position[corner[1]] - a, mesh.position[corner[2]] - a);
    for (const std::uint32_t each : corner) {
      if (glm::dot(face, mesh.normal[each]) < 0) return true;
    }
  }
  return false;
}

/// Returns the bark of a level.
std::vector<Bark> coarser_bark(const Limbs& limbs, const CoarseOptions& wanted, const TriangleLimit& most,
                               SkinOptions options, Job& job) {
  CoarseLimbs kept = coarse_limbs(limbs, wanted, most, options, job);
  Array<std::uint16_t> bones(job);
  if (!wanted.bones.empty()) {
    for (const std::uint32_t joint : kept.was) bones.push_back(wanted.bones[joint]);
  }
  options.bones = bones.span();
  options.corners = kept.corners;
  std::vector<Bark> barks = skin(kept.limbs, options, job);
  if (std::none_of(barks.begin(), barks.end(), [](const Bark& bark) { return faces_inward(bark.mesh); }))
    return barks;
  // Rings whose corners are not rotated against each other.
  for (LimbCorners& corners : kept.corners) corners.finest = corners.current;
  return skin(kept.limbs, options, job);
}

/// Reports whether internodes coincide. `made` is the number of triangles with all limbs counted.
RepeatMode repeats_of(const Limbs& limbs, const SkinOptions& options, std::uint64_t made, const Job& job) {
  return skin_count(limbs, options, job).triangles == made ? RepeatMode::counted : RepeatMode::found;
}

/// Adds a level to the last node.
void add_level(Model& model, int level, std::vector<Bark> parts, MaterialSet& material_set) {
  MeshGroup group{"bark_LOD" + std::to_string(level), {}};
  for (Bark& part : parts)
    group.primitives.push_back({std::move(part.mesh), material_set.material(part.color, Sides::one), {}});
  model.nodes.back().lods.push_back(add_mesh(model, std::move(group)));
}

/// Adds levels with all limbs, and with the sides and stacks of Tunnel's table 8.
void add_sliced_levels(Model& model, const Limbs& limbs, const SkinOptions& finest, MaterialSet& material_set,
                       const GenerateContext& context) {
  for (int level = 1; level < context.demand.lods; ++level) {
    const Detail detail(level);
    SkinOptions options = finest;
    options.sides = std::max(detail.sides(finest.sides), least_sides_of(finest));
    options.stacks = detail.stacks(finest.stacks);
    if (options.sides == finest.sides && options.stacks == finest.stacks) return;
    add_level(model, level, skin(limbs, options, context.job), material_set);
  }
}

struct BarkUse {
  std::span<const std::uint16_t> bones;  ///< bone of each joint; empty without growth animation
  bool carries_organs = false;
};

/// Returns welded bark where it is requested and possible.
std::optional<WeldedBark> add_welded_bark(Model& model, const Limbs& limbs, const BarkUse& use,
                                          const LsystemParams& params, MaterialSet& material_set, Job& job) {
  if (!params.weld) return std::nullopt;
  std::optional<WeldedBark> welded = welded_bark(limbs, use.bones, params, job);
  if (welded) {
    add_meshes(model, "bark", std::move(welded->barks), Sides::one, material_set);
  } else {
    model.warnings.push_back(
        {"/weld", "has no effect: the limbs overlap so much that their joints form no closed surface", 0, 0});
  }
  return welded;
}

/// Adds the bark with its coarser levels. Consumes the limbs, so that their memory is free before polygons
/// and the writer need it.
void add_bark(Model& model, Limbs limbs, const BarkUse& use, const LsystemParams& params,
              MaterialSet& material_set, const GenerateContext& context) {
  Job& job = context.job;
  std::span<const std::uint16_t> bones = use.bones;
  const int finest = static_cast<int>(model.nodes.size());
  const std::vector<Contour> contours = contours_of(params);
  SkinOptions options = skin_options(params, contours, Detail(0));
  std::optional<WeldedBark> welded = add_welded_bark(model, limbs, use, params, material_set, job);
  if (welded) {  // coarser levels are closed tubes, because joints are invisible from a distance
    limbs = std::move(welded->limbs);
    bones = welded->bones.span();
    options.stacks = 1;
  } else {
    options.bones = bones;
    add_meshes(model, "bark", skin(limbs, options, job), Sides::one, material_set);
  }
  if (static_cast<int>(model.nodes.size()) == finest) return;
  if (params.levels == LsystemParams::Levels::slices) {
    options.bones = bones;
    return add_sliced_levels(model, limbs, options, material_set, context);
  }
  const std::uint64_t triangles = triangles_of(model.meshes.back().primitives);
  std::uint64_t before = triangles;
  Array<std::uint16_t> own_bones(job);
  Array<float> shown(job);
  RepeatMode repeats = RepeatMode::counted;
  if (context.demand.lods > 1 && !welded) {
    KeptLimbs once = without_repeats(limbs, options.sides, job);
    if (once.limbs.size() < limbs.size()) {
      for (std::size_t i = 0; i < bones.size(); ++i) {
        if (once.new_index[i] != Limbs::none) own_bones.push_back(bones[i]);
      }
      bones = own_bones.span();
      limbs = std::move(once.limbs);
    }
    repeats = repeats_of(limbs, options, triangles, job);
  }
  if (context.demand.lods > 1) shown = shown_of(limbs, job);
  for (int level = 1; level < context.demand.lods; ++level) {
    const Detail detail(level);
    SkinOptions coarser = skin_options(params, contours, detail);
    coarser.stacks = std::min(coarser.stacks, options.stacks);
    CoarseOptions coarse;
    // Removed limbs that organs hide are less visible than removed organs.
    const std::uint64_t wanted = use.carries_organs ? detail.bark(triangles, 1) : detail.tubes(triangles);
    coarse.triangles = std::min(wanted, Detail::fewer_than(before));
    coarse.skin = &options;
    coarse.was_grafted = welded.has_value();
    coarse.shown = shown.span();
    coarse.bones = bones;
    std::vector<Bark> parts =
        coarser_bark(limbs, coarse, {Detail::fewer_than(before), repeats}, coarser, job);
    std::uint64_t made = 0;
    for (const Bark& part : parts) made += part.mesh.elements();
    if (made == 0 || made >= before) return;
    before = made;
    add_level(model, level, std::move(parts), material_set);
  }
}

/// Adds the limbs of parts that occur at several places.
void add_shared(Model& model, std::span<SharedPart> parts, const LsystemParams& params,
                MaterialSet& material_set, const GenerateContext& context) {
  Job& job = context.job;
  for (SharedPart& part : parts) {
    choose_materials(*part.skeleton, material_set);
    const std::size_t first = model.nodes.size();
    Limbs limbs = std::exchange(part.skeleton->limbs, Limbs(job));
    if (params.style == LsystemParams::Style::tubes) {
      add_bark(model, std::move(limbs), {}, params, material_set, context);
    } else {
      add_meshes(model, "lines", wires(std::move(limbs), job), Sides::none, material_set);
    }
    for (std::size_t node = first; node < model.nodes.size(); ++node) {
      model.nodes[node].name += "_part";
      model.nodes[node].instances.transforms = part.transforms;
    }
  }
}

/// Returns the diagonal of the bounds of limbs, polygons and organs.
float size_of(const Skeleton& skeleton) {
  constexpr float far = std::numeric_limits<float>::max();
  Box box{glm::vec3(far), glm::vec3(-far)};
  const auto grow = [&box](const glm::vec3& p) { box = {glm::min(box.min, p), glm::max(box.max, p)}; };
  for (const glm::vec3& p : skeleton.limbs.position) grow(p);
  for (const glm::vec3& p : skeleton.outlines.vertex) grow(p);
  for (const Organ& organ : skeleton.organs.organ) {
    grow(organ.position);
    grow(organ.position + glm::mat3_cast(organ.frame)[1] * organ.scale.y);
  }
  const glm::vec3 extent = box.max - box.min;
  return box.min.x > box.max.x ? 0 : std::sqrt(glm::dot(extent, extent));
}

/// Warns of limbs that are too thin for a tube.
void warn_of_thin(Model& model, const Limbs& limbs, const LsystemParams& params) {
  const std::uint64_t count = too_thin(limbs, params.sides);
  if (count == 0 || count * worth_a_word < limbs.size()) return;
  model.warnings.push_back({"/width",
                            std::to_string(count) + (count == 1 ? " internode is" : " internodes are") +
                                " too thin for a tube compared with the whole plant and left out; use a "
                                "larger `width` or the style lines",
                            0, 0});
}

/// Adds convex bodies, if the output has collision bodies.
void add_collision(Model& model, const std::vector<LimbBody>& bodies, const GenerateContext& context) {
  if (context.demand.collision == CollisionNames::none) return;
  if (!bodies.empty()) return add_limb_bodies(model, bodies, context);
  model.warnings.push_back({"/output/collision", "has no effect: there is no limb with a thickness", 0, 0});
}

}  // namespace

Model build_model(Skeleton skeleton, const LsystemParams& params, const GenerateContext& context,
                  std::span<SharedPart> parts) {
  Job& job = context.job;
  Model model;
  model.name = "lsystem";
  add_node(model, "lsystem", -1);
  MaterialSet material_set(model, params, job);
  choose_materials(skeleton, material_set);
  const bool tubes = params.style == LsystemParams::Style::tubes;
  const bool empty =
      skeleton.limbs.size() == 0 && skeleton.outlines.outline.empty() && skeleton.organs.organ.empty();
  const float size = skeleton.organs.organ.empty() ? 0 : size_of(skeleton);
  const std::optional<GrowthPlan> growth = growth_of(skeleton, params, context);
  const auto bones = growth ? growth->bone.span() : std::span<const std::uint16_t>{};
  std::vector<LimbBody> bodies;
  if (tubes) {
    warn_of_thin(model, skeleton.limbs, params);
    if (context.demand.collision != CollisionNames::none)
      bodies = limb_bodies(skeleton.limbs, BelowGround::counted, job);
    const BarkUse use{bones, !skeleton.organs.organ.empty()};
    add_bark(model, std::exchange(skeleton.limbs, Limbs(job)), use, params, material_set, context);
  } else {
    add_meshes(model, "lines", wires(std::exchange(skeleton.limbs, Limbs(job)), job), Sides::none,
               material_set);
  }
  add_shared(model, parts, params, material_set, context);
  add_meshes(model, "surfaces", polygons(skeleton.outlines, job, bones), Sides::both, material_set);
  add_organs(model, {skeleton.organs, size, bones}, params, material_set, context);
  if (growth) add_growth(model, *growth);
  add_collision(model, bodies, context);
  if (empty && parts.empty()) {
    model.warnings.push_back(
        {"/axiom", "nothing was drawn: the last word has no F or G, no polygon and no organ", 0, 0});
  } else if (model.meshes.empty() && model.warnings.empty()) {
    model.warnings.push_back(
        {"/axiom", "nothing was drawn: everything that the last word draws has length 0", 0, 0});
  }
  return model;
}

std::uint64_t most_segments(const LsystemParams& params, const Limits& limits) {
  if (params.style == LsystemParams::Style::lines) return limits.triangles;
  return limits.triangles /
         (2 * static_cast<std::uint64_t>(params.sides) * static_cast<std::uint64_t>(params.stacks));
}

Estimate estimate_of(const Skeleton& skeleton, const LsystemParams& params, Job& job) {
  const std::vector<Contour> contours = contours_of(params);
  TubeCount count;
  if (params.weld) {
    count.triangles = welded_triangles(skeleton.limbs, params, job);
    count.vertices =
        static_cast<std::uint64_t>(math::to_int64(welded_vertices * static_cast<double>(count.triangles)));
  } else {
    count = skin_count(skeleton.limbs, skin_options(params, contours, Detail(0)), job, RepeatMode::found);
  }
  const std::uint64_t index = count.vertices > 65'535 ? bytes_a_triangle : bytes_a_triangle / 2;
  return {count.triangles, document + count.triangles * index + count.vertices * bytes_a_vertex, false};
}

Estimate estimate_of(std::uint64_t segments, std::uint64_t limbs, const LsystemParams& params) {
  if (params.style == LsystemParams::Style::lines) return {0, document + segments * 20, false};
  const auto sides = static_cast<std::uint64_t>(params.sides);
  const std::uint64_t rings = segments * static_cast<std::uint64_t>(params.stacks);
  // Both ends of a limb are cones.
  const std::uint64_t triangles = 2 * sides * (rings + limbs);
  const std::uint64_t vertices = (rings + 3 * limbs) * (sides + 1);
  return {triangles, document + triangles * bytes_a_triangle + vertices * bytes_a_vertex, false};
}

}  // namespace seedmesh::lsystem

#include "core/generators/lsystem/dress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/math.h"
#include "core/generators/lsystem/contours.h"
#include "core/generators/lsystem/surfaces.h"
#include "core/generators/lsystem/welded.h"
#include "core/geom/coarse_limbs.h"
#include "core/geom/detail.h"
#include "core/geom/foliage_levels.h"
#include "core/geom/grow.h"
#include "core/geom/polygons.h"
#include "core/geom/skin.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::uint64_t bytes_a_vertex = 32;  // position, normal, uv
constexpr std::uint64_t bytes_a_triangle = 12;
constexpr std::uint64_t document = 1500;    // the JSON part of a small model
constexpr double welded_vertices = 0.71;    // a triangle, as measured
constexpr std::uint64_t worth_a_word = 10;  // fewer than one in so many is no loss
constexpr int attempts = 6;                 ///< at a level of as many triangles as it may have

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

SkinOptions skin_options(const LsystemParams& params, std::span<const Contour> contours,
                         const Detail& detail) {
  SkinOptions options;
  options.contours = contours;
  options.sides = std::max(params.sides, least_sides_of(options));
  options.stacks = detail.stacks(params.stacks);
  options.wrap = wraps_pictures(params);
  options.adapt = params.adapt;
  return options;
}

/// Lines have no bark that bones could move, and a mesh that nodes share cannot have bones of its own.
std::optional<GrowthPlan> growth_of(const Skeleton& skeleton, const LsystemParams& params, Job& job) {
  if (!job.demand().growth) return std::nullopt;
  if (params.style == LsystemParams::Style::lines) {
    Job::reject({"/style", "found lines, which do not grow; the growth animation needs tubes"});
  }
  if (!skeleton.organs.organ.empty() && job.demand().share_organs) {
    Job::reject(
        {"/output/instancing",
         "found organs that share a mesh, which no bone moves; the growth animation needs auto or merge"});
  }
  return plan_growth(skeleton.limbs, {.most_bones = job.demand().most_bones}, job);
}

std::uint64_t triangles_of(const std::vector<Primitive>& primitives) {
  std::uint64_t triangles = 0;
  for (const Primitive& primitive : primitives) triangles += primitive.mesh.elements();
  return triangles;
}

/// The most triangles that a level may have, and how they are counted.
struct Most {
  std::uint64_t triangles = 0;
  Redrawn repeats = Redrawn::counted;
};

/// Fewer limbs and joints, with about as many triangles as they may have and never more than `most`; where
/// that cannot be, all with fewer sides.
CoarseLimbs coarse_limbs(const Limbs& limbs, const CoarseOptions& wanted, const Most& most,
                         SkinOptions options, Job& job) {
  CoarseOptions coarse = wanted;
  CoarseLimbs kept;
  std::uint64_t kept_made = 0, low = 0, high = 0;  // what was asked for and gave too few, too many
  for (int attempt = 0; attempt < attempts; ++attempt) {
    CoarseLimbs next = coarsen(limbs, coarse, job);
    // Stacks have more triangles than the tubes that were counted.
    options.corners = next.corners;
    const std::uint64_t made = skin_triangles(next.limbs, options, most.repeats);
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

/// Of each joint, how much of it is seen between the others.
Array<float> shown_of(const Limbs& limbs, Job& job) {
  const Organs none(job);
  return FoliageLevels({none, {}, limbs, 1}, job).shown(limbs, job);
}

/// Faces that look against a normal.
bool looks_inward(const Mesh& mesh) {
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

/// The bark of a level.
std::vector<Bark> coarser_bark(const Limbs& limbs, const CoarseOptions& wanted, const Most& most,
                               SkinOptions options, Job& job) {
  CoarseLimbs kept = coarse_limbs(limbs, wanted, most, options, job);
  Array<std::uint16_t> bones(job);
  if (!wanted.bones.empty()) {
    for (const std::uint32_t joint : kept.was) bones.push_back(wanted.bones[joint]);
  }
  options.bones = bones.span();
  options.corners = kept.corners;
  std::vector<Bark> barks = skin(kept.limbs, options, job);
  if (std::none_of(barks.begin(), barks.end(), [](const Bark& bark) { return looks_inward(bark.mesh); }))
    return barks;
  // Rings that do not turn against each other.
  for (LimbCorners& corners : kept.corners) corners.finest = corners.now;
  return skin(kept.limbs, options, job);
}

/// Has the plant internodes that lie on others? `made` of all its limbs, so many triangles.
Redrawn repeats_of(const Limbs& limbs, const SkinOptions& options, std::uint64_t made) {
  return skin_triangles(limbs, options) == made ? Redrawn::counted : Redrawn::found;
}

/// One more level of the last node.
void add_level(Model& model, int level, std::vector<Bark> parts, Wardrobe& wardrobe) {
  MeshGroup group{"bark_LOD" + std::to_string(level), {}};
  for (Bark& part : parts)
    group.primitives.push_back({std::move(part.mesh), wardrobe.material(part.color, Sides::one), {}});
  model.nodes.back().lods.push_back(static_cast<int>(model.meshes.size()));
  model.meshes.push_back(std::move(group));
}

struct BarkUse {
  std::span<const std::uint16_t> bones;  ///< of each joint, where the plant grows
  bool carries_organs = false;
};

/// Where it is wanted and can be made.
std::optional<WeldedBark> add_welded_bark(Model& model, const Limbs& limbs, const BarkUse& use,
                                          const LsystemParams& params, Wardrobe& wardrobe, Job& job) {
  if (!params.weld) return std::nullopt;
  std::optional<WeldedBark> welded = welded_bark(limbs, use.bones, params, job);
  if (welded) {
    add_meshes(model, "bark", std::move(welded->barks), Sides::one, wardrobe);
  } else {
    model.warnings.push_back(
        {"/weld", "has no effect: the limbs lie so densely that their joints leave no closed surface", 0, 0});
  }
  return welded;
}

/// The bark with its coarser levels. Takes the limbs: their memory goes back before polygons and writer need
/// theirs.
void add_bark(Model& model, Limbs limbs, const BarkUse& use, const LsystemParams& params, Wardrobe& wardrobe,
              Job& job) {
  std::span<const std::uint16_t> bones = use.bones;
  const int finest = static_cast<int>(model.nodes.size());
  const std::vector<Contour> contours = contours_of(params);
  SkinOptions options = skin_options(params, contours, Detail(0));
  std::optional<WeldedBark> welded = add_welded_bark(model, limbs, use, params, wardrobe, job);
  if (welded) {  // of which coarser levels are closed tubes: nobody sees joints from afar
    limbs = std::move(welded->limbs);
    bones = welded->bones.span();
    options.stacks = 1;
  } else {
    options.bones = bones;
    add_meshes(model, "bark", skin(limbs, options, job), Sides::one, wardrobe);
  }
  if (static_cast<int>(model.nodes.size()) == finest) return;
  const std::uint64_t triangles = triangles_of(model.meshes.back().primitives);
  std::uint64_t before = triangles;
  Array<std::uint16_t> own_bones(job);
  Array<float> shown(job);
  Redrawn repeats = Redrawn::counted;
  if (job.demand().lods > 1 && !welded) {
    KeptLimbs once = without_repeats(limbs, options.sides, job);
    if (once.limbs.size() < limbs.size()) {
      for (std::size_t i = 0; i < bones.size(); ++i) {
        if (once.new_place[i] != Limbs::none) own_bones.push_back(bones[i]);
      }
      bones = own_bones.span();
      limbs = std::move(once.limbs);
    }
    repeats = repeats_of(limbs, options, triangles);
  }
  if (job.demand().lods > 1) shown = shown_of(limbs, job);
  for (int level = 1; level < job.demand().lods; ++level) {
    const Detail detail(level);
    SkinOptions coarser = skin_options(params, contours, detail);
    coarser.stacks = std::min(coarser.stacks, options.stacks);
    CoarseOptions coarse;
    // What organs hide is missed less than they would be.
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
    add_level(model, level, std::move(parts), wardrobe);
  }
}

/// The diagonal of everything.
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

/// What of the limbs no tube shows.
void warn_of_thin(Model& model, const Limbs& limbs, const LsystemParams& params) {
  const std::uint64_t count = too_thin(limbs, params.sides);
  if (count == 0 || count * worth_a_word < limbs.size()) return;
  model.warnings.push_back(
      {"/width",
       std::to_string(count) + (count == 1 ? " internode is" : " internodes are") +
           " too thin beside the whole for a tube and left out; a greater `width`, or lines "
           "by `style`, would show more",
       0, 0});
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
  const bool empty =
      skeleton.limbs.size() == 0 && skeleton.outlines.outline.empty() && skeleton.organs.organ.empty();
  const float size = skeleton.organs.organ.empty() ? 0 : size_of(skeleton);
  const std::optional<GrowthPlan> growth = growth_of(skeleton, params, job);
  const auto bones = growth ? growth->bone.span() : std::span<const std::uint16_t>{};
  if (tubes) {
    warn_of_thin(model, skeleton.limbs, params);
    const BarkUse use{bones, !skeleton.organs.organ.empty()};
    add_bark(model, std::exchange(skeleton.limbs, Limbs(job)), use, params, wardrobe, job);
  } else {
    add_meshes(model, "lines", wires(std::exchange(skeleton.limbs, Limbs(job)), job), Sides::one, wardrobe);
  }
  add_meshes(model, "surfaces", polygons(skeleton.outlines, job, bones), Sides::both, wardrobe);
  add_organs(model, {skeleton.organs, size, bones}, params, wardrobe, job);
  if (growth) add_growth(model, *growth);
  if (empty) {
    model.warnings.push_back(
        {"/axiom", "nothing was drawn: the last word has no F or G, no polygon and no organ", 0, 0});
  } else if (model.meshes.empty() && model.warnings.empty()) {
    model.warnings.push_back(
        {"/axiom", "nothing was drawn: all that the last word draws has no length", 0, 0});
  }
  return model;
}

std::uint64_t most_segments(const LsystemParams& params, const Limits& limits) {
  if (params.style == LsystemParams::Style::lines) return limits.triangles;
  return limits.triangles /
         (2 * static_cast<std::uint64_t>(params.sides) * static_cast<std::uint64_t>(params.stacks));
}

Estimate estimate_of(const Skeleton& skeleton, const LsystemParams& params, Job& job) {
  const std::uint64_t triangles = welded_triangles(skeleton.limbs, params, job);
  const auto vertices =
      static_cast<std::uint64_t>(math::to_int64(welded_vertices * static_cast<double>(triangles)));
  const std::uint64_t index = vertices > 65'535 ? bytes_a_triangle : bytes_a_triangle / 2;
  return {triangles, document + triangles * index + vertices * bytes_a_vertex, false};
}

Estimate estimate_of(std::uint64_t segments, std::uint64_t limbs, const LsystemParams& params) {
  if (params.style == LsystemParams::Style::lines) return {0, document + segments * 20, false};
  const auto sides = static_cast<std::uint64_t>(params.sides);
  const std::uint64_t rings = segments * static_cast<std::uint64_t>(params.stacks);
  // A limb begins and ends in a cone.
  const std::uint64_t triangles = 2 * sides * (rings + limbs);
  const std::uint64_t vertices = (rings + 3 * limbs) * (sides + 1);
  return {triangles, document + triangles * bytes_a_triangle + vertices * bytes_a_vertex, false};
}

}  // namespace seedmesh::lsystem

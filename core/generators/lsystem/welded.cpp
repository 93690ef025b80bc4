#include "core/generators/lsystem/welded.h"

#include <algorithm>

#include "core/generators/lsystem/contours.h"
#include "core/generators/lsystem/looks.h"
#include "core/geom/coarse_limbs.h"
#include "core/geom/detail.h"
#include "core/geom/foliage_levels.h"
#include "core/geom/graft.h"
#include "core/geom/graft_colors.h"
#include "core/geom/graft_count.h"
#include "core/geom/graft_heirs.h"
#include "core/geom/outward.h"

namespace seedmesh::lsystem {
namespace {

// Of the thickest limb: thinner ones do not grow together with their parent at the coarser levels.
constexpr float thinnest_joint = 0.1F;
constexpr int attempts = 4;  // at a level of as many triangles as it may have

/// Limbs in which nothing is drawn twice and each goes on as far as it can, with the bones of their joints.
struct Ready {
  Limbs limbs;
  Array<std::uint16_t> bones;
};

Ready ready_of(const Limbs& drawn, std::span<const std::uint16_t> bones, const LsystemParams& params,
               Job& job) {
  KeptLimbs once = without_repeats(drawn, params.sides, job);
  Array<std::uint16_t> kept(job);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (once.new_place[i] != Limbs::none) kept.push_back(bones[i]);
  }
  HeirLimbs heirs = with_heirs(once.limbs, job);
  Ready ready{std::move(heirs.limbs), Array<std::uint16_t>(job)};
  if (bones.empty()) return ready;
  for (const std::uint32_t was : heirs.was) ready.bones.push_back(kept[was]);
  return ready;
}

GraftOptions graft_options(const LsystemParams& params, std::span<const Contour> contours,
                           const Detail& detail) {
  GraftOptions options;
  options.sides = detail.bark_sides(params.sides);
  options.wrap = wraps_pictures(params);
  options.overlaps = true;
  options.points = true;
  options.contours = contours;
  return options;
}

/// A mesh with the colour of each triangle. Nothing: the limbs lie in heaps.
struct Grafted {
  Mesh mesh;
  Array<std::int16_t> colors;
};
std::optional<Grafted> grafted(const Limbs& limbs, GraftOptions options, std::span<const std::uint16_t> bones,
                               Job& job) {
  Grafted made{{}, Array<std::int16_t>(job)};
  Array<std::uint32_t> joints(job);
  bool is_heap = false;
  options.colors = &made.colors;
  options.is_heap = &is_heap;
  if (!bones.empty()) options.joints = &joints;
  made.mesh = graft(limbs, options, job);
  if (is_heap) return std::nullopt;
  if (!bones.empty()) {
    made.mesh.bone = Array<std::uint16_t>(job, made.mesh.position.size());
    for (std::size_t i = 0; i < joints.size(); ++i) made.mesh.bone[i] = bones[joints[i]];
  }
  return made;
}

/// Of fewer limbs and joints, about as many triangles as it may have.
std::optional<Grafted> coarser(const Ready& plant, const CoarseOptions& wanted, GraftOptions options,
                               Job& job) {
  CoarseOptions coarse = wanted;
  options.pointed = true;
  options.every_bend = true;
  options.thinnest_joint = thinnest_joint * thickest(plant.limbs);
  std::optional<Grafted> made;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const CoarseLimbs kept = coarsen(plant.limbs, coarse, job);
    Array<std::uint16_t> bones(job);
    for (const std::uint32_t joint : kept.was) {
      if (!wanted.bones.empty()) bones.push_back(wanted.bones[joint]);
    }
    made = grafted(kept.limbs, options, bones.span(), job);
    if (!made) return std::nullopt;
    // Forks and collars have more triangles than the tubes that were counted.
    const std::uint64_t count = made->mesh.elements();
    if (count <= wanted.triangles + wanted.triangles / 100) break;
    coarse.triangles = coarse.triangles * wanted.triangles / count;
  }
  turn_outward(made->mesh, job);
  return made;
}

}  // namespace

Array<float> shown_of(const Limbs& limbs, Job& job) {
  const Organs none(job);
  return FoliageLevels({none, {}, limbs, 1}, job).shown(limbs, job);
}

std::uint64_t wanted_triangles(int level, std::uint64_t finest, const BarkUse& use) {
  // What organs hide is missed less than they would be.
  return use.carries_organs ? Detail(level).bark(finest, 1) : Detail(level).tubes(finest);
}

std::optional<std::vector<std::vector<Bark>>> welded_levels(const Limbs& limbs, const BarkUse& use,
                                                            const LsystemParams& params, Job& job) {
  const std::vector<Contour> contours = contours_of(params);
  const Ready plant = ready_of(limbs, use.bones, params, job);
  GraftOptions finest = graft_options(params, contours, Detail(0));
  const int levels = job.demand().lods;
  Array<glm::vec3> drawn(job);  // where the finest level draws the joints
  if (levels > 1) {
    drawn.append(plant.limbs.position.span());
    finest.drawn = &drawn;
  }
  std::optional<Grafted> made = grafted(plant.limbs, finest, plant.bones.span(), job);
  if (!made) return std::nullopt;
  const std::uint64_t triangles = made->mesh.elements();
  std::vector<std::vector<Bark>> all;
  all.push_back(parted_by_color(std::move(made->mesh), made->colors.span(), job));
  if (triangles == 0 || levels < 2) return all;
  const Array<float> shown = shown_of(plant.limbs, job);
  std::uint64_t before = triangles;
  for (int level = 1; level < levels; ++level) {
    const GraftOptions options = graft_options(params, contours, Detail(level));
    CoarseOptions coarse;
    coarse.triangles = std::min(wanted_triangles(level, triangles, use), Detail::fewer_than(before));
    coarse.sides = options.sides;
    coarse.finest_sides = finest.sides;
    coarse.pointed = true;
    coarse.shown = shown.span();
    coarse.drawn = drawn.span();
    coarse.bones = plant.bones.span();
    std::optional<Grafted> simpler = coarser(plant, coarse, options, job);
    if (!simpler) break;
    const std::uint64_t count = simpler->mesh.elements();
    if (count == 0 || count >= before) break;
    before = count;
    all.push_back(parted_by_color(std::move(simpler->mesh), simpler->colors.span(), job));
  }
  return all;
}

std::uint64_t welded_triangles(const Limbs& limbs, const LsystemParams& params, Job& job) {
  const std::vector<Contour> contours = contours_of(params);
  return graft_triangles(ready_of(limbs, {}, params, job).limbs, graft_options(params, contours, Detail(0)),
                         job);
}

void warn_of_welded(const LsystemParams& params, std::vector<Warning>& warnings) {
  if (!params.weld) return;
  if (params.style == LsystemParams::Style::lines) {
    warnings.push_back({"/weld", "has no effect: lines have no bark that could be joined", 0, 0});
    return;
  }
  if (params.stacks > 1)
    warnings.push_back({"/stacks", "has no effect: welded bark has rings where it bends", 0, 0});
  if (params.adapt)
    warnings.push_back(
        {"/adapt", "has no effect: thinner limbs of welded bark have fewer sides anyway", 0, 0});
}

}  // namespace seedmesh::lsystem

#include "core/generators/lsystem/welded.h"

#include <algorithm>

#include "core/generators/lsystem/contours.h"
#include "core/generators/lsystem/materials.h"
#include "core/geom/lod/detail.h"
#include "core/geom/plant/graft/color_split.h"
#include "core/geom/plant/graft/graft.h"
#include "core/geom/plant/graft/limb_continuation.h"
#include "core/geom/plant/graft/triangle_estimate.h"

namespace seedmesh::lsystem {
namespace {

// Number of attempts to join limbs. Each attempt leaves out limbs that did not fit in the one before.
constexpr int attempts = 3;

/// Internodes without duplicates, and the bones of their joints.
struct Drawn {
  Limbs limbs;
  Array<std::uint16_t> bones;
};
Drawn drawn_once(const Limbs& limbs, std::span<const std::uint16_t> bones, const LsystemParams& params,
                 Job& job) {
  KeptLimbs once = without_repeats(limbs, params.sides, job);
  Drawn drawn{std::move(once.limbs), Array<std::uint16_t>(job)};
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (once.new_index[i] != Limbs::none) drawn.bones.push_back(bones[i]);
  }
  return drawn;
}

GraftOptions graft_options(const LsystemParams& params, std::span<const Contour> contours) {
  GraftOptions options;
  options.sides = params.sides;
  options.wrap = wraps_images(params);
  options.overlaps = true;
  options.points = true;
  options.contours = contours;
  return options;
}

/// Keeps limbs at their drawn position if they branch off inside an internode and do not fit there, so that
/// nothing tapers towards them. Returns false where there are none.
bool keep_back(const ContinuedLimbs& continued, const Array<std::uint8_t>& grown, std::size_t joints,
               Array<std::uint8_t>& stay) {
  bool is_any = false;
  for (const std::uint32_t joint : continued.moved) {
    if (grown[joint]) continue;
    if (stay.empty()) {
      stay.resize(joints);
      std::fill(stay.begin(), stay.end(), std::uint8_t{0});
    }
    stay[continued.original[joint]] = 1;
    is_any = true;
  }
  return is_any;
}

}  // namespace

std::optional<WeldedBark> welded_bark(const Limbs& limbs, std::span<const std::uint16_t> bones,
                                      const LsystemParams& params, Job& job) {
  const std::vector<Contour> contours = contours_of(params);
  const Drawn drawn = drawn_once(limbs, bones, params, job);
  Array<std::uint8_t> stay(job), grown(job);
  for (int attempt = 1;; ++attempt) {
    ContinuedLimbs continued = continue_limbs(drawn.limbs, job, stay.span());
    GraftOptions options = graft_options(params, contours);
    Array<std::int16_t> colors(job);
    Array<std::uint32_t> joints(job);
    bool has_no_surface = false;
    options.colors = &colors;
    options.has_no_surface = &has_no_surface;
    options.grown = &grown;
    if (!bones.empty()) options.joints = &joints;
    Mesh mesh = graft(continued.limbs, options, job);
    if (has_no_surface) return std::nullopt;
    if (attempt < attempts && keep_back(continued, grown, drawn.limbs.size(), stay)) continue;
    WeldedBark made{{}, std::move(continued.limbs), Array<std::uint16_t>(job)};
    if (!bones.empty()) {
      for (const std::uint32_t was : continued.original) made.bones.push_back(drawn.bones[was]);
      mesh.bone = Array<std::uint16_t>(job, mesh.position.size());
      for (std::size_t i = 0; i < joints.size(); ++i) mesh.bone[i] = made.bones[joints[i]];
    }
    made.barks = split_by_color(std::move(mesh), colors.span(), job);
    return made;
  }
}

std::uint64_t welded_triangles(const Limbs& limbs, const LsystemParams& params, Job& job) {
  const std::vector<Contour> contours = contours_of(params);
  const Drawn drawn = drawn_once(limbs, {}, params, job);
  return graft_triangles(continue_limbs(drawn.limbs, job).limbs, graft_options(params, contours), job);
}

void warn_of_welded(const LsystemParams& params, std::vector<Warning>& warnings) {
  if (!params.weld) return;
  if (params.style == LsystemParams::Style::lines) {
    warnings.push_back({"/weld", "has no effect: lines have no bark that could be joined", 0, 0});
    return;
  }
  if (params.stacks > 1)
    warnings.push_back({"/stacks", "has no effect: welded bark has rings where it bends", 0, 0});
  if (params.adapt) {
    warnings.push_back(
        {"/adapt", "has no effect: thinner limbs of welded bark have fewer sides anyway", 0, 0});
  }
}

}  // namespace seedmesh::lsystem

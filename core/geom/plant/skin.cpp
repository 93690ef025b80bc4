#include "core/geom/plant/skin.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/parallel.h"
#include "core/geom/plant/tube_count.h"
#include "core/geom/plant/tube_writer.h"
#include "core/model/index_width.h"

namespace seedmesh {
namespace {

// Limbs that a thread processes at once.
constexpr std::size_t limbs_a_chunk = 256;
// Bounds the size of the table of counts, with a row for each chunk and a column for each colour.
constexpr std::size_t most_counts = std::size_t{1} << 20U;

/// A sink that checks stop and deadline, also within one very long limb.
template <class Sink>
class Checked {
 public:
  Checked(Sink& sink, const Job& job) : sink_(sink), job_(job) {}
  void open(const Internode& first, TubeOpening opening) {
    count();
    sink_.open(first, opening);
  }
  void join(const Turn& turn, const Internode& next) {
    count();
    sink_.join(turn, next);
  }
  void close(TubeClosing closing, float free) { sink_.close(closing, free); }

 private:
  void count() {
    if (++steps_ % 4096 == 0) job_.check();
  }
  Sink& sink_;
  const Job& job_;
  unsigned steps_ = 0;
};

/// The number of sides by which Scale is computed.
int finest_sides(const SkinOptions& options) {
  if (options.contours.empty()) return options.sides;
  return std::max(options.sides, fineness(options.contours, static_cast<std::uint32_t>(options.sides)));
}

/// The radius that a limb begins with.
float first_radius(const Limbs& limbs, const Chains& chains, std::uint32_t head) {
  const std::uint32_t joint = limbs.parent[head] == Limbs::none ? chains.next[head] : head;
  return joint == Limbs::none ? 0 : limbs.base_radius[joint];
}

struct Plan {
  Plan(const Limbs& limbs, Chains found, const Scale& the_scale)
      : chains(std::move(found)),
        scale(the_scale),
        palette(limbs),
        chunk(std::max(limbs_a_chunk, chains.head.size() * palette.size() / most_counts)),
        chunks(chunk_count(chains.head.size(), chunk)),
        counts(chunks * palette.size()) {}

  LimbCorners corners(const Limbs& limbs, const SkinOptions& options, std::uint32_t head) const {
    if (!options.corners.empty()) return options.corners[head];
    const auto sides = static_cast<std::uint8_t>(
        options.adapt ? sides_of_limb(options, first_radius(limbs, chains, head), thickest) : options.sides);
    return {sides, sides};
  }

  TubeCount* row(std::size_t index) { return counts.data() + index * palette.size(); }

  Chains chains;
  Scale scale;
  Palette palette;
  float thickest = 0;  ///< first radius of any limb, where sides depend on it
  std::size_t chunk, chunks;
  /// Of each chunk and colour; after sum_counts(), the sums of the chunks before it.
  std::vector<TubeCount> counts;
};

// The sine up to which two directions count as one.
constexpr float straight_sine = 1e-3F;
// The share of a radius by which an even taper may differ.
constexpr float radius_off = 1e-2F;

/// Marks joints without a ring: where the limb goes straight on with an even taper and nothing else changes.
/// Each piece is compared with the first of its row, so that a slow bend is not straight.
class StraightPieces {
 public:
  StraightPieces(const Limbs& limbs, const SkinOptions& options, const Scale& scale, Chains& chains)
      : limbs_(limbs), options_(options), scale_(scale), chains_(chains) {}

  void mark_limb(std::uint32_t head) {
    std::uint32_t joint = limbs_.parent[head] == Limbs::none ? chains_.next[head] : head;
    while (joint != Limbs::none) {
      const glm::vec3 from = limbs_.position[limbs_.parent[joint]], step = limbs_.position[joint] - from;
      const float base = limbs_.base_radius[joint], length = std::sqrt(glm::dot(step, step));
      std::uint32_t next = chains_.next[joint], last = joint;
      for (; length > scale_.shortest && next != Limbs::none; last = next, next = chains_.next[next]) {
        if (!goes_on(last, next)) break;
        const glm::vec3 on = limbs_.position[next] - limbs_.position[last],
                        all = limbs_.position[next] - from;
        const float on_length = std::sqrt(glm::dot(on, on)), all_length = std::sqrt(glm::dot(all, all));
        const glm::vec3 across = glm::cross(step, on);
        if (on_length <= scale_.shortest || glm::dot(step, on) <= 0) break;
        if (std::sqrt(glm::dot(across, across)) > straight_sine * length * on_length) break;
        const float even = base + (limbs_.radius[next] - base) * (length / all_length);
        if (std::abs(even - limbs_.radius[joint]) > radius_off * even) break;
        chains_.mark[last] |= straight_on;
      }
      joint = next;
    }
  }

 private:
  bool goes_on(std::uint32_t joint, std::uint32_t next) const {
    if ((chains_.mark[joint] | chains_.mark[next]) & drawn_before) return false;
    if (!limbs_.color.empty() && limbs_.color[joint] != limbs_.color[next]) return false;
    if (!options_.bones.empty() && options_.bones[joint] != options_.bones[next]) return false;
    if (!limbs_.contour.empty()) return false;
    const float radius = limbs_.radius[joint], least = std::min(radius, limbs_.radius[next]);
    return least >= scale_.thinnest && std::abs(limbs_.base_radius[next] - radius) <= 1e-4F * radius;
  }

  const Limbs& limbs_;
  const SkinOptions& options_;
  const Scale& scale_;
  Chains& chains_;
};

void mark_straight(const Limbs& limbs, const SkinOptions& options, const Scale& scale, Chains& chains) {
  if (options.corners.empty()) return;
  StraightPieces pieces(limbs, options, scale, chains);
  for (const std::uint32_t head : chains.head) pieces.mark_limb(head);
}

void count_tubes(Plan& plan, const Limbs& limbs, const SkinOptions& options, const Job& job) {
  parallel_for(
      job, plan.chains.head.size(), plan.chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
        TubeCounter counter(limbs, options, plan.scale, plan.palette, plan.row(index));
        Checked sink(counter, job);
        MitreCheck check(plan.scale, options.sides);
        int sides = options.sides;
        for (std::size_t i = begin; i < end; ++i) {
          if (const int own = plan.corners(limbs, options, plan.chains.head[i]).current; own != sides) {
            check = MitreCheck(plan.scale, sides = own);
            counter.begin_limb(sides);
          }
          walk_limb({limbs, plan.chains, plan.scale, plan.chains.head[i]}, check, plan.chains, plan.scale,
                    sink);
        }
      });
}

/// Replaces counts by the sums of the counts before; returns the totals of each colour.
std::vector<TubeCount> sum_counts(Plan& plan) {
  std::vector<TubeCount> totals(plan.palette.size());
  for (std::size_t index = 0; index < plan.chunks; ++index) {
    for (std::size_t slot = 0; slot < totals.size(); ++slot) {
      TubeCount& count = plan.row(index)[slot];
      const TubeCount before = totals[slot];
      totals[slot].vertices += count.vertices;
      totals[slot].triangles += count.triangles;
      count = before;
    }
  }
  return totals;
}

Mesh allocate(const TubeCount& count, const SkinOptions& options, const Job& job) {
  check_vertex_count(job, count.vertices, "The bark");
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, count.vertices);
  mesh.normal = Array<glm::vec3>(job, count.vertices);
  if (options.uv) mesh.uv[0] = Array<glm::vec2>(job, count.vertices);
  if (!options.bones.empty()) mesh.bone = Array<std::uint16_t>(job, count.vertices);
  mesh.index.wide = Array<std::uint32_t>(job, 3 * count.triangles);
  mesh.cache_ordered = true;
  return mesh;
}

std::vector<Bark> allocate_all(const std::vector<TubeCount>& totals, const Palette& palette,
                               const SkinOptions& options, Job& job) {
  std::uint64_t triangles = 0;
  for (const TubeCount& total : totals) triangles += total.triangles;
  job.spend(Resource::triangles, triangles);
  std::vector<Bark> barks;
  for (std::size_t slot = 0; slot < totals.size(); ++slot) {
    barks.push_back({palette.color(slot), allocate(totals[slot], options, job)});
  }
  return barks;
}

TubeCursor cursor_at(Mesh& mesh, const TubeCount& place) {
  return {mesh.position.data(),
          mesh.normal.data(),
          mesh.uv[0].empty() ? nullptr : mesh.uv[0].data(),
          mesh.index.wide.data(),
          place.vertices,
          3 * place.triangles,
          mesh.bone.empty() ? nullptr : mesh.bone.data()};
}

void write_tubes(Plan& plan, const Limbs& limbs, const SkinOptions& options, const Job& job,
                 std::vector<Bark>& barks) {
  std::vector<TubeTables> tables(static_cast<std::size_t>(options.sides) + 1);
  const bool is_any = options.adapt || !options.corners.empty();
  for (int sides = is_any ? least_sides_of(options) : options.sides; sides <= options.sides; ++sides) {
    tables[static_cast<std::size_t>(sides)] = TubeTables(CrossSection(options, sides), options.contours);
  }
  parallel_for(
      job, plan.chains.head.size(), plan.chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
        std::vector<TubeCursor> cursors;
        for (std::size_t slot = 0; slot < barks.size(); ++slot) {
          cursors.push_back(cursor_at(barks[slot].mesh, plan.row(index)[slot]));
        }
        TubeWriter writer({limbs, plan.chains, plan.scale, plan.palette, options, tables}, cursors.data());
        Checked sink(writer, job);
        MitreCheck check(plan.scale, options.sides);
        int sides = options.sides;
        for (std::size_t i = begin; i < end; ++i) {
          const LimbCorners corners = plan.corners(limbs, options, plan.chains.head[i]);
          if (corners.current != sides) check = MitreCheck(plan.scale, sides = corners.current);
          writer.begin_limb(corners);
          walk_limb({limbs, plan.chains, plan.scale, plan.chains.head[i]}, check, plan.chains, plan.scale,
                    sink);
        }
        for ([[maybe_unused]] std::size_t slot = 0; index + 1 < plan.chunks && slot < cursors.size();
             ++slot) {
          assert(cursors[slot].vertex == plan.row(index + 1)[slot].vertices);
          assert(cursors[slot].corner == 3 * plan.row(index + 1)[slot].triangles);
        }
      });
}

}  // namespace

Palette::Palette(const Limbs& limbs) {
  if (limbs.color.empty()) {
    slots_.push_back(0);
    colors_.push_back(0);
    return;
  }
  const auto [low, high] = std::minmax_element(limbs.color.begin(), limbs.color.end());
  lowest_ = *low;
  std::vector<std::uint8_t> is_used(static_cast<std::size_t>(*high - *low + 1));
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] != Limbs::none) is_used[static_cast<std::size_t>(limbs.color[i] - lowest_)] = 1;
  }
  slots_.resize(is_used.size());
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (!is_used[i]) continue;
    slots_[i] = static_cast<std::uint16_t>(colors_.size());
    colors_.push_back(static_cast<std::int16_t>(lowest_ + static_cast<int>(i)));
  }
}

int least_sides_of(const SkinOptions& options) { return static_cast<int>(least_sides(options.contours)); }

int sides_of_limb(const SkinOptions& options, float radius, float most) {
  const float share = most > 0 ? std::sqrt(std::min(1.0F, radius / most)) : 1.0F;
  return std::max(least_sides_of(options),
                  static_cast<int>(share * static_cast<float>(options.sides) + 0.5F));
}

std::vector<Bark> skin(const Limbs& limbs, const SkinOptions& options, Job& job) {
  assert(options.sides >= least_sides_of(options) && options.sides <= 64 && options.stacks >= 1);
  if (limbs.size() == 0) return {};
  const Scale scale = scale_of(limbs, finest_sides(options));
  Plan plan(limbs, find_chains(limbs, scale, job), scale);
  for (const std::uint32_t head : plan.chains.head) {
    if (options.adapt) plan.thickest = std::max(plan.thickest, first_radius(limbs, plan.chains, head));
  }
  mark_straight(limbs, options, scale, plan.chains);
  count_tubes(plan, limbs, options, job);
  const std::vector<TubeCount> totals = sum_counts(plan);
  std::vector<Bark> barks = allocate_all(totals, plan.palette, options, job);
  write_tubes(plan, limbs, options, job, barks);
  std::erase_if(barks, [](const Bark& bark) { return bark.mesh.position.empty(); });
  return barks;
}

TubeCount skin_count(const Limbs& limbs, const SkinOptions& options, const Job& request, RepeatMode repeats) {
  TubeCount sum;
  if (limbs.size() == 0) return sum;
  Job job = request.for_estimate();
  const Scale scale = scale_of(limbs, finest_sides(options));
  Plan plan(limbs, repeats == RepeatMode::found ? find_chains(limbs, scale, job) : link_chains(limbs, job),
            scale);
  for (const std::uint32_t head : plan.chains.head) {
    if (options.adapt) plan.thickest = std::max(plan.thickest, first_radius(limbs, plan.chains, head));
  }
  mark_straight(limbs, options, scale, plan.chains);
  count_tubes(plan, limbs, options, job);
  for (const TubeCount& total : sum_counts(plan)) {
    sum.vertices += total.vertices;
    sum.triangles += total.triangles;
  }
  return sum;
}

}  // namespace seedmesh

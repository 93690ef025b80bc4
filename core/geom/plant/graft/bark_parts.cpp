// write_in_parts() of bark_rounds.h.
#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>

#include "core/base/parallel.h"
#include "core/geom/plant/graft/bark_rounds.h"
#include "core/geom/plant/graft/limb_writer.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
// Trees of fewer joints take less time than it takes to wake a thread. Trees of more joints would need too
// much memory for two copies.
constexpr std::size_t least_joints = 128, most_joints = std::size_t{1} << 18U;
constexpr std::size_t most_parts = 8;
// Upper bounds, by which parts are not used where a limit of the request may be met.
constexpr std::uint64_t most_triangles_a_joint = 256, most_bytes_a_triangle = 64;
// Parts may write one joint in this number twice, only to find the loops of their limbs.
constexpr std::size_t joints_a_repeated = 4;
// Triangles are spent in small amounts: the rest of a larger one would not be available to other meters.
constexpr std::uint64_t charged_at_once = 4096;

/// The limbs after the first one, in contiguous parts.
struct PartPlan {
  std::vector<std::uint32_t> first;  ///< of each part, its first limb; then the number of limbs
  /// Of each part, limbs of earlier parts that its limbs grow from, except for limb 0, rising. The part
  /// writes them only for their loops and drops the rest.
  std::vector<std::vector<std::uint32_t>> before;
};

/// One part: buffers, and the sizes of what the part knew before its own limbs.
struct Part {
  Part(const GraftInput& in, std::size_t joints, Job& job)
      : bark(in.options, in.chains.head.size(), joints, job), writer(in, bark) {
    bark.is_part = true;
  }
  BarkBuffers bark;
  LimbWriter writer;
  std::uint32_t first_group = 0, first_loop_vertex = 0;
};

bool is_worth_parting(const GraftInput& in, Job& job) {
  const std::size_t joints = in.limbs.size();
  if (!has_threads(job) || joints < least_joints || joints > most_joints || in.options.drawn) return false;
  const std::uint64_t triangles = most_triangles_a_joint * joints;
  const std::uint64_t left = job.limits().triangles - job.spent(Resource::triangles);
  return triangles < left && most_bytes_a_triangle * triangles < job.limits().memory_bytes / 2;
}

/// As many parts as threads; no parts where they would write too much twice. This happens in trees whose stems
/// are stored one after the other, each with all that grows from it.
PartPlan plan_parts(const GraftInput& in, const Job& job) {
  const Array<std::uint32_t>& head = in.chains.head;
  const std::size_t wanted = std::min<std::size_t>(most_parts, static_cast<std::size_t>(job.threads()));
  const std::size_t joints = in.limbs.size(), trunk = head.size() > 1 ? head[1] : joints;
  PartPlan plan;
  for (std::size_t i = 0; i <= wanted; ++i) {
    const std::uint32_t* first =
        std::lower_bound(head.begin(), head.end(), trunk + (joints - trunk) * i / wanted);
    plan.first.push_back(i == wanted ? static_cast<std::uint32_t>(head.size())
                                     : static_cast<std::uint32_t>(first - head.begin()));
  }
  const std::vector<std::uint32_t> parents = parent_limbs(in);
  std::vector<std::uint32_t> needed_by(head.size(), none);
  std::size_t repeated = 0;
  for (std::uint32_t part = 0; part < wanted; ++part) {
    std::vector<std::uint32_t>& before = plan.before.emplace_back();
    for (std::uint32_t limb = plan.first[part]; limb < plan.first[part + 1]; ++limb) {
      for (std::uint32_t at = parents[limb];
           at != none && at > 0 && at < plan.first[part] && needed_by[at] != part; at = parents[at]) {
        needed_by[at] = part;
        before.push_back(at);
        for (std::uint32_t joint = head[at]; joint != none; joint = in.chains.next[joint]) ++repeated;
      }
    }
    std::sort(before.begin(), before.end());
  }
  return repeated * joints_a_repeated > joints ? PartPlan{} : plan;
}

/// Copies the loops that other parts have written into a part.
void copy_loops(const BarkBuffers& from, BarkBuffers& part) {
  part.loop_vertices.append(from.loop_vertices.span());
  part.group_normal.append(from.group_normal.span());
  part.group_limb = from.group_limb;
  for (const std::uint32_t limb : part.group_limb) part.loops[limb] = from.loops[limb];
}

/// Writes the limbs whose loops a part needs, and drops everything but these loops.
void write_before(Part& part, const std::vector<std::uint32_t>& before) {
  for (const std::uint32_t limb : before) write_limb(part.writer, limb);
  BarkBuffers& bark = part.bark;
  bark.vertices = bark.corners = bark.wide_corners = bark.uncharged = 0;
  bark.mesh.index.wide.clear();
  bark.colors.clear();
  bark.loop_triangles.clear();
  bark.rib_seams.clear();
  part.first_group = static_cast<std::uint32_t>(bark.group_normal.size());
  part.first_loop_vertex = static_cast<std::uint32_t>(bark.loop_vertices.size());
}

template <class T>
void copy_to(Array<T>& to, std::size_t at, const Array<T>& from, std::size_t count) {
  if (count > 0 && !from.empty()) std::copy_n(from.data(), count, to.data() + at);
}

/// Appends the vertices and triangles of a part. Groups that the part has made itself get new numbers.
void append_vertices(BarkBuffers& bark, const Part& from, const Job& job) {
  const BarkBuffers& part = from.bark;
  const std::size_t count = part.vertices, first = bark.vertices;
  const auto shift = static_cast<std::uint32_t>(first);
  reserve_vertices(bark, count);
  const Array<std::uint32_t>& index = part.mesh.index.wide;
  std::uint32_t* to = bark.mesh.index.wide.extend(index.size());
  const std::uint32_t groups = static_cast<std::uint32_t>(bark.group_normal.size()) - from.first_group;
  const std::function<void()> tasks[] = {
      [&] { copy_to(bark.mesh.position, first, part.mesh.position, count); },
      [&] { copy_to(bark.mesh.normal, first, part.mesh.normal, count); },
      [&] { copy_to(bark.mesh.tangent, first, part.mesh.tangent, count); },
      [&] { copy_to(bark.mesh.uv[0], first, part.mesh.uv[0], count); },
      [&] {
        copy_to(bark.twin, first, part.twin, count);
        copy_to(bark.joints, first, part.joints, count);
      },
      [&] {
        for (std::size_t i = 0; i < count; ++i) {
          const std::uint32_t group = part.group[i];
          bark.group[first + i] = group != none && group >= from.first_group ? group + groups : group;
        }
      },
      [&] {
        for (std::size_t i = 0; i < index.size(); ++i) to[i] = index[i] + shift;
      },
  };
  parallel_for(job, std::size(tasks), 1, [&](std::size_t i, std::size_t, std::size_t) { tasks[i](); });
  bark.vertices += count;
  bark.colors.append(part.colors.span());
}

/// Appends the loops and groups of a part, and gives its limbs the groups that their parents have here.
void append_loops(BarkBuffers& bark, const Part& from, std::uint32_t first, std::uint32_t last) {
  const BarkBuffers& part = from.bark;
  const auto vertices = static_cast<std::uint32_t>(bark.loop_vertices.size()) - from.first_loop_vertex;
  const auto groups = static_cast<std::uint32_t>(bark.group_normal.size()) - from.first_group;
  const std::size_t first_pair = from.first_group / 2;
  for (std::size_t pair = first_pair; pair < part.group_limb.size(); ++pair) {
    const std::uint32_t limb = part.group_limb[pair];  // of this part or a later one
    bark.loops[limb] = part.loops[limb];
    bark.loops[limb].first += vertices;
  }
  for (std::uint32_t limb = first; limb < last; ++limb) {
    const Loop& loop = part.loops[limb];
    const std::uint32_t begin = bark.range[limb].begin.vertex;
    if (loop.first >= from.first_loop_vertex || begin == bark.range[limb].end.vertex) continue;
    // The loop belongs to a parent that was written here as well, with other groups.
    const std::uint32_t there = part.loop_vertices[loop.first].group;
    const std::uint32_t here = bark.loop_vertices[bark.loops[limb].first].group;
    for (std::uint32_t i = begin; i <= begin + loop.count; ++i) bark.group[i] = bark.group[i] - there + here;
  }
  for (std::size_t i = from.first_loop_vertex; i < part.loop_vertices.size(); ++i) {
    bark.loop_vertices.push_back(part.loop_vertices[i]);
    bark.loop_vertices.back().group += groups;
  }
  for (std::size_t group = from.first_group; group < part.group_normal.size(); ++group)
    bark.group_normal.push_back({});
  bark.group_limb.insert(bark.group_limb.end(),
                         part.group_limb.begin() + static_cast<std::ptrdiff_t>(first_pair),
                         part.group_limb.end());
}

/// Appends what a part has written of the limbs `first` to `last - 1`.
void append_part(BarkBuffers& bark, const Part& from, std::uint32_t first, std::uint32_t last,
                 const Job& job) {
  const BarkBuffers& part = from.bark;
  for (std::uint64_t left = part.uncharged; left > 0;) {
    const std::uint64_t now = std::min(left, charged_at_once);
    bark.triangles.spend(now);
    left -= now;
  }
  const BarkSizes at = sizes_of(bark);
  const std::uint32_t group = at.group - from.first_group;
  const auto moved = [&](const BarkSizes& sizes) -> BarkSizes {
    return {sizes.vertex + at.vertex,   sizes.triangle + at.triangle,
            sizes.group + group,        sizes.loop_triangle + at.loop_triangle,
            sizes.corners + at.corners, sizes.wide_corners + at.wide_corners};
  };
  for (std::uint32_t limb = first; limb < last; ++limb) {
    const LimbRange& range = part.range[limb];
    bark.range[limb] = {moved(range.begin), moved(range.end), range.first_end + at.triangle};
    bark.start[limb] = part.start[limb];
  }
  for (const std::uint32_t triangle : part.loop_triangles)
    bark.loop_triangles.push_back(triangle + at.triangle);
  for (const auto& [begin, end] : part.rib_seams)
    bark.rib_seams.emplace_back(begin + at.vertex, end + at.vertex);
  bark.corners += part.corners;
  bark.wide_corners += part.wide_corners;
  append_vertices(bark, from, job);
  append_loops(bark, from, first, last);
}

}  // namespace

bool write_in_parts(const GraftInput& in, BarkBuffers& bark, Job& job) {
  if (!is_worth_parting(in, job)) return false;
  const PartPlan plan = plan_parts(in, job);
  const std::size_t count = plan.before.size();
  if (count < 2) return false;
  LimbWriter trunk(in, bark);
  write_limb(trunk, 0);                              // all parts need its loops
  std::vector<std::unique_ptr<Part>> others(count);  // part 0 is written to `bark` itself
  for (std::size_t i = 1; i < count; ++i) {
    others[i] = std::make_unique<Part>(in, in.limbs.size() / count, job);
    copy_loops(bark, others[i]->bark);
  }
  parallel_for(job, count, 1, [&](std::size_t, std::size_t, std::size_t number) {
    if (number > 0) write_before(*others[number], plan.before[number]);
    LimbWriter& writer = number > 0 ? others[number]->writer : trunk;
    for (std::uint32_t limb = plan.first[number]; limb < plan.first[number + 1]; ++limb) {
      if (limb % 64 == 0) job.check();
      write_limb(writer, limb);
    }
  });
  for (std::size_t i = 1; i < count; ++i) {
    append_part(bark, *others[i], plan.first[i], plan.first[i + 1], job);
    others[i] = nullptr;
  }
  return true;
}

}  // namespace seedmesh

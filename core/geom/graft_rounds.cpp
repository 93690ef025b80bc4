#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "core/base/parallel.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

constexpr std::size_t most_together = std::size_t{1} << 20U;

}  // namespace

GraftWriter::Place GraftWriter::here() const {
  return {static_cast<std::uint32_t>(vertices_),
          static_cast<std::uint32_t>(mesh_.index.wide.size() / 3),
          static_cast<std::uint32_t>(group_normal_.size()),
          static_cast<std::uint32_t>(loop_triangles_.size()),
          static_cast<std::uint32_t>(corners_),
          static_cast<std::uint32_t>(wide_corners_)};
}

GraftCounts GraftWriter::counts() const {
  const auto count = [&](Kind kind) {
    return static_cast<std::uint32_t>(std::count(kind_.begin(), kind_.end(), kind));
  };
  GraftCounts counts;
  counts.collars = count(Kind::collar);
  counts.forks = count(Kind::fork);
  counts.closed = count(Kind::closed);
  counts.creases = static_cast<std::uint32_t>(creases_at_last().size());
  counts.limbs = count(Kind::root) + counts.collars + counts.forks + counts.closed;
  return counts;
}

void GraftWriter::tell_grown(Array<std::uint8_t>& grown) const {
  grown.resize(context_.limbs.size());
  std::fill(grown.begin(), grown.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < kind_.size(); ++i) {
    if (kind_[i] == Kind::collar || kind_[i] == Kind::fork) grown[context_.chains.head[i]] = 1;
  }
}

/// The limb that each limb grows from.
std::vector<std::uint32_t> GraftWriter::find_parents() const {
  const Chains& chains = context_.chains;
  std::vector<std::uint32_t> limb_of(context_.limbs.size(), none);
  std::vector<std::uint32_t> parents(chains.head.size(), none);
  for (std::uint32_t i = 0; i < chains.head.size(); ++i) {
    for (std::uint32_t joint = chains.head[i]; joint != none; joint = chains.next[joint]) limb_of[joint] = i;
    const std::uint32_t from = context_.limbs.parent[chains.head[i]];
    if (from != none) parents[i] = limb_of[from];
  }
  return parents;
}

/// Limbs whose trust has changed, and whom they grow from.
void GraftWriter::find_dirty() {
  if (parent_.empty()) parent_ = find_parents();
  std::fill(dirty_.begin(), dirty_.end(), std::uint8_t{0});
  for (std::size_t i = 0; i < dirty_.size(); ++i) {
    if (context_.trust[i] == trust_[i]) continue;
    dirty_[i] = 1;
    if (parent_[i] != none) dirty_[parent_[i]] = 1;
  }
}

/// Behind all that is written.
void GraftWriter::write_anew(std::uint32_t limb) {
  kind_[limb] = Kind::none;
  range_[limb].begin = here();
  range_[limb].first_end = range_[limb].begin.triangle;
  if (context_.trust[limb] != Trust::none) write_limb(limb);
  range_[limb].end = here();
}

void GraftWriter::write_round() {
  const bool is_first = trust_.empty();
  if (!is_first) find_dirty();
  trust_ = context_.trust;
  if (is_first && write_parts()) return;
  const std::vector<Loop> then = is_first ? std::vector<Loop>{} : loops_;
  for (std::size_t i = 0; i < range_.size(); ++i) {
    const auto limb = static_cast<std::uint32_t>(i);
    if (i % 64 == 0) job_.check();
    if (!dirty_[i]) {
      if (has_same_loop(loops_[i], then[i])) {
        keep_limb(limb, then[i]);
        continue;
      }
      dirty_[i] = 1;
    }
    if (!is_first) forget_loops(range_[i]);
    write_anew(limb);
  }
}

bool GraftWriter::has_same_loop(const Loop& now, const Loop& then) const {
  if (now.first == then.first) return true;
  if (now.first == none || then.first == none) return false;
  if (now.count != then.count || now.radius != then.radius || now.reach != then.reach || now.u != then.u ||
      now.is_fork != then.is_fork) {
    return false;
  }
  for (std::uint32_t i = 0; i < now.count; ++i) {
    const LoopVertex &a = loop_vertices_[now.first + i], &b = loop_vertices_[then.first + i];
    if (a.position != b.position || a.angle != b.angle || a.reach != b.reach || a.joint != b.joint)
      return false;
  }
  return true;
}

/// The loops that a limb has made for its children are there no more.
void GraftWriter::forget_loops(const Range& range) {
  for (std::size_t pair = range.begin.group / 2; pair < range.end.group / 2; ++pair)
    loops_[group_limb_[pair]] = {};
}

/// A limb stays as it is, but its loop may have been made anew: the groups of that are its own now.
void GraftWriter::keep_limb(std::uint32_t limb, const Loop& then) {
  const Loop& now = loops_[limb];
  const Range& range = range_[limb];
  if (now.first == then.first || range.begin.vertex == range.end.vertex) return;
  const std::uint32_t old_group = loop_vertices_[then.first].group;
  const std::uint32_t new_group = loop_vertices_[now.first].group;
  for (std::uint32_t i = 0; i <= now.count; ++i) {
    std::uint32_t& group = group_[range.begin.vertex + i];
    group = group - old_group + new_group;
  }
}

/// Pairs of groups that belong to a limb that was written, as parent or as child.
void GraftWriter::mark_touched() {
  touched_.assign(group_limb_.size(), 0);
  for (std::size_t limb = 0; limb < range_.size(); ++limb) {
    const Range& range = range_[limb];
    for (std::size_t pair = range.begin.group / 2; pair < range.end.group / 2; ++pair)
      touched_[pair] = dirty_[limb] | dirty_[group_limb_[pair]];
  }
}

std::uint32_t GraftWriter::sum_of(std::uint32_t Place::*what) const {
  std::uint32_t sum = 0;
  for (const Range& range : range_) sum += range.end.*what - range.begin.*what;
  return sum;
}

/// True where the limbs stand one behind another as they are.
bool GraftWriter::is_in_order() const {
  std::uint32_t vertex = 0;
  for (const Range& range : range_) {
    if (range.begin.vertex != vertex) return false;
    vertex = range.end.vertex;
  }
  return vertex == vertices_;
}

/// Limb by limb; `from` is used up.
template <class T>
Array<T> GraftWriter::gathered(Array<T>& from, std::uint32_t Place::*what) const {
  Array<T> out(job_);
  out.reserve(from.empty() ? 0 : sum_of(what) + 3 * creased_.size());
  for (const Range& range : range_) {
    if (!from.empty())
      out.append(from.span().subspan(range.begin.*what, range.end.*what - range.begin.*what));
  }
  from = {};
  return out;
}

GraftWriter::Written GraftWriter::take() {
  const std::vector<Crease> creases = creases_at_last();
  if (is_in_order()) {
    make_room(vertices_);
    Written out{std::move(mesh_), std::move(joints_), std::move(twin_), std::move(colors_)};
    write_creases(creases, out);
    out.mesh.position.shrink_to_fit();
    out.mesh.normal.shrink_to_fit();
    out.mesh.tangent.shrink_to_fit();
    out.mesh.uv[0].shrink_to_fit();
    out.mesh.index.wide.shrink_to_fit();
    return out;
  }
  group_ = {};
  Written out;
  const std::function<void()> tasks[] = {
      [&] { out.mesh.position = gathered(mesh_.position, &Place::vertex); },
      [&] { out.mesh.normal = gathered(mesh_.normal, &Place::vertex); },
      [&] { out.mesh.tangent = gathered(mesh_.tangent, &Place::vertex); },
      [&] { out.mesh.index.wide = gathered_index(); },
      [&] { out.mesh.uv[0] = gathered(mesh_.uv[0], &Place::vertex); },
      [&] { out.joints = gathered(joints_, &Place::vertex); },
      [&] { out.twin = gathered(twin_, &Place::vertex); },
      [&] { out.colors = gathered(colors_, &Place::triangle); },
  };
  // Great ones one after the other, each of which gives its memory to the next.
  const std::size_t together = vertices_ > most_together ? std::size(tasks) : 1;
  parallel_for(job_, std::size(tasks), together, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) tasks[i]();
  });
  mesh_ = {};
  write_creases(creases, out);
  return out;
}

/// As the vertices stand then.
Array<std::uint32_t> GraftWriter::gathered_index() const {
  Array<std::uint32_t> index(job_);
  index.reserve(std::size_t{3} * sum_of(&Place::triangle));
  std::uint32_t vertex = 0;
  for (const Range& range : range_) {
    const std::size_t first = std::size_t{3} * range.begin.triangle,
                      end = std::size_t{3} * range.end.triangle;
    const std::uint32_t* from = mesh_.index.wide.data() + first;
    std::uint32_t* to = index.extend(end - first);
    const std::uint32_t shift = vertex - range.begin.vertex;
    for (std::size_t i = 0; i < end - first; ++i) to[i] = from[i] + shift;
    vertex += range.end.vertex - range.begin.vertex;
  }
  return index;
}

}  // namespace seedmesh

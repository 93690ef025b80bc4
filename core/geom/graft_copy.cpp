#include <algorithm>

#include "core/geom/graft_writer.h"

namespace seedmesh {

GraftWriter::Begin GraftWriter::here() const {
  return {static_cast<std::uint32_t>(mesh_.position.size()),
          static_cast<std::uint32_t>(mesh_.index.wide.size() / 3),
          static_cast<std::uint32_t>(group_normal_.size()),
          static_cast<std::uint32_t>(loop_vertices_.size()),
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
  counts.limbs = count(Kind::root) + counts.collars + counts.forks + counts.closed;
  return counts;
}

/// The limb that each limb grows from.
void GraftWriter::find_parents() {
  const Chains& chains = context_.chains;
  std::vector<std::uint32_t> limb_of(context_.limbs.size(), none);
  parent_.assign(chains.head.size(), none);
  for (std::uint32_t i = 0; i < chains.head.size(); ++i) {
    for (std::uint32_t joint = chains.head[i]; joint != none; joint = chains.next[joint]) limb_of[joint] = i;
    const std::uint32_t from = context_.limbs.parent[chains.head[i]];
    if (from != none) parent_[i] = limb_of[from];
  }
}

bool GraftWriter::has_same_loop(std::uint32_t limb, const GraftWriter& last) const {
  const Loop &now = loops_[limb], &then = last.loops_[limb];
  if (now.first == none || then.first == none) return now.first == then.first;
  if (now.count != then.count || now.radius != then.radius || now.reach != then.reach || now.u != then.u ||
      now.is_fork != then.is_fork) {
    return false;
  }
  for (std::uint32_t i = 0; i < now.count; ++i) {
    const LoopVertex &a = loop_vertices_[now.first + i], &b = last.loop_vertices_[then.first + i];
    if (a.position != b.position || a.angle != b.angle || a.reach != b.reach || a.joint != b.joint)
      return false;
  }
  return true;
}

/// All that the last round wrote for a limb, with its numbers shifted.
void GraftWriter::copy_limb(std::uint32_t limb, const GraftWriter& last) {
  const Begin from = last.begin_[limb], to = last.begin_[limb + std::size_t{1}], now = here();
  const auto append = [](auto& into, const auto& source, std::size_t first, std::size_t end) {
    into.append(source.span().subspan(first, end - first));
  };
  append(mesh_.position, last.mesh_.position, from.vertex, to.vertex);
  append(mesh_.normal, last.mesh_.normal, from.vertex, to.vertex);
  append(mesh_.uv[0], last.mesh_.uv[0], from.vertex, to.vertex);
  if (context_.options.joints) append(joints_, last.joints_, from.vertex, to.vertex);
  append(group_normal_, last.group_normal_, from.group, to.group);
  // Groups are its own, or those of the loop that it begins with, which its parent has made in one go.
  const Loop &loop = loops_[limb], &old = last.loops_[limb];
  const std::uint32_t old_loop = old.first == none ? 0 : last.loop_vertices_[old.first].group;
  const std::uint32_t new_loop = loop.first == none ? 0 : loop_vertices_[loop.first].group;
  const auto moved = [&](std::uint32_t group) {
    if (group == none) return group;
    const bool is_own = group >= from.group && group < to.group;
    return is_own ? group - from.group + now.group : group - old_loop + new_loop;
  };
  for (std::size_t i = from.vertex; i < to.vertex; ++i) group_.push_back(moved(last.group_[i]));
  for (std::size_t i = from.group / 2; i < to.group / 2; ++i) {
    const std::uint32_t child = last.group_limb_[i];
    group_limb_.push_back(child);
    loops_[child] = last.loops_[child];
    loops_[child].first += now.loop_vertex - from.loop_vertex;
  }
  for (std::size_t i = from.loop_vertex; i < to.loop_vertex; ++i) {
    loop_vertices_.push_back(last.loop_vertices_[i]);
    loop_vertices_.back().group = moved(loop_vertices_.back().group);
  }
  std::uint32_t* index = mesh_.index.wide.extend(std::size_t{3} * (to.triangle - from.triangle));
  for (std::size_t i = std::size_t{3} * from.triangle; i < std::size_t{3} * to.triangle; ++i)
    *index++ = last.mesh_.index.wide[i] - from.vertex + now.vertex;
  kind_[limb] = last.kind_[limb];
  corners_ += to.corners - from.corners;
  wide_corners_ += to.wide_corners - from.wide_corners;
}

/// Pairs of groups that belong to a limb that was written, as parent or as child.
void GraftWriter::mark_touched() {
  touched_.assign(group_limb_.size(), 0);
  for (std::size_t limb = 0; limb + 1 < begin_.size(); ++limb) {
    for (std::size_t pair = begin_[limb].group / 2; pair < begin_[limb + 1].group / 2; ++pair)
      touched_[pair] = dirty_[limb] | dirty_[group_limb_[pair]];
  }
}

}  // namespace seedmesh

/// Limbs of one part of a tree need nothing of another part but the loops that they begin with: parts are
/// written side by side, and put in the order that one writer writes them in.
#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/parallel.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// Joints that are worth a strand, and how many strands there are at most.
constexpr std::size_t joints_a_strand = 384, most_strands = 16;
// Limbs that bear a greater share of all joints are written first.
constexpr std::size_t greatest_share = 8;
// Limbs that are copied together.
constexpr std::size_t limbs_a_chunk = 256;

template <class T>
void copy(const Array<T>& from, std::size_t first, std::size_t count, Array<T>& to, std::size_t place) {
  if (count > 0) std::memcpy(static_cast<void*>(to.data() + place), from.data() + first, count * sizeof(T));
}

}  // namespace

GraftWriter::GraftWriter(const GraftWriter& trunk, OfStrand)
    : context_(trunk.context_),
      job_(trunk.job_),
      tables_(trunk.tables_),
      group_(trunk.job_),
      group_normal_(trunk.job_),
      group_limb_(trunk.group_limb_),
      range_(tables_->range),
      kind_(tables_->kind),
      joints_(trunk.job_),
      twin_(trunk.job_),
      loops_(tables_->loops),
      circles_(tables_->circles),
      loop_vertices_(trunk.loop_vertices_) {
  group_normal_.resize(trunk.group_normal_.size());
}

/// Limbs without great ones of their own, in strands that bear about as many joints each. Needs parents.
GraftWriter::Strands GraftWriter::strands() const {
  const std::size_t count = range_.size();
  std::vector<std::size_t> weight(count, 0);
  std::size_t total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::uint32_t joint = context_.chains.head[i]; joint != none; joint = context_.chains.next[joint])
      ++weight[i];
    total += weight[i];
  }
  for (std::size_t i = count; i-- > 0;) {
    if (parent_[i] != none) weight[parent_[i]] += weight[i];
  }
  const auto is_great = [&](std::uint32_t limb) {
    return parent_[limb] == none || greatest_share * weight[limb] > total;
  };
  Strands strands;
  strands.of.assign(count, 0);
  std::size_t light = 0;
  for (std::uint32_t i = 0; i < count; ++i) light += !is_great(i) && is_great(parent_[i]) ? weight[i] : 0;
  const std::size_t number = std::min(most_strands, light / joints_a_strand);
  strands.limbs.resize(1 + number);
  std::size_t before = 0;
  for (std::uint32_t i = 0; number > 0 && i < count; ++i) {
    if (!is_great(i)) {
      const bool is_top = is_great(parent_[i]);
      strands.of[i] =
          is_top ? static_cast<std::uint32_t>(1 + number * before / light) : strands.of[parent_[i]];
      before += is_top ? weight[i] : 0;
    }
    strands.limbs[strands.of[i]].push_back(i);
  }
  return strands;
}

void GraftWriter::write_limbs(std::span<const std::uint32_t> limbs) {
  std::size_t joints = 0;
  for (const std::uint32_t limb : limbs) {
    for (std::uint32_t at = context_.chains.head[limb]; at != none; at = context_.chains.next[at]) ++joints;
  }
  begin_mesh(joints);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % 64 == 0) job_.check();
    write_anew(limbs[i]);
  }
  spend_triangles();
}

/// The first round. False: it is not worth it, and nothing is written.
bool GraftWriter::write_side_by_side() {
  if (!has_threads(job_) || context_.limbs.size() < 2 * joints_a_strand) return false;
  find_parents();
  const Strands strands = this->strands();
  const std::size_t number = strands.limbs.size() - 1;
  if (number < 2) return false;
  write_limbs(strands.limbs[0]);
  std::vector<std::unique_ptr<GraftWriter>> writers(number);
  parallel_for(job_, number, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      writers[i].reset(new GraftWriter(*this, OfStrand{}));
      writers[i]->write_limbs(strands.limbs[i + 1]);
    }
  });
  join(strands, writers);
  return true;
}

/// The loops of all strands, numbered anew.
std::vector<GraftWriter::Shift> GraftWriter::append_loops(
    const std::vector<std::unique_ptr<GraftWriter>>& writers) {
  const std::size_t first_group = group_normal_.size(), first_vertex = loop_vertices_.size();
  std::vector<Shift> shifts(1);
  for (const auto& writer : writers) {
    const Shift shift{static_cast<std::uint32_t>(group_normal_.size() - first_group),
                      static_cast<std::uint32_t>(loop_vertices_.size() - first_vertex)};
    shifts.push_back(shift);
    group_normal_.resize(group_normal_.size() + writer->group_normal_.size() - first_group);
    const auto first_limb = static_cast<std::ptrdiff_t>(first_group / 2);
    group_limb_.insert(group_limb_.end(), writer->group_limb_.begin() + first_limb,
                       writer->group_limb_.end());
    for (std::size_t i = first_vertex; i < writer->loop_vertices_.size(); ++i) {
      loop_vertices_.push_back(writer->loop_vertices_[i]);
      loop_vertices_.back().group += shift.group;
    }
    corners_ += writer->corners_;
    wide_corners_ += writer->wide_corners_;
  }
  return shifts;
}

/// One limb behind another.
std::vector<GraftWriter::Range> GraftWriter::joined_ranges(const std::vector<Shift>& shifts,
                                                           const Strands& strands) const {
  std::vector<Range> joined;
  joined.reserve(range_.size());
  Place at;
  for (std::size_t limb = 0; limb < range_.size(); ++limb) {
    const Range& then = range_[limb];
    Range& now = joined.emplace_back();
    now.begin = now.end = at;
    for (std::uint32_t Place::*each :
         {&Place::vertex, &Place::triangle, &Place::loop_triangle, &Place::corners, &Place::wide_corners})
      now.end.*each += then.end.*each - then.begin.*each;
    now.first_end = now.begin.triangle + (then.first_end - then.begin.triangle);
    at = now.end;
    now.begin.group = then.begin.group + shifts[strands.of[limb]].group;
    now.end.group = then.end.group + shifts[strands.of[limb]].group;
  }
  return joined;
}

/// From another writer, to where it belongs now. Groups from `first_group` on are that writer's own.
void GraftWriter::copy_limb(const GraftWriter& from, const Range& then, const Range& now,
                            std::uint32_t group_shift, std::uint32_t first_group) {
  const std::size_t first = then.begin.vertex, count = then.end.vertex - first, place = now.begin.vertex;
  copy(from.mesh_.position, first, count, mesh_.position, place);
  copy(from.mesh_.normal, first, count, mesh_.normal, place);
  copy(from.mesh_.uv[0], first, count, mesh_.uv[0], place);
  copy(from.twin_, first, count, twin_, place);
  if (context_.options.joints) copy(from.joints_, first, count, joints_, place);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t group = from.group_[first + i];
    group_[place + i] = group + (group != none && group >= first_group ? group_shift : 0);
  }
  const std::uint32_t* corner = from.mesh_.index.wide.data() + std::size_t{3} * then.begin.triangle;
  std::uint32_t* out = mesh_.index.wide.data() + std::size_t{3} * now.begin.triangle;
  const std::uint32_t shift = now.begin.vertex - then.begin.vertex;
  const std::size_t corners = std::size_t{3} * (then.end.triangle - then.begin.triangle);
  for (std::size_t i = 0; i < corners; ++i) out[i] = corner[i] + shift;
  const std::uint32_t by = now.begin.triangle - then.begin.triangle;
  for (std::size_t i = 0; i < now.end.loop_triangle - now.begin.loop_triangle; ++i)
    loop_triangles_[now.begin.loop_triangle + i] = from.loop_triangles_[then.begin.loop_triangle + i] + by;
}

/// Takes what the writers of the other strands have written, and puts all in the order of limbs.
void GraftWriter::join(const Strands& strands, const std::vector<std::unique_ptr<GraftWriter>>& writers) {
  GraftWriter own(*this, OfStrand{});  // what this one has written itself
  const auto first_group = static_cast<std::uint32_t>(group_normal_.size());
  const auto first_vertex = static_cast<std::uint32_t>(loop_vertices_.size());
  const std::vector<Shift> shifts = append_loops(writers);
  const std::vector<Range> then = std::exchange(range_, joined_ranges(shifts, strands));
  const Place end = range_.back().end;
  std::swap(own.mesh_, mesh_);
  std::swap(own.group_, group_);
  std::swap(own.twin_, twin_);
  std::swap(own.joints_, joints_);
  std::swap(own.loop_triangles_, loop_triangles_);
  begin_mesh(0);
  make_room(end.vertex + Four::size);
  mesh_.index.wide.resize(std::size_t{3} * end.triangle);
  loop_triangles_.resize(end.loop_triangle);
  vertices_ = end.vertex;
  parallel_for(job_, range_.size(), limbs_a_chunk, [&](std::size_t begin, std::size_t last, std::size_t) {
    for (std::size_t limb = begin; limb < last; ++limb) {
      const std::uint32_t strand = strands.of[limb];
      copy_limb(strand == 0 ? own : *writers[strand - 1], then[limb], range_[limb], shifts[strand].group,
                first_group);
      Loop& loop = loops_[limb];
      if (loop.first != none && loop.first >= first_vertex) loop.first += shifts[strand].loop_vertex;
    }
  });
}

}  // namespace seedmesh

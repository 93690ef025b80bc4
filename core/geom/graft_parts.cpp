#include <algorithm>
#include <functional>
#include <iterator>

#include "core/base/parallel.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// Trees of fewer joints take less time than another thread to wake, and those of more have better uses for
// memory than to be written twice.
constexpr std::size_t least_joints = 128, most_joints = std::size_t{1} << 18U;
constexpr std::size_t most_parts = 8;
// No joint has more triangles, and no triangle takes more bytes while it is made.
constexpr std::uint64_t most_triangles_a_joint = 256, most_bytes_a_triangle = 64;
// What parts write only to know where they begin: at most so much of the tree.
constexpr std::size_t most_twice = 4;  // a quarter
constexpr std::uint64_t spent_at_once = 4096;

template <class T>
void append(Array<T>& to, std::size_t at, const Array<T>& from, std::size_t count) {
  if (count > 0) std::copy_n(from.data(), count, to.data() + at);
}

}  // namespace

/// Limbs behind the first that follow each other, as many parts as there are threads. `before`: the limbs of
/// earlier parts that limbs of a part grow from, and what these grow from but for the first limb, which a
/// part writes for the sake of their loops. Trees whose stems are written one after the other, each with all
/// that grows from it, have few of these.
struct GraftWriter::Parts {
  std::vector<std::uint32_t> first;  ///< of each part, and the end
  std::vector<std::vector<std::uint32_t>> before;
  std::size_t count() const { return before.size(); }
};

bool GraftWriter::is_worth_parting() const {
  const std::size_t joints = context_.limbs.size();
  if (!has_threads(job_) || joints < least_joints || joints > most_joints || context_.options.drawn)
    return false;
  const std::uint64_t triangles = most_triangles_a_joint * joints;
  const std::uint64_t left = job_.limits().triangles - job_.spent(Resource::triangles);
  return triangles < left && most_bytes_a_triangle * triangles < job_.limits().memory_bytes / 2;
}

/// None where it is not worth while.
GraftWriter::Parts GraftWriter::find_parts() const {
  const Array<std::uint32_t>& head = context_.chains.head;
  const std::size_t wanted = std::min<std::size_t>(most_parts, static_cast<std::size_t>(job_.threads()));
  const std::size_t joints = context_.limbs.size(), trunk = head.size() > 1 ? head[1] : joints;
  Parts parts;
  for (std::size_t i = 0; i <= wanted; ++i) {
    const std::uint32_t* first =
        std::lower_bound(head.begin(), head.end(), trunk + (joints - trunk) * i / wanted);
    parts.first.push_back(i == wanted ? static_cast<std::uint32_t>(head.size())
                                      : static_cast<std::uint32_t>(first - head.begin()));
  }
  const std::vector<std::uint32_t> parents = find_parents();
  std::vector<std::uint32_t> needed_by(head.size(), none);
  std::size_t twice = 0;
  for (std::uint32_t part = 0; part < wanted; ++part) {
    std::vector<std::uint32_t>& before = parts.before.emplace_back();
    for (std::uint32_t limb = parts.first[part]; limb < parts.first[part + 1]; ++limb) {
      for (std::uint32_t at = parents[limb];
           at != none && at > 0 && at < parts.first[part] && needed_by[at] != part; at = parents[at]) {
        needed_by[at] = part;
        before.push_back(at);
        for (std::uint32_t joint = head[at]; joint != none; joint = context_.chains.next[joint]) ++twice;
      }
    }
    std::sort(before.begin(), before.end());
  }
  return twice * most_twice > joints ? Parts{} : parts;
}

/// The first round on all threads; false: nothing is written. The result is that of one thread.
bool GraftWriter::write_parts() {
  if (!is_worth_parting()) return false;
  const Parts parts = find_parts();
  if (parts.count() < 2) return false;
  write_anew(0);  // the trunk, which all need
  std::vector<std::unique_ptr<GraftWriter>> others(parts.count());
  for (std::size_t i = 1; i < others.size(); ++i) {
    const std::size_t joints = context_.limbs.size() / parts.count();
    others[i].reset(new GraftWriter(context_, common_, joints, job_));
    others[i]->is_part_ = true;
    others[i]->know_loops_of(*this);
  }
  parallel_for(job_, parts.count(), 1, [&](std::size_t, std::size_t, std::size_t number) {
    GraftWriter& writer = number == 0 ? *this : *others[number];
    writer.write_part(parts, number);
  });
  for (std::size_t i = 1; i < parts.count(); ++i) {
    take_part(*others[i], parts.first[i], parts.first[i + 1]);
    others[i] = nullptr;
  }
  return true;
}

/// As if the limbs that another has written were written here.
void GraftWriter::know_loops_of(const GraftWriter& other) {
  loop_vertices_.append(other.loop_vertices_.span());
  group_normal_.append(other.group_normal_.span());
  group_limb_ = other.group_limb_;
  for (const std::uint32_t limb : group_limb_) loops_[limb] = other.loops_[limb];
}

void GraftWriter::write_part(const Parts& parts, std::size_t number) {
  if (is_part_) {
    for (const std::uint32_t limb : parts.before[number]) write_anew(limb);
    vertices_ = corners_ = wide_corners_ = made_ = 0;
    mesh_.index.wide.clear();
    colors_.clear();
    loop_triangles_.clear();
    rib_seams_.clear();
    first_group_ = static_cast<std::uint32_t>(group_normal_.size());
    first_loop_vertex_ = static_cast<std::uint32_t>(loop_vertices_.size());
  }
  for (std::uint32_t limb = parts.first[number]; limb < parts.first[number + 1]; ++limb) {
    if (limb % 64 == 0) job_.check();
    write_anew(limb);
  }
}

/// What another has written of the limbs `first` to `last - 1`, as if it were written here.
void GraftWriter::take_part(const GraftWriter& part, std::uint32_t first, std::uint32_t last) {
  for (std::uint64_t left = part.made_; left > 0;) {  // as small amounts, which leave no more of a lease
    const std::uint64_t now = std::min(left, spent_at_once);
    spend_triangles(now);
    left -= now;
  }
  const Place at = here();
  const std::uint32_t group = at.group - part.first_group_;
  for (std::uint32_t limb = first; limb < last; ++limb) {
    const Range& from = part.range_[limb];
    const auto moved = [&](const Place& place) -> Place {
      return {place.vertex + at.vertex,   place.triangle + at.triangle,
              place.group + group,        place.loop_triangle + at.loop_triangle,
              place.corners + at.corners, place.wide_corners + at.wide_corners};
    };
    range_[limb] = {moved(from.begin), moved(from.end), from.first_end + at.triangle};
    kind_[limb] = part.kind_[limb];
  }
  for (const std::uint32_t triangle : part.loop_triangles_) loop_triangles_.push_back(triangle + at.triangle);
  for (const auto& [begin, end] : part.rib_seams_)
    rib_seams_.emplace_back(begin + at.vertex, end + at.vertex);
  corners_ += part.corners_;
  wide_corners_ += part.wide_corners_;
  take_vertices(part);
  take_loops(part, first, last);
}

void GraftWriter::take_vertices(const GraftWriter& part) {
  const std::size_t count = part.vertices_;
  const auto shift = static_cast<std::uint32_t>(vertices_);
  make_room_for(count);
  const Array<std::uint32_t>& index = part.mesh_.index.wide;
  std::uint32_t* to = mesh_.index.wide.extend(index.size());
  // Those of groups of the part's own; others are not known here by their numbers.
  const std::uint32_t groups = static_cast<std::uint32_t>(group_normal_.size()) - part.first_group_;
  const std::function<void()> tasks[] = {
      [&] { append(mesh_.position, vertices_, part.mesh_.position, count); },
      [&] { append(mesh_.normal, vertices_, part.mesh_.normal, count); },
      [&] {
        if (has_tangents()) append(mesh_.tangent, vertices_, part.mesh_.tangent, count);
      },
      [&] { append(mesh_.uv[0], vertices_, part.mesh_.uv[0], count); },
      [&] {
        append(twin_, vertices_, part.twin_, count);
        if (context_.options.joints) append(joints_, vertices_, part.joints_, count);
      },
      [&] {
        for (std::size_t i = 0; i < count; ++i) {
          const std::uint32_t group = part.group_[i];
          group_[vertices_ + i] = group != none && group >= part.first_group_ ? group + groups : group;
        }
      },
      [&] {
        for (std::size_t i = 0; i < index.size(); ++i) to[i] = index[i] + shift;
      },
  };
  parallel_for(job_, std::size(tasks), 1, [&](std::size_t i, std::size_t, std::size_t) { tasks[i](); });
  vertices_ += count;
  colors_.append(part.colors_.span());
}

/// Their groups of normals too.
void GraftWriter::take_loops(const GraftWriter& part, std::uint32_t first, std::uint32_t last) {
  const auto vertices = static_cast<std::uint32_t>(loop_vertices_.size()) - part.first_loop_vertex_;
  const auto groups = static_cast<std::uint32_t>(group_normal_.size()) - part.first_group_;
  for (std::size_t pair = part.first_group_ / 2; pair < part.group_limb_.size(); ++pair) {
    const std::uint32_t limb = part.group_limb_[pair];  // of this part or a later one
    loops_[limb] = part.loops_[limb];
    loops_[limb].first += vertices;
  }
  for (std::uint32_t limb = first; limb < last; ++limb) {
    const Loop& loop = part.loops_[limb];
    const std::uint32_t begin = range_[limb].begin.vertex;
    if (loop.first >= part.first_loop_vertex_ || begin == range_[limb].end.vertex) continue;
    // The loop of a parent that was written here as well, with other groups.
    const std::uint32_t there = part.loop_vertices_[loop.first].group;
    const std::uint32_t here = loop_vertices_[loops_[limb].first].group;
    for (std::uint32_t i = begin; i <= begin + loop.count; ++i) group_[i] = group_[i] - there + here;
  }
  for (std::size_t i = part.first_loop_vertex_; i < part.loop_vertices_.size(); ++i) {
    loop_vertices_.push_back(part.loop_vertices_[i]);
    loop_vertices_.back().group += groups;
  }
  for (std::size_t group = part.first_group_; group < part.group_normal_.size(); ++group)
    group_normal_.push_back({});
  group_limb_.insert(group_limb_.end(),
                     part.group_limb_.begin() + static_cast<std::ptrdiff_t>(part.first_group_ / 2),
                     part.group_limb_.end());
}

/// Those of a part are spent when it is taken.
void GraftWriter::spend_triangles(std::uint64_t count) {
  if (is_part_) {
    made_ += count;
  } else {
    triangles_.spend(count);
  }
}

}  // namespace seedmesh

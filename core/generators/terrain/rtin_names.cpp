#include "core/generators/terrain/rtin_names.h"

#include <cassert>

#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

constexpr std::uint32_t unnamed = 0xFFFFFFFFU;

/// Calls visit(sample) from one end of an edge to the other end, which is not visited.
template <class Visit>
void each_sample(std::uint32_t from, std::uint32_t to, std::int32_t stride, const Visit& visit) {
  const GridPoint start = grid_point_of(from, stride), end = grid_point_of(to, stride);
  const std::int32_t count = std::max(std::abs(end.x - start.x), std::abs(end.z - start.z));
  const std::int64_t step = (std::int64_t{to} - from) / count;
  std::int64_t sample = from;
  for (std::int32_t i = 0; i < count; ++i, sample += step) visit(static_cast<std::uint32_t>(sample));
}

constexpr std::uint32_t is_shared = 0x80000000U;  // bit of a name: the rest is an index of the shared samples

/// A sample on the border of parts: the part that numbers it, and its number there.
struct Shared {
  std::uint32_t part, name;
};

/// A sample on the path down the hierarchy. The triangles around it share its number.
struct Corner {
  std::uint32_t sample, name = unnamed;
};

struct PartWriter {
  std::uint32_t* names;
  Shared* shared;
  const float* errors;
  float threshold;
  std::uint32_t part;
  std::uint32_t* out;   ///< end of the triangles written so far
  std::uint32_t* used;  ///< the samples that this part numbers
  std::uint32_t count = 0;

  void write(Corner& a, Corner& b, Corner& c, int level) {
    if (level > 0) {
      Corner middle{(a.sample + b.sample) / 2};
      if (errors[middle.sample] > threshold) {
        write(c, a, middle, level - 1);
        write(b, c, middle, level - 1);
        return;
      }
    }
    name(a);
    name(c);
    name(b);
    out[0] = a.name;
    out[1] = b.name;
    out[2] = c.name;
    out += 3;
  }

  void name(Corner& corner) {
    if (corner.name == unnamed) corner.name = found(corner.sample);
  }

  std::uint32_t found(std::uint32_t sample) {
    std::uint32_t& known = names[sample];
    if ((known & is_shared) == 0) return known;
    if (known == unnamed) return known = add(sample);
    Shared& position = shared[known & ~is_shared];
    if (position.part != part) return known;
    if (position.name == unnamed) position.name = add(sample);
    return position.name;
  }

  std::uint32_t add(std::uint32_t sample) {
    used[count] = sample;
    return count++;
  }
};

/// Every part numbers its samples from 0. The counts of the parts before are added at the end. A sample on the
/// border of parts belongs to the first of them, which uses it if any of them does.
class Naming {
 public:
  Naming(std::span<const RtinTriangle> parts, const RtinErrors& errors, float threshold, const Job& job)
      : parts_(parts),
        errors_(errors),
        threshold_(threshold),
        job_(job),
        names_(job, static_cast<std::size_t>(errors.side()) * static_cast<std::size_t>(errors.stride()),
               unnamed),
        shared_(job),
        first_(parts.size() + 1),
        own_(parts.size()),
        used_(job) {}

  Triangulation run() {
    each_part(
        [&](std::size_t part) { first_[part + 1] = count_triangles(errors_, threshold_, parts_[part]); });
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      first_[part + 1] += first_[part];
      share_border(part);
    }
    Triangulation mesh{Array<std::uint32_t>(job_), Array<std::uint32_t>(job_, 3 * first_.back())};
    used_.resize(first_.back() + 2 * parts_.size());
    each_part([&](std::size_t part) { write(part, mesh.index.data() + 3 * first_[part]); });
    std::size_t count = 0;
    for (Own& own : own_) {
      own.before = static_cast<std::uint32_t>(count);
      count += own.count;
    }
    mesh.samples.resize(count);
    each_part([&](std::size_t part) { join(part, mesh); });
    return mesh;
  }

 private:
  struct Own {
    std::uint32_t count = 0, before = 0;
  };

  template <class Body>
  void each_part(const Body& body) {
    parallel_for(job_, parts_.size(), 1, [&](std::size_t part, std::size_t, std::size_t) {
      job_.check();
      body(part);
    });
  }

  void share_border(std::size_t part) {
    const RtinTriangle& half = parts_[part];
    share_edge(half.a, half.b, part);
    share_edge(half.b, half.c, part);
    share_edge(half.c, half.a, part);
  }

  void share_edge(std::uint32_t from, std::uint32_t to, std::size_t part) {
    each_sample(from, to, errors_.stride(), [&](std::uint32_t sample) {
      std::uint32_t& name = names_[sample];
      if (name != unnamed) return;
      name = is_shared | static_cast<std::uint32_t>(shared_.size());
      shared_.push_back({static_cast<std::uint32_t>(part), unnamed});
    });
  }

  /// Returns the samples of a part. A polygon of n triangles has at most n + 2 corners.
  std::uint32_t* used(std::size_t part) { return used_.data() + first_[part] + 2 * part; }

  /// Writes the part's own numbers, and the indices of shared samples.
  void write(std::size_t part, std::uint32_t* out) {
    PartWriter writer{
        names_.data(), shared_.data(), errors_.data(), threshold_, static_cast<std::uint32_t>(part),
        out,           used(part)};
    const RtinTriangle& root = parts_[part];
    Corner a{root.a}, b{root.b}, c{root.c};
    writer.write(a, b, c, root.level);
    own_[part].count = writer.count;
  }

  void join(std::size_t part, Triangulation& mesh) {
    const Own own = own_[part];
    const auto stride = static_cast<std::uint32_t>(errors_.stride());
    const std::uint32_t margin = stride - static_cast<std::uint32_t>(errors_.side());
    const std::uint32_t* list = used(part);
    for (std::uint32_t i = 0; i < own.count; ++i)
      mesh.samples[own.before + i] = list[i] - list[i] / stride * margin;
    std::uint32_t* const end = mesh.index.data() + 3 * first_[part + 1];
    for (std::uint32_t* at = mesh.index.data() + 3 * first_[part]; at != end; ++at) {
      if ((*at & is_shared) == 0) {
        *at += own.before;
      } else {
        const Shared& shared = shared_[*at & ~is_shared];
        assert(shared.name != unnamed);
        *at = shared.name + own_[shared.part].before;
      }
    }
  }

  std::span<const RtinTriangle> parts_;
  const RtinErrors& errors_;
  float threshold_;
  const Job& job_;
  Array<std::uint32_t> names_;  ///< of each sample
  Array<Shared> shared_;
  std::vector<std::size_t> first_;  ///< triangle of each part
  std::vector<Own> own_;            ///< samples of each part
  Array<std::uint32_t> used_;       ///< samples of all parts, with capacity for the maximum of each
};

}  // namespace

std::size_t count_triangles(const RtinErrors& errors, float threshold, const RtinTriangle& root) {
  const std::int32_t stride = errors.stride();
  std::size_t all = 0, edges = 0;
  each_row_inside(corners_of(root, stride), [&](std::int32_t z, std::int32_t first, std::int32_t last) {
    const float* row = errors.row(z);
    std::uint32_t count = 0;
    for (std::int32_t x = first; x <= last; ++x) count += row[x] > threshold ? 1U : 0U;
    all += count;
  });
  const auto in_mesh = [&](std::uint32_t sample) { return errors.data()[sample] > threshold ? 1U : 0U; };
  const auto count_edge = [&](std::uint32_t sample) { edges += in_mesh(sample); };
  each_sample(root.a, root.b, stride, count_edge);
  each_sample(root.b, root.c, stride, count_edge);
  each_sample(root.c, root.a, stride, count_edge);
  // A corner was counted both inside and on an edge. The triangles that it split are outside.
  return 1 + 2 * all - edges - in_mesh(root.a) - in_mesh(root.b) - in_mesh(root.c);
}

Triangulation named(std::span<const RtinTriangle> parts, const RtinErrors& errors, float threshold,
                    const Job& job) {
  return Naming(parts, errors, threshold, job).run();
}

}  // namespace seedmesh::terrain

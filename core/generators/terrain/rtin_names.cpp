#include "core/generators/terrain/rtin_names.h"

#include <cassert>
#include <cstring>

#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

constexpr std::uint32_t unnamed = 0xFFFFFFFFU;

/// visit(sample) from one end of an edge up to the other, which is left out.
template <class Visit>
void each_sample(std::uint32_t from, std::uint32_t to, std::int32_t side, const Visit& visit) {
  const Place start = place_of(from, side), end = place_of(to, side);
  const std::int32_t count = std::max(std::abs(end.x - start.x), std::abs(end.z - start.z));
  const std::int64_t step = (std::int64_t{to} - from) / count;
  std::int64_t sample = from;
  for (std::int32_t i = 0; i < count; ++i, sample += step) visit(static_cast<std::uint32_t>(sample));
}

/// Every part names its samples from 0 on; what other parts named before is added when all are done. A sample
/// on the border of parts belongs to the first of them, which uses it if any does.
class Naming {
 public:
  Naming(std::span<const Half> parts, const float* errors, float threshold, std::int32_t side, const Job& job)
      : parts_(parts),
        errors_(errors),
        threshold_(threshold),
        side_(side),
        job_(job),
        names_(job, static_cast<std::size_t>(side) * static_cast<std::size_t>(side), unnamed),
        shared_(job),
        first_(parts.size() + 1),
        own_(parts.size()),
        used_(job) {}

  Triangulation run() {
    each_part(
        [&](std::size_t part) { first_[part + 1] = count_whole(errors_, threshold_, parts_[part], side_); });
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
  /// In names_: the rest is a place in shared_.
  static constexpr std::uint32_t is_shared = 0x80000000U;
  struct Shared {
    std::uint32_t part, name;
  };
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
    const Half& half = parts_[part];
    share_edge(half.a, half.b, part);
    share_edge(half.b, half.c, part);
    share_edge(half.c, half.a, part);
  }

  void share_edge(std::uint32_t from, std::uint32_t to, std::size_t part) {
    each_sample(from, to, side_, [&](std::uint32_t sample) {
      std::uint32_t& name = names_[sample];
      if (name != unnamed) return;
      name = is_shared | static_cast<std::uint32_t>(shared_.size());
      shared_.push_back({static_cast<std::uint32_t>(part), unnamed});
    });
  }

  /// A polygon of n triangles has n + 2 corners at most.
  std::uint32_t* used(std::size_t part) { return used_.data() + first_[part] + 2 * part; }

  /// Writes the part's own names, and of samples of others where their names will be found.
  void write(std::size_t part, std::uint32_t* out) {
    std::uint32_t* const names = names_.data();
    std::uint32_t* const list = used(part);
    std::uint32_t count = 0;
    const auto add = [&](std::uint32_t sample) {
      list[count] = sample;
      return count++;
    };
    const auto name = [&](std::uint32_t sample) {
      std::uint32_t& known = names[sample];
      if ((known & is_shared) == 0) return known;
      if (known == unnamed) return known = add(sample);
      Shared& shared = shared_[known & ~is_shared];
      if (shared.part != part) return std::uint32_t{known};
      if (shared.name == unnamed) shared.name = add(sample);
      return shared.name;
    };
    each_whole(errors_, threshold_, parts_[part], [&](const Half& half, float) {
      out[0] = name(half.a);
      out[2] = name(half.c);
      out[1] = name(half.b);
      out += 3;
    });
    own_[part].count = count;
  }

  void join(std::size_t part, Triangulation& mesh) {
    const Own own = own_[part];
    if (own.count > 0)
      std::memcpy(mesh.samples.data() + own.before, used(part), own.count * sizeof(std::uint32_t));
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

  std::span<const Half> parts_;
  const float* errors_;
  float threshold_;
  std::int32_t side_;
  const Job& job_;
  Array<std::uint32_t> names_;  ///< by sample
  Array<Shared> shared_;
  std::vector<std::size_t> first_;  ///< triangle of each part
  std::vector<Own> own_;            ///< samples of each part
  Array<std::uint32_t> used_;       ///< samples of all parts, each with room for as many as it may have
};

}  // namespace

std::size_t count_whole(const float* errors, float threshold, const Half& root, std::int32_t side) {
  std::size_t all = 0, edges = 0;
  each_row_inside(places_of(root, side), [&](std::int32_t z, std::int32_t first, std::int32_t last) {
    const float* row = errors + static_cast<std::size_t>(z) * static_cast<std::size_t>(side);
    std::uint32_t count = 0;
    for (std::int32_t x = first; x <= last; ++x) count += row[x] > threshold ? 1U : 0U;
    all += count;
  });
  const auto in_mesh = [&](std::uint32_t sample) { return errors[sample] > threshold ? 1U : 0U; };
  const auto count_edge = [&](std::uint32_t sample) { edges += in_mesh(sample); };
  each_sample(root.a, root.b, side, count_edge);
  each_sample(root.b, root.c, side, count_edge);
  each_sample(root.c, root.a, side, count_edge);
  // A corner was counted both inside and on an edge; what it halved lies outside.
  return 1 + 2 * all - edges - in_mesh(root.a) - in_mesh(root.b) - in_mesh(root.c);
}

Triangulation named(std::span<const Half> parts, const float* errors, float threshold, std::int32_t side,
                    const Job& job) {
  return Naming(parts, errors, threshold, side, job).run();
}

}  // namespace seedmesh::terrain

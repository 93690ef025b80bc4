#include "core/generators/terrain/rtin_names.h"

#include <cassert>
#include <cstring>

#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

constexpr std::uint32_t unnamed = 0xFFFFFFFFU;

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
    each_part([&](std::size_t part) {
      std::size_t count = 0;
      each_whole(errors_, threshold_, parts_[part], [&](const Half&, float) { ++count; });
      first_[part + 1] = count;
    });
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
    const Place start = place_of(from, side_), end = place_of(to, side_);
    const std::int32_t count = std::max(std::abs(end.x - start.x), std::abs(end.z - start.z));
    const std::int64_t step = (std::int64_t{to} - from) / count;
    std::int64_t sample = from;
    for (std::int32_t i = 0; i < count; ++i, sample += step) {
      std::uint32_t& name = names_[static_cast<std::size_t>(sample)];
      if (name != unnamed) continue;
      name = is_shared | static_cast<std::uint32_t>(shared_.size());
      shared_.push_back({static_cast<std::uint32_t>(part), unnamed});
    }
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

Triangulation named(std::span<const Half> parts, const float* errors, float threshold, std::int32_t side,
                    const Job& job) {
  return Naming(parts, errors, threshold, side, job).run();
}

}  // namespace seedmesh::terrain

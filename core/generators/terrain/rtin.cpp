#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/generators/terrain/rtin_errors.h"
#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t triangles_a_chunk = 4096;
constexpr std::uint32_t unnamed = 0xFFFFFFFFU;

/// A triangle of the hierarchy: its long side is a-b and its right angle at c, clockwise seen from above.
/// Fields have at most 16,385 samples a side.
struct Half {
  std::int16_t ax, az, bx, bz, cx, cz;

  static Half of(Place a, Place b, Place c) {
    const auto narrow = [](std::int32_t i) { return static_cast<std::int16_t>(i); };
    return {narrow(a.x), narrow(a.z), narrow(b.x), narrow(b.z), narrow(c.x), narrow(c.z)};
  }
  Place a() const { return {ax, az}; }
  Place b() const { return {bx, bz}; }
  Place c() const { return {cx, cz}; }
};

/// How far a sample that comes with a halving of this level inside a triangle can be off the triangle, in
/// errors of its middle. It is off the line between two earlier samples by one error at most: the apex of
/// the level before last, and an end of a long side that is older still.
constexpr std::size_t most_levels = 32;
constexpr std::array<float, most_levels> farthest_by_level() {
  std::array<float, most_levels> all{};
  for (std::size_t i = 1; i < most_levels; ++i)
    all[i] = 1 + ((i > 2 ? all[i - 2] : 0) + (i > 3 ? all[i - 3] : 0)) / 2;
  return all;
}
constexpr std::array<float, most_levels> farthest = farthest_by_level();

Place middle_of(Place a, Place b) { return {(a.x + b.x) / 2, (a.z + b.z) / 2}; }

/// The triangles that are left whole, in the order of the hierarchy, and which of them nobody has looked at.
/// They are kept in parts, the subtrees of one depth, so that all threads can work on them.
class Leaves {
 public:
  struct Part {
    Array<Half> halves;
    Array<std::uint8_t> fresh;  ///< of each: 1 where samples inside are still to be compared
  };

  Leaves(const Field& field, RtinErrors& errors, double max_error, Job& job)
      : field_(field),
        errors_(errors),
        max_error_(max_error),
        threshold_(static_cast<float>(max_error)),
        rounding_(rounding_of(range_of(field, job), threshold_)),
        job_(job),
        meter_(job, Resource::triangles) {
    const std::int32_t last = field.width - 1;
    std::vector<Half> roots;
    plant({0, 0}, {last, last}, {last, 0}, depth_of_parts, roots);
    plant({last, last}, {0, 0}, {0, last}, depth_of_parts, roots);
    for (std::size_t i = 0; i < roots.size(); ++i)
      parts_.push_back({Array<Half>(job), Array<std::uint8_t>(job)});
    each_part([&](Part& part, std::size_t i) { descend(roots[i], part); });
    meter_.spend(count());
  }

  /// Divides until no sample is off its triangle by more than the bound: what is off is put into the mesh and
  /// the triangles that this divides are looked at anew.
  void settle() {
    while (need_what_is_off()) divide();
  }

  const std::vector<Part>& parts() const { return parts_; }
  std::size_t count() const {
    std::size_t sum = 0;
    for (const Part& part : parts_) sum += part.halves.size();
    return sum;
  }

 private:
  static constexpr int depth_of_parts = 7;

  template <class Body>
  void each_part(const Body& body) {
    parallel_for(job_, parts_.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
      job_.check();
      body(parts_[i], i);
    });
  }

  static bool divisible(Place a, Place c) { return std::abs(a.x - c.x) + std::abs(a.z - c.z) > 1; }
  bool divided(Place a, Place b, Place c) const {
    const Place middle = middle_of(a, b);
    return divisible(a, c) && errors_.at(middle.x, middle.z) > threshold_;
  }

  /// The triangles so deep in the hierarchy, or the leaves above.
  void plant(Place a, Place b, Place c, int depth, std::vector<Half>& out) const {
    if (depth == 0 || !divided(a, b, c)) {
      out.push_back(Half::of(a, b, c));
      return;
    }
    const Place middle = middle_of(a, b);
    plant(c, a, middle, depth - 1, out);
    plant(b, c, middle, depth - 1, out);
  }

  /// How far the rounding of heights and errors may carry an error, generously.
  static float rounding_of(const Range& range, float threshold) {
    return (std::max(std::abs(range.low), std::abs(range.high)) * 2 + threshold) * 0x1p-21F;
  }

  void descend(const Half& half, Part& out) const {
    const Place a = half.a(), b = half.b(), c = half.c();
    const auto area = static_cast<std::uint64_t>(std::abs(turn(a, c, b)));  // a power of two
    descend(a, b, c, std::countr_zero(area), out);
  }

  /// `level`: how often the triangle can be halved. Where the bound on what lies inside is small enough
  /// nobody has to look.
  void descend(Place a, Place b, Place c, int level, Part& out) const {
    float error = 0;
    if (level > 0) {
      const Place middle = middle_of(a, b);
      error = errors_.at(middle.x, middle.z);
      if (error > threshold_) {
        descend(c, a, middle, level - 1, out);
        descend(b, c, middle, level - 1, out);
        return;
      }
    }
    out.halves.push_back(Half::of(a, b, c));
    const bool doubtful =
        level > 0 && farthest[static_cast<std::size_t>(level)] * (error + rounding_) >= threshold_;
    out.fresh.push_back(doubtful ? 1 : 0);
  }

  bool need_what_is_off() {
    std::vector<std::vector<Place>> off(parts_.size());
    each_part([&](Part& part, std::size_t number) {
      for (std::size_t i = 0; i < part.halves.size(); ++i) {
        if (part.fresh[i] != 0) look(part.halves[i], off[number]);
        part.fresh[i] = 0;
      }
    });
    bool found = false;
    for (const std::vector<Place>& places : off) {
      for (const Place at : places) {
        if (errors_.at(at.x, at.z) == RtinErrors::needed) continue;  // a corner, off by rounding alone
        errors_.need(at);
        found = true;
      }
    }
    return found;
  }

  void divide() {
    const std::size_t before = count();
    each_part([&](Part& part, std::size_t) { divide(part); });
    meter_.spend(count() - before);
    errors_.forget_touched();
  }

  bool newly_divided(const Half& half) const {
    const Place middle = middle_of(half.a(), half.b());
    return errors_.touched(middle.x, middle.z) && divided(half.a(), half.b(), half.c());
  }

  /// What is still whole was looked at before.
  void divide(Part& part) const {
    const auto changed = [&](const Half& half) { return newly_divided(half); };
    const Half* next = std::find_if(part.halves.begin(), part.halves.end(), changed);
    if (next == part.halves.end()) return;
    const Array<Half> before = std::exchange(part.halves, part.halves.like<Half>());
    part.halves.reserve(before.size() + before.size() / 4);
    part.fresh.clear();
    part.fresh.reserve(before.size() + before.size() / 4);
    for (const Half* from = before.begin();;) {
      const auto whole = static_cast<std::size_t>(next - from);
      part.halves.append({from, whole});
      std::fill_n(part.fresh.extend(whole), whole, std::uint8_t{0});
      if (next == before.end()) return;
      descend(*next, part);
      from = next + 1;
      next = std::find_if(from, before.end(), changed);
    }
  }

  void look(const Half& half, std::vector<Place>& off) const {
    const auto height = [&](Place at) { return static_cast<double>(field_.at(at.x, at.z)); };
    const Place a = half.a(), b = half.b(), c = half.c();
    if (std::abs(turn(a, c, b)) == 2) {  // one sample that is no corner
      const Place middle = middle_of(a, b);
      if (std::abs((height(a) + height(b)) / 2 - height(middle)) > max_error_) off.push_back(middle);
      return;
    }
    const Plane plane = Plane::through(a, b, c, height(a), height(b), height(c));
    each_row_inside(a, b, c, [&](std::int32_t z, std::int32_t first, std::int32_t last) {
      const float* row = field_.row(z);
      const double start = plane.base + plane.south * z;
      if (worst_of_row(row, start, plane.east, first, last) <= max_error_) return;
      for (std::int32_t x = first; x <= last; ++x) {
        if (std::abs(static_cast<double>(row[x]) - (start + plane.east * x)) > max_error_)
          off.push_back({x, z});
      }
    });
  }

  const Field& field_;
  RtinErrors& errors_;
  double max_error_;
  float threshold_, rounding_;
  Job& job_;
  Meter meter_;
  std::vector<Part> parts_;
};

/// Names the samples by their first use.
Triangulation named(const Leaves& leaves, const Field& field, const Job& job) {
  Array<std::uint32_t> names(job, field.heights.size(), unnamed);
  const std::size_t count = leaves.count();
  Triangulation mesh{Array<std::uint32_t>(job), Array<std::uint32_t>(job)};
  mesh.index = Array<std::uint32_t>(job, 3 * count);
  mesh.samples.reserve(count / 2 + count / 8);
  const auto name = [&](Place at) {
    const auto sample = static_cast<std::uint32_t>(at.z * field.width + at.x);
    if (names[sample] == unnamed) {
      names[sample] = static_cast<std::uint32_t>(mesh.samples.size());
      mesh.samples.push_back(sample);
    }
    return names[sample];
  };
  std::uint32_t* index = mesh.index.data();
  for (const Leaves::Part& part : leaves.parts()) {
    job.check();
    for (const Half& half : part.halves) {
      const Place a = half.a(), b = half.b(), c = half.c();
      index[0] = name(a);
      index[1] = name(c);
      index[2] = name(b);
      if (turn(a, c, b) < 0) std::swap(index[1], index[2]);
      index += 3;
    }
  }
  mesh.samples.shrink_to_fit();
  return mesh;
}

}  // namespace

bool fits_rtin(std::int32_t width, std::int32_t depth) {
  return width == depth && width >= 2 && ((width - 1) & (width - 2)) == 0;
}

Triangulation rtin(const Field& field, double max_error, Border border, Job& job) {
  RtinErrors errors(field, job);
  const std::int32_t last = field.width - 1;
  if (border == Border::whole) {
    for (std::int32_t i = 0; i <= last; ++i) {
      for (const Place at : {Place{i, 0}, Place{i, last}, Place{0, i}, Place{last, i}}) errors.need(at);
    }
  }
  Leaves leaves(field, errors, max_error, job);
  leaves.settle();
  return named(leaves, field, job);
}

double measured_error(const Field& field, const Triangulation& mesh, const Job& job) {
  std::vector<double> worst(chunk_count(mesh.index.size() / 3, triangles_a_chunk), 0.0);
  parallel_for(job, mesh.index.size() / 3, triangles_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                 job.check();
                 for (std::size_t t = begin; t < end; ++t) {
                   const auto corner = [&](std::size_t k) {
                     return place_of(mesh.samples[mesh.index[3 * t + k]], field.width);
                   };
                   const auto height = [&](Place at) { return static_cast<double>(field.at(at.x, at.z)); };
                   const Place a = corner(0), b = corner(1), c = corner(2);
                   if (turn(a, b, c) <= 1) continue;  // corners alone
                   const Plane plane = Plane::through(a, b, c, height(a), height(b), height(c));
                   each_row_inside(a, b, c, [&](std::int32_t z, std::int32_t first, std::int32_t last) {
                     const double off =
                         worst_of_row(field.row(z), plane.base + plane.south * z, plane.east, first, last);
                     worst[chunk] = std::max(worst[chunk], off);
                   });
                 }
               });
  return worst.empty() ? 0 : *std::max_element(worst.begin(), worst.end());
}

}  // namespace seedmesh::terrain

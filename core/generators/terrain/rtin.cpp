#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 64;
constexpr std::size_t triangles_a_chunk = 4096;
constexpr std::uint32_t unnamed = 0xFFFFFFFFU;
constexpr float needed = std::numeric_limits<float>::infinity();

/// Rows of a pass over the samples (first + i * step), in parallel where there are many.
template <class Body>
void each_step(const Job& job, std::int32_t first, std::int32_t last, std::int32_t step, const Body& body) {
  if (last < first) return;
  const auto count = static_cast<std::size_t>((last - first) / step) + 1;
  parallel_for(job, count, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t i = begin; i < end; ++i) body(first + static_cast<std::int32_t>(i) * step);
  });
}

/// For every sample how far off the mesh may be where the triangles that it halves are left whole: of the
/// sample itself and of all below it.
class Errors {
 public:
  Errors(const Field& field, const Job& job)
      : field_(field), job_(job), side_(field.width), errors_(job, field.heights.size(), 0.0F) {
    for (std::int32_t step = 1; step < side_ - 1; step *= 2) {
      sides(step);
      centres(step);
    }
  }

  float at(std::int32_t x, std::int32_t z) const { return errors_[place(x, z)]; }

  /// Puts a sample into every mesh, and with it all whose triangles must be halved before.
  void need(Place sample) {
    std::vector<Place> left{sample};
    while (!left.empty()) {
      const Place at = left.back();
      left.pop_back();
      if (errors_[place(at.x, at.z)] == needed) continue;
      errors_[place(at.x, at.z)] = needed;
      parents(at, left);
    }
  }

 private:
  std::size_t place(std::int32_t x, std::int32_t z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
  }
  float height(std::int32_t x, std::int32_t z) const { return field_.at(x, z); }

  /// Midpoints of the sides of squares of 2 * step: below them are the centres of squares of `step`.
  void sides(std::int32_t step) {
    each_step(job_, 0, side_ - 1, step, [&](std::int32_t z) {
      const bool along = z / step % 2 == 0;  // a side from west to east
      const std::int32_t half = step / 2;
      float* row = errors_.data() + place(0, z);
      const float* here = field_.row(z);
      const auto worst = [&](std::int32_t x, float own) {
        if (half == 0) return own;
        if (z > 0) {
          const float* above = errors_.data() + place(0, z - half);
          if (x > 0) own = std::max(own, above[x - half]);
          if (x < side_ - 1) own = std::max(own, above[x + half]);
        }
        if (z < side_ - 1) {
          const float* below = errors_.data() + place(0, z + half);
          if (x > 0) own = std::max(own, below[x - half]);
          if (x < side_ - 1) own = std::max(own, below[x + half]);
        }
        return own;
      };
      if (along) {
        for (std::int32_t x = step; x < side_; x += 2 * step)
          row[x] = worst(x, std::abs((here[x - step] + here[x + step]) * 0.5F - here[x]));
      } else {
        const float* above = field_.row(z - step);
        const float* below = field_.row(z + step);
        for (std::int32_t x = 0; x < side_; x += 2 * step)
          row[x] = worst(x, std::abs((above[x] + below[x]) * 0.5F - here[x]));
      }
    });
  }

  /// Is the long side of the square around (x, z) that from north-west to south-east?
  static bool runs_south_east(std::int32_t x, std::int32_t z, std::int32_t step) {
    return (x / step / 2 + z / step / 2) % 2 == 0;
  }

  void centres(std::int32_t step) {
    each_step(job_, step, side_ - 1, 2 * step, [&](std::int32_t z) {
      float* row = errors_.data() + place(0, z);
      const float* above = errors_.data() + place(0, z - step);
      const float* below = errors_.data() + place(0, z + step);
      const float* north = field_.row(z - step);
      const float* here = field_.row(z);
      const float* south = field_.row(z + step);
      for (std::int32_t x = step; x < side_; x += 2 * step) {
        const float ends = runs_south_east(x, z, step) ? north[x - step] + south[x + step]
                                                       : north[x + step] + south[x - step];
        const float own = std::abs(ends * 0.5F - here[x]);
        row[x] =
            std::max(std::max(own, std::max(row[x - step], row[x + step])), std::max(above[x], below[x]));
      }
    });
  }

  /// The samples that must be in the mesh before this one can be.
  void parents(Place at, std::vector<Place>& out) const {
    std::int32_t step = 1;
    while (((at.x | at.z) & step) == 0 && step < side_) step *= 2;
    if (step >= side_ - 1) return;  // a corner, which every mesh has
    const auto add = [&](std::int32_t x, std::int32_t z) {
      if (x >= 0 && z >= 0 && x < side_ && z < side_) out.push_back({x, z});
    };
    const bool odd_x = (at.x & step) != 0, odd_z = (at.z & step) != 0;
    if (odd_x && odd_z) {
      // A centre: the corners off its long side, themselves midpoints of sides of squares twice as large.
      if (2 * step >= side_ - 1) return;
      if (runs_south_east(at.x, at.z, step)) {
        add(at.x + step, at.z - step);
        add(at.x - step, at.z + step);
      } else {
        add(at.x - step, at.z - step);
        add(at.x + step, at.z + step);
      }
    } else if (odd_x) {
      add(at.x, at.z - step);
      add(at.x, at.z + step);
    } else {
      add(at.x - step, at.z);
      add(at.x + step, at.z);
    }
  }

  const Field& field_;
  const Job& job_;
  std::int32_t side_;
  Array<float> errors_;
};

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

Place middle_of(Place a, Place b) { return {(a.x + b.x) / 2, (a.z + b.z) / 2}; }

/// The triangles that are left whole, in the order of the hierarchy, and which of them nobody has looked at.
class Leaves {
 public:
  Leaves(const Field& field, Errors& errors, double max_error, Job& job)
      : field_(field),
        errors_(errors),
        max_error_(max_error),
        threshold_(static_cast<float>(max_error)),
        job_(job),
        meter_(job, Resource::triangles),
        halves_(job),
        fresh_(job) {
    const std::int32_t last = field.width - 1;
    descend({0, 0}, {last, last}, {last, 0});
    descend({last, last}, {0, 0}, {0, last});
    meter_.spend(halves_.size());
  }

  /// Divides until no sample is off its triangle by more than the bound: what is off is put into the mesh and
  /// the triangles that this divides are looked at anew.
  void settle() {
    while (need_what_is_off()) divide();
  }

  const Array<Half>& halves() const { return halves_; }

 private:
  void descend(Place a, Place b, Place c) {
    const Place middle = middle_of(a, b);
    const bool divisible = std::abs(a.x - c.x) + std::abs(a.z - c.z) > 1;
    if (divisible && errors_.at(middle.x, middle.z) > threshold_) {
      descend(c, a, middle);
      descend(b, c, middle);
      return;
    }
    halves_.push_back(Half::of(a, b, c));
    fresh_.push_back(divisible ? 1 : 0);
  }

  bool need_what_is_off() {
    std::vector<std::vector<Place>> off(chunk_count(halves_.size(), triangles_a_chunk));
    parallel_for(job_, halves_.size(), triangles_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   job_.check();
                   for (std::size_t i = begin; i < end; ++i) {
                     if (fresh_[i] != 0) look(halves_[i], off[chunk]);
                     fresh_[i] = 0;
                   }
                 });
    bool found = false;
    for (const std::vector<Place>& places : off) {
      for (const Place at : places) {
        if (errors_.at(at.x, at.z) == needed) continue;  // a corner, off by rounding alone
        errors_.need(at);
        found = true;
      }
    }
    return found;
  }

  void divide() {
    const Array<Half> before = std::exchange(halves_, halves_.like<Half>());
    fresh_.clear();
    halves_.reserve(before.size() + before.size() / 8);
    fresh_.reserve(before.size() + before.size() / 8);
    for (const Half& half : before) {
      const std::size_t first = halves_.size();
      descend(half.a(), half.b(), half.c());
      if (halves_.size() == first + 1) fresh_.back() = 0;  // still whole, and looked at before
    }
    meter_.spend(halves_.size() - before.size());
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
  Errors& errors_;
  double max_error_;
  float threshold_;
  Job& job_;
  Meter meter_;
  Array<Half> halves_;
  Array<std::uint8_t> fresh_;  ///< of each: 1 where samples inside are still to be compared
};

/// Names the samples by their first use.
Triangulation named(const Array<Half>& halves, const Field& field, const Job& job) {
  Array<std::uint32_t> names(job, field.heights.size(), unnamed);
  Triangulation mesh{Array<std::uint32_t>(job), Array<std::uint32_t>(job)};
  mesh.index = Array<std::uint32_t>(job, 3 * halves.size());
  mesh.samples.reserve(halves.size() / 2 + halves.size() / 8);
  const auto name = [&](Place at) {
    const auto sample = static_cast<std::uint32_t>(at.z * field.width + at.x);
    if (names[sample] == unnamed) {
      names[sample] = static_cast<std::uint32_t>(mesh.samples.size());
      mesh.samples.push_back(sample);
    }
    return names[sample];
  };
  std::uint32_t* index = mesh.index.data();
  for (const Half& half : halves) {
    const Place a = half.a(), b = half.b(), c = half.c();
    index[0] = name(a);
    index[1] = name(c);
    index[2] = name(b);
    if (turn(a, c, b) < 0) std::swap(index[1], index[2]);
    index += 3;
  }
  mesh.samples.shrink_to_fit();
  return mesh;
}

}  // namespace

bool fits_rtin(std::int32_t width, std::int32_t depth) {
  return width == depth && width >= 2 && ((width - 1) & (width - 2)) == 0;
}

Triangulation rtin(const Field& field, double max_error, Border border, Job& job) {
  Errors errors(field, job);
  const std::int32_t last = field.width - 1;
  if (border == Border::whole) {
    for (std::int32_t i = 0; i <= last; ++i) {
      for (const Place at : {Place{i, 0}, Place{i, last}, Place{0, i}, Place{last, i}}) errors.need(at);
    }
  }
  Leaves leaves(field, errors, max_error, job);
  leaves.settle();
  return named(leaves.halves(), field, job);
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

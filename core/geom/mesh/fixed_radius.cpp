#include "core/geom/mesh/fixed_radius.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/array.h"
#include "core/base/parallel.h"
#include "core/base/wide.h"

namespace seedmesh {
namespace {

// Width of a cell in radii. A point nearer to a border than `margin` cells is in the cells on both sides. The
// margin is one radius, and a half for rounding.
constexpr float cell_width = 160, margin = 1.5F / cell_width;
// With more cells along the diagonal, a float is too coarse for the position of a point in its cell.
constexpr float most_cells = 32'000;
// There are at least 1.5 slots for each point, so that few cells share a slot by their hash.
constexpr std::size_t least_slots = 64, most_slots = std::size_t{1} << 30U;
// A point is compared with at most this number of earlier points of its slot. If there are more, it counts as
// near.
constexpr std::size_t most_in_a_slot = 32;
// With fewer points, one thread is as fast as several.
constexpr std::size_t least_points_to_share = 65'536, most_shares = 8, points_a_chunk = 4096;
// A bit of a slot number: the point is near a border.
constexpr std::uint32_t at_border = 0x80000000U;

/// The exponent of the smallest power of two that is at least `wanted`.
int bits_for(std::size_t wanted) {
  int bits = 0;
  while ((std::size_t{1} << bits) < wanted) ++bits;
  return bits;
}

class Cells {
 public:
  Cells(const glm::vec3& low, float cell, int bits)
      : low_(low), per_cell_(1 / cell), shift_(static_cast<std::uint32_t>(32 - bits)) {}

  glm::vec3 in_cells(const glm::vec3& point) const { return (point - low_) * per_cell_ + 1.0F; }

  /// Below 2^bits, which is at most 2^31.
  std::uint32_t slot(std::int32_t x, std::int32_t y, std::int32_t z) const {
    std::uint32_t hash = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^
                         static_cast<std::uint32_t>(y) * 0x85EBCA77U ^
                         static_cast<std::uint32_t>(z) * 0xC2B2AE3DU;
    hash = (hash ^ hash >> 15U) * 0x2C1B3C6DU;
    hash = (hash ^ hash >> 12U) * 0x297A2D39U;
    return hash >> shift_;
  }

  /// Writes the slot of each point's own cell, with the bit at_border for points near a border.
  void fill(std::span<const glm::vec3> points, std::uint32_t* out) const;

  /// Calls visit(slot) for every cell that is within the margin of `point`.
  template <class Visit>
  void each(const glm::vec3& point, Visit visit) const {
    const glm::vec3 at = in_cells(point);
    const glm::ivec3 low(at - margin), high(at + margin);
    // One bit for each axis along which there are two cells.
    const std::uint32_t two =
        (high.x > low.x ? 1U : 0U) | (high.y > low.y ? 2U : 0U) | (high.z > low.z ? 4U : 0U);
    std::uint32_t each = 0;
    do {
      const std::int32_t x = low.x + static_cast<std::int32_t>(each & 1U),
                         y = low.y + static_cast<std::int32_t>(each >> 1U & 1U),
                         z = low.z + static_cast<std::int32_t>(each >> 2U);
      visit(slot(x, y, z));
      each = (each - two) & two;  // the next number that has only bits of `two`
    } while (each != 0);
  }

 private:
  glm::vec3 low_;
  float per_cell_;
  std::uint32_t shift_;
};

SEEDMESH_WIDE void Cells::fill(std::span<const glm::vec3> points, std::uint32_t* out) const {
  const glm::vec3* point = points.data();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3 at = in_cells(point[i]);
    const auto x = static_cast<std::int32_t>(at.x), y = static_cast<std::int32_t>(at.y),
               z = static_cast<std::int32_t>(at.z);
    const float off = std::max({std::abs(at.x - static_cast<float>(x) - 0.5F),
                                std::abs(at.y - static_cast<float>(y) - 0.5F),
                                std::abs(at.z - static_cast<float>(z) - 0.5F)});
    out[i] = slot(x, y, z) | (off > 0.5F - margin ? at_border : 0U);
  }
}

class Bits {
 public:
  Bits(const Job& job, std::size_t count) : words_(job, count / 64, std::uint64_t{0}) {}
  bool has(std::uint32_t i) const { return (words_[i / 64] >> i % 64 & 1U) != 0; }
  void set(std::uint32_t i) { words_[i / 64] |= std::uint64_t{1} << i % 64; }

 private:
  Array<std::uint64_t> words_;
};

/// A hash table from the slots of cells to linked lists of points: each entry names the entry before it in its
/// slot. Each thread fills a share of the slots.
class Slots {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  /// 2^bits slots.
  Slots(const Cells& cells, int bits, std::span<const glm::vec3> points,
        std::span<const std::uint8_t> is_duplicate, const Job& job)
      : points_(points),
        before_(job, points.size()),
        last_(job, std::size_t{1} << bits, none),
        inside_(job, points.size()) {
    const bool is_shared = has_threads(job) && points_.size() >= least_points_to_share;
    const int share_bits =
        is_shared ? bits_for(std::min<std::size_t>(most_shares, static_cast<std::size_t>(job.threads()))) : 0;
    share_shift_ = static_cast<std::uint32_t>(bits - share_bits);
    collided_.resize(std::size_t{1} << share_bits);
    chunks_.resize(chunk_count(points_.size(), points_a_chunk));
    parallel_for(job, points_.size(), points_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   sort_out(cells, is_duplicate, begin, end, chunks_[chunk]);
                 });
    std::size_t entries = 0;
    for (Chunk& chunk : chunks_) {
      chunk.first = entries;
      entries += chunk.border.size();
    }
    border_.resize(entries);
    before_.resize(points_.size() + entries);
    parallel_for(job, collided_.size(), 1, [&](std::size_t share, std::size_t, std::size_t) {
      for (Chunk& chunk : chunks_) put(chunk, static_cast<std::uint32_t>(share));
    });
  }

  /// The entries whose slot had an entry already, for each share.
  const std::vector<std::vector<std::uint32_t>>& collided() const { return collided_; }
  std::uint32_t before(std::uint32_t number) const { return before_[number]; }
  std::uint32_t point_of(std::uint32_t number) const {
    return number < points_.size() ? number : border_[number - points_.size()];
  }

 private:
  /// One of the cells of a point that is near a border.
  struct Entry {
    std::uint32_t point, slot;
  };
  struct Chunk {
    /// Index of inside_ where each share begins, and the end: points that are neither duplicates nor near a border.
    std::vector<std::size_t> inside;
    std::vector<Entry> border;
    std::size_t first = 0;  ///< index of border_ where the entries of `border` begin
  };

  void sort_out(const Cells& cells, std::span<const std::uint8_t> is_duplicate, std::size_t begin,
                std::size_t end, Chunk& chunk) {
    std::uint32_t* const slot = before_.data();  // put() replaces the slots by the entries before
    cells.fill(points_.subspan(begin, end - begin), slot + begin);
    const auto is_other = [&](std::size_t i) { return (slot[i] & at_border) != 0 || is_duplicate[i] != 0; };
    const auto share_of = [&](std::size_t i) { return (slot[i] & ~at_border) >> share_shift_; };
    chunk.inside.assign(collided_.size() + 1, 0);
    for (std::size_t i = begin; i < end; ++i) chunk.inside[share_of(i) + 1] += is_other(i) ? 0 : 1;
    chunk.inside[0] = begin;
    std::partial_sum(chunk.inside.begin(), chunk.inside.end(), chunk.inside.begin());
    std::vector<std::size_t> at = chunk.inside;
    for (std::size_t i = begin; i < end; ++i) {
      const auto point = static_cast<std::uint32_t>(i);
      if ((slot[i] & at_border) != 0 && !is_duplicate[i])
        cells.each(points_[i], [&](std::uint32_t each) { chunk.border.push_back({point, each}); });
      // Selects instead of branching, because the branch cannot be predicted.
      const bool is_out = is_other(i);
      const std::size_t share = share_of(i);
      std::uint32_t nowhere = 0;
      *(is_out ? &nowhere : &inside_[at[share]]) = point;
      at[share] += is_out ? 0 : 1;
    }
  }

  void put(const Chunk& chunk, std::uint32_t share) {
    std::vector<std::uint32_t>& collided = collided_[share];
    const auto put_one = [&](std::uint32_t number, std::uint32_t slot) {
      const std::uint32_t last = std::exchange(last_[slot], number);
      before_[number] = last;
      return last != none;
    };
    const std::span<const std::uint32_t> inside =
        inside_.span().subspan(chunk.inside[share], chunk.inside[share + 1] - chunk.inside[share]);
    std::size_t count = collided.size();
    collided.resize(count + inside.size() + 1);
    for (const std::uint32_t point : inside) {
      collided[count] = point;
      count += put_one(point, before_[point]) ? 1 : 0;
    }
    collided.resize(count);
    for (std::size_t i = 0; i < chunk.border.size(); ++i) {
      const Entry& entry = chunk.border[i];
      if (entry.slot >> share_shift_ != share) continue;
      border_[chunk.first + i] = entry.point;
      const auto number = static_cast<std::uint32_t>(points_.size() + chunk.first + i);
      if (put_one(number, entry.slot)) collided.push_back(number);
    }
  }

  std::span<const glm::vec3> points_;
  std::uint32_t share_shift_ = 0;
  Array<std::uint32_t> before_, last_, inside_;
  std::vector<std::uint32_t> border_;  ///< the points of entry numbers from points_.size() on
  std::vector<Chunk> chunks_;
  std::vector<std::vector<std::uint32_t>> collided_;
};

/// Test whether two points are at most `radius` apart.
class Radius {
 public:
  explicit Radius(float radius)
      : squared_(static_cast<double>(radius) * static_cast<double>(radius)), doubtful_(2 * radius * radius) {}
  bool joins(const glm::vec3& one, const glm::vec3& other) const {
    const glm::vec3 about = one - other;
    if (glm::dot(about, about) > doubtful_) return false;
    const glm::dvec3 apart = glm::dvec3(one) - glm::dvec3(other);
    return glm::dot(apart, apart) <= squared_;
  }

 private:
  double squared_;
  float doubtful_;
};

}  // namespace

Array<std::uint8_t> near_others(std::span<const glm::vec3> points, std::span<const std::uint8_t> is_duplicate,
                                const Box& box, float radius, const Job& job) {
  Array<std::uint8_t> found(job);
  if (points.empty() || !(radius > 0)) return found;
  const float cell = cell_width * radius;
  if (!(glm::length(box.max - box.min) < most_cells * cell))
    return Array<std::uint8_t>(job, points.size(), std::uint8_t{1});
  const int bits = bits_for(std::clamp(points.size() + points.size() / 2, least_slots, most_slots));
  const Cells cells(box.min, cell, bits);
  const Slots taken(cells, bits, points, is_duplicate, job);
  job.check();
  const Radius within(radius);
  Bits near(job, std::size_t{1} << bits);
  bool any = false;
  const auto mark = [&](std::uint32_t point) {
    any = true;
    cells.each(points[point], [&](std::uint32_t at) { near.set(at); });
  };
  // The points of each share that are near another point.
  std::vector<std::vector<std::uint32_t>> marked(taken.collided().size());
  parallel_for(job, marked.size(), 1, [&](std::size_t share, std::size_t, std::size_t) {
    for (const std::uint32_t number : taken.collided()[share]) {
      const std::uint32_t one = taken.point_of(number);
      std::size_t met = 0;
      std::uint32_t other = taken.before(number);
      for (; other != Slots::none && met < most_in_a_slot; ++met, other = taken.before(other)) {
        const std::uint32_t mate =
            taken.point_of(other);  // the point itself, where two of its cells share a slot
        if (mate == one || !within.joins(points[one], points[mate])) continue;
        marked[share].push_back(one);
        marked[share].push_back(mate);
      }
      if (other != Slots::none)
        marked[share].push_back(one);  // it has more neighbours in the slot than were compared
    }
  });
  for (const std::vector<std::uint32_t>& points_of_share : marked) {
    for (const std::uint32_t point : points_of_share) mark(point);
  }
  if (!any) return found;
  found.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool is_near = false;
    cells.each(points[i], [&](std::uint32_t at) { is_near = is_near || near.has(at); });
    found[i] = is_near ? 1 : 0;
  }
  return found;
}

}  // namespace seedmesh

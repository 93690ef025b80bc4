#include "core/geom/apart.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/array.h"
#include "core/base/rng.h"
#include "core/base/wide.h"

namespace seedmesh {
namespace {

// Points fall into cells so many reaches wide; nearer to a border than `margin` cells (a reach, and what
// rounding may take from it) they are in both cells.
constexpr float cell_width = 80, margin = 1.5F / cell_width;
// Beyond so many cells along the diagonal a float could not tell where in its cell a point is.
constexpr float most_cells = 32'000;
// Bits for each point in the table of cells that are taken: few share one by chance.
constexpr std::size_t bits_a_point = 16, least_bits = 1024, most_bits = std::size_t{1} << 30U;
// So many points in one cell are a heap, and are not compared one by one.
constexpr std::size_t most_in_a_cell = 16;
// Of a slot: the point is near a border.
constexpr std::uint32_t at_border = 0x80000000U;

class Cells {
 public:
  Cells(const glm::vec3& low, float cell, int bits)
      : low_(low), per_cell_(1 / cell), shift_(static_cast<std::uint32_t>(32 - bits)) {}

  glm::vec3 place(const glm::vec3& point) const { return (point - low_) * per_cell_ + 1.0F; }

  /// Below 2^bits, which is at most 2^31.
  std::uint32_t slot(std::int32_t x, std::int32_t y, std::int32_t z) const {
    std::uint32_t hash = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^
                         static_cast<std::uint32_t>(y) * 0x85EBCA77U ^
                         static_cast<std::uint32_t>(z) * 0xC2B2AE3DU;
    hash = (hash ^ hash >> 15U) * 0x2C1B3C6DU;
    hash = (hash ^ hash >> 12U) * 0x297A2D39U;
    return hash >> shift_;
  }

  /// The slot of each point's own cell, with the mark of those near a border.
  void fill(std::span<const glm::vec3> points, std::uint32_t* out) const;

  static std::uint64_t number(std::int32_t x, std::int32_t y, std::int32_t z) {
    return static_cast<std::uint64_t>(x) | static_cast<std::uint64_t>(y) << 21U |
           static_cast<std::uint64_t>(z) << 42U;
  }
  /// The number of the point's own cell.
  std::uint64_t own(const glm::vec3& point) const {
    const glm::ivec3 at(place(point));
    return number(at.x, at.y, at.z);
  }

  /// visit(slot, number) for every cell that is within the margin of a point.
  template <class Visit>
  void each(const glm::vec3& point, Visit visit) const {
    const glm::vec3 at = place(point);
    const glm::ivec3 low(at - margin), high(at + margin);
    // A bit for each axis along which there are two.
    const std::uint32_t two =
        (high.x > low.x ? 1U : 0U) | (high.y > low.y ? 2U : 0U) | (high.z > low.z ? 4U : 0U);
    std::uint32_t each = 0;
    do {
      const std::int32_t x = low.x + static_cast<std::int32_t>(each & 1U),
                         y = low.y + static_cast<std::int32_t>(each >> 1U & 1U),
                         z = low.z + static_cast<std::int32_t>(each >> 2U);
      visit(slot(x, y, z), number(x, y, z));
      each = (each - two) & two;  // the next with none but these bits
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
    const glm::vec3 at = place(point[i]);
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

/// Cells that are taken, and those of them that are taken again: words of both in turn, which are asked for
/// together.
class Taken {
 public:
  Taken(const Job& job, std::size_t count) : words_(job, 2 * (count / 64), std::uint64_t{0}) {}

  /// `times` 0 or 1.
  void take(std::uint32_t slot, std::uint64_t times) {
    const std::uint64_t bit = times << slot % 64;
    std::uint64_t* word = words_.data() + std::size_t{2} * (slot / 64);
    word[1] |= word[0] & bit;
    word[0] |= bit;
  }
  bool is_again(std::uint32_t slot) const {
    return (words_[std::size_t{2} * (slot / 64) + 1] >> slot % 64 & 1U) != 0;
  }

 private:
  Array<std::uint64_t> words_;
};

/// A point within the margin of a cell.
struct Visit {
  std::uint64_t cell;
  std::uint32_t slot, point;
};

/// Points by cell: those of each in a list.
class Cellmates {
 public:
  explicit Cellmates(std::span<const Visit> visits) : visits_(visits), mates_(visits.size()) {
    std::size_t size = 16;
    while (size < 2 * visits.size()) size *= 2;
    last_.assign(size, none);
  }

  /// Calls near(point) for those that are within the reach of another one in their cell; once.
  template <class Near>
  void find_near(std::span<const glm::vec3> points, float reach, Near near) {
    const double squared = static_cast<double>(reach) * static_cast<double>(reach);
    const float doubtful = 2 * reach * reach;
    for (std::uint32_t i = 0; i < visits_.size(); ++i) {
      const std::uint32_t one = visits_[i].point, before = add(i);
      const bool is_heap = mates_[i].count > most_in_a_cell;
      if (is_heap) near(one);
      if (mates_[i].count == most_in_a_cell + 1) {
        for (std::uint32_t k = before; k != none; k = mates_[k].before) near(visits_[k].point);
      }
      for (std::uint32_t k = is_heap ? none : before; k != none; k = mates_[k].before) {
        const std::uint32_t other = visits_[k].point;
        const glm::vec3 about = points[one] - points[other];
        if (glm::dot(about, about) > doubtful) continue;
        const glm::dvec3 apart = glm::dvec3(points[one]) - glm::dvec3(points[other]);
        if (glm::dot(apart, apart) > squared) continue;
        near(one);
        near(other);
      }
    }
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  /// Of a visit: the one before it in its cell, and how many there are up to it.
  struct Mate {
    std::uint32_t before = none, count = 0;
  };

  /// Returns the visit of its cell that was the last.
  std::uint32_t add(std::uint32_t i) {
    const std::uint64_t number = visits_[i].cell;
    std::size_t at = mix(number) & (last_.size() - 1);
    while (last_[at] != none && visits_[last_[at]].cell != number) at = (at + 1) & (last_.size() - 1);
    const std::uint32_t before = last_[at];
    mates_[i] = {before, before == none ? 1 : mates_[before].count + 1};
    last_[at] = i;
    return before;
  }

  std::span<const Visit> visits_;
  std::vector<Mate> mates_;
  std::vector<std::uint32_t> last_;  ///< visit of each cell that has any
};

}  // namespace

Array<std::uint8_t> near_others(std::span<const glm::vec3> points, std::span<const std::uint8_t> twin,
                                float reach, const Job& job) {
  Array<std::uint8_t> found(job);
  if (points.empty() || !(reach > 0)) return found;
  const Box box = bounds_of(points);
  const float cell = cell_width * reach;
  if (!(glm::length(box.max - box.min) < most_cells * cell))
    return Array<std::uint8_t>(job, points.size(), std::uint8_t{1});
  int bits = 0;
  while ((std::size_t{1} << bits) < std::clamp(bits_a_point * points.size(), least_bits, most_bits)) ++bits;
  const Cells cells(box.min, cell, bits);
  Array<std::uint32_t> slot(job, points.size());
  cells.fill(points, slot.data());
  Taken taken(job, std::size_t{1} << bits);
  job.check();
  // Without branches that nobody can foresee: points are put on a list, and stay there if they belong to it.
  Array<std::uint32_t> list(job, points.size());
  std::size_t listed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t is_first = twin[i] ? 0 : 1, is_at_border = slot[i] >> 31U;
    taken.take(slot[i] & ~at_border, is_first & ~is_at_border);
    list[listed] = static_cast<std::uint32_t>(i);
    listed += is_first & is_at_border;
  }
  std::vector<Visit> visits, shared;
  visits.reserve(3 * listed);
  for (std::size_t k = 0; k < listed; ++k) {
    cells.each(points[list[k]], [&](std::uint32_t at, std::uint64_t number) {
      taken.take(at, 1);
      visits.push_back({number, at, list[k]});
    });
  }
  listed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_first = !twin[i], is_inside = (slot[i] & at_border) == 0;
    list[listed] = static_cast<std::uint32_t>(i);
    const bool is_shared = taken.is_again(slot[i] & ~at_border);
    listed += (is_first & is_inside & is_shared) ? 1 : 0;
  }
  for (const Visit& visit : visits) {
    if (taken.is_again(visit.slot)) shared.push_back(visit);
  }
  for (std::size_t k = 0; k < listed; ++k)
    shared.push_back({cells.own(points[list[k]]), slot[list[k]], list[k]});
  job.check();
  if (shared.empty()) return found;
  Bits near(job, std::size_t{1} << bits);
  bool any = false;
  Cellmates(shared).find_near(points, reach, [&](std::uint32_t point) {
    any = true;
    cells.each(points[point], [&](std::uint32_t at, std::uint64_t) { near.set(at); });
  });
  if (!any) return found;
  found.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool is_near = false;
    cells.each(points[i], [&](std::uint32_t at, std::uint64_t) { is_near = is_near || near.has(at); });
    found[i] = is_near ? 1 : 0;
  }
  return found;
}

}  // namespace seedmesh

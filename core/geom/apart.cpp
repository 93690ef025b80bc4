#include "core/geom/apart.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/array.h"
#include "core/base/wide.h"

namespace seedmesh {
namespace {

// Points fall into cells so many reaches wide; nearer to a border than `margin` cells (a reach, and what
// rounding may take from it) they are in both cells.
constexpr float cell_width = 160, margin = 1.5F / cell_width;
// Beyond so many cells along the diagonal a float could not tell where in its cell a point is.
constexpr float most_cells = 32'000;
// At least as many slots for cells as there are points, and half as many more: few share one by chance.
constexpr std::size_t least_slots = 64, most_slots = std::size_t{1} << 30U;
// So many points in one slot are a heap, and are not compared with those before.
constexpr std::size_t most_in_a_slot = 32;
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

  /// visit(slot) for every cell that is within the margin of a point.
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
      visit(slot(x, y, z));
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

/// Points by the slots of their cells, each with the one that was put there before.
class Slots {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  /// `slot` of each point, with the mark of those near a border; those that have one, and twins, are no
  /// points of this table.
  Slots(const Job& job, std::size_t slots, Array<std::uint32_t> slot, std::span<const std::uint8_t> twin)
      : last_(job, slots + 1, none),
        before_(std::move(slot)),
        crowded_(job, before_.size()),
        border_(job, before_.size()) {
    std::size_t crowds = 0, at_borders = 0;
    for (std::size_t i = 0; i < before_.size(); ++i) {
      // Others go to a slot of their own, which nobody asks for. Without branches that nobody can foresee: a
      // point is put on the list, and stays there if it belongs to it.
      const std::uint32_t is_at_border = before_[i] >> 31U;
      const bool is_other = (is_at_border | twin[i]) != 0;
      const std::size_t at = is_other ? slots : before_[i];
      const std::uint32_t before = last_[at];
      last_[at] = static_cast<std::uint32_t>(i);
      before_[i] = before;
      crowded_[crowds] = static_cast<std::uint32_t>(i);
      crowds += ((before != none) & !is_other) ? 1 : 0;
      border_[at_borders] = static_cast<std::uint32_t>(i);
      at_borders += is_at_border & (twin[i] ? 0U : 1U);
    }
    crowded_.resize(crowds);
    border_.resize(at_borders);
  }

  /// Puts one more there, which gets the next number.
  void put(std::uint32_t slot) {
    const auto number = static_cast<std::uint32_t>(before_.size());
    before_.push_back(last_[slot]);
    if (last_[slot] != none) crowded_.push_back(number);
    last_[slot] = number;
  }
  /// Points near a border, but for twins: for put().
  std::span<const std::uint32_t> border() const { return border_.span(); }
  /// Those that came to a slot that was taken.
  std::span<const std::uint32_t> crowded() const { return crowded_.span(); }
  std::uint32_t before(std::uint32_t number) const { return before_[number]; }

 private:
  Array<std::uint32_t> last_, before_, crowded_, border_;
};

/// Are two points within `reach`?
class Reach {
 public:
  explicit Reach(float reach)
      : squared_(static_cast<double>(reach) * static_cast<double>(reach)), doubtful_(2 * reach * reach) {}
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

Array<std::uint8_t> near_others(std::span<const glm::vec3> points, std::span<const std::uint8_t> twin,
                                float reach, const Job& job) {
  Array<std::uint8_t> found(job);
  if (points.empty() || !(reach > 0)) return found;
  const Box box = bounds_of(points);
  const float cell = cell_width * reach;
  if (!(glm::length(box.max - box.min) < most_cells * cell))
    return Array<std::uint8_t>(job, points.size(), std::uint8_t{1});
  int bits = 0;
  const std::size_t wanted = std::clamp(points.size() + points.size() / 2, least_slots, most_slots);
  while ((std::size_t{1} << bits) < wanted) ++bits;
  const std::size_t slots = std::size_t{1} << bits;
  const Cells cells(box.min, cell, bits);
  Array<std::uint32_t> slot(job, points.size());
  cells.fill(points, slot.data());
  job.check();
  Slots taken(job, slots, std::move(slot), twin);
  std::vector<std::uint32_t> who;  // of those that come next
  who.reserve(3 * taken.border().size());
  for (const std::uint32_t point : taken.border()) {
    cells.each(points[point], [&](std::uint32_t at) {
      taken.put(at);
      who.push_back(point);
    });
  }
  job.check();
  const Reach within(reach);
  const auto point_of = [&](std::uint32_t number) {
    return number < points.size() ? number : who[number - points.size()];
  };
  Bits near(job, slots);
  bool any = false;
  const auto mark = [&](std::uint32_t point) {
    any = true;
    cells.each(points[point], [&](std::uint32_t at) { near.set(at); });
  };
  for (const std::uint32_t number : taken.crowded()) {
    const std::uint32_t one = point_of(number);
    std::size_t met = 0;
    std::uint32_t other = taken.before(number);
    for (; other != Slots::none && met < most_in_a_slot; ++met, other = taken.before(other)) {
      const std::uint32_t mate = point_of(other);  // itself, where two of its cells share a slot
      if (mate == one || !within.joins(points[one], points[mate])) continue;
      mark(one);
      mark(mate);
    }
    if (other != Slots::none) mark(one);  // those that it was not compared with stand near it, too
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

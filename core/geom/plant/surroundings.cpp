#include "core/geom/plant/surroundings.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/base/math.h"

namespace seedmesh {
namespace {

constexpr std::size_t check_interval = 1024;
constexpr double everywhere = 1e9;
// The number of points of a step that are tested.
constexpr int probes = 8;
// Ancestors of a tip that it cannot collide with: its own last internodes.
constexpr int kin = 8;
// The largest number of cells of one internode; a coarser grid is used for longer ones.
constexpr int most_cells = 32;
// A step of more pieces, of four cells each, is not a step of a plant.
constexpr double most_pieces = 1024;

double length_of(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

std::uint64_t cell_key(std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t mask = (std::uint64_t{1} << 21U) - 1;
  return (static_cast<std::uint64_t>(x) & mask) << 42U | (static_cast<std::uint64_t>(y) & mask) << 21U |
         (static_cast<std::uint64_t>(z) & mask);
}

std::int64_t cell_of(double x, double size) { return math::to_int64(std::floor(x / size)); }

/// The distance of two segments (Ericson, "Real-Time Collision Detection", 2005, section 5.1.9).
double segments_apart(const glm::dvec3& p1, const glm::dvec3& q1, const glm::dvec3& p2,
                      const glm::dvec3& q2) {
  const glm::dvec3 d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  const double a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, r);
  double s = 0, t = 0;
  if (a > 0 && e > 0) {
    const double c = glm::dot(d1, r), b = glm::dot(d1, d2), denominator = a * e - b * b;
    if (denominator > 0) s = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
    t = (b * s + f) / e;
    if (t < 0 || t > 1) {
      t = std::clamp(t, 0.0, 1.0);
      s = std::clamp((b * t - c) / a, 0.0, 1.0);
    }
  } else if (a > 0) {
    s = std::clamp(-glm::dot(d1, r) / a, 0.0, 1.0);
  } else if (e > 0) {
    t = std::clamp(f / e, 0.0, 1.0);
  }
  return length_of(p1 + d1 * s - (p2 + d2 * t));
}

template <class Visit>
void visit_cells(const glm::dvec3& low, const glm::dvec3& high, double size, Visit&& visit) {
  for (std::int64_t x = cell_of(low.x, size); x <= cell_of(high.x, size); ++x) {
    for (std::int64_t y = cell_of(low.y, size); y <= cell_of(high.y, size); ++y) {
      for (std::int64_t z = cell_of(low.z, size); z <= cell_of(high.z, size); ++z) visit(cell_key(x, y, z));
    }
  }
}

}  // namespace

Surroundings::Surroundings(Options options, Job& job)
    : options_(std::move(options)), job_(job), cells_(job), shades_(job) {}

double Surroundings::signed_distance_at(const glm::dvec3& point) const {
  double room = everywhere;
  if (!options_.guides.empty()) {
    room = -everywhere;
    for (const Solid& guide : options_.guides) room = std::max(room, -surface_near(guide, point).distance);
  }
  for (const Solid& obstacle : options_.obstacles)
    room = std::min(room, surface_near(obstacle, point).distance);
  return room;
}

bool Surroundings::forbids(const glm::dvec3& point) const {
  const auto is_outside = [&](const Solid& guide) { return lies_outside(guide, point); };
  const auto is_inside = [&](const Solid& obstacle) { return lies_inside(obstacle, point); };
  return (!options_.guides.empty() && std::ranges::all_of(options_.guides, is_outside)) ||
         std::ranges::any_of(options_.obstacles, is_inside);
}

glm::dvec3 Surroundings::toward_surface(const glm::dvec3& point) const {
  double least = everywhere;
  glm::dvec3 to{0};
  for (const Solid& solid : options_.obstacles.empty() ? options_.guides : options_.obstacles) {
    const glm::dvec3 apart = nearest_on_surface(solid, point) - point;
    const double distance = length_of(apart);
    if (distance >= least) continue;
    least = distance;
    to = apart;
  }
  return math::unit(to, glm::dvec3{0});
}

void Surroundings::set_internodes(std::span<const GrownInternode> grown) {
  grown_.assign(grown.begin(), grown.end());
  has_cells_ = has_shades_ = false;
}

void Surroundings::fill_cells() {
  has_cells_ = true;
  double longest = 0, thickest = 0;
  for (const GrownInternode& each : grown_) {
    longest = std::max(longest, length_of(each.to - each.from));
    thickest = std::max(thickest, each.radius);
  }
  // Cells of about the mean length contain few internodes; none lies in more than most_cells along an axis.
  double sum = 0;
  for (const GrownInternode& each : grown_) sum += length_of(each.to - each.from);
  const double mean = grown_.empty() ? 1 : sum / static_cast<double>(grown_.size());
  cell_ = std::max({mean, 2 * thickest + options_.clearance, longest / most_cells, 1e-4});
  Array<Cell> found = cells_.empty_array_of<Cell>();
  for (std::size_t i = 0; i < grown_.size(); ++i) {
    if (i % check_interval == 0) job_.check();
    const GrownInternode& each = grown_[i];
    const double reach = each.radius + options_.clearance;
    visit_cells(glm::min(each.from, each.to) - reach, glm::max(each.from, each.to) + reach, cell_,
                [&](std::uint64_t key) {
                  found.push_back({key, static_cast<std::uint32_t>(i)});
                });
  }
  // Sorted by counting: a bucket for each cell on average.
  starts_ = Array<std::uint32_t>(job_, std::bit_ceil(found.size() + 1) + 1, 0);
  for (const Cell& each : found) ++starts_[bucket_of(each.key) + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  cells_.resize(found.size());
  for (std::size_t i = found.size(); i-- > 0;) cells_[--starts_[bucket_of(found[i].key) + 1]] = found[i];
  std::move(starts_.begin() + 1, starts_.end(), starts_.begin());
  starts_.back() = static_cast<std::uint32_t>(found.size());
}

void Surroundings::cast_shadows() {
  has_shades_ = true;
  shades_.clear();
  const ShadowOptions& shadow = options_.shadow;
  // Each cell once: many short internodes are no darker than one long twig.
  Array<std::uint64_t> filled = cells_.empty_array_of<std::uint64_t>();
  for (const GrownInternode& each : grown_) {
    const glm::dvec3 end = each.to;
    filled.push_back(
        cell_key(cell_of(end.x, shadow.cell), cell_of(end.y, shadow.cell), cell_of(end.z, shadow.cell)));
  }
  std::sort(filled.begin(), filled.end());
  const auto* const last = std::unique(filled.begin(), filled.end());
  const auto coordinate = [](std::uint64_t key, unsigned shift) {
    constexpr std::uint64_t mask = (std::uint64_t{1} << 21U) - 1;
    const auto value = static_cast<std::int64_t>(key >> shift & mask);
    return value >= (std::int64_t{1} << 20U) ? value - (std::int64_t{1} << 21U) : value;
  };
  std::size_t steps = 0;
  for (const std::uint64_t* key = filled.begin(); key != last; ++key) {
    if (++steps % check_interval == 0) job_.check();
    double amount = shadow.shade;
    const std::int64_t x = coordinate(*key, 42), y = coordinate(*key, 21), z = coordinate(*key, 0);
    for (int layer = 0; layer <= shadow.layers; ++layer, amount /= shadow.falloff) {
      for (std::int64_t dx = -layer; dx <= layer; ++dx) {
        for (std::int64_t dz = -layer; dz <= layer; ++dz)
          shades_.add(cell_key(x + dx, y - layer, z + dz), amount);
      }
    }
  }
}

double Surroundings::light_at(const glm::dvec3& point) {
  if (!has_shades_) cast_shadows();
  const double size = options_.shadow.cell;
  const std::uint64_t key = cell_key(cell_of(point.x, size), cell_of(point.y, size), cell_of(point.z, size));
  const double amount = shades_.at(key);
  return amount == 0 ? 1 : std::clamp(1 - (amount - options_.shadow.shade), 0.0, 1.0);
}

bool Surroundings::collides(const GrowthTip& tip, const glm::dvec3& from, const glm::dvec3& to) const {
  std::uint32_t relatives[kin];
  int count = 0;
  for (std::uint32_t joint = tip.joint; joint != Limbs::none && count < kin;) {
    relatives[count++] = joint;
    const auto own = std::lower_bound(grown_.begin(), grown_.end(), std::pair(tip.system, joint),
                                      [](const GrownInternode& each, const auto& wanted) {
                                        return std::pair(each.system, each.joint) < wanted;
                                      });
    joint =
        own != grown_.end() && own->system == tip.system && own->joint == joint ? own->parent : Limbs::none;
  }
  const glm::dvec3 place = glm::vec3(tip.position) + 0.0F;  // rounded as internodes are stored
  const auto is_kin = [&](const GrownInternode& each) {
    if (each.system != tip.system) return false;
    if (each.limb == tip.limb || each.limb == tip.limb_ahead) return true;
    if (each.limb_below == tip.limb_ahead && (tip.joint == Limbs::none || each.parent > tip.joint))
      return true;  // grows from what has grown on
    if (each.parent == tip.joint || each.from == place) return true;
    return std::find(relatives, relatives + count, each.joint) != relatives + count;
  };
  const double reach = tip.radius;
  bool hit = false;
  std::size_t seen = 0;
  visit_cells(glm::min(from, to) - reach, glm::max(from, to) + reach, cell_, [&](std::uint64_t key) {
    if (hit) return;
    const std::size_t bucket = bucket_of(key);
    for (std::uint32_t i = starts_[bucket]; i < starts_[bucket + 1] && !hit; ++i) {
      const Cell* found = &cells_[i];
      if (found->key != key) continue;
      if (++seen % check_interval == 0) job_.check();
      const GrownInternode& each = grown_[found->internode];
      if (is_kin(each)) continue;
      hit = segments_apart(from, to, each.from, each.to) < tip.radius + each.radius + options_.clearance;
    }
  });
  return hit;
}

bool Surroundings::is_free(const GrowthTip& tip, double length) {
  if (bounds_growth()) {
    for (int i = 0; i <= probes; ++i) {
      if (forbids(tip.position + tip.heading * (length * i / probes))) return false;
    }
  }
  if (grown_.empty()) return true;
  if (!has_cells_) fill_cells();
  job_.check();
  // Piece by piece, so that a long step visits the cells along it and not all cells of its box.
  const double pieces = std::ceil(std::abs(length) / (4 * cell_));
  if (!(pieces <= most_pieces)) return false;
  const int count = std::max(1, static_cast<int>(math::to_int32(pieces)));
  glm::dvec3 from = tip.position;
  for (int i = 1; i <= count; ++i) {
    const glm::dvec3 end = tip.position + tip.heading * (length * i / count);
    if (collides(tip, from, end)) return false;
    from = end;
  }
  return true;
}

}  // namespace seedmesh

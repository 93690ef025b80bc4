#include "core/generators/building/occlusion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/math.h"

namespace seedmesh::building {
namespace {

constexpr double skin = 1e-5;  ///< metres: shapes that share a face do not overlap

glm::dvec3 center_of(const Scope& scope) { return scope.origin + scope.axes * (0.5 * scope.size); }

/// The distance between two boxes, or the depth of their overlap as a negative number, over the 15 possible
/// separating axes (Gottschalk, Lin, Manocha, "OBBTree", 1996).
double gap(const Scope& a, const Scope& b) {
  const glm::dvec3 between = center_of(b) - center_of(a);
  double widest = -1e300;
  const auto test = [&](glm::dvec3 axis) {
    const double length = glm::length(axis);
    if (length < 1e-9) return;
    axis /= length;
    double reach = 0;
    for (int i = 0; i < 3; ++i) {
      reach += 0.5 * a.size[i] * std::abs(glm::dot(axis, a.axes[i]));
      reach += 0.5 * b.size[i] * std::abs(glm::dot(axis, b.axes[i]));
    }
    widest = std::max(widest, std::abs(glm::dot(axis, between)) - reach);
  };
  for (int i = 0; i < 3; ++i) {
    test(a.axes[i]);
    test(b.axes[i]);
    for (int k = 0; k < 3; ++k) test(glm::cross(a.axes[i], b.axes[k]));
  }
  return widest;
}

bool contains(const Scope& box, const glm::dvec3& p) {
  const glm::dvec3 local = glm::transpose(box.axes) * (p - box.origin);
  for (int i = 0; i < 3; ++i) {
    if (local[i] < -skin || local[i] > box.size[i] + skin) return false;
  }
  return true;
}

bool contains(const Scope& box, const Scope& inner) {
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec3 at(0);
    for (int i = 0; i < 3; ++i) at[i] = (corner >> i & 1) != 0 ? inner.size[i] : 0;
    if (!contains(box, inner.origin + inner.axes * at)) return false;
  }
  return true;
}

void box_around(const Scope& scope, glm::dvec3& low, glm::dvec3& high) {
  const glm::dvec3 middle = center_of(scope);
  glm::dvec3 reach(0);
  for (int i = 0; i < 3; ++i) reach += 0.5 * scope.size[i] * glm::abs(scope.axes[i]);
  low = middle - reach;
  high = middle + reach;
}

}  // namespace

std::uint32_t FirstPassIndex::cell_of(const glm::ivec3& at) const {
  return static_cast<std::uint32_t>((at.z * cells_.y + at.y) * cells_.x + at.x);
}

FirstPassIndex::FirstPassIndex(Shapes shapes, std::vector<SnapPlane> snaps, const Grammar& grammar)
    : shapes_(std::move(shapes)), snaps_(std::move(snaps)), grammar_(&grammar) {
  const auto count = static_cast<std::uint32_t>(shapes_.shapes.size());
  // A depth-first walk gives each shape a rank, and its descendants the ranks behind it.
  std::vector<std::uint32_t> weight(count, 1);
  for (std::uint32_t i = count; i-- > 1;) weight[shapes_.shapes[i].parent] += weight[i];
  rank_.assign(count, 0);
  last_.assign(count, 0);
  std::vector<std::uint32_t> next(count, 1);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t parent = shapes_.shapes[i].parent;
    if (parent != none) {
      rank_[i] = rank_[parent] + next[parent];
      next[parent] += weight[i];
    }
    last_[i] = rank_[i] + weight[i];
    of_key_.emplace(shapes_.shapes[i].key, i);
  }
  glm::dvec3 high(-1e300);
  low_ = glm::dvec3(1e300);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Shape& shape = shapes_.shapes[i];
    if (dimension(shape.size) < 3) continue;
    if (shape.geometry != box_geometry && (shape.geometry & asset_bit) == 0 &&
        !shapes_.solid_of(shape.geometry).is_closed)
      continue;
    Candidate candidate;
    candidate.shape = i;
    box_around({shape.origin, shape.size, shapes_.axes[shape.axes]}, candidate.low, candidate.high);
    low_ = glm::min(low_, candidate.low);
    high = glm::max(high, candidate.high);
    candidates_.push_back(candidate);
  }
  if (candidates_.empty()) return;
  // About two candidates in each cell, and at most 64 cells along an axis.
  const double side = std::clamp(math::cbrt(static_cast<double>(candidates_.size()) / 2), 1.0, 64.0);
  cells_ = glm::ivec3(math::to_int32(side));
  cell_ = glm::max((high - low_) / side, glm::dvec3(1e-6)) * 1.0001;
  const auto cells = static_cast<std::size_t>(cells_.x * cells_.y * cells_.z);
  first_.assign(cells + 1, 0);
  const auto visit = [&](const Candidate& c, auto&& body) {
    const glm::ivec3 a = glm::clamp(glm::ivec3((c.low - low_) / cell_), glm::ivec3(0), cells_ - 1);
    const glm::ivec3 b = glm::clamp(glm::ivec3((c.high - low_) / cell_), glm::ivec3(0), cells_ - 1);
    for (int z = a.z; z <= b.z; ++z) {
      for (int y = a.y; y <= b.y; ++y) {
        for (int x = a.x; x <= b.x; ++x) body(cell_of({x, y, z}));
      }
    }
  };
  for (const Candidate& c : candidates_) visit(c, [&](std::uint32_t cell) { ++first_[cell + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  members_.resize(first_.back());
  std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < candidates_.size(); ++i)
    visit(candidates_[i], [&](std::uint32_t cell) { members_[at[cell]++] = i; });
}

bool FirstPassIndex::counts(const Query& query, std::uint32_t index) const {
  const Shape& shape = shapes_.shapes[index];
  if (query.kind != Query::Kind::occlusion && !shape.is_active && query.target == "all") return false;
  if (query.target == "all" || query.target == "noparent" || query.target.empty()) return true;
  if (query.target == "active") return shape.is_active;
  const std::uint32_t label = shapes_.styles[shape.style].label;
  if (const std::string* name = shapes_.texts.find(label); name != nullptr && *name == query.target)
    return true;
  return grammar_->symbols[shape.symbol].name == query.target;
}

bool FirstPassIndex::is_family(std::uint32_t self, std::uint32_t other) const {
  if (self == none) return false;
  const bool is_below = rank_[other] >= rank_[self] && rank_[other] < last_[self];
  const bool is_above = rank_[self] >= rank_[other] && rank_[self] < last_[other];
  return is_below || is_above;
}

Scope FirstPassIndex::scope_of(std::uint32_t index) const {
  const Shape& shape = shapes_.shapes[index];
  return {shape.origin, shape.size, shapes_.axes[shape.axes]};
}

const Solid* FirstPassIndex::solid_of(std::uint32_t index) const {
  const std::uint32_t geometry = shapes_.shapes[index].geometry;
  return geometry == box_geometry || (geometry & asset_bit) != 0 ? nullptr : &shapes_.solid_of(geometry);
}

template <class Body>
void FirstPassIndex::near(const glm::dvec3& low, const glm::dvec3& high, Job& job, Body&& body) const {
  const glm::dvec3 last(static_cast<double>(cells_.x), static_cast<double>(cells_.y),
                        static_cast<double>(cells_.z));
  const glm::ivec3 a(glm::clamp((low - low_) / cell_ - 1e-3, glm::dvec3(0), last - 1.0));
  const glm::ivec3 b(glm::clamp((high - low_) / cell_ + 1e-3, glm::dvec3(0), last - 1.0));
  std::uint64_t looked = 0;
  for (int z = a.z; z <= b.z; ++z) {
    for (int y = a.y; y <= b.y; ++y) {
      for (int x = a.x; x <= b.x; ++x) {
        const std::uint32_t cell = cell_of({x, y, z});
        for (std::uint32_t m = first_[cell]; m < first_[cell + 1]; ++m) {
          if ((++looked & 4095U) == 0) job.check();
          if (!body(candidates_[members_[m]].shape)) return;
        }
      }
    }
  }
}

/// Tests the line of sight in pieces as long as a cell, so that only candidates near to it are tested.
bool FirstPassIndex::is_visible(const Query& query, const Scope& scope, std::uint32_t self, Job& job) const {
  const glm::dvec3 from = center_of(scope);
  double least = 1e300;
  std::uint32_t target = none;
  glm::dvec3 to(0);
  for (std::uint32_t i = 0; i < shapes_.shapes.size(); ++i) {
    if ((i & 4095U) == 4095U) job.check();
    if (!counts(query, i) || is_family(self, i) || dimension(shapes_.shapes[i].size) == 0) continue;
    const glm::dvec3 p = nearest_point(scope_of(i), from);
    const double distance = glm::length(p - from);
    if (distance >= least) continue;
    least = distance;
    target = i;
    to = p;
  }
  if (target == none) return false;
  if (candidates_.empty()) return true;
  const double step = std::max({cell_.x, cell_.y, cell_.z});
  const auto pieces = std::clamp(std::ceil(least / step), 1.0, 1000.0);
  bool is_free = true;
  for (double k = 0; k < pieces && is_free; ++k) {
    const glm::dvec3 a = from + (to - from) * (k / pieces), b = from + (to - from) * ((k + 1) / pieces);
    near(glm::min(a, b), glm::max(a, b), job, [&](std::uint32_t other) {
      if (is_family(self, other) || is_family(target, other)) return true;
      is_free = !is_line_blocked(from, to, solid_of(other), scope_of(other), skin);
      return is_free;
    });
  }
  return is_free;
}

double FirstPassIndex::measure(const Query& query, const Scope& scope, std::uint32_t self, Job& job) const {
  double count = 0, least = 1e6;
  for (std::uint32_t i = 0; i < shapes_.shapes.size(); ++i) {
    if ((i & 1023U) == 1023U) job.check();
    const std::string* const label = shapes_.texts.find(shapes_.styles[shapes_.shapes[i].style].label);
    // Shapes inherit their label; those that were replaced count through their successors.
    if (i == self || !shapes_.shapes[i].is_active || label == nullptr || *label != query.target ||
        is_family(self, i))
      continue;
    ++count;
    if (query.kind == Query::Kind::distance) least = std::min(least, std::max(0.0, gap(scope, scope_of(i))));
  }
  return query.kind == Query::Kind::count ? count : least;
}

double FirstPassIndex::answer(const Query& query, const Scope& scope, std::span<const std::uint64_t> lineage,
                              Job& job) const {
  // The querying shape in the first pass: itself, or its nearest ancestor that existed there.
  std::uint32_t self = none;
  for (const std::uint64_t key : lineage) {
    const auto found = of_key_.find(key);
    if (found == of_key_.end()) continue;
    self = found->second;
    break;
  }
  if (query.kind == Query::Kind::visible) return is_visible(query, scope, self, job) ? 1 : 0;
  if (query.kind == Query::Kind::count || query.kind == Query::Kind::distance)
    return measure(query, scope, self, job);
  if (candidates_.empty()) return 0;
  glm::dvec3 low, high;
  box_around(scope, low, high);
  Cover cover = Cover::free;
  std::optional<double> answer;
  near(low, high, job, [&](std::uint32_t other) {
    if (is_family(self, other) || !counts(query, other)) return true;
    const Scope box = scope_of(other);
    const double distance = gap(scope, box);
    if (query.kind == Query::Kind::touches) {
      if (std::abs(distance) <= skin) answer = 1;
      return !answer;
    }
    if (distance > -skin && !(dimension(scope.size) < 3 && distance < skin && contains(box, scope)))
      return true;
    bool is_full = contains(box, scope);
    if (const Solid* solid = solid_of(other); solid != nullptr && dimension(scope.size) >= 2) {
      const double share = share_inside(scope, *solid, box);
      if (share < 1e-6) return true;
      is_full = share > 1 - 1e-4;
    }
    if (query.kind == Query::Kind::overlaps) {
      answer = 1;
    } else if (is_full) {
      answer = query.kind == Query::Kind::inside ? 1 : 2;
    }
    cover = Cover::part;
    return !answer;
  });
  if (answer) return *answer;
  return query.kind == Query::Kind::occlusion ? static_cast<double>(cover) : 0;
}

}  // namespace seedmesh::building

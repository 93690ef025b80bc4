#include "core/generators/building/joined_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/generators/building/choose_rule.h"
#include "core/generators/building/contact.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/solid_tools.h"
#include "core/generators/building/united_shapes.h"

namespace seedmesh::building {
namespace {

constexpr std::uint64_t place_of_joint =
    0xFFFF'FFFF'0003U;                ///< of random numbers: a step that no successor has
constexpr double same_border = 1e-9;  ///< distance as a share of the sizes

/// Whether `a` comes before `b` in the tree of shapes. Neither is made of the other.
bool is_before(const Shapes& shapes, std::uint32_t a, std::uint32_t b) {
  const auto up = [&](std::uint32_t& shape) { shape = shapes.shapes[shape].parent; };
  while (shapes.shapes[a].depth > shapes.shapes[b].depth) up(a);
  while (shapes.shapes[b].depth > shapes.shapes[a].depth) up(b);
  while (shapes.shapes[a].parent != shapes.shapes[b].parent) {
    up(a);
    up(b);
  }
  return a < b;
}

/// Boxes in the axes of the first; none if one is no box in these axes.
std::vector<WorldBox> boxes_of(const Derivation& d, std::span<const Shape> shapes) {
  std::vector<WorldBox> boxes;
  const glm::dmat3 back = glm::transpose(d.out.axes[shapes[0].axes]);
  for (const Shape& shape : shapes) {
    if (shape.geometry != box_geometry || dimension(shape.size) != dimension(shapes[0].size)) return {};
    const glm::dmat3 turn = back * d.out.axes[shape.axes];
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) {
        const double share = std::abs(turn[column][row]);
        if (share > same_border && share < 1 - same_border) return {};
      }
    }
    const int flat = flat_axis(shape.size);
    if (dimension(shape.size) == 2 && turn[flat][flat_axis(shapes[0].size)] < 0.5) return {};
    const glm::dvec3 from = back * (shape.origin - shapes[0].origin), to = from + turn * shape.size;
    boxes.push_back({glm::min(from, to), glm::max(from, to)});
  }
  return boxes;
}

/// The box that these fill without an overlap, if there is one.
std::optional<WorldBox> filled_box(std::span<const WorldBox> boxes, const glm::dvec3& first_size) {
  if (boxes.empty()) return std::nullopt;
  WorldBox all = boxes[0];
  for (const WorldBox& box : boxes) {
    all.low = glm::min(all.low, box.low);
    all.high = glm::max(all.high, box.high);
  }
  const glm::dvec3 extent = all.high - all.low;
  const double largest = std::max({extent.x, extent.y, extent.z}), near = same_border * largest;
  const auto measure = [&](const WorldBox& box) {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double size = box.high[axis] - box.low[axis];
      if (first_size[axis] != 0) product *= std::max(0.0, size) / largest;
      if (first_size[axis] == 0 && extent[axis] > near) return -1.0;
    }
    return product;
  };
  double sum = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    sum += measure(boxes[i]);
    for (std::size_t k = 0; k < i; ++k) {
      const WorldBox common{glm::max(boxes[i].low, boxes[k].low) + near,
                            glm::min(boxes[i].high, boxes[k].high) - near};
      bool is_empty = false;
      for (int axis = 0; axis < 3; ++axis)
        is_empty |= first_size[axis] != 0 && common.high[axis] <= common.low[axis];
      if (!is_empty) return std::nullopt;
    }
  }
  const double whole = measure(all);
  if (!(whole > 0) || std::abs(sum - whole) > 1e-8 * whole) return std::nullopt;
  return all;
}

/// Faces of one plane as few polygons.
Solid with_few_faces(Solid solid, double near, const Job& job) {
  solid = welded(solid, near);
  return without_straight_corners(with_joined_faces(with_shared_corners(solid, near, job), near), near);
}

/// What the successor begins with; nothing if the shapes have no geometry that can be joined.
std::optional<ShapeState> united(Derivation& d, std::span<const Shape> shapes, std::uint32_t offset) {
  ShapeState state = shapes[0];
  if (shapes.size() == 1) return state;
  if (const std::optional<WorldBox> box = filled_box(boxes_of(d, shapes), state.size)) {
    state.origin += d.out.axes[state.axes] * box->low;
    for (int axis = 0; axis < 3; ++axis) {
      if (state.size[axis] != 0) state.size[axis] = box->high[axis] - box->low[axis];
    }
    return state;
  }
  for (const Shape& shape : shapes) {
    if (shape.has_asset() || dimension(shape.size) < 2) return std::nullopt;
  }
  Solid solid = united_solid(d, offset, state, shapes, UnionMode::unify);
  if (!solid.is_closed) {
    const int flat = flat_axis(state.size);
    const double near = 1e-7 * std::max({state.size.x, state.size.y, state.size.z});
    if (dimension(state.size) == 2) {
      for (glm::dvec3& p : solid.points) {
        if (std::abs(p[flat]) <= near) p[flat] = 0;
      }
    }
    solid = with_few_faces(std::move(solid), near, d.job);
  }
  if (solid.faces.empty()) return std::nullopt;
  state.roof_up = no_roof;
  take_solid(d, state, std::move(solid));
  return state;
}

class Join {
 public:
  Join(Derivation& d, std::vector<std::uint32_t> waiting) : d_(d), waiting_(std::move(waiting)) {
    std::vector<WorldBox> boxes;
    for (const std::uint32_t each : waiting_) {
      outlines_.push_back(outline_of(d, d.out.shapes[each]));
      boxes.push_back(outlines_.back().box);
      d.job.check();
    }
    tree_.emplace(boxes);
  }

  std::vector<std::uint32_t> run() {
    for (const Joint& joint : d_.grammar.joints) {
      chosen_.assign(joint.lefts.size(), none);
      for (std::uint32_t i = 0; i < waiting_.size(); ++i) {
        if (!is_like(i, joint.lefts[0])) continue;
        chosen_[0] = i;
        search(joint, 1);
        chosen_.assign(joint.lefts.size(), none);
      }
    }
    return std::move(joined_);
  }

 private:
  bool is_like(std::uint32_t i, const Joint::Left& left) const {
    const Shape& shape = d_.out.shapes[waiting_[i]];
    return shape.is_active && shape.symbol == left.symbol && shape.parameter_count == left.parameter_count;
  }

  /// The neighbours of a waiting shape, rising.
  std::vector<std::uint32_t> neighbours_of(std::uint32_t i) const {
    std::vector<std::uint32_t> near = tree_->meeting(outlines_[i].box);
    std::erase_if(near, [&](std::uint32_t k) {
      return k == i || !d_.out.shapes[waiting_[k]].is_active || !are_neighbours(outlines_[i], outlines_[k]);
    });
    return near;
  }

  /// Finds shapes beside those that are chosen, for the rest of the left side.
  bool search(const Joint& joint, std::size_t count) {
    d_.job.check();
    if (count == joint.lefts.size()) return add(joint);
    std::vector<std::uint32_t> near;
    for (const std::uint32_t each : chosen_) {
      if (each == none) continue;
      const std::vector<std::uint32_t> own = neighbours_of(each);
      near.insert(near.end(), own.begin(), own.end());
    }
    std::ranges::sort(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (std::size_t left = 1; left < joint.lefts.size(); ++left) {
      if (chosen_[left] != none) continue;
      for (const std::uint32_t each : near) {
        if (!is_like(each, joint.lefts[left]) || std::ranges::find(chosen_, each) != chosen_.end()) continue;
        chosen_[left] = each;
        if (search(joint, count + 1)) return true;
        chosen_[left] = none;
      }
    }
    return false;
  }

  /// Adds the joined shape, unless no rule applies to it.
  bool add(const Joint& joint) {
    std::vector<Shape> replaced;
    for (std::size_t left = 0; left < chosen_.size(); ++left) {
      if (!joint.lefts[left].is_kept) replaced.push_back(d_.out.shapes[waiting_[chosen_[left]]]);
    }
    const std::uint32_t offset = d_.grammar.rules[d_.grammar.symbols[joint.symbol].rules.front()].offset;
    const std::size_t solids = d_.out.solids.size();
    const std::optional<ShapeState> state = united(d_, replaced, offset);
    if (!state) return false;
    Shape made(*state);
    made.symbol = joint.symbol;
    made.parent = waiting_[chosen_[0]];
    made.depth = static_cast<std::uint16_t>(replaced[0].depth + 1);
    made.key = key_at(replaced[0].key, place_of_joint);
    made.is_carried = replaced[0].is_carried;
    made.first_parameter = static_cast<std::uint32_t>(d_.out.parameters.size());
    for (const std::uint32_t each : chosen_) {
      const Shape part = d_.out.shapes[waiting_[each]];
      for (std::uint32_t i = 0; i < part.parameter_count; ++i) {
        const lang::TaggedValue value = d_.out.parameters[part.first_parameter + i];
        d_.out.parameters.push_back(value);
      }
      made.parameter_count = static_cast<std::uint8_t>(made.parameter_count + part.parameter_count);
    }
    if (made.depth >= deepest_shape) {
      reject(d_, offset,
             "`" + d_.grammar.symbols[joint.symbol].name +
                 "` is nested 1,000 shapes deep: its rules call each other without an end");
    }
    d_.meter.spend();
    d_.out.shapes.push_back(made);
    const auto index = static_cast<std::uint32_t>(d_.out.shapes.size()) - 1;
    if (choose(d_, index) == nullptr) {
      d_.out.shapes.resize(index);
      d_.out.parameters.resize(made.first_parameter);
      d_.out.solids.resize(solids);
      return false;
    }
    for (std::size_t left = 0; left < chosen_.size(); ++left) {
      if (!joint.lefts[left].is_kept) d_.out.shapes[waiting_[chosen_[left]]].is_active = false;
    }
    edit_shape(d_, index);
    joined_.push_back(index);
    return true;
  }

  Derivation& d_;
  std::vector<std::uint32_t> waiting_;  ///< shapes in the order of the tree
  std::vector<Outline> outlines_;       ///< of these
  std::optional<BoxTree> tree_;         ///< of these
  std::vector<std::uint32_t> chosen_;   ///< for the parts of the left side that is searched: into waiting_
  std::vector<std::uint32_t> joined_;
};

}  // namespace

bool waits(const Derivation& d, const Shape& shape) {
  return shape.is_active && !shape.is_leaf && d.grammar.symbols[shape.symbol].is_in_joint;
}

std::vector<std::uint32_t> take_waiting(Derivation& d, std::uint32_t first) {
  std::vector<std::uint32_t> waiting;
  for (auto i = first; i < d.out.shapes.size(); ++i) {
    if (waits(d, d.out.shapes[i])) waiting.push_back(i);
  }
  if (waiting.empty()) return {};
  std::ranges::sort(waiting, [&](std::uint32_t a, std::uint32_t b) { return is_before(d.out, a, b); });
  std::vector<std::uint32_t> next = Join(d, waiting).run();
  if (!next.empty()) return next;
  std::erase_if(waiting, [&](std::uint32_t i) { return !has_rule(d, d.out.shapes[i]); });
  return waiting;
}

}  // namespace seedmesh::building

#include "core/generators/building/joined_shapes.h"

#include <algorithm>
#include <cmath>

#include "core/generators/building/choose_rule.h"

namespace seedmesh::building {
namespace {

constexpr std::uint64_t place_of_joint =
    0xFFFF'FFFF'0003U;                ///< of random numbers: a step that no successor has
constexpr double same_border = 1e-9;  ///< as a share of the sizes

/// The box around two boxes with the same axes, if they fill it; along all axes but one they are equal.
bool grow(ShapeState& box, const ShapeState& other, const glm::dmat3& axes) {
  const glm::dvec3 from = glm::transpose(axes) * (other.origin - box.origin);
  const double scale =
      std::max({box.size.x, box.size.y, box.size.z, other.size.x, other.size.y, other.size.z});
  const auto same = [&](double a, double b) { return std::abs(a - b) <= same_border * scale; };
  for (int axis = 0; axis < 3; ++axis) {
    bool is_beside = true;
    for (int across = 0; across < 3; ++across) {
      if (across != axis)
        is_beside = is_beside && same(from[across], 0) && same(box.size[across], other.size[across]);
    }
    if (!is_beside || box.size[axis] == 0 || other.size[axis] == 0) continue;
    if (same(from[axis], box.size[axis])) {
      box.size[axis] += other.size[axis];
      return true;
    }
    if (same(from[axis], -other.size[axis])) {
      box.origin = other.origin;
      box.size[axis] += other.size[axis];
      return true;
    }
  }
  return false;
}

class Join {
 public:
  Join(Derivation& d, std::uint32_t parent, std::uint32_t first) : d_(d) {
    for (auto i = first; i < d.out.shapes.size(); ++i) {
      const Shape& shape = d.out.shapes[i];
      if (shape.parent == parent && shape.is_active && !shape.is_leaf && shape.geometry == box_geometry)
        open_.push_back(i);
    }
  }

  void run() {
    for (const Joint& joint : d_.grammar.joints) {
      for (std::size_t i = 0; i < open_.size(); ++i) {
        d_.job.check();
        if (!is_like(open_[i], joint.lefts[0])) continue;
        const ShapeState start = d_.out.shapes[open_[i]];  // a copy: shapes are added
        chosen_.assign(1, open_[i]);
        if (!search(joint, start)) continue;
        std::erase_if(open_, [&](std::uint32_t each) { return !d_.out.shapes[each].is_active; });
        --i;  // the next shape has moved here
      }
    }
  }

 private:
  bool is_like(std::uint32_t index, const Joint::Left& left) const {
    const Shape& shape = d_.out.shapes[index];
    return shape.is_active && shape.symbol == left.first && shape.parameter_count == left.second;
  }

  /// Finds a shape for the next part of the left side beside `box`, and the rest of them.
  bool search(const Joint& joint, const ShapeState& box) {
    if (chosen_.size() == joint.lefts.size()) return add(joint, box);
    for (const std::uint32_t each : open_) {
      if (!is_like(each, joint.lefts[chosen_.size()]) || std::ranges::find(chosen_, each) != chosen_.end())
        continue;
      const Shape& shape = d_.out.shapes[each];
      if (d_.out.axes[shape.axes] != d_.out.axes[box.axes]) continue;
      ShapeState larger = box;
      if (!grow(larger, shape, d_.out.axes[box.axes])) continue;
      chosen_.push_back(each);
      if (search(joint, larger)) return true;
      chosen_.pop_back();
    }
    return false;
  }

  /// Adds the joined shape, unless no rule holds for it.
  bool add(const Joint& joint, const ShapeState& box) {
    const Shape first = d_.out.shapes[chosen_[0]];
    Shape joined(box);
    joined.symbol = joint.symbol;
    joined.parent = chosen_[0];
    joined.depth = static_cast<std::uint16_t>(first.depth + 1);
    joined.key = key_at(first.key, place_of_joint);
    joined.is_carried = first.is_carried;
    joined.first_parameter = static_cast<std::uint32_t>(d_.out.parameters.size());
    for (const std::uint32_t each : chosen_) {
      const Shape& part = d_.out.shapes[each];
      for (std::uint32_t i = 0; i < part.parameter_count; ++i) {
        const lang::TaggedValue value = d_.out.parameters[part.first_parameter + i];
        d_.out.parameters.push_back(value);
      }
      joined.parameter_count = static_cast<std::uint8_t>(joined.parameter_count + part.parameter_count);
    }
    d_.meter.spend();
    d_.out.shapes.push_back(joined);
    const auto index = static_cast<std::uint32_t>(d_.out.shapes.size()) - 1;
    if (choose(d_, index) == nullptr) {
      d_.out.shapes.resize(index);
      d_.out.parameters.resize(joined.first_parameter);
      return false;
    }
    for (const std::uint32_t each : chosen_) d_.out.shapes[each].is_active = false;
    edit_shape(d_, index);
    return true;
  }

  Derivation& d_;
  std::vector<std::uint32_t> open_;    ///< shapes that are not joined yet
  std::vector<std::uint32_t> chosen_;  ///< for the left side that is searched
};

}  // namespace

void join_children(Derivation& d, std::uint32_t parent, std::uint32_t first) { Join(d, parent, first).run(); }

}  // namespace seedmesh::building

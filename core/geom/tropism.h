#pragma once
/// Tropisms: forces that turn a growing tip toward a direction, by gravity, light or wind.
///
/// After Prusinkiewicz and Lindenmayer, "The Algorithmic Beauty of Plants", 1990, section 2.1.4: after each
/// segment the heading H turns toward the vector T by e |H x T| radians, about H x T; e is the branch's
/// susceptibility to bending. As in cpfg there may be several, each with an elasticity of its own, which the
/// turtle's state holds and symbols change.
#include <cstddef>
#include <vector>

#include "core/geom/frame.h"

namespace seedmesh {

struct Tropism {
  glm::dvec3 direction{0, -1, 0};  ///< T; its length counts
  double elasticity = 0;           ///< e at the start, radians
  double step = 0;                 ///< what one @T adds and one @Td takes off
};

/// Some tropisms and the present elasticity of each, with a stack for branches.
class Tropisms {
 public:
  explicit Tropisms(std::vector<Tropism> all);

  std::size_t size() const { return all_.size(); }
  /// Beyond the last tropism: nothing.
  void set(std::size_t index, double elasticity);
  void change(std::size_t index, double steps);

  /// The frame after one segment has been drawn, or a share of one.
  Frame turned(const Frame& frame, double share = 1) const;

  const std::vector<double>& elasticities() const { return elasticity_; }

  void push() { stack_.insert(stack_.end(), elasticity_.begin(), elasticity_.end()); }
  void pop();  ///< without a matching push: nothing

 private:
  std::vector<Tropism> all_;
  std::vector<double> elasticity_;
  std::vector<double> stack_;
};

}  // namespace seedmesh

#pragma once
/// Tropisms: forces that turn a growing tip toward a direction, by gravity, light or wind.
///
/// Source: Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants, 1990, section 2.1.4. After each
/// segment the heading H turns toward the vector T by e |H x T| radians about H x T. The number e is the
/// branch's susceptibility to bending. As in cpfg there may be several tropisms. Each has its own elasticity,
/// which is part of the turtle's state and can be changed by symbols.
#include <cstddef>
#include <vector>

#include "core/geom/plant/frame.h"

namespace seedmesh {

struct Tropism {
  glm::dvec3 direction{0, -1, 0};  ///< T; its length matters
  double elasticity = 0;           ///< initial e, radians
  double step = 0;                 ///< the amount that one @T adds and one @Td subtracts
};

/// Tropisms and the current elasticity of each, with a stack for branches.
class Tropisms {
 public:
  explicit Tropisms(std::vector<Tropism> all);

  std::size_t size() const { return all_.size(); }
  /// An index past the last tropism has no effect.
  void set(std::size_t index, double elasticity);
  void change(std::size_t index, double steps);

  /// Returns the frame turned by all tropisms after a segment. `share` is the drawn fraction of the segment.
  Frame turned(const Frame& frame, double share = 1) const;

  const std::vector<double>& elasticities() const { return elasticity_; }

  void push() { stack_.insert(stack_.end(), elasticity_.begin(), elasticity_.end()); }
  void pop();  ///< has no effect without a matching push

 private:
  std::vector<Tropism> all_;
  std::vector<double> elasticity_;
  std::vector<double> stack_;
};

}  // namespace seedmesh

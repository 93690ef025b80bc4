#include "core/geom/polygon/orientation.h"

#include <array>
#include <cmath>

namespace seedmesh {
namespace {

// Shewchuk's bound for the determinant of differences: (3 + 16 u) u, where u is 2^-53.
constexpr double unit_roundoff = 1.1102230246251565e-16;
constexpr double error_share = (3 + 16 * unit_roundoff) * unit_roundoff;

struct Pair {
  double value, error;  ///< their sum is exact
};

/// Knuth's two-sum.
Pair sum_of(double a, double b) {
  const double sum = a + b, from_b = sum - a;
  return {sum, (a - (sum - from_b)) + (b - from_b)};
}

/// Veltkamp's split into halves of 26 bits.
Pair halves_of(double a) {
  const double scaled = 134217729.0 * a, high = scaled - (scaled - a);
  return {high, a - high};
}

/// Dekker's product.
Pair product_of(double a, double b) {
  const double product = a * b;
  const Pair p = halves_of(a), q = halves_of(b);
  return {product,
          p.error * q.error - (((product - p.value * q.value) - p.error * q.value) - p.value * q.error)};
}

int sign_of_difference(double a, double b) { return a > b ? 1 : a < b ? -1 : 0; }

/// The sign of a sum of products, exactly: the sum is kept as components that do not overlap.
class ExactSum {
 public:
  void add_product(double a, double b) {
    const Pair product = product_of(a, b);
    add(product.error);
    add(product.value);
  }

  int sign() const {
    for (std::size_t i = count_; i-- > 0;) {
      if (components_[i] != 0) return components_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  void add(double value) {
    for (std::size_t i = 0; i < count_; ++i) {
      const Pair sum = sum_of(value, components_[i]);
      components_[i] = sum.error;
      value = sum.value;
    }
    components_[count_++] = value;
  }

  std::array<double, 12> components_{};  ///< the largest is last
  std::size_t count_ = 0;
};

}  // namespace

int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
  const double area = left - right, bound = error_share * (std::abs(left) + std::abs(right));
  if (area > bound) return 1;
  if (area < -bound) return -1;
  // Points on one line, as on the edges of a grid, mostly have exact differences. Their products round to two numbers
  // in the order of the products, or to the same number with errors in this order.
  const Pair along_x = sum_of(b.x, -a.x), along_y = sum_of(b.y, -a.y);
  const Pair to_x = sum_of(c.x, -a.x), to_y = sum_of(c.y, -a.y);
  if (along_x.error == 0 && along_y.error == 0 && to_x.error == 0 && to_y.error == 0) {
    const Pair one = product_of(along_x.value, to_y.value), other = product_of(along_y.value, to_x.value);
    return one.value != other.value ? sign_of_difference(one.value, other.value)
                                    : sign_of_difference(one.error, other.error);
  }
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(c.x, a.y);
  sum.add_product(-c.y, a.x);
  return sum.sign();
}

}  // namespace seedmesh

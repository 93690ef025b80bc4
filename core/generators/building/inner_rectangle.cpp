#include "core/generators/building/inner_rectangle.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::building {
namespace {

constexpr std::size_t most_corners = 400;  ///< whose x is a border of slabs; of more corners every n-th
constexpr int first_steps = 64, later_steps = 24, rounds = 3;

struct Interval {
  double low = 0, high = 0;
};
using Intervals = std::vector<Interval>;

class Search {
 public:
  Search(const std::vector<std::vector<glm::dvec2>>& rings, const Job& job) : rings_(rings), job_(job) {}

  InnerRectangle run() {
    std::vector<double> xs;
    double low = 1e300, high = -1e300;
    std::size_t corners = 0;
    for (const auto& ring : rings_) corners += ring.size();
    const std::size_t every = 1 + corners / most_corners;
    std::size_t number = 0;
    for (const auto& ring : rings_) {
      for (const glm::dvec2& p : ring) {
        low = std::min(low, p.x);
        high = std::max(high, p.x);
        if (number++ % every == 0) xs.push_back(p.x);
      }
    }
    if (!(high > low)) return {};
    const std::vector<double> fixed = xs;
    for (int i = 0; i <= first_steps; ++i) xs.push_back(low + (high - low) * i / first_steps);
    sweep(xs);
    double reach = (high - low) / first_steps;
    for (int round = 0; round < rounds && best_.area() > 0; ++round) {
      // Finer steps around the best sides, and the corners near to them.
      xs.clear();
      for (const double side : {best_.low.x, best_.high.x}) {
        for (int i = -later_steps; i <= later_steps; ++i)
          xs.push_back(std::clamp(side + reach * i / later_steps, low, high));
        for (const double x : fixed) {
          if (std::abs(x - side) <= reach) xs.push_back(x);
        }
      }
      sweep(xs);
      reach /= 0.5 * later_steps;
    }
    return best_;
  }

 private:
  void sweep(std::vector<double> xs) {
    std::ranges::sort(xs);
    const double least = 1e-9 * std::max(xs.back() - xs.front(), 1e-9);
    xs.erase(std::unique(xs.begin(), xs.end(), [&](double a, double b) { return b - a < least; }), xs.end());
    std::vector<Intervals> slabs;
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) slabs.push_back(free_in(xs[i], xs[i + 1]));
    for (std::size_t i = 0; i < slabs.size(); ++i) {
      Intervals open = slabs[i];
      for (std::size_t k = i; k < slabs.size() && !open.empty(); ++k) {
        if (k > i) open = common(open, slabs[k]);
        for (const Interval& each : open) {
          const InnerRectangle found{{xs[i], each.low}, {xs[k + 1], each.high}};
          if (found.area() > best_.area() * (1 + 1e-12)) best_ = found;
        }
      }
      job_.check();
    }
  }

  static Intervals common(const Intervals& a, const Intervals& b) {
    Intervals out;
    for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
      const Interval both{std::max(a[i].low, b[k].low), std::min(a[i].high, b[k].high)};
      if (both.high > both.low) out.push_back(both);
      (a[i].high < b[k].high ? i : k) += 1;
    }
    return out;
  }

  /// The intervals of y that are inside for all x from `from` to `to`: the gaps between edges there.
  Intervals free_in(double from, double to) const {
    Intervals covered;
    std::vector<double> crossings;  // of the middle line
    const double middle = 0.5 * (from + to);
    for (const auto& ring : rings_) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        if ((a.x > middle) != (b.x > middle))
          crossings.push_back(a.y + (b.y - a.y) * ((middle - a.x) / (b.x - a.x)));
        if (a.x > b.x) std::swap(a, b);
        if (b.x <= from || a.x >= to) continue;
        const auto at = [&](double x) {
          return b.x == a.x ? a.y : a.y + (b.y - a.y) * std::clamp((x - a.x) / (b.x - a.x), 0.0, 1.0);
        };
        const double p = at(from), q = at(to);
        covered.push_back({std::min(p, q), std::max(p, q)});
      }
    }
    std::ranges::sort(crossings);
    std::ranges::sort(covered, {}, &Interval::low);
    Intervals out;
    double top = covered.empty() ? 0 : covered.front().low;
    for (const Interval& each : covered) {
      if (each.low > top) {
        const double y = 0.5 * (top + each.low);
        const auto below = std::ranges::lower_bound(crossings, y) - crossings.begin();
        if (below % 2 == 1) out.push_back({top, each.low});
      }
      top = std::max(top, each.high);
    }
    return out;
  }

  const std::vector<std::vector<glm::dvec2>>& rings_;
  const Job& job_;
  InnerRectangle best_;
};

}  // namespace

InnerRectangle inner_rectangle(const std::vector<std::vector<glm::dvec2>>& rings, const Job& job) {
  return Search(rings, job).run();
}

}  // namespace seedmesh::building

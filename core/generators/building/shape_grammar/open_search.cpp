#include "core/generators/building/shape_grammar/open_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/generators/building/shape_grammar/open_equations.h"

namespace seedmesh::building {
namespace {

bool lies_on(const glm::dvec3& p, const FigureLine& line, double near) {
  const glm::dvec3 along = line.to - line.from;
  const double length = glm::length(along);
  if (!(length > 0)) return false;
  const double at = glm::dot(p - line.from, along) / length;
  return at >= -near && at <= length + near && glm::length(p - line.from - along * (at / length)) <= near;
}

/// An anchor that is, for all values of the variables, the same weighted sum of those that are searched.
struct ImpliedAnchor {
  std::uint32_t anchor = 0;
  std::vector<double> weights;  ///< by position in the order; their sum is 1
  double near = 0;              ///< how far rounding may move the sum
};

std::vector<ImpliedAnchor> implied_anchors(const std::vector<OpenAnchor>& anchors,
                                           std::span<const std::uint32_t> order, double near) {
  constexpr double rounding = 1e-9;
  std::vector<ImpliedAnchor> out;
  for (std::uint32_t i = 0; i < anchors.size(); ++i) {
    if (std::ranges::find(order, i) != order.end()) continue;
    Rows rows{std::vector<double>(order.size() + 1, 1.0)};
    const auto add = [&](const auto& part_of) {
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<double>& row = rows.emplace_back();
        for (const std::uint32_t each : order) row.push_back(part_of(anchors[each])[axis]);
        row.push_back(part_of(anchors[i])[axis]);
      }
    };
    add([](const OpenAnchor& each) { return each.at; });
    for (std::size_t k = 0; k < anchors[i].changes.size(); ++k)
      add([k](const OpenAnchor& each) { return each.changes[k]; });
    ImpliedAnchor implied{i, {}, near};
    if (solve(rows, implied.weights) < order.size()) continue;
    for (const double weight : implied.weights) implied.near += near * std::abs(weight);
    const bool is_sum = std::ranges::all_of(rows, [&](const std::vector<double>& row) {
      double rest = -row.back(), largest = std::abs(row.back());
      for (std::size_t c = 0; c < order.size(); ++c) {
        rest += row[c] * implied.weights[c];
        largest = std::max(largest, std::abs(row[c] * implied.weights[c]));
      }
      return std::abs(rest) <= rounding * largest;
    });
    if (is_sum) out.push_back(std::move(implied));
  }
  return out;
}

class PointSearch {
 public:
  PointSearch(const std::vector<OpenAnchor>& anchors, std::span<const std::uint32_t> order,
              const FigurePoints& points, const std::function<void()>& look,
              const std::function<void(const std::vector<glm::dvec3>&)>& found)
      : anchors_(anchors),
        order_(order),
        points_(points),
        look_(look),
        found_(found),
        implied_(implied_anchors(anchors, order, points.near)) {}

  void run() {
    if (chosen_.size() == order_.size()) {
      const auto is_there = [this](const ImpliedAnchor& each) { return may_be_there(each); };
      if (std::ranges::all_of(implied_, is_there)) found_(at_);
      return;
    }
    const OpenAnchor& anchor = anchors_[order_[chosen_.size()]];
    const auto of_kind = points_.by_kind.find(anchor.kind);
    if (of_kind == points_.by_kind.end()) return;
    for (const std::uint32_t each : choices(anchor, of_kind->second)) {
      look_();
      const FigureAnchor& point = of_kind->second[each];
      if (!fits(anchor, each, point)) continue;
      chosen_.push_back(each);
      taken_.push_back(point);
      at_.push_back(point.at);
      run();
      chosen_.pop_back();
      taken_.pop_back();
      at_.pop_back();
    }
  }

 private:
  bool is_joined(const OpenAnchor& anchor, std::size_t before) const {
    return anchor.kind == anchor_crossing && anchors_[order_[before]].kind == anchor_crossing &&
           std::ranges::find(anchor.beside, order_[before]) != anchor.beside.end();
  }

  /// The points that can be meant: all, or those on lines through a point that is chosen.
  std::vector<std::uint32_t> choices(const OpenAnchor& anchor, const std::vector<FigureAnchor>& all) const {
    std::vector<std::uint32_t> out;
    for (std::size_t before = 0; before < chosen_.size(); ++before) {
      if (!is_joined(anchor, before)) continue;
      for (const std::uint32_t line : points_.on_lines.lines_of_point[chosen_[before]]) {
        const std::vector<std::uint32_t>& on = points_.on_lines.points_of_line[line];
        out.insert(out.end(), on.begin(), on.end());
      }
      std::ranges::sort(out);
      out.erase(std::unique(out.begin(), out.end()), out.end());
      return out;
    }
    out.resize(all.size());
    std::iota(out.begin(), out.end(), 0U);
    return out;
  }

  bool fits(const OpenAnchor& anchor, std::uint32_t number, const FigureAnchor& point) const {
    for (std::size_t before = 0; before < chosen_.size(); ++before) {
      const OpenAnchor& other = anchors_[order_[before]];
      if (other.kind == anchor.kind && chosen_[before] == number) return false;
      if (anchor.owner != no_owner && other.owner != no_owner &&
          (anchor.owner == other.owner) != (point.owner == taken_[before].owner))
        return false;
      // Corners have a bit for each direction, so that those of an edge differ in one.
      if (anchor.owner != no_owner && anchor.owner == other.owner && anchor.kind == other.kind &&
          std::popcount(anchor.corner ^ other.corner) != std::popcount(point.corner ^ taken_[before].corner))
        return false;
      if (is_joined(anchor, before) && !on_one_line(chosen_[before], number)) return false;
    }
    return true;
  }

  /// False where the figure has no point at the position of this anchor, or no line to it.
  bool may_be_there(const ImpliedAnchor& implied) const {
    const OpenAnchor& anchor = anchors_[implied.anchor];
    glm::dvec3 p(0);
    for (std::size_t i = 0; i < at_.size(); ++i) p += implied.weights[i] * at_[i];
    if (anchor.owner != no_owner) {
      const auto of_kind = points_.by_kind.find(anchor.kind);
      return of_kind != points_.by_kind.end() &&
             std::ranges::any_of(of_kind->second, [&](const FigureAnchor& each) {
               return glm::length(each.at - p) <= implied.near;
             });
    }
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      if (anchors_[order_[i]].kind != anchor_crossing) continue;
      if (std::ranges::find(anchor.beside, order_[i]) == anchor.beside.end()) continue;
      const auto& lines = points_.on_lines.lines_of_point[chosen_[i]];
      const auto is_on = [&](std::uint32_t line) { return lies_on(p, points_.lines[line], implied.near); };
      if (std::ranges::none_of(lines, is_on)) return false;
    }
    return true;
  }

  bool on_one_line(std::uint32_t a, std::uint32_t b) const {
    const std::vector<std::uint32_t>& mine = points_.on_lines.lines_of_point[a];
    const std::vector<std::uint32_t>& theirs = points_.on_lines.lines_of_point[b];
    return std::ranges::any_of(
        mine, [&](std::uint32_t line) { return std::ranges::find(theirs, line) != theirs.end(); });
  }

  const std::vector<OpenAnchor>& anchors_;
  std::span<const std::uint32_t> order_;
  const FigurePoints& points_;
  const std::function<void()>& look_;
  const std::function<void(const std::vector<glm::dvec3>&)>& found_;
  std::vector<ImpliedAnchor> implied_;
  std::vector<std::uint32_t> chosen_;
  std::vector<FigureAnchor> taken_;
  std::vector<glm::dvec3> at_;
};

}  // namespace

LinePoints line_points(const std::vector<FigureLine>& lines, const std::vector<FigureAnchor>& crossings,
                       double near, const Job& job) {
  LinePoints out;
  out.lines_of_point.resize(crossings.size());
  out.points_of_line.resize(lines.size());
  std::size_t all = 0;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    job.check();
    for (std::uint32_t k = 0; k < crossings.size(); ++k) {
      if (!lies_on(crossings[k].at, lines[i], near)) continue;
      out.points_of_line[i].push_back(k);
      out.lines_of_point[k].push_back(i);
      ++all;
    }
  }
  out.per_line = lines.empty() ? 0 : static_cast<double>(all) / static_cast<double>(lines.size());
  return out;
}

void search_points(const std::vector<OpenAnchor>& anchors, std::span<const std::uint32_t> order,
                   const FigurePoints& points, const std::function<void()>& look,
                   const std::function<void(const std::vector<glm::dvec3>&)>& found) {
  PointSearch(anchors, order, points, look, found).run();
}

}  // namespace seedmesh::building

/// The order in which anchors of left shapes with open variables are searched.
#include <algorithm>

#include "core/generators/building/shape_grammar/open_equations.h"

namespace seedmesh::building {
namespace {

constexpr double fixed_direction = 1e-7;  ///< the part of a change across a direction, relative to it

/// Chooses anchors in the order of the search.
class AnchorChoice {
 public:
  AnchorChoice(const std::vector<OpenAnchor>& anchors, bool is_flat, bool with_wholes,
               const std::map<std::uint32_t, std::size_t>& counts, double per_line)
      : anchors_(anchors),
        is_flat_(is_flat),
        with_wholes_(with_wholes),
        counts_(counts),
        per_line_(per_line) {}

  /// Adds the anchor with the fewest candidates that adds equations, until there are enough. Empty: there are not.
  std::vector<std::uint32_t> run() {
    if (!is_flat_ && !take_frame()) return {};
    Rows rows;
    for (const std::uint32_t each : order_) add_rows(rows, anchors_[each], anchors_[each].sample, is_flat_);
    std::vector<double> ignored;
    for (std::size_t rank = rows.empty() ? 0 : solve(rows, ignored);
         rank < unknowns_of(anchors_[0].changes.size());) {
      std::uint32_t best = no_owner;
      std::size_t reached = rank;
      for (std::uint32_t i = 0; i < anchors_.size(); ++i) {
        if (!is_usable(i) || (best != no_owner && cost_of(i) >= cost_of(best))) continue;
        Rows more = rows;
        add_rows(more, anchors_[i], anchors_[i].sample, is_flat_);
        const std::size_t now = solve(more, ignored);
        if (now <= rank) continue;
        best = i;
        reached = now;
      }
      if (best == no_owner) return {};
      add_rows(rows, anchors_[best], anchors_[best].sample, is_flat_);
      rank = reached;
      take(best);
    }
    return order_;
  }

  double cost() const { return cost_; }  ///< the number of combinations that the search tries

 private:
  bool is_usable(std::uint32_t i) const { return with_wholes_ || anchors_[i].owner == no_owner; }

  double cost_of(std::uint32_t i) const {
    const OpenAnchor& each = anchors_[i];
    const bool is_known = std::ranges::any_of(
        order_, [&](std::uint32_t k) { return each.owner != no_owner && anchors_[k].owner == each.owner; });
    if (is_known) return 4;
    const bool is_beside = std::ranges::any_of(
        order_, [&](std::uint32_t k) { return std::ranges::find(each.beside, k) != each.beside.end(); });
    const auto found = counts_.find(each.kind);
    const double count = found == counts_.end() ? 0.0 : static_cast<double>(found->second);
    return is_beside && each.kind == anchor_crossing ? std::min(count, 2 * per_line_) : count;
  }

  void take(std::uint32_t i) {
    cost_ *= cost_of(i);
    order_.push_back(i);
  }

  std::vector<std::uint32_t> by_cost() const {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < anchors_.size(); ++i) {
      if (is_usable(i)) out.push_back(i);
    }
    std::ranges::stable_sort(out, {}, [&](std::uint32_t i) { return cost_of(i); });
    return out;
  }

  /// Takes three anchors whose frame does not depend on the variables.
  bool take_frame() {
    for (const std::uint32_t a : by_cost()) {
      const double before = cost_;
      take(a);
      for (const std::uint32_t b : by_cost()) {
        if (!has_fixed_direction(a, b)) continue;
        for (const std::uint32_t c : by_cost()) {
          if (!has_fixed_plane(a, b, c)) continue;
          take(b);
          take(c);
          return true;
        }
      }
      order_.clear();
      cost_ = before;
    }
    return false;
  }

  bool has_fixed_direction(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 u = anchors_[b].sample - anchors_[a].sample;
    if (!(glm::length(u) > 0)) return false;
    for (std::size_t k = 0; k < anchors_[a].changes.size(); ++k) {
      const glm::dvec3 change = anchors_[b].changes[k] - anchors_[a].changes[k];
      if (glm::length(glm::cross(u, change)) > fixed_direction * glm::length(u)) return false;
    }
    return true;
  }

  bool has_fixed_plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const glm::dvec3 u = anchors_[b].sample - anchors_[a].sample, w = anchors_[c].sample - anchors_[a].sample;
    const glm::dvec3 normal = glm::cross(u, w);
    const double area = glm::length(normal);
    if (!(area > 1e-6 * glm::length(u) * glm::length(w))) return false;
    for (std::size_t k = 0; k < anchors_[a].changes.size(); ++k) {
      const glm::dvec3 change = anchors_[c].changes[k] - anchors_[a].changes[k];
      if (glm::length(glm::cross(normal, glm::cross(u, change))) > fixed_direction * area * glm::length(u))
        return false;
    }
    return true;
  }

  const std::vector<OpenAnchor>& anchors_;
  bool is_flat_, with_wholes_;
  const std::map<std::uint32_t, std::size_t>& counts_;
  double per_line_;
  std::vector<std::uint32_t> order_;
  double cost_ = 1;
};

}  // namespace

std::vector<std::uint32_t> search_order(const std::vector<OpenAnchor>& anchors, bool is_flat,
                                        const std::map<std::uint32_t, std::size_t>& counts, double per_line) {
  AnchorChoice all(anchors, is_flat, true, counts, per_line),
      lines(anchors, is_flat, false, counts, per_line);
  std::vector<std::uint32_t> of_all = all.run(), of_lines = lines.run();
  return of_all.empty() || (!of_lines.empty() && lines.cost() < all.cost()) ? of_lines : of_all;
}

}  // namespace seedmesh::building

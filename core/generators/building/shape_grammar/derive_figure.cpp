/// Matching and application of the rules of a shape grammar.
#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/math.h"
#include "core/generators/building/shape_grammar/anchors.h"
#include "core/generators/building/shape_grammar/open_search.h"
#include "core/generators/building/shape_grammar/shape_grammar.h"

namespace seedmesh::building {
namespace {

constexpr std::uint64_t most_steps = 100'000;
constexpr std::size_t most_matches = 1'000'000;  ///< at a time
constexpr double smallest = 1e-5;                ///< share of the figure; smaller shapes do not match
constexpr double farthest = 1e6;                 ///< metres
constexpr double implied_near = 1e-4;  ///< share of the figure; ten times the deviation that fits() allows

/// A match of a rule, with the markers and solids that it replaces.
struct FigureMatch {
  std::size_t pair = 0;
  Similarity place;
  std::vector<std::uint32_t> markers, solids;
  std::vector<double> values;  ///< of open variables
};

glm::dmat3 frame_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, bool is_flat) {
  const glm::dvec3 x = math::unit(b - a, glm::dvec3(1, 0, 0));
  const glm::dvec3 z = is_flat ? glm::dvec3(0, 1, 0) : math::unit(glm::cross(x, c - a), glm::dvec3(0, 1, 0));
  return {x, glm::cross(z, x), z};
}

class FigureRun {
 public:
  FigureRun(const BuildingShapeGrammar& given, const FigureGrammar& grammar, Job& job)
      : given_(given), grammar_(grammar), job_(job), meter_(job, Resource::shapes) {
    out_.figure = grammar.initial;
    meter_.spend(out_.figure.lines.size() + out_.figure.markers.size() + out_.figure.solids.size());
    for (const FigurePair& pair : grammar.pairs) {
      open_anchors_.push_back(pair.open.empty() ? std::vector<OpenAnchor>{} : open_anchors(pair));
      bool is_determined = false;
      anchors_.push_back(anchors_of_left(pair.left, grammar.is_flat, is_determined));
      double extent = 0;
      for (const FigureAnchor& each : anchors_.back())
        extent = std::max(extent, glm::length(each.at - anchors_.back().front().at));
      extents_.push_back(extent);
    }
  }

  DerivedFigure run(std::optional<int> steps, bool is_parallel) {
    const Rng random = job_.rng().at("shape grammar");
    for (std::uint64_t step = 0; !steps || step < static_cast<std::uint64_t>(*steps); ++step) {
      if (step >= most_steps) {
        job_.refuse(
            limit_issue({Resource::steps, most_steps, most_steps + 1},
                        "the rules match more than 100,000 times; set iterations, or add a rule that ends it",
                        "/shape_grammar/rules"));
      }
      find_matches();
      const Rng here = random.at(step);
      out_.fits_nowhere = step == 0 && matches_.empty();
      if (matches_.empty() || !(is_parallel ? apply_all(here) : apply_one(here))) break;
      ++out_.steps;
      job_.check();
    }
    return std::move(out_);
  }

 private:
  // Finding

  void find_matches() {
    reach_ = std::max(reach_of(out_.figure), 1e-9);
    near_ = 1e-7 * reach_;
    candidates_.clear();
    counts_.clear();
    has_crossings_ = false;
    on_lines_.reset();
    for (const FigureAnchor& each : anchors_of_wholes(out_.figure)) enter(each);
    for (const FigureAnchor& each : ends_of(out_.figure.lines)) enter(each);
    // Crossings are computed when a rule needs them. Until then they count as frequent.
    counts_[anchor_crossing] = out_.figure.lines.size() * 2 + 1;
    counts_[anchor_end] = out_.figure.lines.size() * 4 + 2;
    matches_.clear();
    for (std::size_t i = 0; i < grammar_.pairs.size(); ++i) {
      if (grammar_.pairs[i].weight > 0) grammar_.pairs[i].open.empty() ? match(i) : match_open(i);
    }
  }

  void enter(const FigureAnchor& anchor) {
    candidates_[anchor.kind].push_back(anchor);
    ++counts_[anchor.kind];
  }

  const std::vector<FigureAnchor>& candidates(std::uint32_t kind) {
    if (kind == anchor_crossing && !has_crossings_) {
      has_crossings_ = true;
      candidates_[kind] = crossings_of(out_.figure.lines, near_, &job_);
      // Crossings of several pairs at one position count once.
      std::vector<FigureAnchor>& all = candidates_[kind];
      std::ranges::stable_sort(all, [](const FigureAnchor& a, const FigureAnchor& b) {
        return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.z != b.at.z ? a.at.z < b.at.z : a.at.y < b.at.y;
      });
      all.erase(std::unique(all.begin(), all.end(),
                            [&](const FigureAnchor& a, const FigureAnchor& b) {
                              return glm::length(a.at - b.at) <= near_;
                            }),
                all.end());
    }
    return candidates_[kind];
  }

  void match(std::size_t index) {
    const std::array<FigureAnchor, 3> left = chosen_anchors(anchors_[index], grammar_.is_flat, counts_);
    const double base = glm::length(left[1].at - left[0].at);
    if (!(base > 0)) return;
    const auto of_same_owner = [&](std::size_t k, const FigureAnchor& found, std::size_t other,
                                   const FigureAnchor& other_found) {
      return left[k].owner == no_owner || left[other].owner == no_owner ||
             (left[k].owner == left[other].owner) == (found.owner == other_found.owner);
    };
    const std::vector<FigureAnchor> first = candidates(left[0].kind), second = candidates(left[1].kind);
    const std::vector<FigureAnchor> third =
        grammar_.is_flat ? std::vector<FigureAnchor>(1) : candidates(left[2].kind);
    for (const FigureAnchor& p : first) {
      for (const FigureAnchor& q : second) {
        look();
        if (!of_same_owner(1, q, 0, p)) continue;
        const double scale = glm::length(q.at - p.at) / base;
        if (!(scale * extents_[index] > smallest * reach_)) continue;
        const double near = near_of(index, scale);
        for (const FigureAnchor& r : third) {
          if (!grammar_.is_flat) {
            look();
            if (!of_same_owner(2, r, 0, p) || !of_same_owner(2, r, 1, q)) continue;
            if (std::abs(glm::length(r.at - p.at) - scale * glm::length(left[2].at - left[0].at)) > near ||
                std::abs(glm::length(r.at - q.at) - scale * glm::length(left[2].at - left[1].at)) > near)
              continue;
          }
          try_place(index, {left[0].at, left[1].at, left[2].at}, {p.at, q.at, r.at}, scale);
        }
      }
    }
  }

  /// Matches a left shape whose variables are open.
  void match_open(std::size_t index) {
    const std::vector<OpenAnchor>& anchors = open_anchors_[index];
    const std::vector<FigureAnchor>& crossings = candidates(anchor_crossing);
    if (!on_lines_) on_lines_ = line_points(out_.figure.lines, crossings, near_, job_);
    counts_[anchor_crossing] = crossings.size();
    const std::vector<std::uint32_t> order =
        search_order(anchors, grammar_.is_flat, counts_, on_lines_->per_line);
    search_points(
        anchors, order, {candidates_, *on_lines_, out_.figure.lines, implied_near * reach_},
        [this] { look(); },
        [&](const std::vector<glm::dvec3>& points) {
          for (const bool is_mirrored : {false, true}) {
            if (is_mirrored && !grammar_.mirrors) break;
            const std::optional<OpenPlacement> place =
                solve_placement(anchors, order, points, grammar_.is_flat, is_mirrored);
            if (place) try_open(index, *place);
          }
        });
  }

  void try_open(std::size_t index, const OpenPlacement& found) {
    const FigurePair& pair = grammar_.pairs[index];
    FigureMatch match;
    match.pair = index;
    match.place = found.place;
    match.values = found.values;
    for (std::size_t k = 0; k < pair.open.size(); ++k) {
      const double rounding = 1e-9 * std::max(std::abs(pair.open[k].low), std::abs(pair.open[k].high));
      if (match.values[k] < pair.open[k].low - rounding || match.values[k] > pair.open[k].high + rounding)
        return;
    }
    const Figure left = left_shape(pair, match.values);
    double extent = 0, shortest = 1e300;
    for (const FigureLine& line : left.lines) {
      extent = std::max(
          {extent, glm::length(line.to - left.lines[0].from), glm::length(line.from - left.lines[0].from)});
      shortest = std::min(shortest, glm::length(line.to - line.from));
    }
    for (const FigureSolid& solid : left.solids) {
      if (std::min({solid.size.x, solid.size.z, grammar_.is_flat ? 1.0 : solid.size.y}) <= 0) return;
      extent = std::max(extent, glm::length(solid.size));
    }
    if (extent == 0) extent = std::max(reach_of(left), 1e-9);
    if (!(match.place.scale * extent > smallest * reach_) || shortest <= 1e-6 * extent) return;
    if (!fits(left, 1e-5 * match.place.scale * extent + 1e-11 * reach_, match)) return;
    if (right_of(match)) keep(std::move(match));
  }

  /// The right shape for the values of a match; null: its condition is false.
  std::optional<Figure> right_of(const FigureMatch& match) {
    const FigurePair& pair = grammar_.pairs[match.pair];
    if (pair.open.empty()) return pair.right;
    std::vector<Issue> issues;
    std::optional<Figure> right =
        right_shape(given_, grammar_, match.pair, named(pair, match.values), issues);
    if (issues.empty()) return right;
    std::string values;
    for (std::size_t k = 0; k < pair.open.size(); ++k)
      values += (k > 0 ? ", " : "") + pair.open[k].name + " = " + std::to_string(match.values[k]);
    job_.refuse({issues[0].kind, issues[0].pointer, issues[0].message + ", where a match has " + values});
  }

  void look() {
    if ((++looked_ & 4095U) == 0) job_.check();
  }

  double near_of(std::size_t index, double scale) const {
    return 1e-5 * scale * extents_[index] + 1e-11 * reach_;
  }

  void try_place(std::size_t index, const std::array<glm::dvec3, 3>& from,
                 const std::array<glm::dvec3, 3>& to, double scale) {
    const glm::dmat3 own = glm::transpose(frame_of(from[0], from[1], from[2], grammar_.is_flat));
    glm::dmat3 there = frame_of(to[0], to[1], to[2], grammar_.is_flat);
    for (const bool is_mirrored : {false, true}) {
      if (is_mirrored && !grammar_.mirrors) break;
      // In the plane the axis across the line is mirrored, in space the normal of the triangle.
      if (is_mirrored) there[grammar_.is_flat ? 1 : 2] = -there[grammar_.is_flat ? 1 : 2];
      FigureMatch found;
      found.pair = index;
      found.place.turn = there * own;
      found.place.scale = scale;
      found.place.shift = to[0] - found.place.turn * (scale * from[0]);
      if (fits(grammar_.pairs[index].left, near_of(index, scale), found)) keep(std::move(found));
    }
  }

  /// Whether the whole left shape is part of the figure.
  bool fits(const Figure& left, double near, FigureMatch& match) {
    const Figure& figure = out_.figure;
    for (const FigureMarker& each : left.markers) {
      const FigureMarker marker = match.place.of(each);
      const auto found = std::ranges::find_if(
          figure.markers, [&](const FigureMarker& other) { return are_equal(other, marker, near); });
      if (found == figure.markers.end()) return false;
      match.markers.push_back(static_cast<std::uint32_t>(found - figure.markers.begin()));
    }
    for (const FigureSolid& each : left.solids) {
      const FigureSolid solid = match.place.of(each);
      const auto found = std::ranges::find_if(
          figure.solids, [&](const FigureSolid& other) { return are_equal(other, solid, near); });
      if (found == figure.solids.end()) return false;
      match.solids.push_back(static_cast<std::uint32_t>(found - figure.solids.begin()));
    }
    return std::ranges::all_of(left.lines, [&](const FigureLine& line) {
      return contains(figure.lines, match.place.of(line), near);
    });
  }

  /// Keeps a match. A symmetrical left shape matches in several ways; those with the same result count once.
  void keep(FigureMatch match) {
    const auto is_same = [&](const FigureMatch& other) {
      for (std::size_t k = 0; k < match.values.size() && other.pair == match.pair; ++k) {
        if (std::abs(other.values[k] - match.values[k]) > 1e-6 * (1 + std::abs(match.values[k])))
          return false;
      }
      return other.pair == match.pair && other.markers == match.markers && other.solids == match.solids &&
             glm::length(other.place.shift - match.place.shift) <= near_ &&
             glm::length(other.place.turn[0] - match.place.turn[0]) <= 1e-6 &&
             glm::length(other.place.turn[1] - match.place.turn[1]) <= 1e-6 &&
             glm::length(other.place.turn[2] - match.place.turn[2]) <= 1e-6;
    };
    // Only the latest matches can be equal: they come from the same points.
    const std::size_t from = matches_.size() > 64 ? matches_.size() - 64 : 0;
    if (std::any_of(matches_.begin() + static_cast<std::ptrdiff_t>(from), matches_.end(), is_same)) return;
    if (matches_.size() == most_matches) {
      job_.refuse(limit_issue({Resource::steps, most_matches, most_matches + 1},
                              "the rules have more than 1,000,000 matches at a time",
                              "/shape_grammar/rules"));
    }
    matches_.push_back(std::move(match));
  }

  // Applying

  bool apply_one(Rng random) {
    std::vector<double> weights(grammar_.pairs.size(), 0.0);
    for (const FigureMatch& match : matches_) weights[match.pair] = grammar_.pairs[match.pair].weight;
    double sum = 0;
    for (const double weight : weights) sum += weight;
    double at = random.unit() * sum;
    std::size_t pair = matches_.back().pair;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] <= 0) continue;
      at -= weights[i];
      if (at >= 0) continue;
      pair = i;
      break;
    }
    const auto count = static_cast<std::uint32_t>(std::ranges::count(matches_, pair, &FigureMatch::pair));
    std::uint32_t skip = random.below(count);
    for (const FigureMatch& match : matches_) {
      if (match.pair != pair || skip-- > 0) continue;
      apply(std::span(&match, 1));
      return true;
    }
    return false;
  }

  /// Applies as many matches as share no marker and no solid, in random order by weight.
  bool apply_all(Rng random) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      Rng own = random.at(i);
      order.emplace_back(-math::log(1 - own.unit()) / grammar_.pairs[matches_[i].pair].weight, i);
    }
    std::ranges::stable_sort(order);
    std::vector<bool> taken_markers(out_.figure.markers.size()), taken_solids(out_.figure.solids.size());
    std::vector<FigureMatch> chosen;
    for (const auto& [key, i] : order) {
      FigureMatch& match = matches_[i];
      const bool is_taken =
          std::ranges::any_of(match.markers, [&](std::uint32_t m) { return taken_markers[m]; }) ||
          std::ranges::any_of(match.solids, [&](std::uint32_t s) { return taken_solids[s]; });
      if (is_taken) continue;
      for (const std::uint32_t m : match.markers) taken_markers[m] = true;
      for (const std::uint32_t s : match.solids) taken_solids[s] = true;
      chosen.push_back(std::move(match));
    }
    apply(chosen);
    return true;
  }

  void apply(std::span<const FigureMatch> matches) {
    Figure& figure = out_.figure;
    std::vector<bool> gone_markers(figure.markers.size()), gone_solids(figure.solids.size());
    for (const FigureMatch& match : matches) {
      for (const std::uint32_t m : match.markers) gone_markers[m] = true;
      for (const std::uint32_t s : match.solids) gone_solids[s] = true;
      const FigurePair& pair = grammar_.pairs[match.pair];
      const Figure left = pair.open.empty() ? pair.left : left_shape(pair, match.values);
      for (const FigureLine& line : left.lines) {
        remove_line(figure.lines, match.place.of(line), near_);
        look();
      }
    }
    std::size_t at = 0;
    std::erase_if(figure.markers, [&](const FigureMarker&) { return gone_markers[at++]; });
    at = 0;
    std::erase_if(figure.solids, [&](const FigureSolid&) { return gone_solids[at++]; });
    for (const FigureMatch& match : matches) {
      const FigurePair& pair = grammar_.pairs[match.pair];
      ++out_.uses[pair.name];
      Figure made;
      const Figure right = *right_of(match);
      for (const FigureLine& line : right.lines) made.lines.push_back(match.place.of(line));
      for (const FigureMarker& marker : right.markers) made.markers.push_back(match.place.of(marker));
      for (const FigureSolid& solid : right.solids) made.solids.push_back(match.place.of(solid));
      meter_.spend(made.lines.size() + made.markers.size() + made.solids.size());
      if (!(reach_of(made) <= farthest)) {
        job_.refuse({IssueKind::evaluation, "/shape_grammar/rules/" + std::to_string(match.pair),
                     "this rule makes the figure larger than 1,000 km"});
      }
      add(figure, made, near_);
      if ((++added_ & 15U) == 0) job_.check();
    }
  }

  const BuildingShapeGrammar& given_;
  const FigureGrammar& grammar_;
  Job& job_;
  Meter meter_;
  DerivedFigure out_;
  std::vector<std::vector<FigureAnchor>> anchors_;  ///< of each left shape
  std::vector<double> extents_;
  std::vector<std::vector<OpenAnchor>> open_anchors_;  ///< of each left shape with open variables
  std::optional<LinePoints> on_lines_;
  std::map<std::uint32_t, std::vector<FigureAnchor>> candidates_;
  std::map<std::uint32_t, std::size_t> counts_;
  std::vector<FigureMatch> matches_;
  double reach_ = 1, near_ = 0;
  bool has_crossings_ = false;
  std::uint64_t looked_ = 0, added_ = 0;
};

}  // namespace

DerivedFigure derive_figure(const BuildingShapeGrammar& given, const FigureGrammar& grammar,
                            std::optional<int> steps, bool is_parallel, Job& job) {
  return FigureRun(given, grammar, job).run(steps, is_parallel);
}

}  // namespace seedmesh::building

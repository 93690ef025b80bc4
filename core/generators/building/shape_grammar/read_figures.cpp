/// Reads the parameters of a shape grammar: evaluates coordinates, inserts members of families, and checks
/// left shapes and restrictions.
#include <algorithm>
#include <cmath>

#include "core/generators/building/shape_grammar/anchors.h"
#include "core/generators/building/shape_grammar/figure_value.h"
#include "core/generators/building/shape_grammar/open_pairs.h"
#include "core/generators/building/shape_grammar/rotation.h"
#include "core/generators/building/shape_grammar/shape_grammar.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

using Number = std::variant<double, std::string>;
using Numbers = std::vector<Number>;

constexpr std::size_t most_elements = 2'000;  ///< each is compared with each
constexpr int deepest_family = 16;
constexpr double farthest = 1e6;  ///< metres

std::uint32_t place_in(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) names.push_back(name);
  return static_cast<std::uint32_t>(std::ranges::find(names, name) - names.begin());
}

class FigureReader {
 public:
  FigureReader(const BuildingShapeGrammar& given, FigureGrammar& grammar, std::vector<Issue>& issues)
      : given_(given), grammar_(grammar), issues_(issues), is_flat_(given.dimensions == 2) {}

  using Values = FigureValues;

  /// Adds the elements of the figure at `pointer`, with maximal lines.
  void read(const BuildingFigure& figure, const std::string& pointer, Figure& out, const Values& open = {}) {
    const Figure raw = read_raw(figure, pointer, open);
    const double near = 1e-7 * std::max(reach_of(raw), 1e-9);
    add(out, raw, near);
  }

  /// The elements as they are written, with a line for each segment.
  Figure read_raw(const BuildingFigure& figure, const std::string& pointer, const Values& open) {
    Values values = open;
    values.insert(figure.parameters.begin(), figure.parameters.end());
    Figure raw;
    read(figure, values, pointer, {}, raw);
    return raw;
  }

  double number(const Number& given, const Values& values, const std::string& pointer) {
    const auto* text = std::get_if<std::string>(&given);
    const double result =
        text == nullptr ? std::get<double>(given) : figure_value(*text, values, pointer, issues_);
    if (std::isfinite(result) && std::abs(result) <= farthest) return result;
    add_error(IssueKind::out_of_range, pointer,
              std::isfinite(result) ? "the value is beyond 1,000 km" : "the value is not a finite number");
    return 0;
  }

 private:
  void add_error(IssueKind kind, const std::string& pointer, std::string message) {
    if (issues_.size() < 100) issues_.emplace_back(kind, pointer, std::move(message));
  }

  /// A point of two or three coordinates; without coordinates it is the origin.
  glm::dvec3 point(const Numbers& given, const Values& values, const std::string& pointer) {
    const std::size_t wanted = is_flat_ ? 2 : 3;
    if (given.empty()) return glm::dvec3(0);
    if (given.size() != wanted) {
      add_error(IssueKind::invalid_value, pointer,
                "found " + std::to_string(given.size()) + " coordinates, expected " + std::to_string(wanted) +
                    " by \"dimensions\"");
      return glm::dvec3(0);
    }
    glm::dvec3 p(0);
    for (std::size_t i = 0; i < wanted; ++i)
      p[static_cast<int>(i)] = number(given[i], values, pointer + "/" + std::to_string(i));
    return is_flat_ ? glm::dvec3(p.x, 0, -p.y) : p;
  }

  glm::dmat3 turn(const Numbers& given, const Values& values, const std::string& pointer) {
    if (given.empty()) return glm::dmat3(1);
    if (given.size() == 1) return rotation_about(1, number(given[0], values, pointer + "/0"));
    if (given.size() == 2 || is_flat_) {
      add_error(IssueKind::invalid_value, pointer,
                "found " + std::to_string(given.size()) + " angles, expected " +
                    (is_flat_ ? "one" : "one or three"));
      return glm::dmat3(1);
    }
    glm::dvec3 angles(0);
    for (std::size_t i = 0; i < 3; ++i)
      angles[static_cast<int>(i)] = number(given[i], values, pointer + "/" + std::to_string(i));
    return rotation_xyz(angles);
  }

  glm::dvec3 size(const BuildingBody& body, const Values& values, const std::string& pointer) {
    const std::size_t wanted = is_flat_ ? 2 : 3;
    glm::dvec3 size(1);
    if (body.size.size() > 1 && body.size.size() != wanted) {
      add_error(
          IssueKind::invalid_value, pointer,
          "found " + std::to_string(body.size.size()) + " sizes, expected one or " + std::to_string(wanted));
      return size;
    }
    for (std::size_t i = 0; i < body.size.size(); ++i) {
      const double each = number(body.size[i], values, pointer + "/" + std::to_string(i));
      if (!(each > 0)) {
        add_error(IssueKind::out_of_range, pointer + "/" + std::to_string(i),
                  "found a size of 0 or less, expected a size above 0");
      }
      size[is_flat_ && i == 1 ? 2 : static_cast<int>(i)] = each;
    }
    if (body.size.size() == 1) size = glm::dvec3(size.x);
    if (is_flat_) size.y = 0;
    return size;
  }

  void read_solid(const BuildingBody& body, const Values& values, const std::string& pointer,
                  const Similarity& place, Figure& out) {
    FigureSolid solid;
    solid.kind = static_cast<SolidKind>(body.solid);
    solid.material = place_in(grammar_.materials, body.material);
    solid.base = point(body.at, values, pointer + "/at");
    solid.axes = turn(body.turn, values, pointer + "/turn");
    solid.size = size(body, values, pointer + "/size");
    const bool is_round =
        solid.kind == SolidKind::cylinder || solid.kind == SolidKind::cone || solid.kind == SolidKind::sphere;
    if (is_flat_ && solid.kind != SolidKind::box && solid.kind != SolidKind::cylinder) {
      add_error(IssueKind::not_available, pointer + "/solid",
                "found another kind of solid, expected box or cylinder in a figure of two dimensions");
    }
    if (is_round && solid.size.x != solid.size.z) {
      add_error(IssueKind::invalid_value, pointer + "/size",
                "found a round solid with different sizes along x and z, expected equal sizes");
    }
    if (solid.kind == SolidKind::sphere && solid.size.x != solid.size.y) {
      add_error(IssueKind::invalid_value, pointer + "/size",
                "found a sphere with different sizes, expected equal sizes");
    }
    out.solids.push_back(place.of(solid));
  }

  void read(const BuildingFigure& figure, const Values& values, const std::string& pointer,
            const Similarity& place, Figure& out) {
    for (std::size_t r = 0; r < figure.lines.size(); ++r) {
      const auto& row = figure.lines[r];
      const std::string at = pointer + "/lines/" + std::to_string(r);
      glm::dvec3 last(0);
      for (std::size_t i = 0; i < row.size() && count(at); ++i) {
        const glm::dvec3 next = place.of(point(row[i], values, at + "/" + std::to_string(i)));
        if (i > 0) out.lines.push_back({last, next});
        last = next;
      }
    }
    for (std::size_t i = 0; i < figure.solids.size(); ++i) {
      const std::string at = pointer + "/solids/" + std::to_string(i);
      if (count(at)) read_solid(figure.solids[i], values, at, place, out);
    }
    for (std::size_t i = 0; i < figure.markers.size(); ++i) {
      const BuildingMarker& given = figure.markers[i];
      const std::string at = pointer + "/markers/" + std::to_string(i);
      if (!count(at)) return;
      FigureMarker marker;
      marker.label = place_in(grammar_.labels, given.name);
      marker.count = static_cast<std::uint32_t>(given.points.size());
      for (std::uint32_t k = 0; k < marker.count; ++k)
        marker.points[k] = place.of(point(given.points[k], values, at + "/points/" + std::to_string(k)));
      out.markers.push_back(marker);
    }
    for (std::size_t i = 0; i < figure.shapes.size(); ++i) {
      const std::string at = pointer + "/shapes/" + std::to_string(i);
      if (!count(at)) return;
      read_member(figure.shapes[i], values, at, place, out);
    }
  }

  /// Adds a member of a family, with the values of this use or else those of the family.
  void read_member(const BuildingMember& member, const Values& values, const std::string& pointer,
                   const Similarity& place, Figure& out) {
    const auto found = given_.shapes.find(member.shape);
    if (found == given_.shapes.end()) {
      return add_error(IssueKind::unknown_name, pointer + "/shape",
                       "there is no family \"" + member.shape + "\" in \"shapes\"");
    }
    Values own = found->second.parameters;
    const std::string above = pointer + "/values/";
    for (const auto& [name, value] : member.values) {
      const std::string at = above + name;
      if (!own.contains(name)) {
        add_error(IssueKind::unknown_key, at,
                  "the family \"" + member.shape + "\" has no parameter of this name");
      }
      own[name] = number(value, values, at);
    }
    const double scale = number(member.scale, values, pointer + "/scale");
    if (!(scale > 0)) {
      return add_error(IssueKind::out_of_range, pointer + "/scale",
                       "found a scale of 0 or less, expected a scale above 0");
    }
    const glm::dmat3 rotation = turn(member.turn, values, pointer + "/turn");
    const glm::dvec3 at = point(member.at, values, pointer + "/at");
    glm::dmat3 flip(1);
    if (member.mirror) flip[0][0] = -1;
    if (++depth_ > deepest_family) {
      add_error(IssueKind::out_of_range, pointer + "/shape",
                "families are nested more than " + std::to_string(deepest_family) + " deep");
    } else {
      const Similarity inner{place.turn * rotation * flip, place.scale * scale, place.of(at)};
      read(found->second, own, "/shape_grammar/shapes/" + member.shape, inner, out);
    }
    --depth_;
  }

  bool count(const std::string& pointer) {
    if (++elements_ == most_elements + 1) {
      add_error(IssueKind::out_of_range, pointer,
                "more than " + std::to_string(most_elements) + " elements, counted up to this one");
    }
    return elements_ <= most_elements;
  }

  const BuildingShapeGrammar& given_;
  FigureGrammar& grammar_;
  std::vector<Issue>& issues_;
  bool is_flat_;
  int depth_ = 0;
  std::size_t elements_ = 0;
};

std::string text_of(const glm::dvec3& p, bool is_flat) {
  const auto shown = [](double x) {
    std::string text = std::to_string(x + 0.0);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
  };
  return is_flat ? "(" + shown(p.x) + ", " + shown(-p.z) + ")"
                 : "(" + shown(p.x) + ", " + shown(p.y) + ", " + shown(p.z) + ")";
}

/// Checks a restriction (Gips 1974, Kogovšek 2014): terminals of the left shape that the right shape has not,
/// and too many markers.
void check_restriction(const FigurePair& pair, const std::string& pointer, bool is_flat,
                       FigureRestriction restriction, std::vector<Issue>& issues) {
  const double near = 1e-6 * std::max(reach_of(pair.left), 1e-9);
  for (const FigureLine& line : pair.left.lines) {
    if (!contains(pair.right.lines, line, near)) {
      issues.emplace_back(
          IssueKind::invalid_value, pointer + "/pair/1",
          "the line from " + text_of(line.from, is_flat) + " to " + text_of(line.to, is_flat) +
              " of the left shape is not in the right shape, which a non-erasing grammar does not allow");
    }
  }
  for (const FigureSolid& solid : pair.left.solids) {
    if (std::ranges::none_of(pair.right.solids,
                             [&](const FigureSolid& each) { return are_equal(each, solid, near); })) {
      issues.emplace_back(
          IssueKind::invalid_value, pointer + "/pair/1",
          "the solid at " + text_of(solid.base, is_flat) +
              " of the left shape is not in the right shape, which a non-erasing grammar does not allow");
    }
  }
  if (restriction != FigureRestriction::unimarker) return;
  const auto markers = [](const Figure& figure) { return std::to_string(figure.markers.size()); };
  if (pair.left.markers.size() != 1) {
    issues.emplace_back(
        IssueKind::invalid_value, pointer + "/pair/0",
        "found " + markers(pair.left) + " markers, expected one in the left shape of a unimarker grammar");
  }
  if (pair.right.markers.size() > 1) {
    issues.emplace_back(IssueKind::invalid_value, pointer + "/pair/1",
                        "found " + markers(pair.right) +
                            " markers, expected at most one in the right shape of a unimarker grammar");
  }
}

}  // namespace

namespace {

/// Reads a pair with open variables: its left shape for several values of them, and its right shape once for its errors.
void read_open_pair(const BuildingShapeGrammar& given, std::size_t rule, FigureGrammar& grammar,
                    FigurePair& pair, std::vector<Issue>& issues) {
  const BuildingPair& source = given.rules[rule];
  const std::string pointer = "/shape_grammar/rules/" + std::to_string(rule);
  const std::size_t before = issues.size();
  check_open_variables(source, pointer, issues);
  for (const BuildingOpenVariable& each : source.open) pair.open.push_back({each.name, each.low, each.high});
  const auto left_at = [&](const std::vector<double>& values) {
    return FigureReader(given, grammar, issues)
        .read_raw(source.pair[0], pointer + "/pair/0", named(pair, values));
  };
  const std::vector<double> first = samples_of(pair, first_sample);
  pair.left = left_at(first);
  FigureReader reader(given, grammar, issues);
  if (!source.condition.empty()) reader.number(source.condition, named(pair, first), pointer + "/condition");
  reader.read(source.pair[1], pointer + "/pair/1", pair.right, named(pair, first));
  if (issues.size() > before) return;
  for (std::size_t k = 0; k < pair.open.size(); ++k) {
    std::vector<double> values = first;
    values[k] = samples_of(pair, second_sample)[k];
    pair.moved.push_back(left_at(values));
  }
  if (issues.size() > before) return;
  const std::vector<double> last = samples_of(pair, 0.9);
  check_open_left(pair, left_at(last), last, grammar.is_flat, pointer + "/pair/0", issues);
}

/// Checks that a left shape determines a similarity, and what the restriction forbids.
void check_pair(const FigurePair& pair, const std::string& pointer, bool is_flat,
                FigureRestriction restriction, std::vector<Issue>& issues) {
  bool is_determined = !pair.open.empty();  // has been checked
  if (!is_determined) anchors_of_left(pair.left, is_flat, is_determined);
  if (!is_determined) {
    issues.emplace_back(
        IssueKind::invalid_value, pointer + "/pair/0",
        std::string("this shape does not determine a position, direction and size: expected ") +
            (is_flat ? "two points" : "three points that are not on a line") +
            " of markers, corners of solids, or crossings or ends of lines");
  }
  if (restriction != FigureRestriction::any) check_restriction(pair, pointer, is_flat, restriction, issues);
}

}  // namespace

std::optional<Figure> right_shape(const BuildingShapeGrammar& given, const FigureGrammar& grammar,
                                  std::size_t rule, const FigureValues& values, std::vector<Issue>& issues) {
  const std::string pointer = "/shape_grammar/rules/" + std::to_string(rule);
  FigureGrammar names;
  names.is_flat = grammar.is_flat;
  names.labels = grammar.labels;
  names.materials = grammar.materials;
  FigureReader reader(given, names, issues);
  const std::string& condition = given.rules[rule].condition;
  if (!condition.empty() && reader.number(condition, values, pointer + "/condition") == 0)
    return std::nullopt;
  Figure right;
  reader.read(given.rules[rule].pair[1], pointer + "/pair/1", right, values);
  return right;
}

FigureGrammar read_figures(const BuildingShapeGrammar& given, FigureRestriction restriction,
                           std::vector<Issue>& issues) {
  FigureGrammar grammar;
  grammar.is_flat = given.dimensions == 2;
  grammar.mirrors = given.mirror;
  const std::size_t before = issues.size();
  FigureReader reader(given, grammar, issues);
  for (std::size_t i = 0; i < given.initial.size(); ++i)
    reader.read(given.initial[i], "/shape_grammar/initial/" + std::to_string(i), grammar.initial);
  for (std::size_t i = 0; i < given.rules.size(); ++i) {
    const std::string pointer = "/shape_grammar/rules/" + std::to_string(i);
    FigurePair pair;
    pair.name = given.rules[i].name.empty() ? "rule " + std::to_string(i + 1) : given.rules[i].name;
    pair.weight = given.rules[i].weight;
    if (!given.rules[i].open.empty()) {
      read_open_pair(given, i, grammar, pair, issues);
    } else {
      if (!given.rules[i].condition.empty()) {
        issues.emplace_back(conflict_with({"open"}), pointer + "/condition",
                            "found a condition without open variables, expected `open` as well");
      }
      reader.read(given.rules[i].pair[0], pointer + "/pair/0", pair.left);
      reader.read(given.rules[i].pair[1], pointer + "/pair/1", pair.right);
    }
    grammar.pairs.push_back(std::move(pair));
  }
  if (issues.size() > before) return grammar;
  for (std::size_t i = 0; i < grammar.pairs.size(); ++i) {
    check_pair(grammar.pairs[i], "/shape_grammar/rules/" + std::to_string(i), grammar.is_flat, restriction,
               issues);
  }
  if (restriction == FigureRestriction::unimarker && grammar.initial.markers.size() != 1) {
    issues.emplace_back(IssueKind::invalid_value, "/shape_grammar/initial",
                        "found " + std::to_string(grammar.initial.markers.size()) +
                            " markers, expected one in a unimarker grammar");
  }
  return grammar;
}

}  // namespace seedmesh::building

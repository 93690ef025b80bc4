#include "core/generators/city/given.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/generators/city/geojson.h"
#include "core/geom/polygon/segment_pairs.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double reach = 300;     // cm: ends and corners this near to another street are nodes of both
constexpr double shortest = 310;  // between two corners, cm

template <class T>
CrossSection section_of(const char* name, const T& given) {
  return {name, given.width, {given.sidewalk, given.sidewalk}, given.lanes, given.grade, given.trees};
}

/// The class of a street by the key `highway` of OpenStreetMap. A link has the class of its street.
std::size_t class_of_highway(std::string_view highway) {
  constexpr std::string_view link = "_link";
  if (highway.ends_with(link)) highway.remove_suffix(link.size());
  const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), highway) != names.end();
  };
  EdgeClass found = EdgeClass::minor;
  if (is_one_of({"motorway", "trunk"})) found = EdgeClass::highway;
  if (is_one_of({"primary", "secondary"})) found = EdgeClass::major;
  if (is_one_of({"living_street", "service", "pedestrian", "footway", "path", "track", "cycleway", "steps",
                 "bridleway", "corridor"}))
    found = EdgeClass::lane;
  return static_cast<std::size_t>(found);
}

/// Reads the properties of a feature that count. Null is as no value.
class Properties {
 public:
  Properties(const GeoFeature& street, std::vector<Issue>& issues)
      : street_(street), pointer_(street.pointer + "/properties/"), issues_(issues) {}

  double number(const char* name, double otherwise, double least, double most) const {
    const std::optional<double> value = number_property(street_, name, issues_);
    return value ? in_range(name, *value, least, most) : otherwise;
  }

  int whole(const char* name, int otherwise, int least, int most) const {
    const double value = number(name, otherwise, least, most);
    if (value != std::floor(value)) {
      issues_.emplace_back(IssueKind::invalid_value, pointer_ + name,
                           "found " + number_text(value) + ", expected a whole number");
    }
    return math::to_int32(value);
  }

  /// True, or a text of OpenStreetMap for it: `yes`, or a kind such as `viaduct`.
  bool is_true(const char* name) const {
    const Json* value = first_property(street_, name);
    return value && (*value == true || (value->is_string() && *value != "no" && *value != "false"));
  }

  /// The height level: `level`, or `layer` of OpenStreetMap for bridges and tunnels.
  int level() const {
    const int usual = is_true("bridge") ? 1 : is_true("tunnel") ? -1 : 0;
    if (find("level") || usual == 0) return whole("level", usual, -5, 5);
    const int layer = whole("layer", usual, -5, 5);
    return layer * usual > 0 ? layer : usual;
  }

  std::array<double, 2> sidewalk(const std::array<double, 2>& otherwise) const {
    const Json* value = find("sidewalk");
    if (!value) return otherwise;
    if (value->is_number()) {
      const double both = in_range("sidewalk", value->get<double>(), 0.5, 20);
      return {both, both};
    }
    if (value->is_array() && value->size() == 2 && (*value)[0].is_number() && (*value)[1].is_number()) {
      return {in_range("sidewalk", (*value)[0].get<double>(), 0.5, 20),
              in_range("sidewalk", (*value)[1].get<double>(), 0.5, 20)};
    }
    // In OpenStreetMap the value is the side: "both", "left", "no". Every street here has both.
    if (value->is_string()) return otherwise;
    issues_.emplace_back(IssueKind::wrong_type, pointer_ + "sidewalk",
                         "expected a number, or a list of two numbers");
    return otherwise;
  }

  /// The index of the class: `class`, or that of `highway` of OpenStreetMap, or `minor`.
  std::size_t street_class(const std::vector<CrossSection>& sections) const {
    const Json* name = find("class");
    const auto minor = static_cast<std::size_t>(EdgeClass::minor);
    if (!name) {
      const Json* highway = first_property(street_, "highway");
      return highway && highway->is_string() ? class_of_highway(highway->get_ref<const std::string&>())
                                             : minor;
    }
    for (auto k = static_cast<std::size_t>(EdgeClass::highway); k < first_given; ++k) {
      if (*name == sections[k].name) return k;
    }
    issues_.emplace_back(IssueKind::invalid_value, pointer_ + "class",
                         "expected highway, major, minor or lane");
    return minor;
  }

 private:
  const Json* find(const char* name) const {
    const auto at = street_.properties.find(name);
    return at == street_.properties.end() || at->is_null() ? nullptr : &*at;
  }

  double in_range(const char* name, double value, double least, double most) const {
    if (value >= least && value <= most) return value;
    issues_.emplace_back(
        IssueKind::out_of_range, pointer_ + name,
        "found " + number_text(value) + ", expected " + number_text(least) + " to " + number_text(most));
    return least;
  }

  const GeoFeature& street_;
  std::string pointer_;
  std::vector<Issue>& issues_;
};

/// A line without corners that are too near to the one before or to the end.
CmRing spaced(const CmRing& line) {
  CmRing kept = {line.front()};
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    if (distance(kept.back(), line[i]) >= shortest && distance(line[i], line.back()) >= shortest)
      kept.push_back(line[i]);
  }
  kept.push_back(line.back());
  return kept;
}

/// All segments of all lines, and where each begins.
struct Segments {
  std::vector<Segment> list;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> source;  ///< line and corner
  explicit Segments(const std::vector<GivenLine>& lines) {
    for (std::uint32_t n = 0; n < lines.size(); ++n) {
      for (std::uint32_t k = 0; k + 1 < lines[n].points.size(); ++k) {
        list.push_back({in_cm(lines[n].points[k]), in_cm(lines[n].points[k + 1])});
        source.emplace_back(n, k);
      }
    }
  }
};

/// Moves ends and corners of later lines to those of earlier ones in reach.
void merge_corners(std::vector<GivenLine>& lines) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::pair<CmPoint, int>>> cells;
  const auto cell = [](std::int32_t v) { return math::to_int32(std::floor(v / reach)); };
  for (GivenLine& line : lines) {
    for (CmPoint& p : line.points) {
      CmPoint best = p;
      double least = reach;
      for (std::int32_t dx = -1; dx <= 1; ++dx) {
        for (std::int32_t dy = -1; dy <= 1; ++dy) {
          const auto at = cells.find({cell(p.x) + dx, cell(p.y) + dy});
          if (at == cells.end()) continue;
          for (const auto& [other, level] : at->second) {
            if (level == line.level && distance(other, p) < least) {
              least = distance(other, p);
              best = other;
            }
          }
        }
      }
      if (least < reach) p = best;
    }
    line.points.erase(std::unique(line.points.begin(), line.points.end()), line.points.end());
    for (const CmPoint& p : line.points) {
      auto& list = cells[{cell(p.x), cell(p.y)}];
      if (std::find(list.begin(), list.end(), std::pair{p, line.level}) == list.end())
        list.emplace_back(p, line.level);
    }
  }
}

/// Adds the ends and corners of other lines that are in reach of a segment to its line.
void add_corners(std::vector<GivenLine>& lines) {
  const Segments segments(lines);
  std::vector<std::vector<std::pair<double, CmPoint>>> added(segments.list.size());
  const auto try_add = [&](std::size_t s, const CmPoint& p) {
    const auto [n, k] = segments.source[s];
    const CmPoint &a = lines[n].points[k], &b = lines[n].points[k + 1];
    if (distance(p, a) < shortest || distance(p, b) < shortest) return;
    if (distance_to_segment(in_cm(p), in_cm(a), in_cm(b)) >= reach) return;
    const dvec2 along = in_cm(b) - in_cm(a), off = in_cm(p) - in_cm(a);
    added[s].emplace_back(along.x * off.x + along.y * off.y, p);
  };
  each_near_pair(segments.list, reach, nullptr, [&](std::size_t s, std::size_t t) {
    const auto [n, k] = segments.source[s];
    const auto [m, l] = segments.source[t];
    if (n == m || lines[n].level != lines[m].level) return true;
    for (const std::uint32_t end : {k, k + 1}) try_add(t, lines[n].points[end]);
    for (const std::uint32_t end : {l, l + 1}) try_add(s, lines[m].points[end]);
    return true;
  });
  std::vector<CmRing> changed(lines.size());
  for (std::size_t s = 0; s < segments.list.size(); ++s) {
    const auto [n, k] = segments.source[s];
    changed[n].push_back(lines[n].points[k]);
    std::sort(added[s].begin(), added[s].end());
    for (const auto& [share, p] : added[s]) {
      if (changed[n].back() != p) changed[n].push_back(p);
    }
  }
  for (std::size_t n = 0; n < lines.size(); ++n) {
    changed[n].push_back(lines[n].points.back());
    lines[n].points = std::move(changed[n]);
  }
}

void check_crossings(const std::vector<GivenLine>& lines, std::vector<Issue>& issues) {
  constexpr std::size_t most_issues = 20;
  const Segments segments(lines);
  each_near_pair(segments.list, 1, nullptr, [&](std::size_t s, std::size_t t) {
    const auto [n, k] = segments.source[s];
    const auto [m, l] = segments.source[t];
    const CmPoint &a = lines[n].points[k], &b = lines[n].points[k + 1], &c = lines[m].points[l],
                  &d = lines[m].points[l + 1];
    if (lines[n].level != lines[m].level || !cross_properly(a, b, c, d)) return true;
    const dvec2 from = in_cm(a), along = in_cm(b) - from, across = in_cm(d) - in_cm(c), off = in_cm(c) - from;
    const double share = (off.x * across.y - off.y * across.x) / (along.x * across.y - along.y * across.x);
    const CmPoint at = rounded_cm(from + along * share);
    issues.emplace_back(conflict_with({}), lines[m].geometry,
                        "crosses the street `" + lines[n].pointer.substr(1) + "` at " +
                            number_text(at.x / 100.0) + ", " + number_text(at.y / 100.0) +
                            "; expected an end or corner of one of them within 3 m, or another level");
    return issues.size() < most_issues;
  });
}

}  // namespace

std::vector<CrossSection> classes_of(const CityParams& params) {
  const CityClasses& classes = params.streets.classes;
  return {{"border", 0, {0, 0}, 0, 0},
          {"shore", 0, {0, 0}, 0, 0},
          section_of("highway", classes.highway),
          section_of("major", classes.major),
          section_of("minor", classes.minor),
          section_of("lane", classes.lane)};
}

std::vector<GivenLine> given_lines(const CityParams& params, std::vector<CrossSection>& sections,
                                   std::vector<Issue>& issues) {
  std::vector<GivenLine> lines;
  if (!params.given.given_streets) return lines;
  for (const GeoFeature& feature :
       features_of(*params.given.given_streets, GeoKind::lines, "/given/streets", {issues})) {
    const Properties properties(feature, issues);
    CrossSection section = sections[properties.street_class(sections)];
    section.width = properties.number("width", section.width, 1, 100);
    section.lanes = properties.whole("lanes", section.lanes, 0, 20);
    section.sidewalk = properties.sidewalk(section.sidewalk);
    const int level = properties.level();
    auto known = std::find(sections.begin() + first_given, sections.end(), section);
    if (known == sections.end()) known = sections.insert(known, section);
    const auto number = static_cast<std::uint32_t>(known - sections.begin());
    for (const CmRing& line : feature.lines) {
      const CmRing points = spaced(line);
      if (points.size() == 2 && distance(points[0], points[1]) < shortest) {
        issues.emplace_back(IssueKind::invalid_value, feature.geometry,
                            "found a line of " + number_text(distance(points[0], points[1]) / 100) +
                                " m, expected more than 3 m");
        continue;
      }
      lines.push_back({feature.pointer, feature.geometry, points, number, level});
    }
  }
  if (!issues.empty()) return lines;
  merge_corners(lines);
  add_corners(lines);
  std::erase_if(lines, [](const GivenLine& line) { return line.points.size() < 2; });
  check_crossings(lines, issues);
  return lines;
}

std::vector<Rings> given_water(const CityParams& params, std::vector<Issue>& issues) {
  if (!params.given.given_water) return {};
  return polygons_of(*params.given.given_water, "/given/water", {issues});
}

}  // namespace seedmesh::city

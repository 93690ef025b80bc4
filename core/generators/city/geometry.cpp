#include "core/generators/city/geometry.h"

#include <algorithm>
#include <variant>

#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using Position = std::vector<double>;
using Value = std::variant<double, Position>;

constexpr std::size_t most_positions = 100'000;

/// Collects errors of one geometry; only the first of a kind is reported.
class Reader {
 public:
  Reader(std::string pointer, std::vector<Issue>& issues) : pointer_(std::move(pointer)), issues_(issues) {}

  /// A position as list of numbers, at the depth of a line or ring.
  void add(CmRing& ring, const std::vector<Value>& position) {
    Position numbers;
    for (const Value& each : position) {
      if (!std::holds_alternative<double>(each)) return refuse("found a list, expected a number");
      numbers.push_back(std::get<double>(each));
    }
    add(ring, numbers);
  }
  void add(CmRing& ring, const Value& position) {
    if (!std::holds_alternative<Position>(position)) return refuse("found a number, expected a position");
    add(ring, std::get<Position>(position));
  }

  /// Ends a ring or a line.
  bool ends(const CmRing& ring, std::size_t least) {
    if (is_refused_) return false;
    if (ring.size() < least)
      refuse("found " + std::to_string(ring.size()) + " different corners, expected at least " +
             std::to_string(least));
    return !is_refused_;
  }

 private:
  void add(CmRing& ring, const Position& numbers) {
    if (++positions_ > most_positions)
      return refuse("found more than " + std::to_string(most_positions) + " positions");
    if (numbers.size() < 2 || numbers.size() > 3)
      return refuse("found a position of " + std::to_string(numbers.size()) + " numbers, expected 2 or 3");
    const CmPoint p = rounded_cm({numbers[0] * 100, numbers[1] * 100});
    if (ring.empty() || ring.back() != p) ring.push_back(p);
  }
  void refuse(std::string message) {
    if (!is_refused_) issues_.push_back({IssueKind::invalid_value, pointer_, std::move(message)});
    is_refused_ = true;
  }

  std::string pointer_;
  std::vector<Issue>& issues_;
  std::size_t positions_ = 0;
  bool is_refused_ = false;
};

void open_ring(CmRing& ring) {
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
}

}  // namespace

std::vector<Rings> polygons_of(const CityPolygons& geometry, const std::string& pointer,
                               std::vector<Issue>& issues) {
  std::vector<Rings> polygons;
  Reader reader(pointer + "/coordinates", issues);
  const auto add_ring = [&](Rings& rings, CmRing ring) {
    open_ring(ring);
    if (reader.ends(ring, 3)) rings.push_back(std::move(ring));
  };
  // RFC 7946 allows geometries without coordinates.
  const auto add_polygon = [&](Rings rings) {
    if (!rings.empty()) polygons.push_back(std::move(rings));
  };
  if (geometry.geometry_type == CityGeometryType::Polygon) {
    Rings polygon;
    for (const auto& positions : geometry.coordinates) {
      CmRing ring;
      for (const auto& position : positions) reader.add(ring, position);
      add_ring(polygon, std::move(ring));
    }
    add_polygon(std::move(polygon));
    return polygons;
  }
  for (const auto& rings : geometry.coordinates) {
    Rings polygon;
    for (const auto& positions : rings) {
      CmRing ring;
      for (const Value& position : positions) reader.add(ring, position);
      add_ring(polygon, std::move(ring));
    }
    add_polygon(std::move(polygon));
  }
  return polygons;
}

std::vector<CmRing> lines_of(const CityLines& geometry, const std::string& pointer,
                             std::vector<Issue>& issues) {
  std::vector<CmRing> lines;
  Reader reader(pointer + "/coordinates", issues);
  if (geometry.line_type == CityLineType::LineString) {
    CmRing line;
    for (const auto& position : geometry.coordinates) reader.add(line, position);
    if (reader.ends(line, 2)) lines.push_back(std::move(line));
    return lines;
  }
  for (const auto& positions : geometry.coordinates) {
    CmRing line;
    for (const Value& position : positions) reader.add(line, position);
    if (reader.ends(line, 2)) lines.push_back(std::move(line));
  }
  return lines;
}

bool is_in_any(const std::vector<Rings>& polygons, const glm::dvec2& cm) {
  return std::any_of(polygons.begin(), polygons.end(), [&](const Rings& rings) {
    bool inside = false;
    for (const CmRing& ring : rings) inside ^= is_inside(ring, cm);
    return inside;
  });
}

}  // namespace seedmesh::city

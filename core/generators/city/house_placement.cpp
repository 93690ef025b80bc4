#include "core/generators/city/house_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/city/footprints.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double inset = 0.03;        // keeps rounded walls on the lot, m
constexpr double side_inset = 0.005;  // the same where houses touch, m
// Widths are whole metres and depths have steps of two, so that few models serve many lots.
constexpr double depth_step = 2;
constexpr std::size_t lots_a_chunk = 256;

/// A lot in the frame of its front: x along it, y into the lot, metres.
struct FrontFrame {
  dvec2 origin{0}, along{1, 0}, inward{0, 1};
  double length = 0;
  std::vector<dvec2> corners;
};

/// Sets `frame` to that of a lot. Its memory is reused from one lot to the next.
void set_frame(const Lot& lot, FrontFrame& frame) {
  frame.corners.clear();
  frame.origin = in_metres(lot.front_start);
  const dvec2 front = in_metres(lot.front_end) - frame.origin;
  frame.length = std::sqrt(glm::dot(front, front));
  frame.along = front / frame.length;
  frame.inward = {-frame.along.y, frame.along.x};
  for (const CmPoint& p : lot.corners) {
    const dvec2 off = in_metres(p) - frame.origin;
    frame.corners.emplace_back(glm::dot(off, frame.along), glm::dot(off, frame.inward));
  }
}

/// The widest free range of x about `middle` between two depths; empty if the middle is not free.
std::optional<std::array<double, 2>> free_range(const FrontFrame& frame, double middle, double near,
                                                double far) {
  double low = -1e9, high = 1e9;
  const std::size_t count = frame.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    dvec2 a = frame.corners[i], b = frame.corners[(i + 1) % count];
    if (a.y > b.y) std::swap(a, b);
    if (b.y <= near || a.y >= far) continue;
    const auto x_at = [&](double y) { return b.y > a.y ? a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y) : a.x; };
    const double first = a.y < near ? x_at(near) : a.x, last = b.y > far ? x_at(far) : b.x;
    if (std::max(first, last) <= middle) {
      low = std::max(low, std::max(first, last));
    } else if (std::min(first, last) >= middle) {
      high = std::min(high, std::min(first, last));
    } else {
      return std::nullopt;
    }
  }
  if (low < -1e8 || high > 1e8) return std::nullopt;
  return std::array<double, 2>{low, high};
}

double rounded(double value, double parts) { return std::floor(value * parts + 0.5) / parts; }

/// The largest rectangle that a rule may build on a lot.
std::optional<House> fit(const Lot& lot, const FrontFrame& frame, const CityBuildingRule& rule) {
  std::optional<House> best;
  const double front = std::max(rule.front, inset);
  for (double depth = rule.depth[1]; depth >= rule.depth[0]; depth -= depth_step) {
    for (const double share : {0.5, 0.35, 0.65}) {
      const double middle = frame.length * share;
      const auto range = free_range(frame, middle, inset, front + depth + rule.rear);
      if (!range) continue;
      const double side = std::max(rule.side, side_inset);
      double low = (*range)[0] + side, high = (*range)[1] - side;
      const double most = std::min(rule.share * lot.area / depth, rule.width[1]);
      if (high - low > most) {
        const double centre = (low + high) / 2;
        low = centre - most / 2;
        high = centre + most / 2;
      }
      const double step = rule.shared_walls ? 0.01 : 1;
      const double width = std::floor((high - low) / step) * step;
      if (width < rule.width[0] || width * 6 < depth) continue;
      if (best && width * depth <= best->width * best->depth) continue;
      const dvec2 centre =
          frame.origin + frame.along * ((low + high) / 2) + frame.inward * (front + depth / 2);
      House house;
      house.width = width;
      house.depth = depth;
      house.position = {rounded(centre.x, 1000), rounded(centre.y, 1000)};
      best = house;
    }
  }
  if (best) best->turn = rounded(math::degrees(math::atan2(-frame.inward.x, frame.inward.y)), 10'000);
  return best;
}

/// Houses at the edge, terraces between, and blocks and towers where the density is great.
std::vector<CityBuildingRule> built_in_rules() {
  CityBuildingRule house;
  house.density = {0, 0.5};
  house.floors = {1, 2};
  house.front = 4;
  house.side = 2;
  house.rear = 5;
  house.depth = {8, 12};
  house.share = 0.5;
  house.width = {4.5, 18};
  CityBuildingRule terrace;
  terrace.blueprint = CityBlueprint::terraced_house;
  terrace.density = {0.3, 0.8};
  terrace.floors = {2, 4};
  terrace.front = 1;
  terrace.depth = {9, 13};
  CityBuildingRule office;
  office.blueprint = CityBlueprint::office_tower;
  office.density = {0.75, 1};
  office.lot = {600, 1'000'000};
  office.floors = {5, 16};
  office.front = 3;
  office.side = 3;
  office.rear = 3;
  office.depth = {12, 40};
  CityBuildingRule block;
  block.blueprint = CityBlueprint::parisian_block;
  block.density = {0.7, 1};
  block.floors = {3, 6};
  block.front = 0.5;
  block.depth = {10, 14};
  return {house, terrace, office, block};
}

/// What the conditions of rules compare.
struct Site {
  const Lot& lot;
  const std::string& street_class;
  double distance = 0;  ///< distance from the centre of the streets
};

bool applies(const CityBuildingRule& rule, const Site& site) {
  const auto holds = [](const std::array<double, 2>& range, double value) {
    return range[0] <= value && value <= range[1];
  };
  const Lot& lot = site.lot;
  const bool is_zone =
      rule.zones.empty() || std::find(rule.zones.begin(), rule.zones.end(), lot.zone) != rule.zones.end();
  const auto is_class = [&](CityClass each) { return text_of(each) == site.street_class; };
  const bool is_street =
      rule.streets.empty() || std::any_of(rule.streets.begin(), rule.streets.end(), is_class);
  return is_zone && is_street && holds(rule.density, lot.density) && holds(rule.distance, site.distance) &&
         holds(rule.lot, lot.area) && holds(rule.frontage, lot.frontage);
}

/// Makes `drawn` the rules that apply, in an order drawn by their weights (Efraimidis and Spirakis 2006).
void draw_order(const std::vector<CityBuildingRule>& rules, const Site& site, Rng rng,
                std::vector<std::pair<double, std::uint32_t>>& drawn) {
  drawn.clear();
  for (std::uint32_t i = 0; i < rules.size(); ++i) {
    if (!applies(rules[i], site)) continue;
    Rng draw = rng.at(i);
    drawn.emplace_back(math::log(1 - draw.unit()) / rules[i].weight, i);
  }
  std::sort(drawn.begin(), drawn.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
}

/// Whether an obstacle is at the middle, a corner or the middle of a side of a house.
bool is_on_obstacle(const House& house, const FieldMap& obstacles) {
  const math::SinCos turn = math::sincos_degrees(house.turn);
  for (const double u : {-0.5, 0.0, 0.5}) {
    for (const double v : {-0.5, 0.0, 0.5}) {
      const dvec2 p(u * house.width, v * house.depth);
      const dvec2 at =
          house.position + dvec2(p.x * turn.cos - p.y * turn.sin, p.x * turn.sin + p.y * turn.cos);
      if (obstacles.at(at) >= 0.5) return true;
    }
  }
  return false;
}

std::array<CmPoint, 4> corners_of(const House& house) {
  const math::SinCos turn = math::sincos_degrees(house.turn);
  std::array<CmPoint, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const dvec2 p((k == 0 || k == 3 ? -0.5 : 0.5) * house.width, (k < 2 ? -0.5 : 0.5) * house.depth);
    const dvec2 at = house.position + dvec2(p.x * turn.cos - p.y * turn.sin, p.x * turn.sin + p.y * turn.cos);
    corners[k] = rounded_cm(at * 100.0);
  }
  return corners;
}

}  // namespace

const std::vector<CityBuildingRule>& rules_of(const CityParams& params) {
  static const std::vector<CityBuildingRule> built_in = built_in_rules();
  return params.buildings.rules ? *params.buildings.rules : built_in;
}

std::array<int, 2> floors_of(std::string_view blueprint) {
  if (blueprint == "house") return {1, 4};
  if (blueprint == "terraced_house") return {2, 4};
  if (blueprint == "villa") return {1, 3};
  if (blueprint == "parisian_block") return {2, 8};
  if (blueprint == "office_tower") return {3, 60};
  if (blueprint == "skyscraper") return {6, 150};
  return {0, 0};
}

void place_houses(CityPlan& plan, const CityParams& params, const FieldMap* obstacles,
                  const FootprintIndex& footprints, Job& job) {
  const Rng rng = job.rng().at("houses");
  const std::vector<CityBuildingRule>& rules = rules_of(params);
  const dvec2 centre(params.streets.centre[0], params.streets.centre[1]);
  parallel_for(job, plan.lots.size(), lots_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    FrontFrame frame;
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::size_t i = begin; i < end; ++i) {
      Lot& lot = plan.lots[i];
      if (lot.street == no_index) continue;
      set_frame(lot, frame);
      const dvec2 off = frame.origin - centre;
      const Rng key = rng.at(lot.key);
      const Site site{lot, plan.class_of(lot.street).name, std::sqrt(glm::dot(off, off))};
      draw_order(rules, site, key.at("rule"), order);
      for (const auto& [draw_of_rule, number] : order) {
        lot.house = fit(lot, frame, rules[number]);
        if (lot.house && obstacles && is_on_obstacle(*lot.house, *obstacles)) lot.house.reset();
        if (lot.house && !footprints.is_empty() && footprints.meets(corners_of(*lot.house)))
          lot.house.reset();
        if (!lot.house) continue;
        lot.house->rule = number;
        Rng draw = key.at("house");
        const auto& floors = rules[number].floors;
        lot.house->floors =
            floors[0] + static_cast<int>(draw.below(static_cast<std::uint32_t>(floors[1] - floors[0] + 1)));
        lot.house->seed = draw.below(static_cast<std::uint32_t>(params.buildings.variants));
        break;
      }
    }
  });
}

}  // namespace seedmesh::city

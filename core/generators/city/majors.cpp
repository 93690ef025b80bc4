// Major streets on a net. The random choices of crossings and links depend on their position, so the order of growth
// has no effect on them.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <set>

#include "core/base/math.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/vectors.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double piece_length = 3000;  // of a bent street, cm
constexpr double least_density = 0.1;

/// A crossing of the net: column and row, or ring and ray.
using Site = std::array<std::int32_t, 2>;

std::uint64_t site_key(const Site& site) {
  return key_at(key_at(0x517E, static_cast<std::uint32_t>(site[0])), static_cast<std::uint32_t>(site[1]));
}

class Net {
 public:
  Net(const CityStreets& streets, Rng rng) : streets_(streets), rng_(rng) {
    centre_ = {streets.centre[0] * 100, streets.centre[1] * 100};
    turn_ = math::sincos_degrees(streets.angle);
    const bool is_whole = whole_raster();
    step_ =
        is_whole ? dvec2(streets.block[0] * 100, streets.block[1] * 100) : dvec2(streets.major_spacing * 100);
    every_ = {std::max(1, math::to_int32(streets.major_spacing * 100 / step_.x + 0.5)),
              std::max(1, math::to_int32(streets.major_spacing * 100 / step_.y + 0.5))};
  }

  /// A raster of minor streets is part of the net.
  bool whole_raster() const {
    return streets_.pattern == CityPattern::raster &&
           (!streets_.minor_pattern || *streets_.minor_pattern == CityMinorPattern::raster);
  }
  bool is_radial() const { return streets_.pattern == CityPattern::radial; }

  /// Position in centimetres.
  dvec2 position(const Site& site) const {
    if (is_radial()) {
      const math::SinCos turn = math::sincos(2 * math::pi * site[1] / rays_of(site[0]));
      return centre_ + rotated({step_.x * site[0] * turn.cos, step_.x * site[0] * turn.sin}, turn_);
    }
    dvec2 share(site[0], site[1]);
    if (streets_.pattern == CityPattern::organic) {
      Rng draw = rng_.at("site").at(site_key(site));
      share.x += draw.uniform(-streets_.jitter, streets_.jitter);
      share.y += draw.uniform(-streets_.jitter, streets_.jitter);
    }
    return centre_ + rotated(share * step_, turn_);
  }

  /// Counter-clockwise, beginning in the east or outwards.
  std::vector<Site> neighbours(const Site& site) const {
    const auto [i, k] = site;
    if (!is_radial()) return {{i + 1, k}, {i, k + 1}, {i - 1, k}, {i, k - 1}};
    if (i == 0) {
      std::vector<Site> all;
      all.reserve(static_cast<std::size_t>(rays_of(1)));
      for (std::int32_t ray = 0; ray < rays_of(1); ++ray) all.push_back({1, ray});
      return all;
    }
    const std::int32_t rays = rays_of(i), outer = rays_of(i + 1) / rays;
    std::vector<Site> around = {{i + 1, k * outer}, {i, (k + 1) % rays}};
    const std::int32_t inner = i == 1 ? 1 : rays / rays_of(i - 1);
    if (k % inner == 0) around.push_back({i - 1, i == 1 ? 0 : k / inner});
    around.push_back({i, (k + rays - 1) % rays});
    return around;
  }

  EdgeClass class_of(const Site& a, const Site& b) const {
    if (is_highway(a, b)) return EdgeClass::highway;
    if (!whole_raster()) return EdgeClass::major;
    const auto is_line = [](std::int32_t line, std::int32_t every) { return line % every == 0; };
    const bool is_major = a[0] == b[0] ? is_line(a[0], every_[0]) : is_line(a[1], every_[1]);
    return is_major ? EdgeClass::major : EdgeClass::minor;
  }

  /// Whether the link between two sites is built, by its key alone.
  bool is_filled(const Site& a, const Site& b) const {
    if (is_highway(a, b) || (whole_raster() && class_of(a, b) == EdgeClass::major)) return true;
    return link_draw(a, b, "fill").unit() < streets_.fill;
  }

  /// Lines of the net that are highways: those through the centre, and others at the spacing of highways. Of a radial
  /// net, each second ray of the innermost ring, and rings at the spacing.
  bool is_highway(const Site& a, const Site& b) const {
    if (streets_.highway_spacing <= 0) return false;
    const auto every = [&](double step) {
      return std::max(1, math::to_int32(streets_.highway_spacing * 100 / step + 0.5));
    };
    if (!is_radial()) return a[0] == b[0] ? a[0] % every(step_.x) == 0 : a[1] % every(step_.y) == 0;
    if (a[0] == b[0]) return a[0] > 0 && a[0] % every(step_.x) == 0;
    const Site& outer = std::max(a, b);
    return outer[1] % (rays_of(outer[0]) / 3) == 0;
  }

  Rng link_draw(const Site& a, const Site& b, std::string_view name) const {
    return rng_.at(name).at(site_key(std::min(a, b))).at(site_key(std::max(a, b)));
  }

  /// The points of a link, ends included.
  std::vector<CmPoint> points(const Site& a, const Site& b) const {
    if (b < a) {
      std::vector<CmPoint> back = points(b, a);
      std::reverse(back.begin(), back.end());
      return back;
    }
    const dvec2 from = position(a), to = position(b), along = to - from;
    const double length = std::sqrt(along.x * along.x + along.y * along.y);
    const std::int32_t count = whole_raster() ? 1 : std::max(1, math::to_int32(length / piece_length + 0.5));
    // A bow and an S, whose slopes at the ends stay below the bend.
    Rng draw = link_draw(a, b, "bend");
    const double most = whole_raster() ? 0 : math::radians(streets_.bend) / 6;
    const double bow = draw.uniform(-most, most), swing = draw.uniform(-most, most) / 2;
    const dvec2 side(-along.y, along.x);
    std::vector<CmPoint> line;
    for (std::int32_t n = 0; n <= count; ++n) {
      const double t = static_cast<double>(n) / count;
      double off = bow * math::sin(math::pi * t) + swing * math::sin(2 * math::pi * t);
      if (n == 0 || n == count) off = 0;
      dvec2 p = from + along * t + side * off;
      if (is_radial() && a[0] == b[0] && n > 0 && n < count) p = on_ring(from, to, p, a[0]);
      line.push_back(rounded_cm(p));
    }
    return line;
  }

  Site start() const { return {0, 0}; }

  /// A site near a position in centimetres.
  Site site_near(const dvec2& cm) const {
    const dvec2 off = rotated(cm - centre_, {0 - turn_.sin, turn_.cos});
    const auto nearest = [](double value) { return math::to_int32(std::floor(value + 0.5)); };
    if (!is_radial()) return {nearest(off.x / step_.x), nearest(off.y / step_.y)};
    const std::int32_t ring = nearest(std::sqrt(off.x * off.x + off.y * off.y) / step_.x);
    if (ring == 0) return {0, 0};
    const std::int32_t rays = rays_of(ring);
    return {ring, (nearest(math::atan2(off.y, off.x) / (2 * math::pi) * rays) + rays) % rays};
  }

 private:
  std::int32_t rays_of(std::int32_t ring) const {
    std::int32_t rays = 6;
    while (rays < 4.19 * ring) rays *= 2;
    return rays;
  }
  dvec2 on_ring(const dvec2& from, const dvec2& to, const dvec2& p, std::int32_t ring) const {
    const dvec2 off = p - centre_, chord = (from + to) / 2.0 - centre_;
    const double length = std::sqrt(off.x * off.x + off.y * off.y);
    return chord.x * off.x + chord.y * off.y > 0 ? centre_ + off * (step_.x * ring / length) : p;
  }

  const CityStreets& streets_;
  Rng rng_;
  dvec2 centre_{0}, step_{0};
  math::SinCos turn_{};
  std::array<std::int32_t, 2> every_{};
};

/// The links of the net as roads of the L-system.
class NetRules final : public RoadRules {
 public:
  NetRules(const GrowthInput& input, const Net& net) : input_(input), net_(net) {}

  GlobalGoals global_goals(double, double road, Rng) override {
    GlobalGoals goals;
    if (!is_road(road)) return goals;
    const Road done = roads_[static_cast<std::size_t>(road)];
    std::size_t slot = 0;
    for (const Site& next : net_.neighbours(done.to)) {
      if (next == done.from || slot == 3) continue;
      goals.delay[slot] = 0;
      goals.road[slot++] = propose(done.to, beyond_water(done.to, next));
    }
    return goals;
  }

  RoadState local_constraints(double road) override {
    if (!is_road(road)) return RoadState::failed;
    Road& each = roads_[static_cast<std::size_t>(road)];
    const Site from = each.from, to = each.to;
    if (was_tried(from, to)) return RoadState::failed;
    std::optional<Route> built = link(from, to, false);
    // A tunnel can pass sites on a ridge.
    for (std::int32_t steps = 2; steps <= 3 && !built && ends_on_slope(from, each.to); ++steps) {
      each.to = {from[0] + (to[0] - from[0]) * steps, from[1] + (to[1] - from[1]) * steps};
      if (was_tried(from, each.to)) return RoadState::failed;
      built = link(from, each.to, true);
    }
    if (!built) return RoadState::failed;
    route.pieces.insert(route.pieces.end(), built->pieces.begin(), built->pieces.end());
    route.separated.insert(route.separated.end(), built->separated.begin(), built->separated.end());
    for (const Site& end : {from, built->reaches_end ? each.to : from}) {
      if (const auto part = part_of_land(input_.region, net_.position(end))) parts_.insert(*part);
    }
    if (!built->reaches_end) return RoadState::failed;
    return reached_.insert(each.to).second ? RoadState::succeed : RoadState::failed;
  }

  std::array<double, 2> measure(double road) const override {
    if (!is_road(road)) return {0, 0};
    const Road& each = roads_[static_cast<std::size_t>(road)];
    const dvec2 along = net_.position(each.to) - net_.position(each.from);
    return {math::degrees(math::atan2(along.y, along.x)),
            std::sqrt(along.x * along.x + along.y * along.y) / 100};
  }

  std::vector<StreetGrammar::Start> starts() { return starts_at(first_site()); }

  /// Starts at a site that is not beside a reached one, or on a part of the land, between waters, that no street has
  /// reached. None if there is no such site.
  std::vector<StreetGrammar::Start> starts_elsewhere() {
    for (const dvec2& p : lattice_of(input_.region)) {
      const Site site = net_.site_near(p);
      const dvec2 at = net_.position(site);
      if (reached_.count(site) != 0 || !may_start(at)) continue;
      const auto part = part_of_land(input_.region, at);
      if (part && (parts_.count(*part) == 0 || !is_beside_reached(site))) return starts_at(site);
    }
    return {};
  }

  Route route;

 private:
  struct Road {
    Site from, to;
  };

  std::vector<StreetGrammar::Start> starts_at(const Site& start) {
    reached_.insert(start);
    std::vector<StreetGrammar::Start> all;
    for (const Site& next : net_.neighbours(start))
      all.push_back({0, 0, propose(start, next), key_at(site_key(start), site_key(next))});
    return all;
  }
  bool is_road(double road) const { return road >= 0 && road < static_cast<double>(roads_.size()); }

  bool was_tried(const Site& from, const Site& to) {
    const auto ends = std::minmax(from, to);
    return !tried_.insert({ends.first, ends.second}).second;
  }

  /// Whether tunnels may grow and the ground at the end of a link is too steep for it.
  bool ends_on_slope(const Site& from, const Site& to) const {
    if (input_.streets.tunnel_length <= 0 || net_.is_radial() || !input_.landform) return false;
    const std::vector<CmPoint> line = net_.points(from, to);
    const dvec2 end = in_cm(line.back()), along = in_cm(line[line.size() - 2]) - end;
    const double length = std::sqrt(along.x * along.x + along.y * along.y);
    return input_.is_too_steep(end, end + along * std::min(1.0, piece_length / length),
                               input_.limit_of(static_cast<std::uint32_t>(net_.class_of(from, to))));
  }

  /// The street between two sites, if it can be built. `has_tunnel`: only with a tunnel.
  std::optional<Route> link(const Site& from, const Site& to, bool has_tunnel) const {
    const std::vector<CmPoint> line = net_.points(from, to);
    const std::size_t middle = line.size() / 2;
    const bool is_dense = input_.density.at(in_metres(line.front())) >= least_density &&
                          input_.density.at(in_metres(line[middle])) >= least_density;
    if (!is_on_land(input_.region, in_cm(line.front())) || !is_dense || !net_.is_filled(from, to))
      return std::nullopt;
    const auto kind = static_cast<std::uint32_t>(net_.class_of(from, to));
    std::optional<Route> built = route_of(input_.region, line, kind, input_.streets.bridge_length * 100);
    if (has_tunnel || !input_.is_free(*built)) built = input_.tunnelled(*built);
    if (!built || !is_clear_of_bridges(*built)) return std::nullopt;
    const bool is_tunnel = std::any_of(built->separated.begin(), built->separated.end(),
                                       [](const auto& each) { return each.level < 0; });
    return has_tunnel && !is_tunnel ? std::nullopt : built;
  }

  /// The site itself, or one farther in the same direction if it lies in water.
  Site beyond_water(const Site& from, const Site& next) const {
    if (net_.is_radial() || is_on_land(input_.region, net_.position(next))) return next;
    for (std::int32_t steps = 2; steps <= 3; ++steps) {
      const Site far = {from[0] + (next[0] - from[0]) * steps, from[1] + (next[1] - from[1]) * steps};
      if (is_on_land(input_.region, net_.position(far))) return far;
    }
    return next;
  }

  /// Whether no other bridge or tunnel crosses it, and the ends of the bridges are far enough from each other for
  /// streets between them.
  bool is_clear_of_bridges(const Route& built) const {
    constexpr double apart = 4000;  // cm
    for (const SeparatedLine& own : built.separated) {
      for (const SeparatedLine& other : route.separated) {
        for (const CmPoint& end : {own.line.front(), own.line.back()}) {
          if (distance(end, other.line.front()) < apart || distance(end, other.line.back()) < apart)
            return false;
        }
      }
    }
    return !meets_separated(built, route.separated) &&
           !(input_.given && meets_separated(built, input_.given->separated));
  }

  /// Whether a site around another one of the net has been reached. The sites of a radial net all have a way to its
  /// centre, so that growth there starts once.
  bool is_beside_reached(const Site& site) const {
    if (net_.is_radial()) return true;
    for (std::int32_t i = -1; i <= 1; ++i) {
      for (std::int32_t k = -1; k <= 1; ++k) {
        if (reached_.count({site[0] + i, site[1] + k}) != 0) return true;
      }
    }
    return false;
  }

  bool may_start(const dvec2& cm) const {
    return is_on_land(input_.region, cm) && input_.density.at(cm / 100.0) >= least_density;
  }
  /// The site at the centre, or the one nearest to it among those near the points of a lattice over the area.
  Site first_site() const {
    Site best = net_.start();
    if (may_start(net_.position(best))) return best;
    double least = 1e300;
    for (const dvec2& p : lattice_of(input_.region)) {
      const Site site = net_.site_near(p);
      const dvec2 at = net_.position(site), off = at - net_.position(net_.start());
      const double d = off.x * off.x + off.y * off.y;
      if (d >= least || !may_start(at)) continue;
      least = d;
      best = site;
    }
    return best;
  }
  double propose(const Site& from, const Site& to) {
    roads_.push_back({from, to});
    return static_cast<double>(roads_.size() - 1);
  }

  const GrowthInput& input_;
  const Net& net_;
  std::vector<Road> roads_;
  std::set<std::pair<Site, Site>> tried_;
  std::set<Site> reached_;
  std::set<std::size_t> parts_;  ///< parts of the land with streets
};

}  // namespace

dvec2 frame_at(const CityStreets& streets, bool is_radial, const dvec2& cm) {
  const math::SinCos turn = math::sincos_degrees(streets.angle);
  if (!is_radial) return {turn.cos, turn.sin};
  const dvec2 off = cm - dvec2(streets.centre[0], streets.centre[1]) * 100.0;
  const double length = std::sqrt(off.x * off.x + off.y * off.y);
  return length > 0 ? off / length : dvec2(turn.cos, turn.sin);
}

Route grow_majors(const GrowthInput& input, Job& job) {
  const Net net(input.streets, job.rng().at("majors"));
  NetRules rules(input, net);
  for (auto starts = rules.starts(); !starts.empty(); starts = rules.starts_elsewhere()) {
    if (const auto steps = input.grammar.grow(starts, rules, job.limits().shapes, job)) {
      job.refuse(limit_issue({Resource::steps, *steps, *steps + 1}, "the major streets do not stop growing",
                             "/streets/productions"));
    }
  }
  return std::move(rules.route);
}

}  // namespace seedmesh::city

#include "core/import/map_projection.h"

#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/schema/json.h"

namespace seedmesh {
namespace {

constexpr double semi_axis = 6378137, flattening = 1 / 298.257223563;
constexpr double n = flattening / (2 - flattening);
constexpr double meridian_radius = semi_axis / (1 + n) * (1 + n * n / 4 + n * n * n * n / 64);
constexpr std::array<double, 4> series{n / 2 - 2 * n * n / 3 + 5 * n * n * n / 16 + 41 * n * n * n * n / 180,
                                       13 * n* n / 48 - 3 * n* n* n / 5 + 557 * n* n* n* n / 1440,
                                       61 * n* n* n / 240 - 103 * n* n* n* n / 140,
                                       49561 * n* n* n* n / 161280};

double sinh_of(double x) { return (math::exp(x) - math::exp(-x)) / 2; }
double cosh_of(double x) { return (math::exp(x) + math::exp(-x)) / 2; }
double atanh_of(double x) { return math::log((1 + x) / (1 - x)) / 2; }

}  // namespace

TransverseMercator::TransverseMercator(double longitude, double latitude)
    : longitude_(longitude), latitude_(latitude) {
  north_ = from_equator({longitude, latitude}).y;
}

glm::dvec2 TransverseMercator::from_equator(const glm::dvec2& position) const {
  const double eccentricity = 2 * std::sqrt(n) / (1 + n);
  double turn = position.x - longitude_;
  turn -= 360 * std::floor((turn + 180) / 360);  // the shorter way around the Earth
  // Poles and the antipodal meridian have no image; stop short of them.
  const double latitude = std::min(std::max(position.y, -89.999999), 89.999999);
  const math::SinCos across = math::sincos_degrees(std::min(std::max(turn, -89.0), 89.0));
  const double sine = math::sincos_degrees(latitude).sin;
  const double t = sinh_of(atanh_of(sine) - eccentricity * atanh_of(eccentricity * sine));
  const double north = math::atan2(t, across.cos), east = atanh_of(across.sin / std::sqrt(1 + t * t));
  glm::dvec2 sum(east, north);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double order = 2 * static_cast<double>(i + 1);
    const math::SinCos at = math::sincos(order * north);
    sum.x += series[i] * at.cos * sinh_of(order * east);
    sum.y += series[i] * at.sin * cosh_of(order * east);
  }
  return sum * meridian_radius;
}

glm::dvec2 TransverseMercator::forward(const glm::dvec2& position) const {
  const glm::dvec2 p = from_equator(position);
  return {p.x, p.y - north_};
}

std::string TransverseMercator::text() const {
  return "+proj=tmerc +lat_0=" + number_text(latitude_) + " +lon_0=" + number_text(longitude_) +
         " +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m";
}

glm::dvec2 of_web_mercator(const glm::dvec2& position) {
  const double half = math::pi * semi_axis;
  const double y = std::min(std::max(position.y, -half), half);
  return {math::degrees(position.x / semi_axis),
          math::degrees(2 * math::atan2(math::exp(y / semi_axis), 1) - math::pi / 2)};
}

}  // namespace seedmesh

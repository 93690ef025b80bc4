#pragma once
/// Geographic positions as local metres.
#include <glm/vec2.hpp>
#include <string>

namespace seedmesh {

/// The transverse Mercator projection of the ellipsoid of WGS 84 about an origin, with scale 1 along its meridian: east
/// and north in metres. It preserves angles; lengths at 50 km from the meridian are 0.003 % too long. Source:
/// Krüger, "Konforme Abbildung des Erdellipsoids in der Ebene", 1912, to the fourth order (0.001 mm within
/// 1,000 km).
class TransverseMercator {
 public:
  /// Makes the projection about an origin in degrees.
  TransverseMercator(double longitude, double latitude);

  /// Returns the metres to the east and north of the origin, for a longitude and latitude in degrees.
  glm::dvec2 forward(const glm::dvec2& position) const;

  /// Returns the projection as PROJ writes it.
  std::string text() const;

 private:
  glm::dvec2 from_equator(const glm::dvec2& position) const;
  double longitude_, latitude_;
  double north_ = 0;  ///< distance of the origin from the equator
};

/// Returns the longitude and latitude in degrees of a position of Web Mercator (EPSG:3857) in metres.
glm::dvec2 of_web_mercator(const glm::dvec2& position);

}  // namespace seedmesh

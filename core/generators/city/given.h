#pragma once
/// Streets and water that the request gives.
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/city/plan.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Returns the cross sections of the classes, by EdgeClass.
std::vector<CrossSection> classes_of(const CityParams& params);

/// A given line. It has a corner, which becomes a node, wherever another line of its level meets it.
struct GivenLine {
  std::string pointer;   ///< pointer of its feature
  std::string geometry;  ///< pointer of the geometry of the feature
  CmRing points;
  std::uint32_t section = 0;  ///< index into the list of cross sections; at least first_given
  int level = 0;
};

/// Returns the lines of the given streets, joined where an end or corner of one lies within 3 m of another. Adds
/// their cross sections to `sections`. Adds issues for properties out of range, geometries that cannot be read,
/// lines shorter than 3 m, and crossings without an end or corner.
std::vector<GivenLine> given_lines(const CityParams& params, std::vector<CrossSection>& sections,
                                   std::vector<Issue>& issues);

/// Returns the polygons of the given water, in centimetres. Adds issues for geometries that cannot be read.
std::vector<Rings> given_water(const CityParams& params, std::vector<Issue>& issues);

}  // namespace seedmesh::city

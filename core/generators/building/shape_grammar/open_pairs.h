#pragma once
/// Left shapes with open variables: their points as linear functions, and the values that a match determines.
#include <map>
#include <optional>
#include <span>

#include "core/generators/building/shape_grammar/anchors.h"
#include "core/generators/building/shape_grammar/shape_grammar.h"

namespace seedmesh {
struct BuildingPair;
}

namespace seedmesh::building {

/// Left shapes are read for two values of each open variable: at these shares of its range.
constexpr double first_sample = 0.38, second_sample = 0.62;

/// Returns a value for each open variable, at this share of its range.
std::vector<double> samples_of(const FigurePair& pair, double share);
FigureValues named(const FigurePair& pair, const std::vector<double>& values);

/// Reports empty ranges, and variables that share a name with another variable or with a parameter.
void check_open_variables(const BuildingPair& given, const std::string& pointer, std::vector<Issue>& issues);

/// Returns the left shape for these values.
Figure left_shape(const FigurePair& pair, const std::vector<double>& values);

/// Reports a left shape that is not linear in its variables, or whose points do not determine them and a similarity.
/// `other` is the left shape read for `values`.
void check_open_left(const FigurePair& pair, const Figure& other, const std::vector<double>& values,
                     bool is_flat, const std::string& pointer, std::vector<Issue>& issues);

/// A point of a left shape: `at` plus the sum of the changes times the values.
struct OpenAnchor {
  glm::dvec3 at{0}, sample{0};  ///< `sample` is the point for first_sample
  std::vector<glm::dvec3> changes;
  std::uint32_t kind = 0, owner = no_owner, corner = 0;  ///< as in FigureAnchor
  std::vector<std::uint32_t> beside;  ///< anchors at the other ends of lines that begin here
};

/// Returns one anchor for each point. An end that lines of several directions share has the kind anchor_crossing.
std::vector<OpenAnchor> open_anchors(const FigurePair& pair);

/// Returns the anchors to search for, in this order: as many as determine the similarity and the values, those with few
/// candidates first. In space, the directions between the first three do not depend on the variables. `per_line` is the
/// mean number of points on a line of the figure. The result is empty if all anchors together are not enough.
std::vector<std::uint32_t> search_order(const std::vector<OpenAnchor>& anchors, bool is_flat,
                                        const std::map<std::uint32_t, std::size_t>& counts, double per_line);

struct OpenPlacement {
  Similarity place;
  std::vector<double> values;
};

/// Returns the similarity, mirrored or not, and the values that map these anchors to these points, by least squares;
/// nothing if there are none.
std::optional<OpenPlacement> solve_placement(const std::vector<OpenAnchor>& anchors,
                                             std::span<const std::uint32_t> order,
                                             std::span<const glm::dvec3> points, bool is_flat,
                                             bool is_mirrored);

}  // namespace seedmesh::building

#pragma once
/// General shape grammars: pairs of labelled shapes (Stiny and Gips, "Shape grammars and the generative
/// specification of painting and sculpture", 1972; Gips 1974; Kogovšek 2014, 4.1).
///
///   parameters -> FigureGrammar (read_figures) -> Figure (derive_figure)
///
/// A rule u -> v applies if a similarity t makes t(u) part of the figure: each line of t(u) lies in a line,
/// and each marker and solid equals one of the figure. The figure becomes (figure - t(u)) + t(v).
/// Similarities are found from distinguished points (Krishnamurti, "The construction of shapes", 1981):
/// points of markers, corners of solids and crossings of lines. The plane needs two of them, space three that
/// are not on a line. If a left shape has too few, the ends of its lines count too, and then only whole lines
/// match.
///
/// A left shape with open variables is a family (Stiny, "Ice-ray: a note on the generation of Chinese lattice
/// designs", 1977): a match also determines their values. Points of the left shape are linear in these values.
/// The inverse similarity, from the figure to the left shape, therefore has linear equations.
///
/// Shapes smaller than 10^-5 of the figure are not found, so that rules that make ever smaller shapes end.
/// In each step, the rule (by weight) and the match are chosen at random; the number of the step is the key.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/generators/building/shape_grammar/figure.h"

namespace seedmesh {
struct BuildingShapeGrammar;
}

namespace seedmesh::building {

struct OpenVariable {
  std::string name;
  double low = 0, high = 0;
};

struct FigurePair {
  std::string name;  ///< name for the report: its own name, or "rule 1" and so on
  double weight = 1;
  Figure left, right;
  /// Variables of both shapes. If there are some, `left` has them at first_sample, with a line for each segment, and
  /// `right` is read for each match.
  std::vector<OpenVariable> open;
  std::vector<Figure> moved;  ///< `left` with one variable at second_sample
};

struct FigureGrammar {
  bool is_flat = true, mirrors = true;
  std::vector<FigurePair> pairs;
  Figure initial;
  std::vector<std::string> labels, materials;
};

enum class FigureRestriction { any, non_erasing, unimarker };

/// Evaluates coordinates and inserts members of families. Errors have pointers below /shape_grammar: unknown
/// names, invalid numbers, left shapes that do not determine a similarity, more than 2,000 elements, and what
/// the restriction forbids. non_erasing forbids lines and solids of a left shape that the right shape has
/// not. unimarker also requires exactly one marker in left shapes and in the initial shape, and at most one
/// in right shapes.
FigureGrammar read_figures(const BuildingShapeGrammar& given, FigureRestriction restriction,
                           std::vector<Issue>& issues);

/// Values that a match has found, by name.
using FigureValues = std::map<std::string, double>;

/// Returns the right shape of a rule for these values of its open variables; nothing if its condition is 0. Errors as
/// in read_figures, of which it reports only those that depend on values.
std::optional<Figure> right_shape(const BuildingShapeGrammar& given, const FigureGrammar& grammar,
                                  std::size_t rule, const FigureValues& values, std::vector<Issue>& issues);

struct DerivedFigure {
  Figure figure;
  std::map<std::string, std::uint64_t> uses;  ///< number of uses of each rule
  std::uint64_t steps = 0;
  bool fits_nowhere = false;  ///< no rule applies to the initial shape
};

/// Runs the rules: one match in each step, or in parallel all matches that share no marker and no solid. Without
/// `steps` it runs until no rule applies. Spends Resource::shapes for added elements. Throws Stop after 100,000
/// steps, or if the figure grows beyond 1,000 km. Cost of a step: linear in markers and solids if markers determine
/// the similarity, else the square of the lines.
DerivedFigure derive_figure(const BuildingShapeGrammar& given, const FigureGrammar& grammar,
                            std::optional<int> steps, bool is_parallel, Job& job);

}  // namespace seedmesh::building

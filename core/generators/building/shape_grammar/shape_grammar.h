#pragma once
/// General shape grammars: pairs of labelled shapes (Stiny and Gips, "Shape grammars and the generative
/// specification of painting and sculpture", 1972; Gips 1974; Kogovšek 2014, 4.1).
///
///   parameters -> PictureGrammar (read_pictures) -> Picture (derive_picture)
///
/// A rule u -> v fits where a similarity t makes t(u) a part of the picture: each line of t(u) in a line,
/// each marker and solid equal to one. Then the picture becomes (picture - t(u)) + t(v). Similarities are
/// found from distinguished points (Krishnamurti, "The construction of shapes", 1981): points of markers,
/// corners of solids, crossings of lines; two of them in the plane, three that are not in a line in space.
/// Where a left shape has too few of them the ends of its lines count too, and its lines are then found as
/// wholes.
///
/// What is smaller than 10^-5 of the picture is not found any more, so that a shape that goes on in smaller
/// ones ends. Randomness: which rule (by weight) and which place, drawn by the number of the step.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/generators/building/shape_grammar/picture.h"

namespace seedmesh {
struct BuildingShapeGrammar;
}

namespace seedmesh::building {

struct PicturePair {
  std::string name;  ///< for the report: its own, or "rule 1" and so on
  double weight = 1;
  ShapePicture left, right;
};

struct PictureGrammar {
  bool is_flat = true, mirrors = true;
  std::vector<PicturePair> pairs;
  ShapePicture initial;
  std::vector<std::string> labels, materials;
};

enum class PictureRestriction { any, non_erasing, unimarker };

/// Works out coordinates and members of families. Faults have pointers below /shape_grammar: unknown names,
/// numbers that are none, left shapes whose place cannot be told, and what the restriction forbids: with
/// non_erasing a line or solid of a left shape that the right one has not; with unimarker besides any number
/// of markers but one on the left (and in the initial shape), and more than one on the right. At most 2,000
/// elements in all.
PictureGrammar read_pictures(const BuildingShapeGrammar& given, PictureRestriction restriction,
                             std::vector<Issue>& issues);

struct DerivedPicture {
  ShapePicture picture;
  std::map<std::string, std::uint64_t> uses;  ///< of each rule
  std::uint64_t steps = 0;
  bool fits_nowhere = false;  ///< no rule fits the initial shape
};

/// Runs the rules, one at a place in each step, or in parallel at all places at once that share no marker and
/// no solid. `steps` none: until none fits, at most 100,000. Spends Resource::shapes for what is added; Stop
/// where the picture grows beyond 1,000 km. Cost: a step is linear in markers and solids where markers tell
/// the place, else the square of the lines; and as many checks as there are candidates.
DerivedPicture derive_picture(const PictureGrammar& grammar, std::optional<int> steps, bool is_parallel,
                              Job& job);

}  // namespace seedmesh::building

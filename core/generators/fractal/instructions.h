#pragma once
/// The maps of a copy machine, from their name or from the list in the request.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/generators/fractal/affine.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

struct Instructions {
  std::string name;  ///< "" for a list
  std::vector<Affine> maps;
  std::vector<double> weights;  ///< of frcm, one a map; not normalised

  /// Each round leaves the element itself in place and copies only what the round before added: the identity
  /// stood among the maps.
  bool keeps = false;

  /// Applied to the element before anything else.
  Affine stem;

  /// Applied once around all rounds: the three sides of the snowflake. Empty: none.
  std::vector<Affine> arrangement;

  /// Copies of this element touch at most along edges and points, so areas and volumes add up. "" for none,
  /// "*" for every element inside its frame.
  std::string_view apart;
};

/// Known to be in order by check().
Instructions instructions_of(const FractalParams& params);

/// What is wrong with a list of maps, or with the word.
std::vector<Issue> check_instructions(const FractalParams& params);

}  // namespace seedmesh::fractal

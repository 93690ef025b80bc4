#pragma once
/// The maps of an iterated function system, by name or from the list in the request.
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
  std::vector<double> weights;  ///< one for each map, for frcm; not normalised

  /// True if the identity is one of the maps. Each round then keeps all copies so far, and applies the other
  /// maps only to those that the previous round has added.
  bool keeps = false;

  /// Applied to the element before anything else.
  Affine stem;

  /// Applied once after all rounds: the three sides of the snowflake. May be empty.
  std::vector<Affine> arrangement;

  /// The name of the element whose copies touch at most along edges and in points, so that areas and volumes
  /// can be added; "" if there is none.
  std::string_view separate;
};

/// The parameters must have passed check_instructions().
Instructions instructions_of(const FractalParams& params);

/// The warning that the probabilities of a list of maps do not sum to 1, unless that is an error.
std::optional<Warning> warning_of_weights(const FractalParams& params);

/// Errors in a list of maps or in the text of word_test.
std::vector<Issue> check_instructions(const FractalParams& params);

}  // namespace seedmesh::fractal

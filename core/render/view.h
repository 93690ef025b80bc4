#pragma once
/// The direction from which a picture is taken.
#include <optional>

namespace seedmesh::render {

/// The direction from the model to the eye, in degrees. Azimuth 0 is +Z and 90 is +X; elevation 90 is above.
struct View {
  double azimuth = 35;
  std::optional<double> elevation = {};  ///< none: 18, and up to 38 for models that are low and wide
};

}  // namespace seedmesh::render

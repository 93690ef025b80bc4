#pragma once
/// Where a picture is taken from, and where its light comes from.
#include <glm/glm.hpp>
#include <span>

#include "core/render/items.h"

namespace seedmesh::render {

/// The direction from the model to the eye, in degrees. Azimuth 0 is +Z and 90 is +X; elevation 90 is above.
struct View {
  double azimuth = 35, elevation = 18;
};

/// Orthonormal axes: right, up, and towards the eye.
struct Frame {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, towards{0, 0, 1};
};

/// Returns the axes of a view.
Frame frame_of(const View& view);

/// A pinhole camera with a square image.
struct Camera {
  Frame frame;
  glm::dvec3 eye{0};
  double half = 0.2;  ///< half the width of the image at distance 1
};

/// Returns the camera from whose image no part of the items sticks out, with a small margin.
Camera camera_for(const Model& model, const Items& items, const View& view);

}  // namespace seedmesh::render

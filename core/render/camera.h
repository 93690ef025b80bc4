#pragma once
/// The camera of a picture, and the axes of a view.
#include <glm/glm.hpp>

#include "core/render/items.h"
#include "core/render/view.h"

namespace seedmesh::render {

/// Orthonormal axes: right, up, and towards the eye.
struct Frame {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, towards{0, 0, 1};
};

/// Returns the axes of a view whose elevation is given.
Frame frame_of(double azimuth, double elevation);

/// Returns the elevation of a view, in degrees. A model whose height is small beside its width is seen from farther
/// above, so that it does not shrink to a stripe.
double elevation_of(const View& view, const Box& box);

/// A pinhole camera. Its image is a square, of which a picture shows the middle.
struct Camera {
  Frame frame;
  glm::dvec3 eye{0};
  double half = 0.2;  ///< half the width of the image at distance 1
};

/// Returns a camera that shows all of the items, with a small margin. The picture has the `share` of the square
/// image in width and height, each at most 1.
Camera camera_for(const Model& model, const Items& items, const Frame& frame, const glm::dvec2& share);

}  // namespace seedmesh::render

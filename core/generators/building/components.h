#pragma once
/// The faces, edges and vertices of a shape as shapes, and the classes by which selectors select them.
#include <span>
#include <vector>

#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// A component, with its classes in the frames of SelectorFrame.
struct Component {
  ShapeState state;
  std::uint32_t classes[2] = {0, 0};
};

/// Returns all components of a kind, in the order of the geometry. Faces have the origin at their first corner, x
/// along the first edge and z along the normal; edges have x along them and z as the mean of the normals of their
/// faces. Cost: linear; edges n log n.
std::vector<Component> components_of(Derivation& d, const ShapeState& state, std::uint8_t kind);

/// Whether a selector selects a component. `number` is the position of the component among those of its classes.
bool is_selected(Derivation& d, const Part& part, const Component& component, std::int32_t number,
                 std::uint32_t shape);

/// Returns the bits of a selector such as front or eave; 0 for other words.
std::uint32_t class_named(std::string_view name);
/// Reads the words of a selector, perhaps with a frame: front, world.up, street.front. Returns false if the text
/// is no selector.
bool read_selector(std::string_view dotted, std::uint32_t& classes, std::uint8_t& frame);

/// Returns several flat shapes as one, in the scope of `state`, with shared corners.
ShapeState merged_faces(Derivation& d, const ShapeState& state, std::span<const ShapeState> faces);

}  // namespace seedmesh::building

#pragma once
/// Tags of components: names that rules and operations give to faces, edges and vertices, for selectors.
#include <span>
#include <string_view>

#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Returns the number of a set of tags, which is added unless an equal one exists.
std::uint32_t tag_set(Derivation& d, std::vector<std::uint32_t> tags);
/// Returns the tags of both sets.
std::uint32_t joined_tags(Derivation& d, std::uint32_t a, std::uint32_t b);
/// Returns the set with one more tag.
std::uint32_t with_tag(Derivation& d, std::uint32_t set, std::string_view name);
/// Whether a tag matches a query. Points divide both into parts. The parts of the query must be the first parts of
/// the tag; `?` matches any part and `*` one or more parts. A part of the query that ends in `*` matches all parts
/// that begin with the rest of it.
bool fits_tag(std::string_view tag, std::string_view query);
/// Whether a component of `dimension` (2 faces, 1 edges, 0 vertices) with a set of tags has one that matches the
/// query. Tags of edges count for edges and vertices, tags of vertices only for vertices.
bool has_tag(const Derivation& d, std::uint32_t set, std::string_view query, int dimension);
/// Returns the name of a tag without the sign of edges or vertices.
std::string_view name_of_tag(std::string_view tag);

/// Returns the index of a style that has the tags of the faces around an edge. It also has the tag `bool.cut` where
/// faces of both operands of a Boolean operation meet.
std::uint32_t style_of_edge(Derivation& d, const Solid& solid, std::span<const std::uint32_t> faces,
                            std::uint32_t style);

/// Tags the faces that an extrusion, a roof, a taper or an envelope made of a flat shape: extrude.bottom,
/// extrude.side.outer, extrude.side.inner (around holes), extrude.top.
void add_auto_tags(Derivation& d, Op op, const ShapeState& before, ShapeState& after);

}  // namespace seedmesh::building

#pragma once
/// Tags of components: names that rules and operations give to faces, edges and vertices, for selectors.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Returns the number of a set of tags, which is added unless an equal one exists.
std::uint32_t tag_set(Derivation& d, std::vector<std::uint32_t> tags);
/// Returns the tags of both sets.
std::uint32_t joined_tags(Derivation& d, std::uint32_t a, std::uint32_t b);
/// Returns the set with one more tag.
std::uint32_t with_tag(Derivation& d, std::uint32_t set, std::string_view name);
bool has_tag(const Derivation& d, std::uint32_t set, std::string_view name);

}  // namespace seedmesh::building

#pragma once
/// The levels of detail that output.lods asks for: a number, or a list of triangles.
#include <cstdint>
#include <vector>

#include "core/schema/issue_list.h"
#include "generated/params/output.h"

namespace seedmesh {

/// Returns the number of levels.
int level_count(const OutputParams& output);

/// Whether output.lods gives numbers of triangles: a list of several levels, or of one level smaller than the model.
bool has_listed_levels(const OutputParams& output);

/// Returns the list as numbers of triangles, for a model with `whole` triangles: shares up to 1 of it, and numbers
/// above 1.
std::vector<std::uint64_t> listed_triangles(const OutputParams& output, std::uint64_t whole);

/// Errors of a list: numbers of triangles that are not whole, and entries that do not fall.
void check_level_list(const OutputParams& output, IssueList& errors);

}  // namespace seedmesh

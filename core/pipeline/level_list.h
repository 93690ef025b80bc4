#pragma once
/// The levels of detail of output.lods: a number, or a list of triangles.
#include <cstdint>
#include <vector>

#include "core/schema/issue_list.h"
#include "generated/params/output.h"

namespace seedmesh {

/// Returns the number of levels.
int level_count(const OutputParams& output);

/// Whether output.lods gives numbers of triangles: a list of several levels, or of one level smaller than the model.
bool has_listed_levels(const OutputParams& output);

/// Returns the list as numbers of triangles. An entry of at most 1 is a share of `whole`, the number of
/// triangles of the model. A larger entry is a number of triangles.
std::vector<std::uint64_t> listed_triangles(const OutputParams& output, std::uint64_t whole);

/// Adds the errors of a list: numbers of triangles that are not whole, and entries that are not smaller than
/// the one before.
void check_level_list(const OutputParams& output, IssueList& errors);

}  // namespace seedmesh

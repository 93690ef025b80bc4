#pragma once
/// What a GLB file contains, in a few lines that a person can compare. The file is read again from its bytes,
/// so that the summary does not depend on the code that wrote it.
#include <string>
#include <string_view>

namespace seedmesh::golden {

/// Five lines, each indented by two spaces and ended by a newline: counts of drawn elements and stored
/// vertices, bounds in metres, area of all drawn triangles in square metres, names of the materials, and
/// numbers of nodes, meshes, textures and animations. Drawn elements are counted once for each node.
/// Expects an uncompressed GLB (profile core) with float positions, as this project writes it; for other
/// bytes the result is one line with their number.
std::string summary_of_glb(std::string_view file);

}  // namespace seedmesh::golden

#pragma once
/// Selects the samples of a reduced mesh and triangulates them.
///
/// Both reduced meshes keep a stated bound: no sample of the field lies further above or below the mesh than
/// `max_error`. The bound applies to all samples, not only for those tested when a triangle was split;
/// measured_error() returns the error reached.
#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// A vertex is the sample number x + z * width. Three vertices form a triangle, counter-clockwise as seen
/// from above.
struct Triangulation {
  Array<std::uint32_t> samples;
  Array<std::uint32_t> index;
};

/// Treatment of the border. With `whole`, the samples of the border that are kept depend on the border alone,
/// so that neighbours fit together. rtin() keeps all samples of the border. greedy() keeps those that a
/// polyline within the bound needs. With `by_error`, the border is treated like the interior.
enum class Border { by_error, whole };

/// The largest error of a mesh, in metres, with a separate bound for a border that has to fit meshes of other
/// levels.
struct Tolerance {
  double inside = 0, border = 0;
};

/// Returns true for a square of 2^n + 1 samples, which rtin() needs.
bool fits_rtin(std::int32_t width, std::int32_t depth);

/// Returns a right-triangulated irregular network (Evans, Kirkpatrick and Townsend, "Right-triangulated
/// irregular networks", 2001): right triangles are split where their error exceeds the bound. Samples that
/// the usual midpoint test leaves outside the bound are added until it is kept. Spends Resource::triangles.
/// Cost: 10 to 20 ns for each sample.
Triangulation rtin(const Field& field, double max_error, Border border, Job& job);

/// Returns a Delaunay triangulation by greedy insertion (Garland and Heckbert, "Fast polygonal approximation
/// of terrains and height fields", 1995): the sample with the largest error comes next. It has about half the
/// triangles of rtin() at the same error. A `whole` border keeps those samples that a greedy polyline along
/// it needs for the border's bound; they depend on the border alone. Spends Resource::triangles. Cost: about
/// 1 microsecond for each triangle.
Triangulation greedy(const Field& field, const Tolerance& tolerance, Border border, Job& job);
Triangulation greedy(const Field& field, double max_error, Border border, Job& job);

/// Returns the largest vertical distance between a sample and the mesh, in metres. Cost: about 2 ns for each
/// sample.
double measured_error(const Field& field, const Triangulation& mesh, const Job& job);

}  // namespace seedmesh::terrain

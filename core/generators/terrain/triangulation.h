#pragma once
/// Which samples of a field a mesh has, and its triangles.
///
/// Both reduced meshes keep a stated bound: no sample of the field lies further above or below the mesh than
/// `max_error`. It is a bound on all samples, not on those at hand when a triangle was split;
/// measured_error() tells what was reached.
#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// A vertex is sample x + z * width; three vertices a triangle, counter-clockwise seen from above.
struct Triangulation {
  Array<std::uint32_t> samples;
  Array<std::uint32_t> index;
};

/// What stays of the border. `whole` keeps every sample of it, so that neighbours fit together whatever error
/// they were made with; `by_error` treats it like the inside.
enum class Border { by_error, whole };

/// How far off a mesh may be, in metres; apart for the border where that is to fit meshes of other levels.
struct Tolerance {
  double inside = 0, border = 0;
};

/// Is the field a square of 2^n + 1 samples, as rtin() wants it?
bool fits_rtin(std::int32_t width, std::int32_t depth);

/// Right-triangulated irregular network (Evans, Kirkpatrick and Townsend, "Right-triangulated irregular
/// networks", 2001): right triangles halved where they are off. Where the bound is still passed after the
/// usual test of midpoints, the samples concerned are put in, until it holds. Cost: 10 to
/// 20 ns a sample. Spends triangles.
Triangulation rtin(const Field& field, double max_error, Border border, Job& job);

/// Greedy insertion into a Delaunay triangulation (Garland and Heckbert, "Fast polygonal approximation of
/// terrains and height fields", 1995): the sample that is off most, anywhere, comes next. About half the
/// triangles of rtin() at the same error, at about 1 microsecond each. A `whole` border keeps those samples
/// of it that a greedy line along it would need by the border's bound, which depend on the border alone.
/// Spends triangles.
Triangulation greedy(const Field& field, const Tolerance& tolerance, Border border, Job& job);
Triangulation greedy(const Field& field, double max_error, Border border, Job& job);

/// The greatest vertical distance between a sample and the mesh, in metres; about 2 ns a sample.
double measured_error(const Field& field, const Triangulation& mesh, const Job& job);

}  // namespace seedmesh::terrain

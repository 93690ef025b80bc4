#include "core/generators/terrain/cache_order.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/generators/terrain/scan.h"

namespace seedmesh::terrain {
namespace {

// Number of triangles that are ordered together. It bounds the memory of the ordering.
constexpr std::size_t triangles_ordered = std::size_t{1} << 17U;

/// Sorts triangles by squares of the field, stable within each square. Returns the end of each square.
std::vector<std::size_t> sort_by_squares(Triangulation& plan, const Field& field, const Job& job) {
  const std::size_t triangles = plan.index.size() / 3;
  std::size_t across = 1;
  while (across * across * triangles_ordered < triangles) ++across;
  const auto square_of = [&](std::size_t corner) {
    const GridPoint at = grid_point_of(plan.samples[plan.index[corner]], field.width);
    const auto part = [across](std::int32_t position, std::int32_t side) {
      return static_cast<std::size_t>(position) * across / static_cast<std::size_t>(side);
    };
    return part(at.z, field.depth) * across + part(at.x, field.width);
  };
  std::vector<std::size_t> ends(across * across, 0);
  for (std::size_t i = 0; i < plan.index.size(); i += 3) ends[square_of(i)] += 3;
  std::size_t end = 0;
  for (std::size_t& each : ends) each = std::exchange(end, end + each);
  Array<std::uint32_t> sorted(job, plan.index.size());
  for (std::size_t i = 0; i < plan.index.size(); i += 3) {
    std::size_t& at = ends[square_of(i)];
    std::copy_n(plan.index.data() + i, 3, sorted.data() + at);
    at += 3;
  }
  plan.index = std::move(sorted);
  return ends;
}

}  // namespace

void order_for_cache(Triangulation& plan, const Field& field, const Job& job) {
  std::size_t begin = 0;
  for (const std::size_t end : sort_by_squares(plan, field, job)) {
    std::uint32_t* first = plan.index.data() + begin;
    if (end > begin) meshopt_optimizeVertexCache(first, first, end - begin, plan.samples.size());
    begin = end;
    job.check();
  }
  Array<std::uint32_t> position(job, plan.samples.size(), 0xFFFFFFFFU);
  Array<std::uint32_t> samples(job);
  samples.reserve(plan.samples.size());
  for (std::uint32_t& corner : plan.index) {
    std::uint32_t& at = position[corner];
    if (at == 0xFFFFFFFFU) {
      at = static_cast<std::uint32_t>(samples.size());
      samples.push_back(plan.samples[corner]);
    }
    corner = at;
  }
  plan.samples = std::move(samples);
}

}  // namespace seedmesh::terrain

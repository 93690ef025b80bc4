#include "core/geom/plant/graft/bark_buffers.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/geom/plant/graft/limb_axis.h"

namespace seedmesh {
namespace {

// Initial capacities. Most trees of fine twigs need about as much; small trees of thick limbs need twice
// that.
constexpr std::size_t vertices_a_joint = 4, triangles_a_joint = 5, more_vertices = std::size_t{1} << 15U,
                      more_vertices_a_joint = 2;
constexpr std::size_t groups_a_limb = 5, triangles_a_group = 6, more_groups = std::size_t{1} << 13U;
constexpr std::size_t temporary_groups = 1024;  // of junction_normals.cpp
// Above this number of vertices the arrays are copied one after the other, each into the memory of the last.
constexpr std::size_t most_together = std::size_t{1} << 20U;

/// True where the limbs are contiguous and in order.
bool is_in_order(const BarkBuffers& bark) {
  std::uint32_t vertex = 0;
  for (const LimbRange& range : bark.range) {
    if (range.begin.vertex != vertex) return false;
    vertex = range.end.vertex;
  }
  return vertex == bark.vertices;
}

/// Copies an array limb by limb and frees it.
template <class T>
Array<T> gathered(const BarkBuffers& bark, Array<T>& from, std::uint32_t BarkSizes::*size, std::size_t spare,
                  const Job& job) {
  Array<T> out(job);
  out.reserve(from.empty() ? 0 : sum_of(bark.range, size) + spare);
  for (const LimbRange& range : bark.range) {
    if (!from.empty())
      out.append(from.span().subspan(range.begin.*size, range.end.*size - range.begin.*size));
  }
  from = {};
  return out;
}

/// The corners of all triangles, by the numbers that gathered vertices have.
Array<std::uint32_t> gathered_index(const BarkBuffers& bark, const Job& job) {
  Array<std::uint32_t> index(job);
  index.reserve(std::size_t{3} * sum_of(bark.range, &BarkSizes::triangle));
  std::uint32_t vertex = 0;
  for (const LimbRange& range : bark.range) {
    const std::uint32_t *from = bark.corners_of(range.begin.triangle),
                        *end = bark.corners_of(range.end.triangle);
    const std::uint32_t shift = vertex - range.begin.vertex;
    std::uint32_t* to = index.extend(static_cast<std::size_t>(end - from));
    while (from != end) *to++ = *from++ + shift;
    vertex += range.end.vertex - range.begin.vertex;
  }
  return index;
}

}  // namespace

BarkBuffers::BarkBuffers(const GraftOptions& options, std::size_t limbs, std::size_t joints_expected,
                         Job& job)
    : has_tangents(options.tangents),
      has_joints(options.joints != nullptr),
      has_colors(options.colors != nullptr),
      v_scale(options.v_scale),
      group(job),
      twin(job),
      joints(job),
      colors(job),
      loop_triangles(job),
      group_normal(job),
      loops(limbs),
      loop_vertices(job),
      range(limbs),
      start(limbs, LimbStart::none),
      triangles(job, Resource::triangles) {
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.tangent = Array<glm::vec4>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  const std::size_t more =
      std::min(more_vertices + more_vertices_a_joint * joints_expected, vertices_a_joint * joints_expected);
  resize_vertices(*this, vertices_a_joint * joints_expected + more + 64);
  mesh.index.wide.reserve(3 * (triangles_a_joint * joints_expected + more + more / 2));
  const std::size_t groups = std::min(more_groups, groups_a_limb * limbs);
  group_limb.reserve(groups);
  group_normal.reserve(2 * groups + temporary_groups);
  loop_vertices.reserve(groups);
  loop_triangles.reserve(triangles_a_group * groups);
}

BarkSizes sizes_of(const BarkBuffers& bark) {
  return {static_cast<std::uint32_t>(bark.vertices),
          static_cast<std::uint32_t>(bark.mesh.index.wide.size() / 3),
          static_cast<std::uint32_t>(bark.group_normal.size()),
          static_cast<std::uint32_t>(bark.loop_triangles.size()),
          static_cast<std::uint32_t>(bark.corners),
          static_cast<std::uint32_t>(bark.wide_corners)};
}

std::uint32_t sum_of(std::span<const LimbRange> ranges, std::uint32_t BarkSizes::*size) {
  std::uint32_t sum = 0;
  for (const LimbRange& range : ranges) sum += range.end.*size - range.begin.*size;
  return sum;
}

void resize_vertices(BarkBuffers& bark, std::size_t vertices) {
  bark.mesh.position.resize(vertices);
  bark.mesh.normal.resize(vertices);
  bark.mesh.uv[0].resize(vertices);
  if (bark.has_tangents) bark.mesh.tangent.resize(vertices);
  bark.group.resize(vertices);
  bark.twin.resize(vertices);
  if (bark.has_joints) bark.joints.resize(vertices);
}

std::uint32_t* add_triangles(BarkBuffers& bark, std::size_t count) {
  if (bark.is_part) {
    bark.uncharged += count;
  } else {
    bark.triangles.spend(count);
  }
  return bark.mesh.index.wide.extend(3 * count);
}

void note_loop_triangles(BarkBuffers& bark, std::size_t first) {
  const std::size_t end = bark.mesh.index.wide.size() / 3;
  const std::uint32_t* corner = bark.mesh.index.wide.data() + 3 * first;
  // Each triangle is written to the list and kept where it touches a loop: a branch would be mispredicted.
  std::uint32_t* noted = bark.loop_triangles.extend(end - first);
  for (std::size_t t = first; t < end; ++t, corner += 3) {
    *noted = static_cast<std::uint32_t>(t);
    noted += (bark.group[corner[0]] & bark.group[corner[1]] & bark.group[corner[2]]) != Limbs::none ? 1 : 0;
  }
  bark.loop_triangles.resize(static_cast<std::size_t>(noted - bark.loop_triangles.data()));
}

void level_tangent(Mesh& mesh, std::size_t vertex) {
  glm::vec4& tangent = mesh.tangent[vertex];
  const glm::vec3& normal = mesh.normal[vertex];
  glm::vec3 along(tangent);
  const float before = glm::dot(along, along);
  along -= normal * glm::dot(along, normal);
  constexpr float least = 1e-3F;
  const bool is_found = before > 0 && glm::dot(along, along) > least * least * before;
  tangent = {math::quick_unit(is_found ? along : unit_perpendicular(normal), {1, 0, 0}) + 0.0F, tangent.w};
}

JoinedBark take_bark(BarkBuffers& bark, std::size_t spare_triangles, const Job& job) {
  if (is_in_order(bark)) {
    resize_vertices(bark, bark.vertices);
    return {std::move(bark.mesh), std::move(bark.joints), std::move(bark.twin), std::move(bark.colors)};
  }
  bark.group = {};
  JoinedBark out;
  const std::size_t spare = 3 * spare_triangles;
  const auto by_vertex = [&](auto& to, auto& from) {
    to = gathered(bark, from, &BarkSizes::vertex, spare, job);
  };
  const std::function<void()> tasks[] = {
      [&] { by_vertex(out.mesh.position, bark.mesh.position); },
      [&] { by_vertex(out.mesh.normal, bark.mesh.normal); },
      [&] { by_vertex(out.mesh.tangent, bark.mesh.tangent); },
      [&] { out.mesh.index.wide = gathered_index(bark, job); },
      [&] { by_vertex(out.mesh.uv[0], bark.mesh.uv[0]); },
      [&] { by_vertex(out.joints, bark.joints); },
      [&] { by_vertex(out.twin, bark.twin); },
      [&] { out.colors = gathered(bark, bark.colors, &BarkSizes::triangle, spare, job); },
  };
  const std::size_t together = bark.vertices > most_together ? std::size(tasks) : 1;
  parallel_for(job, std::size(tasks), together, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) tasks[i]();
  });
  bark.mesh = {};
  return out;
}

}  // namespace seedmesh

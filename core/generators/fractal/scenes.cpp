#include "core/generators/fractal/scenes.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/fractal/faces.h"
#include "core/generators/fractal/measure.h"
#include "core/geom/polygon/triangulate.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {
namespace {

constexpr double gap = 0.25;  ///< between stages, as a share of the width of one

double space_of(const FractalParams& params, const Job& job) {
  if (params.method != FractalMethod::mrcm) return params.size;
  FractalParams cubes = params;
  cubes.element = FractalElement::sphere;  // fills its frame, and no cells have to be counted
  int most = 0;
  for (const std::int32_t rounds : params.stages) most = std::max(most, rounds);
  Job own = job.for_estimate();
  const Measure measured = measure(cubes, instructions_of(params), most, own);
  if (!measured.bounds) return params.size * 1.25;
  const glm::vec3 size = measured.bounds->max - measured.bounds->min;
  return params.size * std::max(1.0, static_cast<double>(std::max(size.x, size.y)));
}

Box box_of(const Cloud& cloud) { return bounds_of(cloud.position.span()); }

double longest_side(const Box& box) {
  const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
  return std::max({size.x, size.y, size.z, 1e-9});
}

Mesh points_of(const FractalParams& params, Cloud cloud, const Job& job) {
  std::vector<glm::u8vec4> palette;
  for (const Color& color : params.palette)
    palette.push_back(linear_color(color.red, color.green, color.blue));
  Mesh mesh;
  mesh.topology = Topology::points;
  mesh.color = Array<glm::u8vec4>(job, cloud.position.size());
  for (std::size_t i = 0; i < cloud.position.size(); ++i)
    mesh.color[i] = palette[cloud.map[i] % palette.size()];
  mesh.position = std::move(cloud.position);
  return mesh;
}

Mesh voxels_of(const FractalParams& params, const Cloud& cloud, Job& job) {
  const Box box = box_of(cloud);
  const double cell = longest_side(box) / params.voxels * (1 + 1e-9);
  const glm::dvec3 low(box.min), extent = glm::dvec3(box.max) - low;
  glm::ivec3 size;
  for (int axis = 0; axis < 3; ++axis) size[axis] = math::to_int32(std::floor(extent[axis] / cell)) + 1;
  BitGrid by_x(job, glm::ivec3(0), size), by_z(job, glm::ivec3(0), {size.z, size.y, size.x});
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const glm::dvec3 p = (glm::dvec3(cloud.position[i]) - low) / cell;
    const glm::ivec3 at =
        glm::min(glm::ivec3(math::to_int32(p.x), math::to_int32(p.y), math::to_int32(p.z)), size - 1);
    by_x.row(at.y, at.z)[at.x / 64] |= std::uint64_t{1} << (at.x % 64);
    by_z.row(at.y, at.x)[at.z / 64] |= std::uint64_t{1} << (at.z % 64);
  }
  return exposed_faces({std::move(by_x), std::move(by_z), low, glm::dvec3(cell)}, nullptr, job);
}

/// Counter-clockwise, from the left end of the lower side.
std::vector<glm::dvec2> snowflake(int rounds, const Job& job) {
  std::size_t steps = 0;
  const auto look = [&] {
    if (++steps % 4'096 == 0) job.check();
  };
  FractalParams params;
  params.instructions = FractalInstructions::koch_snowflake;
  const Instructions instructions = instructions_of(params);
  std::vector<Affine> curve = instructions.arrangement;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Affine> finer;
    finer.reserve(curve.size() * instructions.maps.size());
    for (const Affine& part : curve) {
      look();
      for (const Affine& map : instructions.maps) finer.push_back(compose(part, map));
    }
    curve = std::move(finer);
  }
  std::vector<glm::dvec2> outline;
  for (const Affine& part : curve) {
    look();
    outline.emplace_back(part({-0.5, 0, 0}));
  }
  std::ranges::reverse(outline);
  return outline;
}

}  // namespace

void add_mesh(Model& model, int parent, const std::string& name, Mesh mesh) {
  add_node(model, name, parent, seedmesh::add_mesh(model, name, std::move(mesh), 0));
}

void each_stage(Model& model, const FractalParams& params, std::int64_t amount, const Job& job,
                const std::function<void(int node, std::int64_t amount)>& make) {
  add_node(model, "fractal", -1);
  if (params.stages.empty()) {
    make(0, amount);
    return;
  }
  const double pitch = (1 + gap) * space_of(params, job);
  for (std::size_t i = 0; i < params.stages.size(); ++i) {
    const auto columns = static_cast<std::size_t>(params.columns);
    Node& node = add_node(model, "stage_" + std::to_string(params.stages[i]), 0);
    const std::size_t row = i / columns;
    node.transform.translation =
        glm::vec3(glm::dvec3(static_cast<double>(i % columns), -static_cast<double>(row), 0) * pitch);
    make(static_cast<int>(model.nodes.size()) - 1, params.stages[i]);
  }
}

void add_cloud(Model& model, int parent, const FractalParams& params, Cloud cloud,
               const std::vector<Primitive>& element, Job& job) {
  if (params.cloud == FractalCloud::points) {
    add_mesh(model, parent, "points", points_of(params, std::move(cloud), job));
    return;
  }
  if (params.cloud == FractalCloud::voxels) {
    add_mesh(model, parent, "voxels", voxels_of(params, cloud, job));
    return;
  }
  const double edge = longest_side(box_of(cloud)) / params.voxels;
  MeshGroup group;
  group.name = "elements";
  for (const Primitive& primitive : element) {
    group.primitives.push_back(
        {scattered(primitive.mesh, cloud.position.span(), edge, job), primitive.material, {}});
  }
  add_node(model, "elements", parent, seedmesh::add_mesh(model, std::move(group)));
}

Mesh koch_plate(int rounds, double size, Job& job) {
  constexpr double half = 0.05;
  constexpr std::size_t check_interval = 16'384;
  constexpr int most_rounds = 9;
  if (rounds > most_rounds) {
    job.refuse(limit_issue({Resource::iterations, most_rounds, static_cast<std::uint64_t>(rounds)},
                           "found " + std::to_string(rounds) +
                               " rounds of a snowflake's plate; the limit is " + std::to_string(most_rounds),
                           "/iterations"));
  }
  std::size_t corners = 3;
  for (int round = 0; round < rounds; ++round) corners *= 4;
  job.spend(Resource::triangles, 4 * corners - 4);
  const std::vector<glm::dvec2> outline = snowflake(rounds, job);
  Triangulator triangulator(&job);
  // Many corners are collinear. Triangles far smaller than the smallest bump of the curve are left out.
  const double least_area = 0.05 / static_cast<double>(corners) / static_cast<double>(corners);
  const std::span<const std::uint32_t> inside = triangulator.run(outline, least_area);
  Mesh mesh = empty_mesh(job);
  for (const double z : {half, -half}) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (const glm::dvec2& p : outline) {
      if (mesh.position.size() % check_interval == 0) job.check();
      mesh.position.push_back(glm::vec3(glm::dvec3(p, z) * size));
      mesh.normal.push_back({0, 0, z > 0 ? 1 : -1});
    }
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (i % check_interval == 0) job.check();
      mesh.index.wide.push_back(first + inside[z > 0 ? i : i / 3 * 3 + 2 - i % 3]);
    }
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    const glm::vec3 out(math::unit(glm::dvec3(b.y - a.y, a.x - b.x, 0), {0, 1, 0}));
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (const glm::dvec3& p :
         {glm::dvec3(a, half), glm::dvec3(a, -half), glm::dvec3(b, -half), glm::dvec3(b, half)}) {
      mesh.position.push_back(glm::vec3(p * size));
      mesh.normal.push_back(out);
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(first + corner);
  }
  return mesh;
}

}  // namespace seedmesh::fractal

// Coloured areas on level ground; see areas.h.
#include "core/generators/scene/areas.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>

#include "core/generators/material_members.h"
#include "core/generators/scene/buildings.h"
#include "core/geom/polygon/plan.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

// Height above the ground. Areas of each following name and colour are slightly higher, so that areas that overlap do
// not flicker. All stay below paths.
constexpr double lift = 0.01, step_up = 0.004, most_above = 0.024;

using Key = std::tuple<std::string, std::uint32_t, double, std::array<double, 4>>;

Key key_of(const SceneArea& area) {
  const Color& color = area.color;
  return {area.name, static_cast<std::uint32_t>(color.red << 16U | color.green << 8U | color.blue),
          area.roughness, light_key(area)};
}

void append(Mesh& mesh, const SceneArea& area, double height, Job& job) {
  const Plan plan = plan_of_rings(area.outline);
  const std::vector<std::uint32_t> corners = triangulate(plan, ThinTriangles::drop, &job);
  job.spend(Resource::triangles, corners.size() / 3);
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  std::vector<bool> is_used(edge_count(plan), false);
  for (const std::uint32_t i : corners) is_used[i] = true;
  std::vector<std::uint32_t> vertex(is_used.size());
  std::uint32_t point = 0, used = 0;
  for (const PlanRing& ring : plan.rings) {
    for (const glm::dvec2& p : ring) {
      vertex[point] = first + used;
      if (is_used[point++]) {
        ++used;
        mesh.position.push_back(glm::vec3(raised(p, height)) + 0.0F);
        mesh.normal.push_back({0, 1, 0});
      }
    }
  }
  for (const std::uint32_t i : corners) mesh.index.wide.push_back(vertex[i]);
}

}  // namespace

void add_areas(Model& model, const std::vector<SceneArea>& areas, Job& job) {
  std::map<Key, std::size_t> group_of;
  std::vector<Mesh> meshes;
  std::vector<const SceneArea*> first;
  for (const SceneArea& area : areas) group_of.emplace(key_of(area), 0);
  const double step =
      std::min(step_up, most_above / static_cast<double>(std::max<std::size_t>(group_of.size(), 1)));
  group_of.clear();
  for (std::size_t i = 0; i < areas.size(); ++i) {
    Job own = job;
    const Job::PointerScope scope(own, "/areas/" + std::to_string(i));
    const auto [group, is_new] = group_of.emplace(key_of(areas[i]), meshes.size());
    if (is_new) {
      meshes.push_back(empty_mesh(job));
      first.push_back(&areas[i]);
    }
    append(meshes[group->second], areas[i], lift + step * static_cast<double>(group->second), own);
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].index.wide.empty()) continue;
    const SceneArea& area = *first[i];
    Material material;
    material.name = area.name;
    material.base_color = linear_color(area.color);
    material.roughness = static_cast<float>(area.roughness);
    set_specular(material, area.specular);
    set_emission(material, area.emission);
    const int number = add_material(model, std::move(material));
    add_node(model, area.name, 0, add_mesh(model, area.name, std::move(meshes[i]), number));
  }
}

}  // namespace seedmesh::scene

#include "core/generators/city/model_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "core/base/math.h"
#include "core/generators/city/solid_builder.h"
#include "core/generators/scene/model_levels.h"
#include "core/model/collision_name.h"
#include "core/model/levels.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

constexpr std::array<double, 4> shares = {0.5, 0.25, 0.12, 0.06};
constexpr int levels_of_camera = 5;

Box box_of(const std::vector<Primitive>& primitives) {
  std::optional<Box> all;
  for (const Primitive& each : primitives) {
    if (each.mesh.elements() == 0) continue;
    const Box box = bounds_of(each.mesh);
    all = all ? Box{glm::min(all->min, box.min), glm::max(all->max, box.max)} : box;
  }
  return all.value_or(Box{});
}

void measure(LevelInfo& info, const Box& box) {
  const glm::dvec3 size(box.max - box.min);
  info.radius = glm::length(size) / 2;
  info.middle = static_cast<double>(box.min.y + box.max.y) / 2;
}

std::uint64_t triangles_of(const std::vector<Primitive>& primitives) {
  std::uint64_t sum = 0;
  for (const Primitive& each : primitives) sum += each.mesh.elements();
  return sum;
}

}  // namespace

ViewPoint::ViewPoint(const CityParams& params) {
  if (!params.camera) return;
  at_ = {params.camera->position[0], params.camera->position[2], 0 - params.camera->position[1]};
  half_height_ = math::tan(math::radians(params.camera->field_of_view) / 2);
}

std::size_t ViewPoint::level(const LevelInfo& info, const Transform& at) const {
  if (!is_given()) return 0;
  const double scale = static_cast<double>(at.scale.x);
  const glm::dvec3 middle = glm::dvec3(at.translation) + glm::dvec3(0, info.middle * scale, 0);
  const double distance = glm::length(middle - at_), radius = info.radius * scale;
  const double share = distance <= radius ? 1 : radius / (distance * half_height_);
  std::size_t level = 0;
  while (level < shares.size() && share < shares[level]) ++level;
  return std::min(level, info.triangles.size() - 1);
}

int level_count(const ViewPoint& view, const Demand& demand) {
  return view.is_given() ? std::max(demand.lods, levels_of_camera) : demand.lods;
}

int CopyWriter::add_material(Material material, const Model& made) {
  for (TextureUse* use :
       {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
        &material.occlusion_texture, &material.emissive_texture}) {
    if (use->texture < 0) continue;
    city_.textures.push_back(made.textures[static_cast<std::size_t>(use->texture)]);
    use->texture = static_cast<int>(city_.textures.size()) - 1;
  }
  for (std::size_t i = 0; i < city_.materials.size(); ++i) {
    if (scene::is_same(city_.materials[i], material, scene::Seeds::may_differ)) return static_cast<int>(i);
  }
  city_.materials.push_back(std::move(material));
  return static_cast<int>(city_.materials.size()) - 1;
}

int CopyWriter::add_level(std::string name, std::vector<Primitive> primitives,
                          const std::vector<int>& materials) {
  MeshGroup group{std::move(name), {}};
  for (Primitive& each : primitives) {
    if (each.mesh.elements() == 0) continue;
    if (each.material >= 0) each.material = materials[static_cast<std::size_t>(each.material)];
    group.primitives.push_back(std::move(each));
  }
  if (group.primitives.empty()) return -1;
  city_.meshes.push_back(std::move(group));
  return static_cast<int>(city_.meshes.size()) - 1;
}

void CopyWriter::add_bodies(int mesh, const char* group, const std::vector<Copy>& copies) {
  const CollisionNames names = context_.demand.collision;
  if (names == CollisionNames::none) return;
  const MeshGroup& shown = city_.meshes[static_cast<std::size_t>(mesh)];
  const Box box = box_of(shown.primitives);
  SolidBuilder solid(context_.job);
  solid.add_box(box.min, box.max);
  const std::string of = shown.name;
  Primitive primitive;
  primitive.mesh = solid.take(context_.job);
  Material material;
  material.name = "collision";
  const auto same = std::find_if(city_.materials.begin(), city_.materials.end(),
                                 [](const Material& each) { return each.name == "collision"; });
  primitive.material = static_cast<int>(same - city_.materials.begin());
  if (same == city_.materials.end()) city_.materials.push_back(std::move(material));
  MeshGroup body{"collision", {}};
  body.primitives.push_back(std::move(primitive));
  const auto body_mesh = static_cast<int>(city_.meshes.size());
  city_.meshes.push_back(std::move(body));
  for (std::size_t i = 0; i < copies.size(); ++i) {
    Node node;
    node.name = collision_name(names, of, i + 1);
    node.parent = nodes_.group(copies[i].chunk, group);
    node.mesh = body_mesh;
    node.collision = CollisionShape::convex;
    node.transform = copies[i].at;
    city_.nodes.push_back(std::move(node));
  }
}

void CopyWriter::add(Model made, const std::string& name, const char* group, const std::vector<Copy>& copies,
                     Bodies bodies) {
  if (copies.empty()) return;
  Job& job = context_.job;
  std::vector<int> materials;
  for (Material& material : made.materials) materials.push_back(add_material(std::move(material), made));
  const bool is_merged = merged_ && copies.size() == 1;
  if (is_merged && levels_of(made) == 1 && merged_->add_nodes(made, materials, copies[0].at, copies[0].chunk))
    return;
  std::vector<std::vector<Primitive>> levels = scene::extract_levels(made, job);
  if (is_merged) return merge(levels, materials, copies[0]);
  LevelInfo info;
  std::vector<int> meshes;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const Box box = box_of(levels[level]);
    const std::uint64_t triangles = triangles_of(levels[level]);
    const int mesh = add_level(name + (level > 0 ? "_LOD" + std::to_string(level) : ""),
                               std::move(levels[level]), materials);
    if (mesh < 0) continue;
    if (meshes.empty()) measure(info, box);
    meshes.push_back(mesh);
    info.triangles.push_back(triangles);
  }
  if (meshes.empty()) return;
  std::vector<std::tuple<std::size_t, std::uint32_t, std::size_t>> order;  // level, chunk, copy
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    order.emplace_back(view_.level(info, copies[i].at), copies[i].chunk, i);
    triangles += info.triangles[std::get<0>(order.back())];
  }
  job.spend(Resource::triangles, triangles - std::min(triangles, info.triangles[0]));
  std::sort(order.begin(), order.end());
  const auto wanted = static_cast<std::size_t>(context_.demand.lods);
  for (std::size_t begin = 0; begin < order.size();) {
    const auto [level, chunk, first] = order[begin];
    std::size_t end = begin;
    while (end < order.size() && std::get<0>(order[end]) == level && std::get<1>(order[end]) == chunk) ++end;
    Node node;
    node.name = city_.meshes[static_cast<std::size_t>(meshes[level])].name;
    node.parent = nodes_.group(chunk, group);
    node.mesh = meshes[level];
    for (std::size_t i = level + 1; i < std::min(level + wanted, meshes.size()); ++i)
      node.lods.push_back(meshes[i]);
    if (end - begin == 1) {
      node.transform = copies[first].at;
    } else {
      for (std::size_t i = begin; i < end; ++i)
        node.instances.transforms.push_back(copies[std::get<2>(order[i])].at);
    }
    city_.nodes.push_back(std::move(node));
    begin = end;
  }
  if (bodies == Bodies::boxes) add_bodies(meshes[0], group, copies);
}

void CopyWriter::merge(const std::vector<std::vector<Primitive>>& levels, const std::vector<int>& materials,
                       const Copy& copy) {
  LevelInfo info;
  std::vector<std::size_t> shown;  // levels with triangles
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const std::uint64_t triangles = triangles_of(levels[level]);
    if (triangles == 0) continue;
    if (shown.empty()) measure(info, box_of(levels[level]));
    shown.push_back(level);
    info.triangles.push_back(triangles);
  }
  if (shown.empty()) return;
  const std::size_t chosen = view_.level(info, copy.at);
  const std::uint64_t triangles = info.triangles[chosen];
  context_.job.spend(Resource::triangles, triangles - std::min(triangles, info.triangles[0]));
  for (const Primitive& each : levels[shown[chosen]]) {
    const int material = each.material < 0 ? -1 : materials[static_cast<std::size_t>(each.material)];
    merged_->add(each.mesh, material, copy.at, copy.chunk);
  }
}

void CopyWriter::write_merged(const char* group, const char* name) {
  if (!merged_) return;
  merged_->write(city_, nodes_, group, name);
  merged_.reset();
}

LevelInfo level_info_of(Model made, Job& job) {
  LevelInfo info;
  std::vector<std::vector<Primitive>> levels = scene::extract_levels(made, job);
  for (const std::vector<Primitive>& level : levels) {
    const std::uint64_t triangles = triangles_of(level);
    if (triangles == 0) continue;
    if (info.triangles.empty()) measure(info, box_of(level));
    info.triangles.push_back(triangles);
  }
  if (info.triangles.empty()) info.triangles.push_back(0);
  return info;
}

}  // namespace seedmesh::city

// Buildings of a scene; see buildings.h. Defaults of roofs follow the pages "Simple 3D Buildings" and "roof:shape" of the
// OpenStreetMap wiki where these state some.
#include "core/generators/scene/buildings.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/scene/areas.h"
#include "core/generators/scene/ground.h"
#include "core/geom/mesh/weld.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

using glm::dvec2;

// The least height of walls and of a roof, so that a body is closed.
constexpr double least_wall = 0.01, least_roof = 0.001;
constexpr std::size_t buildings_a_chunk = 16;
// The most of a building's height that a roof takes where neither height nor angle are given.
constexpr double most_of_height = 0.5;

/// A building as a mesh about its middle.
struct Body {
  Mesh mesh;
  dvec2 middle{0};
  double ground = 0;
  std::vector<Warning> warnings;
};

/// Degrees of a roof without height and angle. Domes and onions follow their width instead.
double usual_angle(SceneShape shape) {
  switch (shape) {
    case SceneShape::skillion:
      return 10;
    case SceneShape::dome:
    case SceneShape::round:
      return 45;
    case SceneShape::onion:
    case SceneShape::mansard:
    case SceneShape::gambrel:
      return 55;
    default:
      return 35;
  }
}

MassOptions options_of(const SceneBuilding& building, const Plan& plan, const std::string& pointer,
                       Body& body, const Job& job) {
  MassOptions options;
  options.roof = static_cast<MassRoof>(building.roof.shape);
  options.base = building.base;
  options.eaves = building.height;
  if (building.roof.direction) {
    const math::SinCos at = math::sincos_degrees(*building.roof.direction);
    options.direction = dvec2(at.sin, at.cos);
  }
  options.across = building.roof.orientation == SceneOrientation::across;
  if (options.roof == MassRoof::flat) return options;
  const double whole = building.height - building.base, most = whole - least_wall;
  double height = 0;
  if (building.roof.height) {
    height = *building.roof.height;
  } else {
    const double angle = building.roof.angle.value_or(usual_angle(building.roof.shape));
    height = roof_height_at(plan, options, math::radians(angle), job);
    if (!building.roof.angle) height = std::min(height, most_of_height * whole);
  }
  if (height > most + 2 * least_wall) {
    body.warnings.push_back(
        {pointer + "/roof/angle", "the roof is lower, because it would be higher than the building"});
  }
  options.roof_height = std::clamp(height, least_roof, std::max(most, least_roof));
  options.eaves = building.height - options.roof_height;
  return options;
}

glm::u8vec4 color_of(const Color& color) {
  const auto linear = [](std::uint8_t value) {
    return static_cast<std::uint8_t>(math::to_uint32(std::floor(linear_of_srgb(value) * 255.0 + 0.5)));
  };
  return {linear(color.red), linear(color.green), linear(color.blue), 255};
}

/// The triangles of a mass, with vertices for each of its faces.
Mesh mesh_of(const Mass& mass, const SceneBuilding& building, const Job& job) {
  Mesh mesh = empty_mesh(job);
  mesh.color = Array<glm::u8vec4>(job);
  mesh.index.wide.reserve(3 * mass.triangles.size());
  const glm::u8vec4 wall = color_of(building.color), roof = color_of(building.roof.color);
  std::vector<std::uint32_t> vertex(mass.point.size()), seen(mass.point.size(), 0);
  for (std::uint32_t f = 0; f < mass.faces.size(); ++f) {
    const Mass::Face& face = mass.faces[f];
    const std::size_t end = f + 1 < mass.faces.size() ? mass.faces[f + 1].first : mass.triangles.size();
    const glm::vec3 normal = glm::vec3(raised(dvec2(face.normal), face.normal.z)) + 0.0F;
    for (std::size_t t = face.first; t < end; ++t) {
      for (const std::uint32_t corner : mass.triangles[t]) {
        if (seen[corner] != f + 1) {
          seen[corner] = f + 1;
          vertex[corner] = static_cast<std::uint32_t>(mesh.position.size());
          const glm::dvec3& p = mass.point[corner];
          mesh.position.push_back(glm::vec3(raised(dvec2(p), p.z)) + 0.0F);
          mesh.normal.push_back(normal);
          mesh.color.push_back(face.part == MassPart::roof ? roof : wall);
        }
        mesh.index.wide.push_back(vertex[corner]);
      }
    }
  }
  return mesh;
}

Body body_of(const SceneBuilding& building, const Ground& ground, const std::string& pointer, Job& job) {
  Body body;
  Plan plan = plan_of_rings(building.footprint);
  body.middle = smallest_box(plan).middle;
  bool is_first = true;
  for (const dvec2& p : plan.rings[0]) {
    const double height = ground.height({p.x, -p.y});
    body.ground = is_first ? height : std::min(body.ground, height);
    is_first = false;
  }
  for (PlanRing& ring : plan.rings) {
    for (dvec2& p : ring) p -= body.middle;
  }
  const MassOptions options = options_of(building, plan, pointer, body, job);
  const Mass mass = mass_of(plan, options, job);
  if (mass.made != options.roof) {
    const auto name = [](MassRoof roof) { return mass_roof_names[static_cast<std::size_t>(roof)]; };
    body.warnings.push_back({pointer + "/roof/shape", std::string("the shape ") + name(options.roof) +
                                                          " does not fit the footprint; the roof is " +
                                                          name(mass.made)});
  }
  job.spend(Resource::triangles, mass.triangles.size());
  body.mesh = mesh_of(mass, building, job);
  weld(body.mesh, job);  // faces of one plane share vertices
  return body;
}

std::vector<Body> bodies_of(const SceneParams& params, const Ground& ground, Job& job) {
  std::vector<Body> bodies(params.buildings.size());
  parallel_for(job, bodies.size(), buildings_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    Job own = job;
    for (std::size_t i = begin; i < end; ++i) {
      const std::string pointer = "/buildings/" + std::to_string(i);
      const Job::PointerScope scope(own, pointer);
      bodies[i] = body_of(params.buildings[i], ground, pointer, own);
    }
  });
  return bodies;
}

/// The materials by SceneMaterial, as numbers of the model; added where they are used.
class Materials {
 public:
  explicit Materials(Model& model) : model_(model) {}
  int of(SceneMaterial surface) {
    int& number = number_[static_cast<std::size_t>(surface)];
    if (number >= 0) return number;
    number = static_cast<int>(model_.materials.size());
    Material material;
    material.name = surface == SceneMaterial::plain   ? "building"
                    : surface == SceneMaterial::glass ? "glass"
                                                      : "metal";
    material.roughness = surface == SceneMaterial::plain   ? 0.9F
                         : surface == SceneMaterial::glass ? 0.1F
                                                           : 0.4F;
    material.metallic = surface == SceneMaterial::metal ? 1.0F : 0.0F;
    model_.materials.push_back(std::move(material));
    return number;
  }

 private:
  Model& model_;
  std::array<int, 3> number_{-1, -1, -1};
};

void add_nodes(Model& model, const SceneParams& params, std::vector<Body> bodies, int parent) {
  Materials materials(model);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const SceneBuilding& building = params.buildings[i];
    const std::string name = building.name.value_or("building_" + std::to_string(i + 1));
    const int mesh = add_mesh(model, name, std::move(bodies[i].mesh), materials.of(building.material));
    add_node(model, name, parent, mesh).transform.translation =
        glm::vec3(raised(bodies[i].middle, bodies[i].ground)) + 0.0F;
  }
}

void append(Mesh& mesh, const Body& body, const Job& job) {
  if (mesh.position.empty()) {
    mesh = empty_mesh(job);
    mesh.color = Array<glm::u8vec4>(job);
  }
  const auto shift = static_cast<std::uint32_t>(mesh.position.size());
  const glm::vec3 at = glm::vec3(raised(body.middle, body.ground)) + 0.0F;
  for (const glm::vec3& p : body.mesh.position) mesh.position.push_back(p + at);
  mesh.normal.append(body.mesh.normal.span());
  mesh.color.append(body.mesh.color.span());
  for (const std::uint32_t i : body.mesh.index.wide) mesh.index.wide.push_back(shift + i);
}

/// Many buildings, in few meshes for each material.
void add_merged(Model& model, const SceneParams& params, const std::vector<Body>& bodies, int parent,
                const Job& job) {
  Materials materials(model);
  for (const SceneMaterial surface : {SceneMaterial::plain, SceneMaterial::glass, SceneMaterial::metal}) {
    Mesh mesh;
    const auto flush = [&] {
      if (mesh.position.empty()) return;
      add_node(model, "buildings", parent,
               add_mesh(model, "buildings", std::move(mesh), materials.of(surface)));
      mesh = Mesh{};
    };
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (params.buildings[i].material != surface) continue;
      append(mesh, bodies[i], job);
      if (mesh.position.size() >= merged_vertices) flush();
    }
    flush();
  }
}

}  // namespace

Plan plan_of_rings(const std::vector<std::vector<std::array<double, 2>>>& rings) {
  std::vector<PlanRing> made;
  for (const auto& ring : rings) {
    made.emplace_back();
    for (const auto& p : ring) made.back().emplace_back(p[0], -p[1]);
  }
  return read_plan(std::move(made));
}

void add_outlines(Model& model, const SceneParams& params, const Ground& ground, Job& job) {
  add_areas(model, params.areas, job);
  if (params.buildings.empty()) return;
  std::vector<Body> bodies = bodies_of(params, ground, job);
  for (Body& body : bodies) {
    for (Warning& warning : body.warnings) model.warnings.push_back(std::move(warning));
  }
  const int parent = static_cast<int>(model.nodes.size());
  add_node(model, "buildings", 0);
  if (bodies.size() <= most_building_nodes) {
    add_nodes(model, params, std::move(bodies), parent);
  } else {
    add_merged(model, params, bodies, parent, job);
  }
}

Array<Footprint> footprints_of_buildings(const SceneParams& params, const Job& job) {
  Array<Footprint> footprints(job);
  for (const SceneBuilding& building : params.buildings) {
    job.check();
    const PlanBox box = smallest_box(plan_of_rings(building.footprint));
    Footprint footprint;
    footprint.at = {box.middle.x, -box.middle.y};
    footprint.half = box.half;
    footprint.cos = box.along.x;
    footprint.sin = box.along.y;
    footprint.round = false;
    footprints.push_back(footprint);
  }
  return footprints;
}

std::uint64_t expected_triangles(const SceneParams& params) {
  std::uint64_t triangles = 0;
  for (const SceneBuilding& building : params.buildings) {
    for (const auto& ring : building.footprint) triangles += 6 * ring.size();
  }
  for (const SceneArea& area : params.areas) {
    for (const auto& ring : area.outline) triangles += ring.size();
  }
  return triangles;
}

}  // namespace seedmesh::scene

#include "core/generators/fractal/element.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "core/generators/fractal/faces.h"
#include "core/generators/material_members.h"
#include "core/geom/mesh/flatten.h"
#include "core/gltf/read/read.h"
#include "core/model/empty_mesh.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {
namespace {

using Name = FractalElement;

Mesh colored_mesh(const Job& job) {
  Mesh mesh = empty_mesh(job);
  mesh.color = Array<glm::u8vec4>(job);
  return mesh;
}

/// Adds a flat convex face with its own vertices, counter-clockwise from outside.
void add_face(Mesh& mesh, std::initializer_list<glm::dvec3> corners) {
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  const glm::dvec3* c = corners.begin();
  const glm::dvec3 normal = math::unit(glm::cross(c[1] - c[0], c[2] - c[0]), {0, 1, 0});
  for (const glm::dvec3& corner : corners) {
    mesh.position.push_back(glm::vec3(corner));
    mesh.normal.push_back(glm::vec3(normal));
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    for (const std::uint32_t corner : {0U, i - 1, i}) mesh.index.wide.push_back(first + corner);
  }
}

/// The six sides in the order -X, +X, -Y, +Y, -Z, +Z.
Mesh cube(const Job& job) {
  Mesh mesh = colored_mesh(job);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.5, 0.5}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto corner = [&](double a, double b) {
        glm::dvec3 p(side);
        p[u] = a;
        p[v] = b;
        return p;
      };
      if (side > 0) {
        add_face(mesh, {corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)});
      } else {
        add_face(mesh, {corner(-0.5, -0.5), corner(-0.5, 0.5), corner(0.5, 0.5), corner(0.5, -0.5)});
      }
    }
  }
  return mesh;
}

Mesh rainbow_cube(const Job& job) {
  Mesh mesh = cube(job);
  for (const glm::u8vec4& color : rainbow()) {
    for (int corner = 0; corner < 4; ++corner) mesh.color.push_back(color);
  }
  return mesh;
}

Mesh pyramid(const Job& job) {
  Mesh mesh = colored_mesh(job);
  const glm::dvec3 top{0, 0.5, 0}, a{-0.5, -0.5, 0.5}, b{0.5, -0.5, 0.5}, c{0.5, -0.5, -0.5},
      d{-0.5, -0.5, -0.5};
  add_face(mesh, {a, b, top});
  add_face(mesh, {b, c, top});
  add_face(mesh, {c, d, top});
  add_face(mesh, {d, a, top});
  add_face(mesh, {a, d, c, b});
  return mesh;
}

/// Has every second corner of the unit cube.
Mesh tetrahedron(const Job& job) {
  Mesh mesh = colored_mesh(job);
  const glm::dvec3 a{0.5, 0.5, 0.5}, b{0.5, -0.5, -0.5}, c{-0.5, 0.5, -0.5}, d{-0.5, -0.5, 0.5};
  add_face(mesh, {a, b, c});
  add_face(mesh, {a, c, d});
  add_face(mesh, {a, d, b});
  add_face(mesh, {b, d, c});
  return mesh;
}

/// A sphere of diameter 1. Each side of an octahedron is divided into 16 triangles.
Mesh sphere(const Job& job) {
  constexpr int steps = 4;
  Mesh mesh = colored_mesh(job);
  std::vector<glm::ivec3> keys;
  const auto corner = [&](const glm::ivec3& key) {
    const auto found = std::find(keys.begin(), keys.end(), key);
    if (found != keys.end()) return static_cast<std::uint32_t>(found - keys.begin());
    keys.push_back(key);
    const glm::dvec3 normal = math::unit(glm::dvec3(key), {0, 1, 0});
    mesh.position.push_back(glm::vec3(normal * 0.5));
    mesh.normal.push_back(glm::vec3(normal));
    return static_cast<std::uint32_t>(keys.size() - 1);
  };
  for (int octant = 0; octant < 8; ++octant) {
    const glm::ivec3 sign{(octant & 1) ? -1 : 1, (octant & 2) ? -1 : 1, (octant & 4) ? -1 : 1};
    const bool turned = sign.x * sign.y * sign.z < 0;
    const auto at = [&](int i, int j) { return corner(sign * glm::ivec3(steps - i - j, i, j)); };
    // A list in braces, because arguments of a call are evaluated in any order.
    const auto add = [&](const std::array<std::uint32_t, 3>& corners) {
      const std::size_t second = turned ? 2 : 1;
      for (const std::size_t k : {std::size_t{0}, second, 3 - second}) mesh.index.wide.push_back(corners[k]);
    };
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; i + j < steps; ++j) {
        add({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < steps) add({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return mesh;
}

/// A square frame around the letter L, made of 9 by 9 dots, one dot thick.
Mesh letter_plate(Job& job) {
  constexpr int dots = 9;
  BitGrid by_x(job, glm::ivec3(0), {dots, dots, 1}), by_z(job, glm::ivec3(0), {1, dots, dots});
  for (int y = 0; y < dots; ++y) {
    for (int x = 0; x < dots; ++x) {
      const bool border = x == 0 || y == 0 || x == dots - 1 || y == dots - 1;
      const bool letter = (x == 3 && y >= 2 && y <= 6) || (y == 2 && x >= 3 && x <= 5);
      if (!border && !letter) continue;
      by_x.row(y, 0)[0] |= std::uint64_t{1} << x;
      by_z.row(y, x)[0] |= 1;
    }
  }
  constexpr double cell = 0.96 / dots;  // so that neighbours do not touch
  const Solid solid{std::move(by_x), std::move(by_z), {-0.48, -0.48, -0.5 * cell}, glm::dvec3(cell)};
  Mesh mesh = exposed_faces(solid, nullptr, job);
  mesh.cache_ordered = false;
  return mesh;
}

Mesh segment(const Job& job) {
  Mesh mesh = colored_mesh(job);
  mesh.topology = Topology::lines;
  mesh.position.push_back({-0.5F, 0, 0});
  mesh.position.push_back({0.5F, 0, 0});
  mesh.index.wide.push_back(0);
  mesh.index.wide.push_back(1);
  return mesh;
}

Mesh named_mesh(Name name, Job& job) {
  switch (name) {
    case Name::cube:
      return cube(job);
    case Name::pyramid:
      return pyramid(job);
    case Name::rainbow_cube:
      return rainbow_cube(job);
    case Name::sphere:
      return sphere(job);
    case Name::tetrahedron:
      return tetrahedron(job);
    case Name::letter_plate:
      return letter_plate(job);
    case Name::segment:
    case Name::plate:  // koch_plate() makes it
      return segment(job);
  }
  return cube(job);
}

Result<Model> model_of(const FractalElementObject& given, const GenerateContext& context) {
  Job& job = context.job;
  if (given.model) return generate_child(*given.model, "/element/model", job.rng().at("element"), context);
  return read_glb(*given.glb, "/element/glb", job);
}

std::uint64_t bytes_of(const Mesh& mesh) {
  return mesh.position.bytes() + mesh.normal.bytes() + mesh.uv[0].bytes() + mesh.color.bytes() +
         mesh.index.size() * (mesh.position.size() > 65'535 ? 4 : 2);
}

}  // namespace

glm::u8vec4 linear_color(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  const auto byte = [](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::floor(linear_of_srgb(value) * 255.0F + 0.5F));
  };
  return {byte(red), byte(green), byte(blue), 255};
}

bool is_named(const FractalParams& params, FractalElement name) {
  return params.element.index() == 0 && std::get<0>(params.element) == name;
}

bool is_cube(const FractalParams& params) {
  return is_named(params, Name::cube) || is_named(params, Name::rainbow_cube);
}

std::array<glm::u8vec4, 6> rainbow() {
  return {linear_color(216, 44, 38), linear_color(244, 134, 30), linear_color(246, 218, 48),
          linear_color(60, 170, 70), linear_color(40, 98, 200),  linear_color(140, 60, 180)};
}

Material plain_material(const FractalParams& params) {
  Material material;
  material.name = "fractal";
  const bool painted = params.method == FractalMethod::escape || is_named(params, Name::rainbow_cube) ||
                       (params.method == FractalMethod::frcm && params.cloud == FractalCloud::points);
  if (!painted) material.base_color = linear_color(params.color);
  material.roughness = 0.9F;
  set_specular(material, params.specular);
  set_emission(material, params.emission);
  return material;
}

Result<Element> element_of(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Element element;
  if (params.element.index() == 0) {
    element.primitives.push_back({named_mesh(std::get<0>(params.element), job), 0, {}});
    element.materials.push_back(plain_material(params));
  } else {
    const FractalElementObject& given = std::get<1>(params.element);
    Result<Model> model = model_of(given, context);
    if (!model) return std::move(model).error();
    element.primitives = flatten(*model, job);
    element.materials = std::move(model->materials);
    element.warnings = std::move(model->warnings);
    if (!model->textures.empty()) {
      for (Material& material : element.materials) {
        for (TextureUse* use : material.textures()) *use = {};
      }
      element.warnings.push_back({"/element/model", "The textures of the element are not used.", 0, 0});
    }
    if (!fit_unit_box(element.primitives))
      return Error{Code::invalid, {{IssueKind::invalid_value, "/element", "the element has no extent"}}};
  }
  for (const Primitive& primitive : element.primitives) {
    element.bytes += bytes_of(primitive.mesh);
    element.elements += primitive.mesh.elements();
  }
  return element;
}

std::optional<Measures> measures_of(const FractalParams& params) {
  if (is_cube(params)) return Measures{6, 1};
  if (is_named(params, Name::pyramid)) return Measures{1 + std::sqrt(5.0), 1.0 / 3};
  if (is_named(params, Name::tetrahedron)) return Measures{2 * std::sqrt(3.0), 1.0 / 3};
  return std::nullopt;
}

}  // namespace seedmesh::fractal

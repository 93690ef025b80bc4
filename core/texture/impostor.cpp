#include "core/texture/impostor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/model/empty_mesh.h"
#include "core/model/levels.h"
#include "core/texture/atlas.h"
#include "core/texture/decode.h"
#include "core/texture/raster.h"

namespace seedmesh::texture {
namespace {

constexpr std::size_t views = 3;
constexpr std::uint32_t large = 4096;  ///< where a view of four samples each way takes a gigabyte
constexpr std::uint32_t edges =
    32;  ///< of a cell, one is free on each side, so that neighbours do not bleed in
constexpr std::uint32_t least_halved = 128;  ///< texels from which on normals have half as many a side
constexpr double apart =
    5e-4;  ///< distance of a quad from the axis, as a share of its width, so that no two faces coincide
constexpr float impostor_roughness = 0.9F;

ViewFrame frame_of(std::size_t view) {
  const math::SinCos turn = math::sincos_degrees(60.0 * static_cast<double>(view));
  return {{turn.cos, 0, -turn.sin}, {0, 1, 0}, {turn.sin, 0, turn.cos}};
}

glm::mat4 matrix_of(const Transform& t) {
  glm::mat4 matrix = glm::mat4_cast(t.rotation);
  for (int axis = 0; axis < 3; ++axis) matrix[axis] *= t.scale[axis];
  matrix[3] = glm::vec4(t.translation, 1);
  return matrix;
}

template <class Visit>
void each_mesh(const Model& model, const std::vector<ImpostorRecipe::Part>& parts, const Visit& visit) {
  for (const ImpostorRecipe::Part& part : parts) {
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(part.mesh)].primitives) {
      if (primitive.mesh.topology == Topology::triangles) visit(primitive, part.at);
    }
  }
}

/// The extent of the images.
struct Windows {
  std::array<ViewWindow, views> of;
  bool is_flat = true;
};

Windows windows_of(const Model& model, const std::vector<ImpostorRecipe::Part>& parts, const Job& job) {
  constexpr double far = std::numeric_limits<double>::max();
  Windows windows;
  windows.of.fill({glm::dvec2(far), glm::dvec2(-far)});
  std::array<ViewFrame, views> frames;
  for (std::size_t view = 0; view < views; ++view) frames[view] = frame_of(view);
  each_mesh(model, parts, [&](const Primitive& primitive, const glm::mat4& at) {
    const Mesh& mesh = primitive.mesh;
    job.check();
    for (const glm::vec3& position : mesh.position) {
      const glm::dvec3 p(glm::vec3(at * glm::vec4(position, 1)));
      for (std::size_t view = 0; view < views; ++view) {
        const glm::dvec2 seen(glm::dot(p, frames[view].right), glm::dot(p, frames[view].up));
        windows.of[view] = {glm::min(windows.of[view].low, seen), glm::max(windows.of[view].high, seen)};
      }
    }
  });
  windows.is_flat = std::any_of(windows.of.begin(), windows.of.end(), [](const ViewWindow& window) {
    return !(window.high.x > window.low.x) || !(window.high.y > window.low.y);
  });
  return windows;
}

/// The corner of an image in its atlas, in cells; the fourth cell stays empty.
glm::uvec2 cell_of(std::size_t view) {
  return {static_cast<std::uint32_t>(view % 2), static_cast<std::uint32_t>(view / 2)};
}

Mesh quads_of(const Windows& windows, const Job& job) {
  constexpr float inset = 1.0F / edges;
  Mesh mesh = empty_mesh(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  for (std::size_t view = 0; view < views; ++view) {
    const ViewFrame frame = frame_of(view);
    const ViewWindow& window = windows.of[view];
    for (const double side : {1.0, -1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.position.size());
      for (const glm::dvec2 corner :
           {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
        const glm::dvec2 place = window.low + (window.high - window.low) * corner;
        const glm::dvec3 before = frame.towards * (side * apart * (window.high.x - window.low.x));
        mesh.position.push_back(glm::vec3(frame.right * place.x + frame.up * place.y + before) + 0.0F);
        mesh.normal.push_back(glm::vec3(frame.towards * side) + 0.0F);
        const glm::vec2 inside =
            inset +
            glm::vec2(static_cast<float>(corner.x), static_cast<float>(1 - corner.y)) * (1 - 2 * inset);
        mesh.uv[0].push_back((glm::vec2(cell_of(view)) + inside) / 2.0F);
      }
      const std::array<std::uint32_t, 6> corners =
          side > 0 ? std::array{0U, 1U, 2U, 0U, 2U, 3U} : std::array{0U, 2U, 1U, 0U, 3U, 2U};
      for (const std::uint32_t corner : corners) mesh.index.wide.push_back(first + corner);
    }
  }
  return mesh;
}

// --- The levels of a model

/// The transforms of all nodes relative to their root.
struct Places {
  std::vector<std::size_t> root;
  std::vector<glm::mat4> at;
  std::vector<bool> still;  ///< at the position of the root
};

Places places_of(const Model& model) {
  Places places;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.parent < 0) {
      places.root.push_back(i);
      places.at.emplace_back(1);
    } else {
      const auto parent = static_cast<std::size_t>(node.parent);
      places.root.push_back(places.root[parent]);
      places.at.push_back(places.at[parent] * matrix_of(node.transform));
    }
    places.still.push_back(places.at[i] == glm::mat4(1));
  }
  return places;
}

bool is_shown(const Node& node) {
  return node.mesh >= 0 && node.skin < 0 && node.collision == CollisionShape::none;
}

/// Repeats the coarsest mesh of a node until it has `levels` levels after the finest.
void fill_levels(Node& node, std::size_t levels) {
  const int coarsest = node.lods.empty() ? node.mesh : node.lods.back();
  node.lods.resize(levels, coarsest);
}

bool add_level(Model& model, const Places& places, std::size_t root, Job& job) {
  std::vector<ImpostorRecipe::Part> parts;
  std::vector<std::size_t> shown;
  std::size_t levels = 0;
  std::optional<std::size_t> bearer;
  for (std::size_t i = root; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (places.root[i] != root || !is_shown(node)) continue;
    shown.push_back(i);
    levels = std::max(levels, node.lods.size());
    if (!bearer && places.still[i] && node.instances.transforms.empty()) bearer = i;
    if (node.instances.transforms.empty()) parts.push_back({node.mesh, places.at[i]});
    for (const Transform& copy : node.instances.transforms)
      parts.push_back({node.mesh, places.at[i] * matrix_of(copy)});
  }
  if (!bearer) return false;
  const int impostor = add_impostor(model, std::move(parts), model.nodes[root].name + "_impostor", job);
  if (impostor < 0) return false;
  for (const std::size_t i : shown) {
    fill_levels(model.nodes[i], levels);
    model.nodes[i].lods.push_back(i == *bearer ? impostor : -1);
    model.nodes[i].has_impostor = true;
  }
  return true;
}

// --- Pictures

/// The textures that recipes need, decoded once. JPEG images are left out.
using Library = std::map<std::pair<int, float>, Texels>;

std::pair<int, float> key_of(const Material& material) {
  return {material.base_color_texture.texture,
          material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 0.0F};
}

Library library_of(const Model& model, const Job& job) {
  Library library;
  for (const Material& recipe : model.materials) {
    each_mesh(model, recipe.impostor.parts, [&](const Primitive& primitive, const glm::mat4&) {
      if (primitive.material < 0) return;
      const auto key = key_of(model.materials[static_cast<std::size_t>(primitive.material)]);
      if (key.first < 0 || library.contains(key)) return;
      const Image& image = *model.textures[static_cast<std::size_t>(key.first)];
      if (image.mime != "image/png" && image.mime != "image/webp") return;
      const Result<Decoded> decoded = decode_picture(std::as_bytes(std::span(image.bytes)), {}, job);
      if (decoded && decoded->picture) library.emplace(key, Texels(*decoded->picture, key.second, job));
    });
  }
  return library;
}

Surface surface_of(const Model& model, const Primitive& primitive, const Library& library) {
  Surface surface;
  if (primitive.material < 0) return surface;
  const Material& material = model.materials[static_cast<std::size_t>(primitive.material)];
  surface.color = material.base_color;
  const auto found = library.find(key_of(material));
  if (found == library.end()) return surface;
  surface.texels = &found->second;
  surface.repeat = material.base_color_texture.repeat;
  return surface;
}

/// The input of all images.
struct Scenery {
  const Model& model;
  const Library& library;
  const Job& job;
};

/// The atlas of colours, and that of normals with fewer texels.
struct Sheets {
  Atlas color, normal;

  Sheets(std::uint32_t size, const Job& job)
      : color(size, job), normal(size >= least_halved ? size / 2 : size, job) {}
};

/// Samples of a texel along each axis.
std::uint32_t samples_of(std::uint32_t size) { return size < large ? 4 : 2; }

/// Renders one image into its cell.
void draw_view(const Scenery& scenery, const std::vector<ImpostorRecipe::Part>& parts, std::size_t view,
               const ViewWindow& window, Sheets& sheets) {
  const std::uint32_t cell = sheets.color.size() / 2, edge = cell / edges, inside = cell - 2 * edge;
  const std::uint32_t samples = samples_of(sheets.color.size());
  Canvas canvas(frame_of(view), window, inside * samples, inside * samples, scenery.job);
  each_mesh(scenery.model, parts, [&](const Primitive& primitive, const glm::mat4& at) {
    canvas.draw(primitive.mesh, at, surface_of(scenery.model, primitive, scenery.library), scenery.job);
  });
  sheets.color.put(canvas, cell_of(view) * cell, {cell, edge, samples});
  const std::uint32_t times = sheets.color.size() / sheets.normal.size();
  sheets.normal.put_normals(canvas, cell_of(view) * (cell / times),
                            {cell / times, edge / times, samples * times});
}

}  // namespace

int add_impostor(Model& model, std::vector<ImpostorRecipe::Part> parts, const std::string& name, Job& job) {
  const Windows windows = windows_of(model, parts, job);
  if (windows.is_flat) return -1;
  job.spend(Resource::triangles, triangles_of_impostor);
  Material material;
  material.name = name;
  material.roughness = impostor_roughness;
  material.alpha_mode = AlphaMode::mask;
  material.alpha_cutoff = Atlas::cutoff;
  material.impostor.parts = std::move(parts);
  MeshGroup group{name, {}};
  group.primitives.push_back({quads_of(windows, job), static_cast<int>(model.materials.size()), {}});
  model.materials.push_back(std::move(material));
  model.meshes.push_back(std::move(group));
  return static_cast<int>(model.meshes.size()) - 1;
}

std::size_t add_impostor_levels(Model& model, Job& job) {
  const Places places = places_of(model);
  std::size_t count = 0;
  for (std::size_t i = 0; i < places.root.size(); ++i) {
    if (places.root[i] == i && add_level(model, places, i, job)) ++count;
  }
  return count;
}

void draw_impostors(Model& model, int size, Job& job) {
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    if (!model.materials[i].impostor.parts.empty()) wanted.push_back(i);
  }
  if (wanted.empty()) return;
  const Library library = library_of(model, job);
  std::vector<Sheets> sheets;
  for (std::size_t i = 0; i < wanted.size(); ++i) sheets.emplace_back(static_cast<std::uint32_t>(size), job);
  std::vector<Windows> windows(wanted.size());
  const auto parts_of = [&](std::size_t i) -> const auto& {
    return model.materials[wanted[i]].impostor.parts;
  };
  parallel_for(job, wanted.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) windows[i] = windows_of(model, parts_of(i), job);
  });
  const Scenery scenery{model, library, job};
  parallel_for(job, wanted.size() * views, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t view = i % views;
      draw_view(scenery, parts_of(i / views), view, windows[i / views].of[view], sheets[i / views]);
    }
  });
  std::vector<std::array<std::shared_ptr<const Image>, 2>> images(wanted.size());
  parallel_for(job, wanted.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::string& name = model.materials[wanted[i]].name;
      images[i] = {sheets[i].normal.normal_image(name + "_normal", job), sheets[i].color.image(name, job)};
    }
  });
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Material& material = model.materials[wanted[i]];
    const auto first = static_cast<int>(model.textures.size());
    material.normal_texture = {first, 0, false};
    material.base_color_texture = {first + 1, 0, false};
    for (auto& image : images[i]) model.textures.push_back(std::move(image));
    material.impostor.parts.clear();
  }
  empty_hidden_meshes(model);
}

}  // namespace seedmesh::texture

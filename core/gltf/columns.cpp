#include "core/gltf/columns.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <tuple>
#include <utility>

namespace seedmesh::gltf {
namespace {

constexpr std::string_view uv_semantics[] = {"TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2", "TEXCOORD_3"};

template <class T>
Column column_of(Array<T>& array, Component component, Lanes lanes) {
  const std::size_t count = array.size();
  return {.slice = keep(std::move(array)), .component = component, .lanes = lanes, .count = count};
}

Column column_of(std::vector<float>& numbers, Lanes lanes) {
  const std::size_t count = numbers.size() / static_cast<std::size_t>(lanes);
  return {.slice = keep(std::move(numbers)), .lanes = lanes, .count = count};
}

bool same(const Box& a, const Box& b) { return a.min == b.min && a.max == b.max; }

Column positions_of(Mesh& mesh) {
  const Box box = same(mesh.bounds, Box{}) ? bounds_of(mesh.position.span()) : mesh.bounds;
  assert(same(box, bounds_of(mesh.position.span())));
  Column column = column_of(mesh.position, Component::f32, Lanes::vec3);
  column.range = box;
  return column;
}

void name_column(Part& part, std::string_view semantic, Column column) {
  part.attributes.push_back({semantic, part.columns.size()});
  part.columns.push_back(std::move(column));
}

void take_uv(Part& part, Mesh& mesh) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t columns[4] = {none, none, none, none};
  std::size_t sets = 0;
  for (std::size_t set = 0; set < mesh.uv.size(); ++set) {
    if (mesh.uv[set].empty()) continue;
    sets = set + 1;
    columns[set] = part.columns.size();
    part.columns.push_back(column_of(mesh.uv[set], Component::f32, Lanes::vec2));
  }
  const auto* const first = std::find_if(columns, columns + sets, [](std::size_t c) { return c != none; });
  for (std::size_t set = 0; set < sets; ++set) {
    if (columns[set] == none) columns[set] = set > 0 ? columns[set - 1] : *first;
    part.attributes.push_back({uv_semantics[set], columns[set]});
  }
}

/// JOINTS_0 and WEIGHTS_0 of vertices with one joint each: only the first of four numbers is used.
template <class Number>
void name_bones(Part& part, Array<std::uint16_t>& bone, Component component) {
  using Four = glm::vec<4, Number>;
  Array<Four> joints = bone.empty_array_of<Four>();
  Array<glm::u8vec4> weights = bone.empty_array_of<glm::u8vec4>();
  joints.resize(bone.size());
  weights.resize(bone.size());
  for (std::size_t i = 0; i < bone.size(); ++i) {
    joints[i] = Four(static_cast<Number>(bone[i]), 0, 0, 0);
    weights[i] = glm::u8vec4(255, 0, 0, 0);
  }
  bone = {};
  name_column(part, "JOINTS_0", column_of(joints, component, Lanes::vec4));
  name_column(part, "WEIGHTS_0", column_of(weights, Component::u8, Lanes::vec4));
  part.columns.back().normalized = true;
}

void take_bones(Part& part, Mesh& mesh) {
  if (mesh.bone.empty()) return;
  if (*std::max_element(mesh.bone.begin(), mesh.bone.end()) <= 255) {
    name_bones<std::uint8_t>(part, mesh.bone, Component::u8);
  } else {
    name_bones<std::uint16_t>(part, mesh.bone, Component::u16);
  }
}

}  // namespace

Part take_part(Primitive& primitive) {
  Mesh& mesh = primitive.mesh;
  Part part{.topology = mesh.topology,
            .material = primitive.material,
            .variant_materials = std::move(primitive.variant_materials)};
  if (!mesh.index.small.empty()) part.index = column_of(mesh.index.small, Component::u16, Lanes::scalar);
  if (!mesh.index.wide.empty()) part.index = column_of(mesh.index.wide, Component::u32, Lanes::scalar);
  name_column(part, "POSITION", positions_of(mesh));
  if (!mesh.normal.empty()) name_column(part, "NORMAL", column_of(mesh.normal, Component::f32, Lanes::vec3));
  if (!mesh.tangent.empty())
    name_column(part, "TANGENT", column_of(mesh.tangent, Component::f32, Lanes::vec4));
  take_uv(part, mesh);
  if (!mesh.color.empty()) {
    name_column(part, "COLOR_0", column_of(mesh.color, Component::u8, Lanes::vec4));
    part.columns.back().normalized = true;
  }
  if (!mesh.joints.empty())
    name_column(part, "JOINTS_0", column_of(mesh.joints, Component::u16, Lanes::vec4));
  if (!mesh.weights.empty())
    name_column(part, "WEIGHTS_0", column_of(mesh.weights, Component::f32, Lanes::vec4));
  take_bones(part, mesh);
  if (!mesh.next_position.empty())
    name_column(part, "_NEXT_POSITION", column_of(mesh.next_position, Component::f32, Lanes::vec3));
  return part;
}

namespace {

/// The arrays of a packed mesh, with the current materials of the primitive.
Part take_packed(Primitive& primitive) {
  Part part = static_cast<const PackedPart&>(*primitive.mesh.packed).part;
  primitive.mesh.packed.reset();
  part.material = primitive.material;
  part.variant_materials = std::move(primitive.variant_materials);
  return part;
}

Column take_inverse_binds(Skin& skin) {
  for (glm::mat4& matrix :
       skin.inverse_bind) {  // glTF requires an exact last row; an inversion may leave rounding errors
    for (int column = 0; column < 4; ++column) matrix[column][3] = column < 3 ? 0.0F : 1.0F;
  }
  const std::size_t count = skin.inverse_bind.size();
  return {.slice = keep(std::move(skin.inverse_bind)), .lanes = Lanes::mat4, .count = count};
}

Lanes lanes_of(Path path) {
  switch (path) {
    case Path::translation:
    case Path::scale:
      return Lanes::vec3;
    case Path::rotation:
      return Lanes::vec4;
    case Path::weights:
      return Lanes::scalar;
  }
  return Lanes::scalar;
}

Tracks take_tracks(Animation& animation) {
  Tracks tracks;
  for (std::vector<float>& times : animation.times) {
    std::optional<Box> range;
    if (!times.empty()) range = Box{glm::vec3(times.front()), glm::vec3(times.back())};
    tracks.times.push_back(column_of(times, Lanes::scalar));
    tracks.times.back().range = range;
  }
  using Same = std::tuple<int, Interpolation, Lanes, std::vector<float>>;
  std::map<Same, int> samplers;
  for (std::size_t i = 0; i < animation.channels.size(); ++i) {
    Channel& channel = animation.channels[i];
    const auto [known, is_new] =
        samplers.try_emplace({channel.times, channel.interpolation, lanes_of(channel.path), channel.values},
                             static_cast<int>(tracks.values.size()));
    tracks.sampler.push_back(known->second);
    if (!is_new) continue;
    tracks.channel.push_back(static_cast<int>(i));
    tracks.values.push_back(column_of(channel.values, lanes_of(channel.path)));
  }
  return tracks;
}

}  // namespace

Columns take_columns(Model& model) {
  Columns columns;
  for (MeshGroup& group : model.meshes) {
    std::vector<Part>& parts = columns.meshes.emplace_back();
    for (Primitive& primitive : group.primitives) {
      if (primitive.mesh.elements() == 0) continue;
      parts.push_back(primitive.mesh.packed ? take_packed(primitive) : take_part(primitive));
    }
  }
  for (Skin& skin : model.skins) columns.inverse_binds.push_back(take_inverse_binds(skin));
  for (Animation& animation : model.animations) columns.animations.push_back(take_tracks(animation));
  return columns;
}

void release(Columns& columns) {
  for (std::vector<Part>& mesh : columns.meshes) {
    for (Part& part : mesh) {
      for (Column& column : part.columns) column.slice = {};
      if (part.index) part.index->slice = {};
    }
  }
  for (Column& column : columns.inverse_binds) column.slice = {};
  for (Tracks& tracks : columns.animations) {
    for (Column& column : tracks.times) column.slice = {};
    for (Column& column : tracks.values) column.slice = {};
  }
}

}  // namespace seedmesh::gltf

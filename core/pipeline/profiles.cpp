#include "core/pipeline/profiles.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "core/model/collision_name.h"

namespace seedmesh {
namespace {

constexpr bool yes = true, no = false;

constexpr std::array<Profile, 7> profiles = {{{OutputProfile::core, no, no, no, no, no, yes, no, no},
                                              {OutputProfile::web, yes, yes, yes, yes, yes, yes, yes, no},
                                              {OutputProfile::tiles, yes, no, yes, yes, no, yes, no, no},
                                              {OutputProfile::unity, no, no, yes, no, yes, no, no, yes},
                                              {OutputProfile::unreal, no, no, no, no, no, no, no, yes},
                                              {OutputProfile::godot, no, no, no, no, no, yes, no, no},
                                              {OutputProfile::blender, no, no, yes, no, no, yes, no, no}}};

constexpr std::size_t longest_in_blender = 63;

/// Makes names unique: "bark", "bark_2", ... Cuts the stem where names have a greatest length.
class Names {
 public:
  explicit Names(std::size_t longest) : longest_(longest) {}

  std::string unique(std::string_view stem) {
    std::string name = cut(stem, longest_);
    for (int number = 2; !taken_.insert(name).second; ++number) {
      const std::string ending = "_" + std::to_string(number);
      name = cut(stem, longest_ - ending.size()) + ending;
    }
    return name;
  }

 private:
  /// Cuts between characters of UTF-8.
  static std::string cut(std::string_view name, std::size_t longest) {
    std::size_t end = std::min(name.size(), longest);
    while (end > 0 && end < name.size() && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
    return std::string(name.substr(0, end));
  }

  std::size_t longest_;
  std::set<std::string> taken_;
};

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

std::string spelled(std::string name, OutputProfile profile) {
  constexpr std::string_view not_in_godot = ".:@/\"%";
  for (char& c : name) {
    if (profile == OutputProfile::unreal && !is_plain(c)) c = '_';
    if (profile == OutputProfile::godot && not_in_godot.find(c) != std::string_view::npos) c = '_';
  }
  return name;
}

std::string_view unreal_prefix(CollisionShape shape) {
  switch (shape) {
    case CollisionShape::box:
      return "UBX_";
    case CollisionShape::capsule:
      return "UCP_";
    case CollisionShape::sphere:
      return "USP_";
    case CollisionShape::none:
    case CollisionShape::convex:
      return "UCX_";
  }
  return "UCX_";
}

bool is_visible(const Node& node) { return node.mesh >= 0 && node.collision == CollisionShape::none; }

/// The mesh that a collision shape encloses: its parent's, a sibling's, or the first of the model.
const MeshGroup* enclosed_by(const Model& model, const Node& shape) {
  const Node* found = nullptr;
  if (shape.parent >= 0 && is_visible(model.nodes[static_cast<std::size_t>(shape.parent)])) {
    found = &model.nodes[static_cast<std::size_t>(shape.parent)];
  }
  for (const Node& node : model.nodes) {
    if (!found && is_visible(node) && node.parent == shape.parent) found = &node;
  }
  for (const Node& node : model.nodes) {
    if (!found && is_visible(node)) found = &node;
  }
  return found ? &model.meshes[static_cast<std::size_t>(found->mesh)] : nullptr;
}

/// "_00" and so on: Unreal expects a number where a mesh has several shapes.
std::string numbered(std::size_t number) { return (number < 10 ? "_0" : "_") + std::to_string(number); }

std::string collision_name(const std::string& mesh, CollisionShape shape, std::size_t number,
                           OutputProfile profile) {
  if (profile == OutputProfile::unreal) return std::string(unreal_prefix(shape)) + mesh + numbered(number);
  return mesh + "_collision" + numbered(number) + "-convcolonly";
}

/// The convention that `output.collision` selects, read from the name that the generator chose.
CollisionNames convention_of(std::string_view name) {
  if (name.starts_with("UCX_")) return CollisionNames::unreal;
  if (name.ends_with("-convcolonly")) return CollisionNames::godot;
  return CollisionNames::plain;
}

/// Generators number the shapes of one model from 1. In a file of several models, a further suffix would make names
/// unique. It would hide the suffix that Godot reads, however, and Unreal would search for a mesh of that name. So
/// the numbers count through the file, and Unreal's names contain the mesh's name in this file.
void name_collisions(Model& model, OutputProfile profile) {
  const bool is_engine = profile == OutputProfile::unreal || profile == OutputProfile::godot;
  std::map<std::string, std::size_t> shapes;  // of each visible mesh
  std::size_t asked_by_godot = 0;
  for (Node& node : model.nodes) {
    const CollisionNames asked = convention_of(node.name);
    if (node.collision == CollisionShape::none || (asked == CollisionNames::plain && !is_engine)) continue;
    const MeshGroup* group = enclosed_by(model, node);
    const std::string mesh = group ? group->name : "model";
    if (asked == CollisionNames::godot) {
      node.name = collision_name(asked, mesh, ++asked_by_godot);
    } else if (asked == CollisionNames::unreal) {
      node.name = collision_name(asked, mesh, ++shapes[mesh]);
    } else {
      node.name = collision_name(mesh, node.collision, shapes[mesh]++, profile);
    }
    // Unreal reads the names of meshes.
    if (node.mesh >= 0) model.meshes[static_cast<std::size_t>(node.mesh)].name = node.name;
  }
}

}  // namespace

const Profile& profile_of(OutputProfile name) {
  return *std::find_if(profiles.begin(), profiles.end(),
                       [name](const Profile& each) { return each.name == name; });
}

std::string profiles_where(bool Profile::*reads) {
  std::string list;
  for (const Profile& each : profiles) {
    if (each.*reads) list += (list.empty() ? "" : ", ") + std::string(text_of(each.name));
  }
  return list;
}

void name_for(Model& model, OutputProfile profile) {
  const std::size_t longest = profile == OutputProfile::blender ? longest_in_blender : std::size_t{1} << 20U;
  Names nodes(longest), meshes(longest), materials(longest), animations(longest);
  for (MeshGroup& group : model.meshes) group.name = spelled(std::move(group.name), profile);
  name_collisions(model, profile);
  for (Node& node : model.nodes) {
    std::string name = node.collision == CollisionShape::none ? spelled(node.name, profile) : node.name;
    if (profile == OutputProfile::unity && !node.lods.empty()) name += "_LOD0";
    node.name = nodes.unique(name);
  }
  for (MeshGroup& group : model.meshes) group.name = meshes.unique(group.name);
  for (Material& material : model.materials)
    material.name = materials.unique(spelled(material.name, profile));
  for (Animation& animation : model.animations) {
    std::string name = spelled(animation.name, profile);
    if (profile == OutputProfile::godot && name == "wind") name += "-loop";
    animation.name = animations.unique(name);
  }
}

}  // namespace seedmesh

#include "core/gltf/write/nodes.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <unordered_set>

#include "core/gltf/json_writer.h"
#include "core/model/levels.h"

namespace seedmesh::gltf {
namespace {

/// Three numbers: the shortest text that reads back as the same floats, or as the same doubles.
void append_vector(JsonWriter& json, std::string_view name, const glm::vec3& v, bool exact) {
  if (!exact) return json.values(name, std::span(&v.x, 3));
  json.array(name, [&] {
    for (int axis = 0; axis < 3; ++axis) {
      std::string text;
      append_number(text, static_cast<double>(v[axis]));
      json.json(text);
    }
  });
}

void append_transform(JsonWriter& json, const Transform& t, bool exact) {
  if (t.translation != glm::vec3(0)) append_vector(json, "translation", t.translation, exact);
  const glm::vec4 rotation(t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w);
  if (rotation != glm::vec4(0, 0, 0, 1)) json.values("rotation", std::span(&rotation.x, 4));
  if (t.scale != glm::vec3(1)) append_vector(json, "scale", t.scale, exact);
}

std::string_view name_of(CollisionShape shape) {
  switch (shape) {
    case CollisionShape::none:
      return "none";
    case CollisionShape::box:
      return "box";
    case CollisionShape::capsule:
      return "capsule";
    case CollisionShape::sphere:
      return "sphere";
    case CollisionShape::convex:
      return "convex";
  }
  return "none";
}

void append_coverage(JsonWriter& json, const Node& node, std::size_t levels) {
  json.array([&] {
    for (const float share : screen_shares(node, levels - 1)) {
      std::string text;
      append_number(text, share);
      json.json(text);
    }
    json.value(0);
  });
}

/// `measured` has the thresholds of the levels.
void append_extras(JsonWriter& json, const Node& node, const Node& measured, std::size_t levels) {
  if (node.extras.empty() && node.collision == CollisionShape::none && levels < 2) return;
  json.object("extras", [&] {
    for (const Extra& extra : node.extras) {
      json.key(extra.name);
      json.json(extra.json);
    }
    if (node.collision != CollisionShape::none) json.member("collision", name_of(node.collision));
    if (levels > 1) {
      json.key("MSFT_screencoverage");
      append_coverage(json, measured, levels);
    }
  });
}

/// The children of all nodes, grouped by parent, in ascending order.
struct Family {
  std::vector<std::size_t> first;  ///< for each node the index of its first child; one more at the end
  std::vector<std::size_t> children;
};

Family family_of(const Model& model) {
  Family family{std::vector<std::size_t>(model.nodes.size() + 1, 0), {}};
  for (const Node& node : model.nodes) {
    if (node.parent >= 0) ++family.first[static_cast<std::size_t>(node.parent) + 1];
  }
  for (std::size_t i = 1; i < family.first.size(); ++i) family.first[i] += family.first[i - 1];
  family.children.resize(family.first.back());
  std::vector<std::size_t> next = family.first;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const int parent = model.nodes[i].parent;
    if (parent >= 0) family.children[next[static_cast<std::size_t>(parent)]++] = i;
  }
  return family;
}

class NodeWriter {
 public:
  NodeWriter(std::string& out, const Model& model, const NodeMeshes& shown)
      : json_(out), model_(model), shown_(shown), family_(family_of(model)), next_copy_(model.nodes.size()) {
    find_bodies();
    next_level_ = next_copy_;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) next_level_ += copies(i);
    find_object();
    const auto is_copied = [](const Node& node) {
      return !node.instances.transforms.empty() || !node.lods.empty();
    };
    if (std::none_of(model.nodes.begin(), model.nodes.end(), is_copied)) return;
    for (const Node& node : model.nodes) names_.insert(node.name);
  }

  void append_node(std::size_t number) {
    const Node& node = model_.nodes[number];
    const bool shows = stands_itself(number);
    const std::size_t of_object = number == 0 ? object_.size() : 0;
    const std::size_t coarser = of_object > 0 ? of_object : shows && object_.empty() ? levels(number) : 0;
    json_.object([&] {
      json_.member("name", node.name);
      append_transform(json_, node.transform, shown_.exact);
      if (shows) append_shown(number, shown_.meshes[number]);
      append_children(number);
      append_extensions(number, shows, coarser, true);
      append_extras(json_, node, of_object > 0 ? model_.nodes[widest_part_] : node, 1 + coarser);
    });
  }

  void append_copies(std::size_t number, TextMeter& meter) {
    const Node& node = model_.nodes[number];
    Node extras;  // of a copy: only those of its levels
    extras.has_impostor = node.has_impostor;
    extras.screen = node.screen;
    for (std::size_t i = 0; i < copies(number); ++i) {
      json_.object([&] {
        json_.member("name", copy_name(node.name, i));
        append_transform(json_, node.instances.transforms[i], shown_.exact);
        append_shown(number, shown_.meshes[number]);
        append_extensions(number, false, levels(number));
        append_extras(json_, extras, extras, 1 + levels(number));
      });
      meter.step();
    }
  }

  /// Appends the coarser levels in the order of their numbers: those of nodes, then those of copies. Of an object, the
  /// parts of each level come before the nodes that group them.
  void append_all_levels(TextMeter& meter) {
    if (!object_.empty()) return append_object(meter);
    for (const bool itself : {true, false}) {
      for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
        if (levels(i) > 0 && stands_itself(i) == itself) append_levels(i, meter);
      }
    }
  }

 private:
  /// The number of copies that become nodes.
  std::size_t copies(std::size_t number) const {
    if (shown_.meshes[number] < 0 || shown_.copies.contains(number)) return 0;
    return model_.nodes[number].instances.transforms.size();
  }

  /// Does the node itself show its mesh, once or by instancing?
  bool stands_itself(std::size_t number) const {
    return shown_.meshes[number] >= 0 &&
           (model_.nodes[number].instances.transforms.empty() || shown_.copies.contains(number));
  }

  std::size_t levels(std::size_t number) const {
    return shown_.meshes[number] < 0 || shown_.lods.empty() ? 0 : shown_.lods[number].size();
  }

  void append_levels(std::size_t number, TextMeter& meter) {
    const Node& node = model_.nodes[number];
    const bool itself = stands_itself(number);
    for (std::size_t i = 0; i < (itself ? 1 : copies(number)); ++i) {
      for (std::size_t level = 0; level < levels(number); ++level) {
        json_.object([&] {
          json_.member("name", level_name(itself ? node.name : copy_name(node.name, i), level + 1));
          append_transform(json_, itself ? node.transform : node.instances.transforms[i], shown_.exact);
          append_shown(number, shown_.lods[number][level]);
          append_extensions(number, itself && shown_.lods[number][level] >= 0, 0);
        });
        meter.step();
      }
    }
  }

  /// The mesh of a part at a coarser level. A part without levels is the same at all of them.
  int mesh_of_part(std::size_t part, std::size_t level) const {
    return levels(part) == 0 ? shown_.meshes[part] : shown_.lods[part][level];
  }

  /// Numbers the nodes of the coarser levels of an object. Its parts have all levels or none.
  void find_object() {
    std::size_t count = 0;
    for (const std::size_t part : shown_.parts) {
      if (levels(part) > 0 && count > 0 && levels(part) != count) return;
      if (levels(part) == 0 || (count > 0 && !model_.nodes[part].has_impostor)) continue;
      count = levels(part);
      widest_part_ = part;
    }
    object_.resize(count);
    std::size_t next = next_level_;
    for (std::size_t level = 0; level < count; ++level) {
      for (const std::size_t part : shown_.parts) {
        if (mesh_of_part(part, level) >= 0) object_[level].push_back(next++);
      }
    }
    if (count > 0) next_level_ = next;
  }

  void append_object(TextMeter& meter) {
    const Node& root = model_.nodes.front();
    for (std::size_t level = 0; level < object_.size(); ++level) {
      for (const std::size_t part : shown_.parts) {
        if (mesh_of_part(part, level) < 0) continue;
        json_.object([&] {
          json_.member("name", level_name(model_.nodes[part].name, level + 1));
          append_transform(json_, model_.nodes[part].transform, shown_.exact);
          append_shown(part, mesh_of_part(part, level));
        });
        meter.step();
      }
    }
    for (std::size_t level = 0; level < object_.size(); ++level) {
      json_.object([&] {
        json_.member("name", level_name(root.name, level + 1));
        append_transform(json_, root.transform, shown_.exact);
        if (object_[level].empty()) return;
        json_.array("children", [&] {
          for (const std::size_t child : object_[level]) json_.value(child);
        });
      });
      meter.step();
    }
  }

  /// `itself`: with the copies that are arrays. `coarser`: the number of coarser levels.
  void append_extensions(std::size_t number, bool itself, std::size_t coarser, bool itself_of_model = false) {
    const auto found = itself ? shown_.copies.find(number) : shown_.copies.end();
    const bool has_body = itself_of_model && is_body_[number];
    const int shape = itself_of_model && !shown_.shapes.empty() ? shown_.shapes[number] : -1;
    if (found == shown_.copies.end() && coarser == 0 && !has_body && shape < 0) return;
    json_.object("extensions", [&] {
      if (found != shown_.copies.end()) append_instancing(found->second);
      if (coarser > 0) {
        json_.object("MSFT_lod", [&] {
          json_.array("ids", [&] {
            for (std::size_t i = 0; i < coarser; ++i) json_.value(next_level_++);
          });
        });
      }
      if (has_body || shape >= 0) append_body(has_body, shape);
    });
  }

  /// A static body, a shape of the body around it, or both in one node.
  void append_body(bool has_body, int shape) {
    json_.object("OMI_physics_body", [&] {
      if (shape >= 0) json_.object("collider", [&] { json_.member("shape", shape); });
      if (has_body) json_.object("motion", [&] { json_.member("type", "static"); });
    });
  }

  /// The parents of shapes are bodies, and shapes without a parent.
  void find_bodies() {
    is_body_.assign(model_.nodes.size(), false);
    for (std::size_t i = 0; i < shown_.shapes.size(); ++i) {
      if (shown_.shapes[i] < 0) continue;
      const int parent = model_.nodes[i].parent;
      is_body_[parent < 0 ? i : static_cast<std::size_t>(parent)] = true;
    }
  }

  void append_instancing(const CopyAccessors& accessors) {
    json_.object("EXT_mesh_gpu_instancing", [&] {
      json_.object("attributes", [&] {
        if (accessors.translation >= 0) json_.member("TRANSLATION", accessors.translation);
        if (accessors.rotation >= 0) json_.member("ROTATION", accessors.rotation);
        if (accessors.scale >= 0) json_.member("SCALE", accessors.scale);
      });
    });
  }

  /// "bark_LOD0" is the finest of "bark_LOD1".
  std::string level_name(std::string name, std::size_t level) const {
    constexpr std::string_view finest = "_LOD0";
    if (name.ends_with(finest)) name.resize(name.size() - finest.size());
    name += "_LOD";
    append_integer(name, static_cast<long long>(level));
    while (names_.contains(name)) name += '_';
    return name;
  }

  void append_shown(std::size_t number, int mesh) {
    const int skin = model_.nodes[number].skin;
    if (mesh < 0) return;  // a skin without a mesh is an error
    json_.member("mesh", mesh);
    if (skin < 0) return;
    const int number_of_skin = shown_.skins[static_cast<std::size_t>(skin)];
    if (number_of_skin >= 0) json_.member("skin", number_of_skin);
  }

  /// The copies of all nodes come after the nodes of the model, in the same order.
  void append_children(std::size_t number) {
    const std::size_t begin = family_.first[number], end = family_.first[number + 1];
    if (begin == end && copies(number) == 0) return;
    json_.array("children", [&] {
      for (std::size_t i = begin; i < end; ++i) json_.value(family_.children[i]);
      for (std::size_t i = 0; i < copies(number); ++i) json_.value(next_copy_++);
    });
  }

  /// Names stay unique: a copy gets another name where a node of the model has it already.
  std::string copy_name(const std::string& name, std::size_t i) const {
    std::string copy = name + '_';
    append_integer(copy, static_cast<long long>(i));
    while (names_.contains(copy)) copy += '_';
    return copy;
  }

  JsonWriter json_;
  const Model& model_;
  const NodeMeshes& shown_;
  Family family_;
  std::vector<bool> is_body_;
  std::size_t next_copy_, next_level_ = 0;        ///< numbers of the next nodes after those of the model
  std::vector<std::vector<std::size_t>> object_;  ///< of each coarser level of the object, the nodes below it
  std::size_t widest_part_ = 0;                   ///< the part that has the thresholds of the object
  std::unordered_set<std::string_view> names_;    ///< of the model's nodes, if any node is copied
};

}  // namespace

void append_nodes(std::string& out, const Model& model, const NodeMeshes& shown, Job& job) {
  TextMeter meter(out, job);
  NodeWriter writer(out, model, shown);
  out += '[';
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    writer.append_node(i);
    meter.step();
  }
  for (std::size_t i = 0; i < model.nodes.size(); ++i) writer.append_copies(i, meter);
  writer.append_all_levels(meter);
  out += ']';
  meter.finish();
}

}  // namespace seedmesh::gltf

#include "core/gltf/nodes.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_set>

#include "core/gltf/json_text.h"

namespace seedmesh::gltf {
namespace {

template <int n, class Vector>
void append_vector(std::string& out, std::string_view key, const Vector& vector) {
  out += key;
  for (int i = 0; i < n; ++i) {
    out += i == 0 ? '[' : ',';
    append_number(out, vector[i]);
  }
  out += ']';
}

void append_transform(std::string& out, const Transform& t) {
  if (t.translation != glm::vec3(0)) append_vector<3>(out, ",\"translation\":", t.translation);
  const glm::vec4 rotation(t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w);
  if (rotation != glm::vec4(0, 0, 0, 1)) append_vector<4>(out, ",\"rotation\":", rotation);
  if (t.scale != glm::vec3(1)) append_vector<3>(out, ",\"scale\":", t.scale);
}

void append_member(std::string& out, std::string_view key, int number) {
  if (number < 0) return;
  out += key;
  append_integer(out, number);
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

/// Shares of the screen's height below which the next level is shown; the last is never left for nothing.
/// A picture takes over where it is about as large as it is sharp.
void append_coverage(std::string& out, const Node& node, std::size_t levels) {
  constexpr std::array<std::string_view, 5> shares = {"0.5", "0.25", "0.12", "0.06", "0.03"};
  constexpr std::size_t of_impostor = 2;
  for (std::size_t i = 0; i + 1 < levels; ++i) {
    out += i == 0 ? '[' : ',';
    const bool is_last = node.has_impostor && i + 2 == levels;
    out += shares[std::min(is_last ? std::max(i, of_impostor) : i, shares.size() - 1)];
  }
  out += ",0]";
}

void append_extras(std::string& out, const Node& node, std::size_t levels) {
  char before = '{';
  const auto append_name = [&](std::string_view name) {
    if (before == '{') out += ",\"extras\":";
    out += before;
    append_string(out, name);
    out += ':';
    before = ',';
  };
  for (const Extra& extra : node.extras) {
    append_name(extra.name);
    out += extra.json;
  }
  if (node.collision != CollisionShape::none) {
    append_name("collision");
    append_string(out, name_of(node.collision));
  }
  if (levels > 1) {
    append_name("MSFT_screencoverage");
    append_coverage(out, node, levels);
  }
  if (before == ',') out += '}';
}

/// The children of every node, those of one node side by side, in rising order.
struct Family {
  std::vector<std::size_t> first;  ///< for each node where its children begin; one more at the end
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
  NodeWriter(std::string& out, const Model& model, const Shown& shown)
      : out_(out), model_(model), shown_(shown), family_(family_of(model)), next_copy_(model.nodes.size()) {
    next_level_ = next_copy_;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) next_level_ += copies(i);
    const auto is_copied = [](const Node& node) {
      return !node.instances.transforms.empty() || !node.lods.empty();
    };
    if (std::none_of(model.nodes.begin(), model.nodes.end(), is_copied)) return;
    for (const Node& node : model.nodes) names_.insert(node.name);
  }

  void append_node(std::size_t number) {
    const Node& node = model_.nodes[number];
    open(node.name);
    append_transform(out_, node.transform);
    const bool shows = stands_itself(number);
    if (shows) append_shown(number, shown_.meshes[number]);
    append_children(number);
    const std::size_t coarser = shows ? levels(number) : 0;
    append_extensions(number, shows, coarser);
    append_extras(out_, node, 1 + coarser);
    out_ += '}';
  }

  void append_copies(std::size_t number, TextMeter& meter) {
    const Node& node = model_.nodes[number];
    for (std::size_t i = 0; i < copies(number); ++i) {
      open(copy_name(node.name, i));
      append_transform(out_, node.instances.transforms[i]);
      append_shown(number, shown_.meshes[number]);
      append_extensions(number, false, levels(number));
      if (levels(number) > 0) {
        Node copy;
        copy.has_impostor = node.has_impostor;
        append_extras(out_, copy, 1 + levels(number));
      }
      out_ += '}';
      meter.step();
    }
  }

  /// The coarser levels in the order in which they were named: those of nodes, then those of copies.
  void append_all_levels(TextMeter& meter) {
    for (const bool itself : {true, false}) {
      for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
        if (levels(i) > 0 && stands_itself(i) == itself) append_levels(i, meter);
      }
    }
  }

 private:
  /// Copies that are nodes.
  std::size_t copies(std::size_t number) const {
    if (shown_.meshes[number] < 0 || shown_.copies.contains(number)) return 0;
    return model_.nodes[number].instances.transforms.size();
  }

  /// Whether the node shows its mesh, once or by instancing, and no child does so for it.
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
        open(level_name(itself ? node.name : copy_name(node.name, i), level + 1));
        append_transform(out_, itself ? node.transform : node.instances.transforms[i]);
        append_shown(number, shown_.lods[number][level]);
        append_extensions(number, itself && shown_.lods[number][level] >= 0, 0);
        out_ += '}';
        meter.step();
      }
    }
  }

  /// `itself`: with the copies that are no nodes. `coarser`: how many levels to name.
  void append_extensions(std::size_t number, bool itself, std::size_t coarser) {
    const auto found = itself ? shown_.copies.find(number) : shown_.copies.end();
    if (found == shown_.copies.end() && coarser == 0) return;
    out_ += ",\"extensions\":{";
    if (found != shown_.copies.end()) {
      out_ += "\"EXT_mesh_gpu_instancing\":{\"attributes\":{";
      append_attribute("\"TRANSLATION\":", found->second.translation);
      append_attribute("\"ROTATION\":", found->second.rotation);
      append_attribute("\"SCALE\":", found->second.scale);
      out_ += "}}";
    }
    if (coarser > 0) {
      if (out_.back() == '}') out_ += ',';
      out_ += "\"MSFT_lod\":{\"ids\":[";
      for (std::size_t i = 0; i < coarser; ++i) append_child(next_level_++);
      out_ += "]}";
    }
    out_ += '}';
  }

  void append_attribute(std::string_view key, int accessor) {
    if (accessor < 0) return;
    if (out_.back() != '{') out_ += ',';
    append_member(out_, key, accessor);
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

  void open(std::string_view name) {
    if (out_.back() != '[') out_ += ',';
    out_ += "{\"name\":";
    append_string(out_, name);
  }

  void append_shown(std::size_t number, int mesh) {
    const int skin = model_.nodes[number].skin;
    if (mesh < 0) return;  // a skin without a mesh is an error
    append_member(out_, ",\"mesh\":", mesh);
    if (skin >= 0) append_member(out_, ",\"skin\":", shown_.skins[static_cast<std::size_t>(skin)]);
  }

  /// The copies of all nodes stand after the model's own nodes, in the order of those.
  void append_children(std::size_t number) {
    const std::size_t begin = family_.first[number], end = family_.first[number + 1];
    if (begin == end && copies(number) == 0) return;
    out_ += ",\"children\":[";
    for (std::size_t i = begin; i < end; ++i) append_child(family_.children[i]);
    for (std::size_t i = 0; i < copies(number); ++i) append_child(next_copy_++);
    out_ += ']';
  }

  void append_child(std::size_t number) {
    if (out_.back() != '[') out_ += ',';
    append_integer(out_, static_cast<long long>(number));
  }

  /// Names stay unique: a copy gives way to a node of the model that already has its name.
  std::string copy_name(const std::string& name, std::size_t i) const {
    std::string copy = name + '_';
    append_integer(copy, static_cast<long long>(i));
    while (names_.contains(copy)) copy += '_';
    return copy;
  }

  std::string& out_;
  const Model& model_;
  const Shown& shown_;
  Family family_;
  std::size_t next_copy_, next_level_ = 0;      ///< numbers of nodes that come behind those of the model
  std::unordered_set<std::string_view> names_;  ///< of the model's nodes, if any node is copied
};

}  // namespace

void append_nodes(std::string& out, const Model& model, const Shown& shown, Job& job) {
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
  meter.settle();
}

}  // namespace seedmesh::gltf

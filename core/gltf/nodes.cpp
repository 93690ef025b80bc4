#include "core/gltf/nodes.h"

#include <algorithm>
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

void append_extras(std::string& out, const Node& node) {
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
    const auto is_copied = [](const Node& node) { return !node.instances.transforms.empty(); };
    if (std::none_of(model.nodes.begin(), model.nodes.end(), is_copied)) return;
    for (const Node& node : model.nodes) names_.insert(node.name);
  }

  void append_node(std::size_t number) {
    const Node& node = model_.nodes[number];
    open(node.name);
    append_transform(out_, node.transform);
    if (node.instances.transforms.empty()) append_shown(number);
    append_children(number);
    append_extras(out_, node);
    out_ += '}';
  }

  void append_copies(std::size_t number, TextMeter& meter) {
    const Node& node = model_.nodes[number];
    for (std::size_t i = 0; i < copies(number); ++i) {
      open(copy_name(node.name, i));
      append_transform(out_, node.instances.transforms[i]);
      append_shown(number);
      out_ += '}';
      meter.step();
    }
  }

 private:
  std::size_t copies(std::size_t number) const {
    return shown_.meshes[number] < 0 ? 0 : model_.nodes[number].instances.transforms.size();
  }

  void open(std::string_view name) {
    if (out_.back() != '[') out_ += ',';
    out_ += "{\"name\":";
    append_string(out_, name);
  }

  void append_shown(std::size_t number) {
    const int skin = model_.nodes[number].skin;
    if (shown_.meshes[number] < 0) return;  // a skin without a mesh is an error
    append_member(out_, ",\"mesh\":", shown_.meshes[number]);
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
  std::size_t next_copy_;
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
  out += ']';
  meter.settle();
}

}  // namespace seedmesh::gltf

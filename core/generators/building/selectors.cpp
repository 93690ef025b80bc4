/// The words of selectors, and how they take components; see components.h.
#include <algorithm>

#include "core/generators/building/components.h"
#include "core/generators/building/evaluate.h"

namespace seedmesh::building {
namespace {

struct ClassName {
  std::string_view name;
  std::uint32_t classes;
};
constexpr ClassName class_names[] = {
    {"front", face_front},   {"back", face_back},         {"left", face_left},
    {"right", face_right},   {"top", face_top},           {"bottom", face_bottom},
    {"side", face_side},     {"all", face_all},           {"horizontal", face_horizontal},
    {"aslant", face_aslant}, {"vertical", face_vertical}, {"nutant", face_nutant},
    {"inside", face_inside}, {"border", face_border},     {"eave", edge_eave},
    {"hip", edge_hip},       {"valley", edge_valley},     {"ridge", edge_ridge},
};
/// The directions of the world; -z is north.
constexpr ClassName world_names[] = {
    {"south", face_front}, {"north", face_back},  {"east", face_right}, {"west", face_left},
    {"up", face_top},      {"down", face_bottom}, {"side", face_side},
};

}  // namespace

std::uint32_t class_named(std::string_view name) {
  const auto* const found = std::ranges::find(class_names, name, &ClassName::name);
  return found == std::end(class_names) ? 0 : found->classes;
}

bool read_selector(std::string_view dotted, std::uint32_t& classes, std::uint8_t& frame) {
  frame = frame_scope;
  const std::size_t dot = dotted.find('.');
  const std::string_view word = dotted.substr(dot == std::string_view::npos ? 0 : dot + 1);
  const std::string_view prefix = dot == std::string_view::npos ? std::string_view() : dotted.substr(0, dot);
  classes = class_named(word);
  if (prefix.empty()) return classes != 0;
  if (prefix == "world" || prefix == "object") {
    frame = frame_world;
    const auto* const found = std::ranges::find(world_names, word, &ClassName::name);
    if (found != std::end(world_names)) classes = found->classes;
    return classes != 0;
  }
  if (prefix == "scope" || prefix == "edge") return classes != 0;
  if (prefix != "street") return false;
  // A lot without streets: its own sides.
  if (classes == 0 && (word == "inside" || word == "outside")) classes = never;
  return classes != 0;
}

bool is_selected(Derivation& d, const Part& part, const Component& component, std::int32_t number,
                 std::uint32_t shape) {
  if (!part.condition.is_given) {
    if ((component.classes[part.frame] & part.classes) == 0) return false;
    return part.index < 0 || part.index == number;
  }
  const Component* const before = d.component;
  d.component = &component;
  look_at(d, component.state, shape);
  const lang::TaggedValue value = evaluate(d, part.condition);
  d.component = before;
  if (part.index == -2) return value.number == number;  // a number that is computed
  return value.is_text() || value.number != 0;
}

}  // namespace seedmesh::building

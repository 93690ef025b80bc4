#include "core/generators/idle.h"

namespace seedmesh {

void IdleParameters::warn(std::string pointer, const std::string& reason) {
  warnings_.push_back({std::move(pointer), "has no effect: " + reason, 0, 0});
}

void IdleParameters::warn_if(bool is_idle, std::string pointer, const std::string& reason) {
  if (is_idle) warn(std::move(pointer), reason);
}

void IdleParameters::warn_of(const std::string& pointer, std::initializer_list<std::string_view> names,
                             const std::string& reason) {
  const Json::json_pointer at(pointer);
  if (!given_.contains(at)) return;
  const Json& object = given_.at(at);
  for (const std::string_view name : names) {
    if (object.contains(name)) warn(pointer + "/" + std::string(name), reason);
  }
}

}  // namespace seedmesh

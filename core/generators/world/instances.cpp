#include "core/generators/world/instances.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::world {
namespace {
constexpr int type_float = 5126, type_unsigned_byte = 5121, type_short = 5122;
}

void Instances::add(const std::array<double, 3>& at, const std::array<float, 3>& scale) {
  const bool is_first = translations_.empty();
  for (std::size_t k = 0; k < 3; ++k) {
    const float value = static_cast<float>(at[k]) + 0.0F;  // -0 becomes 0
    low_[k] = is_first ? value : std::min(low_[k], value);
    high_[k] = is_first ? value : std::max(high_[k], value);
    translations_.push_back(value);
    scales_.push_back(scale[k]);
  }
}

void Instances::add(const std::array<double, 3>& at, const std::array<float, 3>& scale,
                    const std::array<float, 2>& turn) {
  add(at, scale);
  const auto part = [](float v) {
    return static_cast<std::int16_t>(math::to_int32(std::floor(static_cast<double>(v) * 32767 + 0.5)));
  };
  turns_.insert(turns_.end(), {0, part(turn[0]), 0, part(turn[1])});
}

void Instances::add_to(Glb& glb, const std::string& name, const std::vector<int>& meshes) const {
  glb.use_extension("EXT_mesh_gpu_instancing");
  const auto values = [&](const std::vector<float>& list, const char* type) {
    const int view = glb.add_bytes(list.data(), list.size() * sizeof(float), 0, 0);
    return Json{{"bufferView", view}, {"componentType", type_float}, {"count", count()}, {"type", type}};
  };
  Json translation = values(translations_, "VEC3");
  translation["min"] = low_;
  translation["max"] = high_;
  Json attributes = {{"TRANSLATION", glb.add_accessor(std::move(translation))},
                     {"SCALE", glb.add_accessor(values(scales_, "VEC3"))}};
  if (!turns_.empty()) {
    attributes["ROTATION"] =
        glb.add_accessor({{"bufferView", glb.add_bytes(turns_.data(), turns_.size() * 2, 0, 0)},
                          {"componentType", type_short},
                          {"normalized", true},
                          {"count", count()},
                          {"type", "VEC4"}});
  }
  if (!tints_.empty()) {
    attributes["_COLOR_0"] =
        glb.add_accessor({{"bufferView", glb.add_bytes(tints_.data(), tints_.size(), 0, 0)},
                          {"componentType", type_unsigned_byte},
                          {"normalized", true},
                          {"count", count()},
                          {"type", "VEC4"}});
  }
  for (const int mesh : meshes) {
    glb.add_node({{"name", name},
                  {"mesh", mesh},
                  {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
  }
}

}  // namespace seedmesh::world

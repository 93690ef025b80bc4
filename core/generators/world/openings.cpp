#include "core/generators/world/openings.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/generators/world/store.h"

namespace seedmesh::world {
namespace {

constexpr double window_width = 0.9, window_height = 1.25, door_width = 1, door_height = 2.1;  ///< metres
constexpr int type_byte = 5120, type_unsigned_byte = 5121, type_unsigned_short = 5123, type_float = 5126;
constexpr int array_buffer = 34962, element_buffer = 34963;
constexpr std::size_t vertex_bytes =
    20;  ///< position as floats, normal as signed bytes, colour as RGBA bytes

using Quad = std::array<glm::dvec3, 4>;
using Paint = std::array<std::uint8_t, 3>;  ///< linear
constexpr Paint white{150, 146, 136}, glass{10, 14, 19}, stone{92, 86, 76};
constexpr Paint brick{86, 44, 34};
constexpr Paint wood{44, 24, 13}, panel{27, 14, 8};

/// An upright rectangle before a wall: to the right, upwards, and its distance from the wall, in metres.
struct Part {
  double left = 0, right = 0, low = 0, high = 0, out = 0;
};

/// Rectangles before a wall, which faces +Z.
class Relief {
 public:
  void add(const Part& part, const Paint& paint) {
    const auto [left, right, low, high, out] = part;
    add_quad({glm::dvec3(left, low, out), {right, low, out}, {right, high, out}, {left, high, out}},
             {0, 0, 1}, paint);
  }
  /// Adds a ledge: its front and its upper side.
  void add_ledge(const Part& part, const Paint& paint) {
    const auto [left, right, low, high, out] = part;
    add(part, paint);
    add_quad({glm::dvec3(left, high, out), {right, high, out}, {right, high, 0}, {left, high, 0}}, {0, 1, 0},
             paint);
  }
  /// Adds a block without a floor: `part.out` is the distance of its walls from the middle.
  void add_block(const Part& part, const Paint& paint) {
    const auto [left, right, low, high, out] = part;
    const glm::dvec3 corners[] = {{left, low, out}, {right, low, out}, {right, low, -out}, {left, low, -out}};
    const glm::dvec3 up(0, high - low, 0), normals[] = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}};
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec3 &a = corners[k], &b = corners[(k + 1) % 4];
      add_quad({a, b, b + up, a + up}, normals[k], paint);
    }
    add_quad({corners[0] + up, corners[1] + up, corners[2] + up, corners[3] + up}, {0, 1, 0}, paint);
  }
  /// Ends a mesh, and appends it to an asset whose vertices are in the first view and whose corners are in the second.
  void end_mesh(Asset& asset) {
    const std::size_t count = positions_.size() - first_;
    glm::vec3 low = positions_[first_], high = low;
    for (std::size_t k = first_; k < positions_.size(); ++k) {
      low = glm::min(low, positions_[k]);
      high = glm::max(high, positions_[k]);
    }
    Json& accessors = asset.parts["accessors"];
    const auto vertices = [&](Json accessor, std::size_t offset) {
      accessor.update(
          Json{{"bufferView", 0}, {"byteOffset", first_ * vertex_bytes + offset}, {"count", count}});
      accessors.push_back(std::move(accessor));
      return accessors.size() - 1;
    };
    Json attributes;
    attributes["POSITION"] = vertices({{"componentType", type_float},
                                       {"type", "VEC3"},
                                       {"min", {low.x, low.y, low.z}},
                                       {"max", {high.x, high.y, high.z}}},
                                      0);
    attributes["NORMAL"] =
        vertices({{"componentType", type_byte}, {"normalized", true}, {"type", "VEC3"}}, 12);
    attributes["COLOR_0"] =
        vertices({{"componentType", type_unsigned_byte}, {"normalized", true}, {"type", "VEC4"}}, 16);
    accessors.push_back({{"bufferView", 1},
                         {"byteOffset", first_corner_ * 2},
                         {"componentType", type_unsigned_short},
                         {"count", corners_.size() - first_corner_},
                         {"type", "SCALAR"}});
    asset.parts["meshes"].push_back(
        {{"primitives",
          Json::array({{{"attributes", attributes}, {"indices", accessors.size() - 1}, {"material", 0}}})}});
    asset.triangles = std::max<std::uint64_t>(asset.triangles, (corners_.size() - first_corner_) / 3);
    first_ = positions_.size();
    first_corner_ = corners_.size();
  }
  void end_file(Asset& asset) const {
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      char vertex[vertex_bytes];
      std::memcpy(vertex, &positions_[k], 12);
      for (int axis = 0; axis < 3; ++axis)
        vertex[12 + axis] = static_cast<char>(math::to_int32(normals_[k][axis] * 127));
      vertex[15] = 0;
      std::memcpy(vertex + 16, paints_[k].data(), 3);
      vertex[19] = static_cast<char>(255);
      asset.file.append(vertex, vertex_bytes);
    }
    const std::size_t size = asset.file.size();
    for (const std::uint16_t corner : corners_) {
      asset.file += static_cast<char>(corner & 255U);
      asset.file += static_cast<char>(corner >> 8U);
    }
    asset.parts["bufferViews"] = {
        {{"buffer", 0}, {"byteLength", size}, {"byteStride", vertex_bytes}, {"target", array_buffer}},
        {{"buffer", 0},
         {"byteLength", 2 * corners_.size()},
         {"byteOffset", size},
         {"target", element_buffer}}};
    asset.file.resize((asset.file.size() + 3) & ~std::size_t{3});
  }

 private:
  void add_quad(const Quad& quad, const glm::dvec3& normal, const Paint& paint) {
    const auto first = static_cast<std::uint16_t>(positions_.size() - first_);
    for (const glm::dvec3& p : quad) {
      positions_.push_back(glm::vec3(p));
      normals_.push_back(normal);
      paints_.push_back(paint);
    }
    for (const int k : {0, 1, 2, 0, 2, 3}) corners_.push_back(static_cast<std::uint16_t>(first + k));
  }

  std::vector<glm::vec3> positions_;
  std::vector<glm::dvec3> normals_;
  std::vector<Paint> paints_;
  std::vector<std::uint16_t> corners_;
  std::size_t first_ = 0, first_corner_ = 0;  ///< of the mesh that is not ended yet
};

Asset make_asset() {
  Asset asset;
  Relief relief;
  // a window with four panes in a frame, above a ledge
  constexpr double half = window_width / 2, frame = 0.09, bar = 0.03;
  relief.add({-half - frame, half + frame, -frame, window_height + frame, 0.03}, white);
  for (const double side : {-1.0, 1.0}) {
    const double a = side * bar, b = side * half;
    relief.add({std::min(a, b), std::max(a, b), 0.02, 0.6 * window_height - bar, 0.05}, glass);
    relief.add({std::min(a, b), std::max(a, b), 0.6 * window_height + bar, window_height, 0.05}, glass);
  }
  relief.add_ledge({-half - 0.15, half + 0.15, -0.15, -0.06, 0.12}, stone);
  relief.end_mesh(asset);
  // a door with two panels and a light above it
  constexpr double wide = door_width / 2;
  relief.add({-wide - 0.12, wide + 0.12, 0, door_height + 0.12, 0.03}, stone);
  relief.add({-wide, wide, 0, door_height, 0.05}, wood);
  relief.add({-wide + 0.12, wide - 0.12, 0.15, 0.75, 0.06}, panel);
  relief.add({-wide + 0.12, wide - 0.12, 0.87, 1.6, 0.06}, panel);
  relief.add({-wide + 0.08, wide - 0.08, 1.72, door_height - 0.06, 0.06}, glass);
  relief.end_mesh(asset);
  relief.add_block({-0.55, 0.55, 0, 1, 0.4}, brick);
  relief.end_mesh(asset);
  relief.end_file(asset);
  asset.parts["materials"] = Json::array(
      {{{"name", "openings"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.9}}}}});
  asset.hash = hash_of(asset.file + asset.parts.dump());
  asset.size = sizeof(asset) + asset.file.size() + 8 * asset.parts.dump().size();
  return asset;
}

}  // namespace

void Openings::add_window(const Opening& opening) { add(windows_, opening, window_width, window_height); }

void Openings::add_door(const Opening& opening) { add(doors_, opening, door_width, door_height); }

void Openings::add_chimney(const Opening& opening) { add(chimneys_, opening, 1, 1); }

/// Turns +Z of a mesh out of the wall. `width`, `height`: of the mesh.
void Openings::add(Instances& copies, const Opening& opening, double width, double height) const {
  const double w = std::sqrt(std::max(0.0, (1 - opening.y) / 2));
  const double y = w > 1e-4 ? opening.x / (2 * w) : 1;
  copies.add({opening.east - frame_.middle_east, opening.foot, frame_.middle_north - opening.north},
             {static_cast<float>(opening.width / width), static_cast<float>(opening.height / height), 1.0F},
             {static_cast<float>(y), static_cast<float>(w)});
}

void Openings::add_to(Glb& glb, const World& world, Job& job) const {
  const std::size_t count = windows_.count() + doors_.count() + chimneys_.count();
  if (count == 0) return;
  const auto asset = opening_asset(world, job);
  const std::vector<int> meshes = glb.add_asset(*asset);
  job.spend(Resource::triangles, count * asset->triangles);
  if (windows_.count() > 0) windows_.add_to(glb, "buildings_windows", {meshes[0]});
  if (doors_.count() > 0) doors_.add_to(glb, "buildings_doors", {meshes[1]});
  if (chimneys_.count() > 0) chimneys_.add_to(glb, "buildings_chimneys", {meshes[2]});
}

std::shared_ptr<const Asset> opening_asset(const World& world, const Job& job) {
  return world.store->get<Asset>({0, Store::Layer::file, -1, 4, 0}, job,
                                 [] { return std::make_shared<const Asset>(make_asset()); });
}

}  // namespace seedmesh::world

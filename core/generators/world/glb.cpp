#include "core/generators/world/glb.h"

#include <algorithm>

#include "core/generators/world/asset.h"

namespace seedmesh::world {
namespace {

constexpr int array_buffer = 34962, element_buffer = 34963;
constexpr int type_byte = 5120, type_unsigned_byte = 5121, type_short = 5122, type_unsigned_short = 5123,
              type_unsigned = 5125, type_float = 5126;

int append(Json& list, Json value) {
  list.push_back(std::move(value));
  return static_cast<int>(list.size()) - 1;
}

void append_word(std::string& out, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>((word >> shift) & 255U);
}

constexpr const char* lists_of_assets[] = {"bufferViews", "accessors", "images", "samplers",
                                           "textures",    "materials", "meshes"};

/// Adds to the numbers of textures in a material: of each object whose name ends with "Texture".
void move_textures(Json& value, int by) {
  if (value.is_array()) {
    for (Json& each : value) move_textures(each, by);
  }
  if (!value.is_object()) return;
  for (auto& [name, each] : value.items()) {
    if (name.ends_with("Texture") && each.contains("index")) each["index"] = each["index"].get<int>() + by;
    move_textures(each, by);
  }
}

}  // namespace

Glb::Glb(const std::array<double, 3>& translation) {
  json_["asset"] = {{"version", "2.0"}, {"generator", "seedmesh"}};
  json_["scene"] = 0;
  json_["scenes"] = Json::array({{{"nodes", {0}}}});
  json_["nodes"] =
      Json::array({{{"name", "tile"}, {"translation", translation}, {"children", Json::array()}}});
  json_["buffers"] = Json::array({Json::object()});
  for (const char* name : {"bufferViews", "accessors", "meshes", "materials"}) json_[name] = Json::array();
  use_extension("KHR_mesh_quantization");
}

void Glb::use_extension(std::string_view name) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    Json& names = json_[list];
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
}

int Glb::add_material(std::string_view name, double roughness, bool two_sided) {
  Json material = {{"name", name},
                   {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", roughness}}}};
  if (two_sided) material["doubleSided"] = true;
  return append(json_["materials"], std::move(material));
}

int Glb::add_material(std::string_view name, double roughness, const std::string& image) {
  const int material = add_material(name, roughness);
  json_["materials"][static_cast<std::size_t>(material)]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", texture_of(image)}};
  return material;
}

int Glb::add_leaf_material(std::string_view name, const std::string& image) {
  const int material = add_material(name, 1, image);
  json_["materials"][static_cast<std::size_t>(material)].update(
      Json{{"alphaMode", "MASK"}, {"alphaCutoff", 0.5}});
  return material;
}

int Glb::texture_of(const std::string& image) {
  const auto known = textures_.find(image);
  if (known != textures_.end()) return known->second;
  const int source = append(json_["images"], {{"uri", image}});
  return textures_[image] = append(json_["textures"], {{"source", source}});
}

int Glb::add_shared_buffer(const std::string& file, std::size_t bytes) {
  return append(json_["buffers"], {{"uri", shared_files + file}, {"byteLength", bytes}});
}

std::vector<int> Glb::add_asset(const Asset& asset) {
  if (const auto known = assets_.find(asset.hash); known != assets_.end()) return known->second;
  const int buffer = add_shared_buffer(asset.hash + ".bin", asset.file.size());
  std::map<std::string, int> first;
  for (const char* list : lists_of_assets)
    first[list] = json_.contains(list) ? static_cast<int>(json_[list].size()) : 0;
  const auto move = [&](Json& object, const char* key, const char* list) {
    if (object.contains(key)) object[key] = object[key].get<int>() + first[list];
  };
  std::vector<int> meshes;
  for (const char* list : lists_of_assets) {
    if (!asset.parts.contains(list)) continue;
    for (Json part : asset.parts[list]) {
      move(part, "bufferView", "bufferViews");
      if (part.contains("buffer")) part["buffer"] = buffer;
      if (std::string_view(list) == "textures") {
        move(part, "source", "images");
        move(part, "sampler", "samplers");
      }
      if (std::string_view(list) == "materials") move_textures(part, first["textures"]);
      if (std::string_view(list) == "meshes") {
        for (Json& primitive : part["primitives"]) {
          for (auto& [name, accessor] : primitive["attributes"].items())
            accessor = accessor.get<int>() + first["accessors"];
          move(primitive, "indices", "accessors");
          move(primitive, "material", "materials");
        }
        meshes.push_back(static_cast<int>(json_["meshes"].size()));
      }
      json_[list].push_back(std::move(part));
    }
  }
  if (asset.parts.contains("extensionsUsed")) {
    for (const Json& name : asset.parts["extensionsUsed"]) {
      Json& used = json_["extensionsUsed"];
      if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
    }
  }
  return assets_[asset.hash] = std::move(meshes);
}

int Glb::add_view(int buffer, std::size_t offset, std::size_t bytes, std::size_t stride, int target) {
  Json view = {{"buffer", buffer}, {"byteLength", bytes}};
  if (offset > 0) view["byteOffset"] = offset;
  if (stride > 0) view["byteStride"] = stride;
  if (target > 0) view["target"] = target;
  return append(json_["bufferViews"], std::move(view));
}

int Glb::add_bytes(const void* data, std::size_t bytes, std::size_t stride, int target) {
  bytes_.resize((bytes_.size() + 3) & ~std::size_t{3});
  const std::size_t offset = bytes_.size();
  bytes_.append(static_cast<const char*>(data), bytes);
  return add_view(0, offset, bytes, stride, target);
}

int Glb::add_accessor(Json accessor) { return append(json_["accessors"], std::move(accessor)); }
int Glb::add_gltf_mesh(Json mesh) { return append(json_["meshes"], std::move(mesh)); }
int Glb::add_node(Json node) {
  const int index = append(json_["nodes"], std::move(node));
  json_["nodes"][0]["children"].push_back(index);
  return index;
}

int Glb::add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  const bool is_small = vertices <= 65535;
  int view = 0;
  if (is_small) {
    const std::vector<std::uint16_t> small(indices.begin(), indices.end());
    view = add_bytes(small.data(), small.size() * 2, 0, element_buffer);
  } else {
    view = add_bytes(indices.data(), indices.size() * 4, 0, element_buffer);
  }
  return add_accessor({{"bufferView", view},
                       {"componentType", is_small ? type_unsigned_short : type_unsigned},
                       {"count", indices.size()},
                       {"type", "SCALAR"}});
}

void Glb::add_mesh(std::string_view name, const TileMesh& mesh, int material, double step, double height,
                   const std::vector<float>& coordinates) {
  Parts parts{{{add_indices(mesh.indices, mesh.vertices.size()), material}}, -1};
  if (!coordinates.empty()) {
    const int view = add_bytes(coordinates.data(), coordinates.size() * sizeof(float), 0, array_buffer);
    parts.coordinates = add_accessor({{"bufferView", view},
                                      {"componentType", type_float},
                                      {"count", coordinates.size() / 2},
                                      {"type", "VEC2"}});
  }
  add_mesh(name, mesh.vertices, parts, step, height);
}

int Glb::add_shared_indices(int buffer, std::size_t offset, std::size_t count) {
  const int view = add_view(buffer, offset, 2 * count, 0, element_buffer);
  return add_accessor(
      {{"bufferView", view}, {"componentType", type_unsigned_short}, {"count", count}, {"type", "SCALAR"}});
}

int Glb::add_shared_coordinates(int buffer, std::size_t offset, std::size_t count) {
  const int view = add_view(buffer, offset, 8 * count, 0, array_buffer);
  return add_accessor(
      {{"bufferView", view}, {"componentType", type_float}, {"count", count}, {"type", "VEC2"}});
}

void Glb::add_mesh(std::string_view name, const std::vector<TileVertex>& vertices, const Parts& parts,
                   double step, double height) {
  int low[3] = {32767, 32767, 32767}, high[3] = {-32768, -32768, -32768};
  for (const TileVertex& v : vertices) {
    const int values[3] = {v.x, v.y, v.z};
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], values[k]);
      high[k] = std::max(high[k], values[k]);
    }
  }
  const int view =
      add_bytes(vertices.data(), vertices.size() * sizeof(TileVertex), sizeof(TileVertex), array_buffer);
  const std::size_t count = vertices.size();
  Json attributes;
  attributes["POSITION"] = add_accessor({{"bufferView", view},
                                         {"componentType", type_short},
                                         {"count", count},
                                         {"type", "VEC3"},
                                         {"min", low},
                                         {"max", high}});
  attributes["NORMAL"] = add_accessor({{"bufferView", view},
                                       {"byteOffset", 8},
                                       {"componentType", type_byte},
                                       {"normalized", true},
                                       {"count", count},
                                       {"type", "VEC3"}});
  attributes["COLOR_0"] = add_accessor({{"bufferView", view},
                                        {"byteOffset", 12},
                                        {"componentType", type_unsigned_byte},
                                        {"normalized", true},
                                        {"count", count},
                                        {"type", "VEC4"}});
  if (parts.coordinates >= 0) attributes["TEXCOORD_0"] = parts.coordinates;
  Json primitives = Json::array();
  for (const Part& part : parts.parts)
    primitives.push_back({{"attributes", attributes}, {"indices", part.order}, {"material", part.material}});
  const int made = add_gltf_mesh({{"name", name}, {"primitives", std::move(primitives)}});
  add_node({{"name", name}, {"mesh", made}, {"translation", {0, height, 0}}, {"scale", {step, step, step}}});
}

std::size_t Glb::size() const { return 28 + canonical_text(json_).size() + bytes_.size(); }

std::string Glb::text() && {
  for (const char* name : {"bufferViews", "accessors", "meshes", "materials"}) {
    if (json_[name].empty()) json_.erase(name);
  }
  if (json_["nodes"][0]["children"].empty()) json_["nodes"][0].erase("children");
  if (bytes_.empty()) bytes_.resize(4);
  bytes_.resize((bytes_.size() + 3) & ~std::size_t{3});
  json_["buffers"][0]["byteLength"] = bytes_.size();
  std::string text = canonical_text(json_);
  text.resize((text.size() + 3) & ~std::size_t{3}, ' ');
  std::string out = "glTF";
  append_word(out, 2);
  append_word(out, static_cast<std::uint32_t>(28 + text.size() + bytes_.size()));
  append_word(out, static_cast<std::uint32_t>(text.size()));
  out += "JSON";
  out += text;
  append_word(out, static_cast<std::uint32_t>(bytes_.size()));
  out.append("BIN\0", 4);
  out += bytes_;
  return out;
}

}  // namespace seedmesh::world

#include "tests/golden/glb_summary.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace seedmesh::golden {
namespace {

using Json = nlohmann::json;

enum Mode { points = 0, lines = 1, triangles = 4 };  // values of glTF's primitive.mode

struct Totals {
  std::uint64_t triangles = 0, lines = 0, points = 0, vertices = 0;
  double area = 0;
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};
};

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

/// The two chunks of a GLB.
struct Glb {
  Json json;
  std::string_view binary;
};

constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
constexpr std::uint32_t magic = 0x46546C67;  // "glTF"

Glb opened(std::string_view file) {
  const std::size_t length = word_at(file, header_bytes), start = header_bytes + chunk_header_bytes;
  Glb glb{Json::parse(file.substr(start, length)), {}};
  if (start + length < file.size()) glb.binary = file.substr(start + length + chunk_header_bytes);
  return glb;
}

/// The bytes of an accessor and the distance between its elements.
struct Column {
  std::string_view bytes;
  std::size_t stride, count;
  int component;
};

Column column_of(const Glb& glb, std::size_t index, std::size_t packed_stride) {
  const Json& accessor = glb.json["accessors"][index];
  const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t offset =
      view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
  return {glb.binary.substr(offset), view.value("byteStride", packed_stride), accessor["count"],
          accessor["componentType"]};
}

std::vector<glm::dvec3> positions_of(const Glb& glb, std::size_t accessor, const glm::dmat4& transform) {
  const Column column = column_of(glb, accessor, 3 * sizeof(float));
  std::vector<glm::dvec3> positions(column.count);
  for (std::size_t i = 0; i < column.count; ++i) {
    float at[3];
    std::memcpy(at, column.bytes.data() + i * column.stride, sizeof at);
    positions[i] = glm::dvec3(transform * glm::dvec4(at[0], at[1], at[2], 1));
  }
  return positions;
}

std::vector<std::uint32_t> indices_of(const Glb& glb, const Json& primitive, std::size_t vertices) {
  std::vector<std::uint32_t> indices;
  if (!primitive.contains("indices")) {
    for (std::size_t i = 0; i < vertices; ++i) indices.push_back(static_cast<std::uint32_t>(i));
    return indices;
  }
  constexpr int short_type = 5123;
  const auto accessor = primitive["indices"].get<std::size_t>();
  const std::size_t size = glb.json["accessors"][accessor]["componentType"] == short_type ? 2 : 4;
  const Column column = column_of(glb, accessor, size);
  indices.resize(column.count);
  for (std::size_t i = 0; i < column.count; ++i)
    std::memcpy(&indices[i], column.bytes.data() + i * size, size);
  return indices;
}

void add_primitive(const Glb& glb, const Json& primitive, const glm::dmat4& transform, Totals& totals) {
  const std::vector<glm::dvec3> at = positions_of(glb, primitive["attributes"]["POSITION"], transform);
  const std::vector<std::uint32_t> indices = indices_of(glb, primitive, at.size());
  for (const std::uint32_t i : indices) {
    totals.low = glm::min(totals.low, at[i]);
    totals.high = glm::max(totals.high, at[i]);
  }
  const int mode = primitive.value("mode", static_cast<int>(triangles));
  if (mode == points) totals.points += indices.size();
  if (mode == lines) totals.lines += indices.size() / 2;
  if (mode != triangles) return;
  totals.triangles += indices.size() / 3;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const glm::dvec3 &a = at[indices[i]], &b = at[indices[i + 1]], &c = at[indices[i + 2]];
    totals.area += glm::length(glm::cross(b - a, c - a)) / 2;
  }
}

glm::dmat4 transform_of(const Json& node) {
  if (node.contains("matrix")) return glm::make_mat4(node["matrix"].get<std::vector<double>>().data());
  const auto numbers = [&](const char* name, std::vector<double> otherwise) {
    return node.value(name, std::move(otherwise));
  };
  const auto t = numbers("translation", {0, 0, 0}), r = numbers("rotation", {0, 0, 0, 1}),
             s = numbers("scale", {1, 1, 1});
  glm::dmat4 transform = glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2]));
  for (int axis = 0; axis < 3; ++axis) transform[axis] *= s[static_cast<std::size_t>(axis)];
  transform[3] = glm::dvec4(t[0], t[1], t[2], 1);
  return transform;
}

void add_node(const Glb& glb, std::size_t index, const glm::dmat4& above, Totals& totals) {
  const Json& node = glb.json["nodes"][index];
  const glm::dmat4 transform = above * transform_of(node);
  if (node.contains("mesh")) {
    for (const Json& primitive : glb.json["meshes"][node["mesh"].get<std::size_t>()]["primitives"])
      add_primitive(glb, primitive, transform, totals);
  }
  for (const Json& child : node.value("children", Json::array())) add_node(glb, child, transform, totals);
}

std::uint64_t stored_vertices(const Json& json) {
  std::vector<std::size_t> accessors;
  for (const Json& mesh : json.value("meshes", Json::array())) {
    for (const Json& primitive : mesh["primitives"]) accessors.push_back(primitive["attributes"]["POSITION"]);
  }
  std::sort(accessors.begin(), accessors.end());
  accessors.erase(std::unique(accessors.begin(), accessors.end()), accessors.end());
  std::uint64_t vertices = 0;
  for (const std::size_t accessor : accessors)
    vertices += json["accessors"][accessor]["count"].get<std::uint64_t>();
  return vertices;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value + 0.0);  // + 0.0 turns -0 into 0
  return text;
}

std::string point(const glm::dvec3& at) {
  return "(" + number(at.x) + ", " + number(at.y) + ", " + number(at.z) + ")";
}

std::string count_of(const Json& json, const char* member) {
  return std::string(member) + " " + std::to_string(json.value(member, Json::array()).size());
}

std::string material_names(const Json& json) {
  std::string names;
  for (const Json& material : json.value("materials", Json::array()))
    names += (names.empty() ? "" : ", ") + material.value("name", std::string("(no name)"));
  return names.empty() ? "none" : names;
}

}  // namespace

std::string summary_of_glb(std::string_view file) {
  if (file.size() < header_bytes + chunk_header_bytes || word_at(file, 0) != magic)
    return "  " + std::to_string(file.size()) + " bytes that are no GLB\n";
  const Glb glb = opened(file);
  Totals totals;
  for (const Json& node : glb.json["scenes"][0].value("nodes", Json::array()))
    add_node(glb, node, glm::dmat4(1), totals);
  totals.vertices = stored_vertices(glb.json);
  const bool is_empty = totals.low.x > totals.high.x;
  return "  triangles " + std::to_string(totals.triangles) + ", lines " + std::to_string(totals.lines) +
         ", points " + std::to_string(totals.points) + ", vertices " + std::to_string(totals.vertices) +
         "\n  bounds " + (is_empty ? "none" : point(totals.low) + " to " + point(totals.high) + " m") +
         "\n  area " + number(totals.area) + " m2\n  materials " + material_names(glb.json) + "\n  " +
         count_of(glb.json, "nodes") + ", " + count_of(glb.json, "meshes") + ", " +
         count_of(glb.json, "textures") + ", " + count_of(glb.json, "animations") + "\n";
}

}  // namespace seedmesh::golden

#include "core/gltf/lists.h"

#include <map>
#include <string_view>

#include "core/gltf/json_text.h"

namespace seedmesh::gltf {
namespace {

/// The mode numbers are those of OpenGL; glTF takes triangles where none is given.
constexpr int points_mode = 0, lines_mode = 1, triangles_mode = 4;

int mode_of(Topology topology) {
  switch (topology) {
    case Topology::triangles:
      return triangles_mode;
    case Topology::lines:
      return lines_mode;
    case Topology::points:
      return points_mode;
  }
  return triangles_mode;
}

std::string_view name_of(Lanes lanes) {
  switch (lanes) {
    case Lanes::scalar:
      return "SCALAR";
    case Lanes::vec2:
      return "VEC2";
    case Lanes::vec3:
      return "VEC3";
    case Lanes::vec4:
      return "VEC4";
    case Lanes::mat4:
      return "MAT4";
  }
  return "SCALAR";
}

std::string_view name_of(Path path) {
  switch (path) {
    case Path::translation:
      return "translation";
    case Path::rotation:
      return "rotation";
    case Path::scale:
      return "scale";
    case Path::weights:
      return "weights";
  }
  return "translation";
}

std::string_view name_of(Interpolation interpolation) {
  return interpolation == Interpolation::step ? "STEP" : "LINEAR";
}

/// Appends `key`, which brings its own punctuation, and a number.
void append_member(std::string& out, std::string_view key, std::uint64_t number) {
  out += key;
  append_integer(out, static_cast<long long>(number));
}

void append_member(std::string& out, std::string_view key, int number) {
  append_member(out, key, static_cast<std::uint64_t>(number));
}

void append_corner(std::string& out, std::string_view key, const glm::vec3& corner, Lanes lanes) {
  out += key;
  for (int lane = 0; lane < static_cast<int>(lanes); ++lane) {
    out += lane == 0 ? '[' : ',';
    append_number(out, corner[lane]);
  }
  out += ']';
}

void append_accessor(std::string& out, const Column& column, const Bin::Place& place) {
  append_member(out, "{\"bufferView\":", place.view);
  if (place.offset > 0) append_member(out, ",\"byteOffset\":", place.offset);
  append_member(out, ",\"componentType\":", static_cast<int>(column.component));
  append_member(out, ",\"count\":", std::uint64_t{column.count});
  if (column.normalized) out += ",\"normalized\":true";
  out += ",\"type\":\"";
  out += name_of(column.lanes);
  out += '"';
  if (column.range) {
    append_corner(out, ",\"min\":", column.range->min, column.lanes);
    append_corner(out, ",\"max\":", column.range->max, column.lanes);
  }
  out += '}';
}

/// One mapping for each material, with all variants that show it.
void append_variants(std::string& out, const Part& part, MaterialUse& materials) {
  std::map<int, std::vector<std::size_t>> mappings;
  for (std::size_t variant = 0; variant < part.variant_materials.size(); ++variant) {
    const int material = materials.numbering.use(part.variant_materials[variant]);
    if (material >= 0) mappings[material].push_back(variant);
  }
  if (mappings.empty()) return;
  materials.any_variants = true;
  out += ",\"extensions\":{\"KHR_materials_variants\":{\"mappings\":[";
  for (const auto& [material, variants] : mappings) {
    if (out.back() != '[') out += ',';
    append_member(out, "{\"material\":", material);
    out += ",\"variants\":";
    char before = '[';
    for (const std::size_t variant : variants) {
      out += before;
      append_integer(out, static_cast<long long>(variant));
      before = ',';
    }
    out += "]}";
  }
  out += "]}}";
}

void append_primitive(std::string& out, const Part& part, Accessors& accessors, MaterialUse& materials) {
  std::vector<int> numbers;
  for (const Column& column : part.columns) numbers.push_back(accessors.add(vertex_pool(column), column));
  out += "{\"attributes\":{";
  for (const Attribute& attribute : part.attributes) {
    if (out.back() != '{') out += ',';
    append_string(out, attribute.semantic);
    append_member(out, ":", numbers[attribute.column]);
  }
  out += '}';
  if (part.index) {
    Pool pool = index_pool(*part.index);
    if (accessors.packing() == Packing::tight && part.topology != Topology::triangles) {
      pool = pool == Pool::index2 ? Pool::sequence2 : Pool::sequence4;
    }
    append_member(out, ",\"indices\":", accessors.add(pool, *part.index));
  }
  const int material = materials.numbering.use(part.material);
  if (material >= 0) append_member(out, ",\"material\":", material);
  if (part.topology != Topology::triangles) append_member(out, ",\"mode\":", mode_of(part.topology));
  append_variants(out, part, materials);
  out += '}';
}

}  // namespace

int Numbering::use(int index) {
  if (index < 0) return -1;
  int& number = numbers_[static_cast<std::size_t>(index)];
  if (number < 0) {
    number = static_cast<int>(used_.size());
    used_.push_back(static_cast<std::size_t>(index));
  }
  return number;
}

int Accessors::add(Pool pool, const Column& column) {
  rows_.push_back({bin_.add(pool, column.slice), &column});
  return static_cast<int>(rows_.size()) - 1;
}

void Accessors::append(std::string& out, Job& job) const {
  TextMeter meter(out, job);
  out += '[';
  for (const Row& row : rows_) {
    if (out.back() != '[') out += ',';
    append_accessor(out, *row.column, bin_.place(row.item));
    meter.step();
  }
  out += ']';
  meter.settle();
}

void append_mesh(std::string& out, const std::string& name, const std::vector<Part>& parts,
                 Accessors& accessors, MaterialUse& materials) {
  out += "{\"name\":";
  append_string(out, name);
  out += ",\"primitives\":[";
  for (const Part& part : parts) {
    if (out.back() != '[') out += ',';
    append_primitive(out, part, accessors, materials);
  }
  out += "]}";
}

void append_animation(std::string& out, const Animation& animation, const Tracks& tracks,
                      Accessors& accessors) {
  std::string samplers;
  std::map<int, int> inputs;
  out += "{\"name\":";
  append_string(out, animation.name);
  out += ",\"channels\":[";
  for (std::size_t i = 0; i < animation.channels.size(); ++i) {
    const Channel& channel = animation.channels[i];
    append_member(out, i == 0 ? "{\"sampler\":" : ",{\"sampler\":", tracks.sampler[i]);
    append_member(out, ",\"target\":{\"node\":", channel.node);
    out += ",\"path\":";
    append_string(out, name_of(channel.path));
    out += "}}";
  }
  for (std::size_t i = 0; i < tracks.values.size(); ++i) {
    const Channel& channel = animation.channels[static_cast<std::size_t>(tracks.channel[i])];
    const auto [input, is_new] = inputs.try_emplace(channel.times, -1);
    if (is_new)
      input->second = accessors.add(Pool::keys, tracks.times[static_cast<std::size_t>(channel.times)]);
    append_member(samplers, i == 0 ? "{\"input\":" : ",{\"input\":", input->second);
    append_member(samplers, ",\"output\":", accessors.add(Pool::keys, tracks.values[i]));
    samplers += ",\"interpolation\":";
    append_string(samplers, name_of(channel.interpolation));
    samplers += '}';
  }
  out += "],\"samplers\":[" + samplers + "]}";
}

void append_views(std::string& out, const Bin& bin) {
  for (const Bin::View& view : bin.views()) {
    out += out.empty() ? "[{\"buffer\":0" : ",{\"buffer\":0";
    append_member(out, ",\"byteLength\":", view.length);
    if (view.offset > 0) append_member(out, ",\"byteOffset\":", view.offset);
    if (view.stride > 0) append_member(out, ",\"byteStride\":", std::uint64_t{view.stride});
    if (const int target = target_of(view.pool); target > 0) append_member(out, ",\"target\":", target);
    out += '}';
  }
}

}  // namespace seedmesh::gltf

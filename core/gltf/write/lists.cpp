#include "core/gltf/write/lists.h"

#include <map>
#include <span>
#include <string_view>

#include "core/gltf/json_writer.h"

namespace seedmesh::gltf {
namespace {

// The numbers of OpenGL. glTF takes triangles where no mode is given.
constexpr int linear = 9729, linear_mipmap_linear = 9987, repeated = 10497, clamped_to_edge = 33071;
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

void append_accessor(JsonWriter& json, const Column& column, const Bin::Location& location) {
  json.object([&] {
    json.member("bufferView", location.view);
    if (location.offset > 0) json.member("byteOffset", location.offset);
    json.member("componentType", static_cast<int>(column.component));
    json.member("count", column.count);
    if (column.normalized) json.member("normalized", true);
    json.member("type", name_of(column.lanes));
    if (column.range) {
      const auto lanes = static_cast<std::size_t>(column.lanes);
      json.values("min", std::span(&column.range->min.x, lanes));
      json.values("max", std::span(&column.range->max.x, lanes));
    }
  });
}

/// One mapping for each material, with all variants that show it.
void append_variants(JsonWriter& json, const Part& part, MaterialUse& materials) {
  std::map<int, std::vector<std::size_t>> mappings;
  for (std::size_t variant = 0; variant < part.variant_materials.size(); ++variant) {
    const int material = materials.numbering.use(part.variant_materials[variant]);
    if (material >= 0) mappings[material].push_back(variant);
  }
  if (mappings.empty()) return;
  materials.any_variants = true;
  json.object("extensions", [&] {
    json.object("KHR_materials_variants", [&] {
      json.array("mappings", [&] {
        for (const auto& mapping : mappings) {  // Clang 14 captures no structured bindings
          json.object([&] {
            json.member("material", mapping.first);
            json.values("variants", mapping.second);
          });
        }
      });
    });
  });
}

void append_primitive(JsonWriter& json, const Part& part, Accessors& accessors, MaterialUse& materials) {
  std::vector<int> numbers;
  for (const Column& column : part.columns) numbers.push_back(accessors.add(vertex_pool(column), column));
  json.object([&] {
    json.object("attributes", [&] {
      for (const Attribute& attribute : part.attributes)
        json.member(attribute.semantic, numbers[attribute.column]);
    });
    if (part.index) {
      Pool pool = index_pool(*part.index);
      if (accessors.packing() == Packing::tight && part.topology != Topology::triangles) {
        pool = pool == Pool::index2 ? Pool::sequence2 : Pool::sequence4;
      }
      json.member("indices", accessors.add(pool, *part.index));
    }
    const int material = materials.numbering.use(part.material);
    if (material >= 0) json.member("material", material);
    if (part.topology != Topology::triangles) json.member("mode", mode_of(part.topology));
    append_variants(json, part, materials);
  });
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
  JsonWriter json(out);
  json.array([&] {
    for (const Row& row : rows_) {
      append_accessor(json, *row.column, bin_.location(row.item));
      meter.step();
    }
  });
  meter.finish();
}

void append_mesh(std::string& out, const std::string& name, const std::vector<Part>& parts,
                 Accessors& accessors, MaterialUse& materials) {
  JsonWriter json(out);
  json.object([&] {
    json.member("name", name);
    json.array("primitives", [&] {
      for (const Part& part : parts) append_primitive(json, part, accessors, materials);
    });
  });
}

void append_animation(std::string& out, const Animation& animation, const Tracks& tracks,
                      Accessors& accessors) {
  JsonWriter json(out);
  json.object([&] {
    json.member("name", animation.name);
    json.array("channels", [&] {
      for (std::size_t i = 0; i < animation.channels.size(); ++i) {
        const Channel& channel = animation.channels[i];
        json.object([&] {
          json.member("sampler", tracks.sampler[i]);
          json.object("target", [&] {
            json.member("node", channel.node);
            json.member("path", name_of(channel.path));
          });
        });
      }
    });
    json.array("samplers", [&] {
      std::map<int, int> inputs;
      for (std::size_t i = 0; i < tracks.values.size(); ++i) {
        const Channel& channel = animation.channels[static_cast<std::size_t>(tracks.channel[i])];
        const auto input = inputs.try_emplace(channel.times, -1);
        int& times = input.first->second;
        if (input.second)
          times = accessors.add(Pool::keys, tracks.times[static_cast<std::size_t>(channel.times)]);
        json.object([&] {
          json.member("input", times);
          json.member("output", accessors.add(Pool::keys, tracks.values[i]));
          json.member("interpolation", name_of(channel.interpolation));
        });
      }
    });
  });
}

void append_skin(std::string& out, const Skin& skin, int matrices) {
  JsonWriter json(out);
  json.object([&] {
    if (matrices >= 0) json.member("inverseBindMatrices", matrices);
    json.values("joints", skin.joints);
    if (!skin.name.empty()) json.member("name", skin.name);
    if (skin.skeleton >= 0) json.member("skeleton", skin.skeleton);
  });
}

int TextureList::sampler(bool repeat) {
  const auto [place, is_new] = samplers_.try_emplace(repeat, static_cast<int>(samplers_.size()));
  if (!is_new) return place->second;
  const int wrap = repeat ? repeated : clamped_to_edge;
  JsonWriter json(sampler_list_);
  json.object([&] {
    json.member("magFilter", linear);
    json.member("minFilter", linear_mipmap_linear);
    json.member("wrapS", wrap);
    json.member("wrapT", wrap);
  });
  return place->second;
}

int TextureList::number(const TextureUse& use, const Model& model, Numbering& images) {
  if (use.texture < 0) return -1;
  const auto [place, is_new] =
      textures_.try_emplace({use.texture, use.repeat}, static_cast<int>(textures_.size()));
  if (!is_new) return place->second;
  const Image& image = *model.textures[static_cast<std::size_t>(use.texture)];
  const bool is_webp = image.mime == "image/webp";
  has_webp_ = has_webp_ || is_webp || image.webp;
  needs_webp_ = needs_webp_ || is_webp;
  JsonWriter json(texture_list_);
  json.object([&] {
    if (is_webp || image.webp) {
      const int offset = is_webp ? 0 : static_cast<int>(model.textures.size());
      json.object("extensions", [&] {
        json.object("EXT_texture_webp", [&] { json.member("source", images.use(use.texture + offset)); });
      });
    }
    json.member("sampler", sampler(use.repeat));
    if (!is_webp) json.member("source", images.use(use.texture));
  });
  return place->second;
}

void append_views(std::string& out, const Bin& bin, bool has_strides) {
  JsonWriter json(out);
  for (const Bin::View& view : bin.views()) {
    json.object([&] {
      json.member("buffer", 0);
      json.member("byteLength", view.length);
      if (view.offset > 0) json.member("byteOffset", view.offset);
      const bool is_array = target_of(view.pool) != 0 && view.pool < Pool::sequence2;
      const std::uint32_t stride = has_strides && is_array ? stride_of(view.pool) : view.stride;
      if (stride > 0) json.member("byteStride", stride);
      if (const int target = target_of(view.pool); target > 0) json.member("target", target);
    });
  }
}

}  // namespace seedmesh::gltf

#include "core/pipeline/world_assets.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "core/pipeline/body.h"

namespace seedmesh {
namespace {

constexpr int texels = 128;
/// Budgets of a near model in turn, for models that cannot be simplified to fewer; 0: none.
constexpr int near_triangles[] = {1500, 6000, 0};

/// A binary glTF file in its two parts.
struct Glb {
  Json json;
  std::string bytes;
};

std::uint32_t word_at(const std::string& text, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, text.data() + at, sizeof word);
  return word;
}

Glb read_glb(const std::string& text) {
  constexpr std::size_t header = 12, chunk_header = 8;
  const std::size_t size = word_at(text, header);
  const std::size_t end = header + chunk_header + size;
  return {Json::parse(text.substr(header + chunk_header, size)),
          end + chunk_header <= text.size() ? text.substr(end + chunk_header) : std::string()};
}

/// Copies the meshes of a file and all that they need, with indices from 0 and one buffer.
class Extract {
 public:
  Extract(const Glb& from, world::AssetForm form) : from_(from), form_(form) {}

  void add_mesh(int mesh) {
    Json made = from_.json["meshes"][static_cast<std::size_t>(mesh)];
    for (Json& primitive : made["primitives"]) {
      for (auto& [name, accessor] : primitive["attributes"].items())
        accessor = add("accessors", accessor.get<int>());
      if (primitive.contains("indices"))
        primitive["indices"] = add("accessors", primitive["indices"].get<int>());
      if (primitive.contains("material"))
        primitive["material"] = add("materials", primitive["material"].get<int>());
      primitive.erase("extensions");  // seasons as variants of materials
      count(primitive);
    }
    made.erase("extras");
    asset_.parts["meshes"].push_back(std::move(made));
  }

  world::Asset take() && {
    asset_.file.resize((asset_.file.size() + 3) & ~std::size_t{3});
    asset_.hash = world::hash_of(asset_.file + asset_.parts.dump());
    asset_.size = sizeof(asset_) + asset_.file.size() + 8 * asset_.parts.dump().size();
    return std::move(asset_);
  }

 private:
  /// The new number of a part.
  int add(const std::string& list, int number) {
    const auto known = numbers_.find({list, number});
    if (known != numbers_.end()) return known->second;
    Json part = from_.json[list][static_cast<std::size_t>(number)];
    part.erase("extras");
    part.erase("name");
    if (list == "bufferViews") return keep(list, number, copied(part));
    if (list == "accessors") return keep(list, number, with_slice(std::move(part)));
    if (part.contains("bufferView")) part["bufferView"] = add("bufferViews", part["bufferView"].get<int>());
    if (list == "textures") {
      if (part.contains("source")) part["source"] = add("images", part["source"].get<int>());
      if (part.contains("sampler")) part["sampler"] = add("samplers", part["sampler"].get<int>());
    }
    // near models have no tangents, and relief of bark is not seen beyond some metres
    if (list == "materials" && form_ == world::AssetForm::near) part.erase("normalTexture");
    if (list == "materials") add_textures(part);
    return keep(list, number, std::move(part));
  }

  int keep(const std::string& list, int number, Json part) {
    Json& all = asset_.parts[list];
    all.push_back(std::move(part));
    return numbers_[{list, number}] = static_cast<int>(all.size()) - 1;
  }

  /// The accessor with a view of its own: views of a file may contain much more than one mesh needs.
  Json with_slice(Json accessor) {
    static const std::map<std::string, std::size_t> widths = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    static const std::map<int, std::size_t> sizes = {{5120, 1}, {5121, 1}, {5122, 2},
                                                     {5123, 2}, {5125, 4}, {5126, 4}};
    Json view = from_.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t element =
        widths.at(accessor["type"].get<std::string>()) * sizes.at(accessor["componentType"].get<int>());
    const std::size_t stride = view.value("byteStride", element),
                      count = accessor["count"].get<std::size_t>();
    view["byteOffset"] =
        view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    view["byteLength"] = stride * (count - 1) + element;
    view.erase("name");
    accessor.erase("byteOffset");
    Json& views = asset_.parts["bufferViews"];
    views.push_back(copied(std::move(view)));
    accessor["bufferView"] = views.size() - 1;
    return accessor;
  }

  Json copied(Json view) {
    asset_.file.resize((asset_.file.size() + 3) & ~std::size_t{3});
    const std::size_t at = asset_.file.size();
    asset_.file +=
        from_.bytes.substr(view.value("byteOffset", std::size_t{0}), view["byteLength"].get<std::size_t>());
    view["buffer"] = 0;
    view["byteOffset"] = at;
    return view;
  }

  void add_textures(Json& value) {
    if (value.is_array()) {
      for (Json& each : value) add_textures(each);
    }
    if (!value.is_object()) return;
    for (auto& [name, each] : value.items()) {
      if (name == "extensions") {
        for (const auto& [extension, content] : each.items()) use(extension);
      }
      if (name.ends_with("Texture") && each.contains("index"))
        each["index"] = add("textures", each["index"].get<int>());
      add_textures(each);
    }
  }

  void use(const std::string& extension) {
    Json& used = asset_.parts["extensionsUsed"];
    if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
  }

  void count(const Json& primitive) {
    const Json& positions = asset_.parts["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    const bool is_first = asset_.triangles == 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = positions["min"][k], high = positions["max"][k];
      asset_.low[k] = is_first ? low : std::min(asset_.low[k], low);
      asset_.high[k] = is_first ? high : std::max(asset_.high[k], high);
    }
    const Json& corners = primitive.contains("indices")
                              ? asset_.parts["accessors"][primitive["indices"].get<std::size_t>()]
                              : positions;
    asset_.triangles += corners["count"].get<std::uint64_t>() / 3;
  }

  const Glb& from_;
  const world::AssetForm form_;
  world::Asset asset_;
  std::map<std::pair<std::string, int>, int> numbers_;
};

/// The meshes that the scene shows: of the finest level, or of the coarsest.
void add_meshes(const Json& json, std::size_t number, world::AssetForm form, std::vector<int>& meshes) {
  const Json& node = json["nodes"][number];
  if (form == world::AssetForm::far && node.contains("extensions") &&
      node["extensions"].contains("MSFT_lod")) {
    const auto last = node["extensions"]["MSFT_lod"]["ids"].back().get<std::size_t>();
    return add_meshes(json, last, form, meshes);
  }
  if (node.contains("mesh")) meshes.push_back(node["mesh"].get<int>());
  for (const Json& child : node.value("children", Json::array()))
    add_meshes(json, child.get<std::size_t>(), form, meshes);
}

std::vector<int> meshes_of(const Json& json, world::AssetForm form) {
  std::vector<int> meshes;
  for (const Json& root : json["scenes"][0]["nodes"]) add_meshes(json, root.get<std::size_t>(), form, meshes);
  return meshes;
}

Json request_of(const Child& model, world::AssetForm form, std::uint64_t seed, int most_triangles) {
  Json output = {{"textures", texels}, {"provenance", "none"}, {"instancing", "merge"}};
  if (form == world::AssetForm::near) {
    if (most_triangles > 0) output["max_triangles"] = most_triangles;
    output["tangents"] = "none";
  } else {
    output["profile"] = "unity";
    output["impostor"] = true;
  }
  return {{"generator", model.generator},
          {"seed", std::to_string(model.seed.value_or(seed))},
          {"parameters", Json::parse(model.parameters)},
          {"output", std::move(output)}};
}

/// The model within the first budget that it can keep.
Result<Product> made(const Child& model, world::AssetForm form, std::uint64_t seed,
                     const Job::Options& options) {
  for (const int most : near_triangles) {
    const Result<Request> request = read_request_body(request_of(model, form, seed, most), options);
    if (!request) return request.error();
    Result<Product> product = produce(*request, options);
    const bool is_last = most == 0 || form == world::AssetForm::far;
    if (product || is_last || product.error().code != Code::limit) return product;
  }
  return Error{Code::limit, {}};
}

}  // namespace

world::MakeAsset asset_maker(const Job::Options& options) {
  return [options](const Child& model, world::AssetForm form, std::uint64_t seed, const std::string& pointer,
                   Job& job) -> world::Asset {
    Job::Options own = options;
    own.progress = nullptr;
    const Result<Product> product = made(model, form, seed, own);
    if (!product) {
      const Issue& first = product.error().issues.front();
      job.refuse({first.kind, pointer, "the model cannot be made: " + first.message});
    }
    const Glb glb = read_glb(product->payload.text());
    Extract extract(glb, form);
    for (const int mesh : meshes_of(glb.json, form)) extract.add_mesh(mesh);
    return std::move(extract).take();
  };
}

}  // namespace seedmesh

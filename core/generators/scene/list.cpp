#include "core/generators/scene/list.h"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "core/base/parallel.h"
#include "core/generators/scene/scene.h"
#include "core/geom/mesh/finish.h"
#include "core/geom/mesh/tangents.h"
#include "core/gltf/write/write.h"
#include "core/gltf/write/zip.h"
#include "core/schema/warning_list.h"
#include "core/schema/writer.h"
#include "core/texture/paint.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t placements_a_chunk = 8192;

std::array<float, 3> numbers(const glm::vec3& v) { return {v.x + 0.0F, v.y + 0.0F, v.z + 0.0F}; }
std::array<float, 4> numbers(const glm::quat& q) { return {q.x + 0.0F, q.y + 0.0F, q.z + 0.0F, q.w + 0.0F}; }

std::size_t count_of(const ScenePlacements& all_placements) {
  std::size_t count = 0;
  for (const Array<Placement>& layer : all_placements.layers) count += layer.size();
  return count;
}

Json layers_json(const SceneParams& params, const ScenePlacements& all_placements) {
  Json layers = Json::array();
  for (std::size_t i = 0; i < params.layers.size(); ++i) {
    layers.push_back({{"name", params.layers[i].name.value_or("layer_" + std::to_string(i))},
                      {"placed", all_placements.layers[i].size()}});
  }
  return layers;
}

void append(std::string& out, float number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number + 0.0F);
  out.append(digits.data(), end.ptr);
}

template <std::size_t size>
void append(std::string& out, std::string_view key, const std::array<float, size>& values) {
  out += key;
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0) out += ',';
    append(out, values[i]);
  }
  out += ']';
}

/// Writes one placement as one line.
void append(std::string& out, const std::string& model, const Transform& t) {
  out += "{\"model\":\"";
  out += model;  // a name has only letters, digits and _
  append(out, "\",\"translation\":[", numbers(t.translation));
  append(out, ",\"rotation\":[", numbers(t.rotation));
  append(out, ",\"scale\":[", numbers(t.scale));
  out += '}';
}

/// Returns the lines of all placements, in chunks that were written in parallel.
std::vector<std::string> lines_of(const SceneParams& params, const Ground& ground,
                                  const ScenePlacements& all_placements, const VariantTable& variant_table,
                                  Job& job) {
  struct Piece {
    std::size_t layer, begin, end;
  };
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < all_placements.layers.size(); ++i) {
    const std::size_t size = all_placements.layers[i].size();
    for (std::size_t begin = 0; begin < size; begin += placements_a_chunk)
      pieces.push_back({i, begin, std::min(begin + placements_a_chunk, size)});
  }
  std::vector<std::string> lines(pieces.size());
  parallel_for(job, pieces.size(), 1, [&](std::size_t first, std::size_t last, std::size_t) {
    for (std::size_t p = first; p < last; ++p) {
      const Piece& piece = pieces[p];
      std::string& out = lines[p];
      job.check();
      for (std::size_t i = piece.begin; i < piece.end; ++i) {
        const Placement& placement = all_placements.layers[piece.layer][i];
        out += p == 0 && i == 0 ? "\n" : ",\n";
        append(out, variant_table.variants[variant_table.variant_at(piece.layer, placement)].name,
               transform_of(placement, params.layers[piece.layer], ground));
      }
      out.shrink_to_fit();
      job.spend(Resource::output_bytes, out.size());
    }
  });
  return lines;
}

Payload file_of(Model model, const GenerateContext& context) {
  Job& job = context.job;
  texture::paint(model, context.demand.textures, {}, nullptr, job);
  if (context.demand.tangents) add_tangents(model, job);
  finish(model, job);
  return write(std::move(model), Container::glb, "Seedmesh", job);
}

}  // namespace

Json placements_json(const SceneParams& params, const Ground& ground, const ScenePlacements& all_placements,
                     const VariantTable& variant_table, const Job& job) {
  Json models = Json::object();
  for (const ModelVariant& variant : variant_table.variants)
    models[variant.name] = schema::write_child(variant.request);
  Json answer{{"models", std::move(models)},
              {"layers", layers_json(params, all_placements)},
              {"warnings", warning_list(all_placements.warnings)},
              {"placements", nullptr}};
  if (count_of(all_placements) > most_listed) return answer;
  Json rows = Json::array();
  for (std::size_t layer = 0; layer < all_placements.layers.size(); ++layer) {
    for (std::size_t i = 0; i < all_placements.layers[layer].size(); ++i) {
      if (i % 4096 == 0) job.check();
      const Placement& placement = all_placements.layers[layer][i];
      const Transform t = transform_of(placement, params.layers[layer], ground);
      rows.push_back({{"model", variant_table.variants[variant_table.variant_at(layer, placement)].name},
                      {"translation", numbers(t.translation)},
                      {"rotation", numbers(t.rotation)},
                      {"scale", numbers(t.scale)}});
    }
  }
  answer["placements"] = std::move(rows);
  return answer;
}

Result<Payload> placement_list(const SceneParams& params, const Ground& ground,
                               const ScenePlacements& all_placements, Forecast& forecast,
                               const GenerateContext& context) {
  Job& job = context.job;
  const VariantTable& variant_table = forecast.variant_table();
  std::vector<gltf::ZipEntry> entries;
  gltf::ZipEntry list{"placements.json", {}};
  Json models = Json::object();
  for (const ModelVariant& variant : variant_table.variants) {
    models[variant.name] = {{"file", "models/" + variant.name + ".glb"},
                            {"request", schema::write_child(variant.request)}};
  }
  list.payload.add("{\"models\":" + canonical_text(models) + ",\"layers\":" +
                   canonical_text(layers_json(params, all_placements)) + ",\n\"placements\":[");
  for (std::string& lines : lines_of(params, ground, all_placements, variant_table, job))
    if (!lines.empty()) list.payload.add(std::move(lines));
  list.payload.add("\n]}\n");
  entries.push_back(std::move(list));
  Result<std::vector<Model>> made = models_of(forecast, {}, context);
  if (!made) return std::move(made).error();
  for (std::size_t i = 0; i < variant_table.variants.size(); ++i) {
    entries.push_back(
        {"models/" + variant_table.variants[i].name + ".glb", file_of(std::move((*made)[i]), context)});
  }
  return gltf::zip(std::move(entries), job);
}

}  // namespace seedmesh::scene

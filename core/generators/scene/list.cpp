#include "core/generators/scene/list.h"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "core/base/parallel.h"
#include "core/generators/scene/scene.h"
#include "core/geom/finish.h"
#include "core/geom/tangents.h"
#include "core/gltf/write.h"
#include "core/gltf/zip.h"
#include "core/schema/writer.h"
#include "core/texture/paint.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t stands_a_chunk = 8192;

std::array<float, 3> numbers(const glm::vec3& v) { return {v.x + 0.0F, v.y + 0.0F, v.z + 0.0F}; }
std::array<float, 4> numbers(const glm::quat& q) { return {q.x + 0.0F, q.y + 0.0F, q.z + 0.0F, q.w + 0.0F}; }

std::size_t count_of(const Planting& planting) {
  std::size_t count = 0;
  for (const Array<Stand>& layer : planting.layers) count += layer.size();
  return count;
}

Json layers_told(const SceneParams& params, const Planting& planting) {
  Json layers = Json::array();
  for (std::size_t i = 0; i < params.layers.size(); ++i) {
    layers.push_back({{"name", params.layers[i].name.value_or("layer_" + std::to_string(i))},
                      {"placed", planting.layers[i].size()}});
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

/// One stand a line.
void append(std::string& out, const std::string& model, const Transform& t) {
  out += "{\"model\":\"";
  out += model;  // a name of letters, digits and _
  append(out, "\",\"translation\":[", numbers(t.translation));
  append(out, ",\"rotation\":[", numbers(t.rotation));
  append(out, ",\"scale\":[", numbers(t.scale));
  out += '}';
}

/// The lines of all stands, in pieces that were made side by side.
std::vector<std::string> lines_of(const SceneParams& params, const Ground& ground, const Planting& planting,
                                  const Casting& casting, Job& job) {
  struct Piece {
    std::size_t layer, begin, end;
  };
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < planting.layers.size(); ++i) {
    const std::size_t size = planting.layers[i].size();
    for (std::size_t begin = 0; begin < size; begin += stands_a_chunk)
      pieces.push_back({i, begin, std::min(begin + stands_a_chunk, size)});
  }
  std::vector<std::string> lines(pieces.size());
  parallel_for(job, pieces.size(), 1, [&](std::size_t first, std::size_t last, std::size_t) {
    for (std::size_t p = first; p < last; ++p) {
      const Piece& piece = pieces[p];
      std::string& out = lines[p];
      job.check();
      for (std::size_t i = piece.begin; i < piece.end; ++i) {
        const Stand& stand = planting.layers[piece.layer][i];
        out += p == 0 && i == 0 ? "\n" : ",\n";
        append(out, casting.casts[casting.cast_of(piece.layer, stand)].name,
               transform_of(stand, params.layers[piece.layer], ground));
      }
      out.shrink_to_fit();
      job.spend(Resource::output_bytes, out.size());
    }
  });
  return lines;
}

Payload file_of(Model model, Job& job) {
  texture::paint(model, job.demand().textures, nullptr, job);
  if (job.demand().tangents) add_tangents(model, job);
  finish(model, job);
  return write(std::move(model), Container::glb, "Seedmesh", job);
}

}  // namespace

Json told(const SceneParams& params, const Ground& ground, const Planting& planting, const Casting& casting,
          const Job& job) {
  Json models = Json::object();
  for (const Cast& cast : casting.casts) models[cast.name] = schema::write_child(cast.request);
  Json warnings = Json::array();
  for (const Warning& each : planting.warnings)
    warnings.push_back({{"pointer", "/parameters" + each.pointer}, {"message", each.message}});
  Json answer{{"models", std::move(models)},
              {"layers", layers_told(params, planting)},
              {"warnings", std::move(warnings)},
              {"placements", nullptr}};
  if (count_of(planting) > most_told) return answer;
  Json placements = Json::array();
  for (std::size_t layer = 0; layer < planting.layers.size(); ++layer) {
    for (std::size_t i = 0; i < planting.layers[layer].size(); ++i) {
      if (i % 4096 == 0) job.check();
      const Stand& stand = planting.layers[layer][i];
      const Transform t = transform_of(stand, params.layers[layer], ground);
      placements.push_back({{"model", casting.casts[casting.cast_of(layer, stand)].name},
                            {"translation", numbers(t.translation)},
                            {"rotation", numbers(t.rotation)},
                            {"scale", numbers(t.scale)}});
    }
  }
  answer["placements"] = std::move(placements);
  return answer;
}

Result<Payload> placement_list(const SceneParams& params, const Ground& ground, const Planting& planting,
                               Forecast& forecast, Job& job) {
  const Casting& casting = forecast.casting();
  std::vector<gltf::ZipEntry> entries;
  gltf::ZipEntry list{"placements.json", {}};
  Json models = Json::object();
  for (const Cast& cast : casting.casts)
    models[cast.name] = {{"file", "models/" + cast.name + ".glb"},
                         {"request", schema::write_child(cast.request)}};
  list.payload.add("{\"models\":" + canonical_text(models) +
                   ",\"layers\":" + canonical_text(layers_told(params, planting)) + ",\n\"placements\":[");
  for (std::string& lines : lines_of(params, ground, planting, casting, job))
    if (!lines.empty()) list.payload.add(std::move(lines));
  list.payload.add("\n]}\n");
  entries.push_back(std::move(list));
  Result<std::vector<Model>> made = models_of(forecast, {}, job);
  if (!made) return std::move(made).error();
  for (std::size_t i = 0; i < casting.casts.size(); ++i)
    entries.push_back({"models/" + casting.casts[i].name + ".glb", file_of(std::move((*made)[i]), job)});
  return gltf::zip(std::move(entries));
}

}  // namespace seedmesh::scene

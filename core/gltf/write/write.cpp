#include "core/gltf/write/write.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "core/gltf/bin.h"
#include "core/gltf/columns.h"
#include "core/gltf/compress/quantize.h"
#include "core/gltf/content_names.h"
#include "core/gltf/write/document.h"
#include "core/gltf/write/object_levels.h"
#include "core/gltf/write/zip.h"

namespace seedmesh {
namespace {

using gltf::Columns;
using gltf::Document;

constexpr std::uint32_t glb_magic = 0x46546C67, glb_version = 2;
constexpr std::uint32_t json_chunk = 0x4E4F534A, bin_chunk = 0x004E4942;

constexpr std::string_view data_address = ",\"uri\":\"data:application/octet-stream;base64,";

void append_word(std::string& out, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(word >> shift & 0xFFU);
}

/// The name in characters that every file system and URL takes.
std::string file_stem(std::string_view name) {
  std::string stem;
  for (const char c : name) {
    const bool safe = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    stem += safe ? c : '_';
  }
  return stem.empty() ? "model" : stem;
}

Payload write_glb(Document document, Job& job) {
  std::string& json = document.head;
  json += document.tail;
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::uint64_t bin_size = document.bin.size();
  const std::uint64_t size = 12 + 8 + json.size() + (bin_size > 0 ? 8 + bin_size : 0);
  gltf::refuse_beyond_4_gib(size, job);
  job.spend(Resource::output_bytes, bin_size);

  std::string header;
  for (const std::uint32_t word : {glb_magic, glb_version, static_cast<std::uint32_t>(size),
                                   static_cast<std::uint32_t>(json.size()), json_chunk}) {
    append_word(header, word);
  }
  Payload payload;
  payload.add(std::move(header));
  payload.add(std::move(json));
  if (bin_size > 0) {
    std::string chunk;
    append_word(chunk, static_cast<std::uint32_t>(bin_size));
    append_word(chunk, bin_chunk);
    payload.add(std::move(chunk));
    payload.append(gltf::raw(std::move(document.bin), job));
  }
  return payload;
}

Payload write_gltf(Document document, Job& job) {
  const std::uint64_t text_size = gltf::base64_size(document.bin.size());
  gltf::refuse_beyond_4_gib(document.head.size() + document.tail.size() + text_size, job);
  job.spend(Resource::output_bytes, text_size);
  Payload payload;
  payload.add(std::move(document.head));
  if (document.bin.size() > 0) {
    payload.add(std::string(data_address));
    payload.append(gltf::base64(std::move(document.bin), job));
    payload.add("\"");
  }
  payload.add(std::move(document.tail));
  return payload;
}

/// Adds stem.gltf and, unless nothing is stored, stem.bin.
void add_files(std::vector<gltf::ZipEntry>& files, const std::string& stem, Document document, Job& job) {
  job.spend(Resource::output_bytes, document.bin.size());
  Payload json;
  json.add(std::move(document.head));
  if (document.bin.size() > 0) json.add(",\"uri\":\"" + stem + ".bin\"");
  json.add(std::move(document.tail));
  files.push_back({stem + ".gltf", std::move(json)});
  if (document.bin.size() > 0) files.push_back({stem + ".bin", gltf::raw(std::move(document.bin), job)});
}

std::string extension_of(std::string_view mime) {
  return mime == "image/jpeg" ? ".jpg" : mime == "image/webp" ? ".webp" : ".png";
}

/// A file name for each image of the model by its number, unique, in the folder `textures`.
std::vector<std::string> image_files(const Model& model, const std::vector<std::string>& image_names) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  const std::size_t count = model.textures.size();
  for (std::size_t number = 0; number < 2 * count; ++number) {
    const auto& image = gltf::image_numbered(model, number);
    if (!image) {
      names.emplace_back();
      continue;
    }
    const std::string own = gltf::image_name(model, image_names, number);
    const std::string stem = "textures/" + (own.empty() ? "texture" : file_stem(own));
    const std::string extension = extension_of(image->mime);
    std::string name = stem + extension;
    for (int i = 2; !taken.insert(name).second; ++i) {
      name = stem;
      name += '_' + std::to_string(i) + extension;
    }
    names.push_back(std::move(name));
  }
  return names;
}

std::size_t lod_count(const Model& model) {
  std::size_t coarser = 0;
  for (const Node& node : model.nodes) coarser = std::max(coarser, node.lods.size());
  return 1 + coarser;
}

/// "bark_LOD0" becomes "bark_LOD1" where the next level is written to a file of its own.
void name_next_level(Model& model, std::size_t level) {
  const std::string before = "_LOD" + std::to_string(level - 1), after = "_LOD" + std::to_string(level);
  for (Node& node : model.nodes) {
    if (!node.lods.empty() && node.name.ends_with(before))
      node.name.replace(node.name.size() - before.size(), before.size(), after);
  }
}

Payload write_zip(Model& model, Columns& columns, gltf::DocumentOptions options, Job& job) {
  const std::string stem = file_stem(model.name);
  options.image_uris = image_files(model, options.image_names);
  options.dialect.lods_inside = false;
  std::vector<gltf::ZipEntry> files;
  std::set<std::size_t> images;
  const std::size_t lods = lod_count(model);
  for (; options.lod < lods; ++options.lod) {
    options.last = options.lod + 1 == lods;
    if (options.lod > 0) name_next_level(model, options.lod);
    Document document = gltf::describe(model, columns, options, job);
    images.insert(document.images.begin(), document.images.end());
    const std::string suffix = options.lod == 0 ? "" : "_LOD" + std::to_string(options.lod);
    add_files(files, stem + suffix, std::move(document), job);
  }
  for (const std::size_t used : images) {
    const std::shared_ptr<const Image>& image = gltf::image_numbered(model, used);
    job.spend(Resource::output_bytes, image->bytes.size());
    Payload payload;
    payload.add(image, std::as_bytes(std::span(image->bytes)));
    files.push_back({options.image_uris[used], std::move(payload)});
  }
  return gltf::zip(std::move(files), job);
}

/// Triangles and vertices as they are after quantizing.
void recount(const Model& model, const Columns& columns, ModelCounts& counts) {
  counts.triangles = counts.vertices = 0;
  for (const std::vector<gltf::Part>& parts : columns.meshes) {
    for (const gltf::Part& part : parts) counts.vertices += part.columns.front().count;
  }
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const std::uint64_t times = std::max<std::size_t>(1, node.instances.transforms.size());
    for (const gltf::Part& part : columns.meshes[static_cast<std::size_t>(node.mesh)]) {
      if (part.topology != Topology::triangles) continue;
      counts.triangles += times * (part.index ? part.index->count : part.columns.front().count) / 3;
    }
  }
}

}  // namespace

Payload write(Model model, const WriteOptions& options, Job& job) {
  const Dialect& dialect = options.dialect;
  const bool is_quantized = dialect.compressed || dialect.quantized;
  std::vector<std::size_t> parts;  // found before grids transform them
  if (dialect.lods_inside) parts = gltf::parts_of_object(model);
  std::vector<gltf::Grid> grids;
  if (is_quantized) {
    grids =
        gltf::apply_grids(model, {.least_extent = options.least_extent, .keeps_copies = !dialect.compressed});
  }
  Columns columns = gltf::take_columns(model);
  if (is_quantized) {
    gltf::quantize(columns, grids, job,
                   dialect.compressed ? gltf::Encoding::filtered : gltf::Encoding::plain);
    if (options.counts) recount(model, columns, *options.counts);
  }
  gltf::DocumentOptions described{.generator = options.generator,
                                  .scene_extras = options.scene_extras,
                                  .dialect = dialect,
                                  .parts = std::move(parts)};
  if (!options.image_stem.empty()) described.image_names = gltf::image_names(model, options.image_stem);
  if (options.container == Container::zip) return write_zip(model, columns, described, job);
  described.last = true;
  Document document = gltf::describe(model, columns, described, job);
  return options.container == Container::glb ? write_glb(std::move(document), job)
                                             : write_gltf(std::move(document), job);
}

Payload write(Model model, Container container, const std::string& generator, Job& job) {
  return write(std::move(model), {container, generator, {}}, job);
}

}  // namespace seedmesh

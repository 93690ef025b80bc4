/// Spec: Khronos, "glTF 2.0 Specification" (2021): GLB 4.
#include "core/gltf/read/file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/array.h"
#include "core/gltf/read/bytes.h"

namespace seedmesh::gltf {
namespace {

constexpr std::uint64_t parser_cost = 256;  ///< bytes of parsed structures for a byte of JSON, at most

/// The members that a mesh needs. All others are removed before the library reads them, so that it can neither open
/// files nor multiply buffers.
constexpr std::string_view kept_members[] = {"accessors", "asset", "bufferViews", "buffers", "materials",
                                             "meshes",    "nodes", "scene",       "scenes"};

void strip(nlohmann::json& node) {
  if (node.is_object()) {
    for (const char* member : {"extras", "extensions", "targets", "skin", "camera", "weights"})
      node.erase(member);
  }
  if (!node.is_structured()) return;
  for (nlohmann::json& part : node) strip(part);
}

bool has_entries(const nlohmann::json& json, const char* member) {
  const auto found = json.find(member);
  return found != json.end() && found->is_array() && !found->empty();
}

nlohmann::json needed(const nlohmann::json& json) {
  if (!json.is_object()) throw Unreadable{"its JSON is not an object"};
  if (has_entries(json, "extensionsRequired")) {
    throw Unreadable{"it requires the extension " + json["extensionsRequired"][0].dump() +
                     ", which is not supported"};
  }
  nlohmann::json kept = nlohmann::json::object();
  for (const std::string_view member : kept_members) {
    const auto found = json.find(member);
    if (found != json.end()) kept[std::string(member)] = *found;
  }
  strip(kept);
  const auto buffers = kept.find("buffers");
  if (buffers != kept.end()) {
    if (!buffers->is_array() || buffers->size() != 1 || !(*buffers)[0].is_object() ||
        (*buffers)[0].contains("uri")) {
      throw Unreadable{"expected all data in one buffer inside the GLB"};
    }
  }
  if (has_entries(kept, "materials")) {
    for (nlohmann::json& material : kept["materials"]) {
      if (!material.is_object()) continue;
      for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        material.erase(texture);
      const auto surface = material.find("pbrMetallicRoughness");
      if (surface == material.end() || !surface->is_object()) continue;
      for (const char* texture : {"baseColorTexture", "metallicRoughnessTexture"}) surface->erase(texture);
    }
  }
  return kept;
}

std::vector<std::string> unused_parts(const nlohmann::json& json) {
  std::vector<std::string> names;
  for (const char* member : {"images", "skins", "animations", "cameras"}) {
    if (has_entries(json, member)) names.emplace_back(member);
  }
  return names;
}

void append_word(Array<std::byte>& out, std::uint64_t word) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::byte>(word >> shift & 0xFFU));
}

/// The same GLB with only the JSON that is needed.
Array<std::byte> rebuilt(const nlohmann::json& json, std::span<const std::byte> rest, const Job& job) {
  std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  text.append((4 - text.size() % 4) % 4, ' ');
  Array<std::byte> glb(job);
  glb.reserve(20 + text.size() + rest.size());
  for (const std::uint64_t word :
       {std::uint64_t{0x46546C67}, std::uint64_t{2}, std::uint64_t{20} + text.size() + rest.size(),
        std::uint64_t{text.size()}, std::uint64_t{0x4E4F534A}}) {
    append_word(glb, word);
  }
  glb.append(std::as_bytes(std::span(text)));
  glb.append(rest);
  return glb;
}

// NOLINTNEXTLINE(readability-function-size): the type of the callback
bool refuse_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                  void*) {
  return false;
}

/// No file of the disk may be read. Later versions of the library query a file's size, too.
template <class Callbacks>
Callbacks without_files() {
  Callbacks callbacks = {};
  callbacks.FileExists = [](const std::string&, void*) { return false; };
  callbacks.ExpandFilePath = [](const std::string&, void*) { return std::string(); };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) {
    return false;
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](std::size_t*, std::string*, const std::string&, void*) {
      return false;
    };
  }
  return callbacks;
}

tinygltf::Model model_in(std::span<const std::byte> glb) {
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(refuse_image, nullptr);
  parser.SetFsCallbacks(without_files<tinygltf::FsCallbacks>());
  tinygltf::Model model;
  std::string error, warning;
  bool read = false;
  try {
    read = parser.LoadBinaryFromMemory(&model, &error, &warning,
                                       reinterpret_cast<const unsigned char*>(glb.data()),
                                       static_cast<unsigned>(glb.size()));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  if (read) return model;
  const std::size_t end = error.find('\n');
  throw Unreadable{"it is not valid glTF: " + error.substr(0, std::min(end, std::size_t{200}))};
}

}  // namespace

std::uint64_t parsing_cost(std::span<const std::byte> glb, std::string_view json) {
  return parser_cost * json.size() + 2 * glb.size();
}

ReadFile parsed(std::span<const std::byte> glb, std::string_view text, const Job& job) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) throw Unreadable{"its JSON cannot be read"};
  const Array<std::byte> needed_glb = rebuilt(needed(json), glb.subspan(20 + text.size()), job);
  return {model_in(needed_glb.span()), unused_parts(json)};
}

}  // namespace seedmesh::gltf

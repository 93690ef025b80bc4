#include "core/gltf/read/bytes.h"

#include "core/base/base64.h"

namespace seedmesh::gltf {
namespace {

constexpr std::uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A;
constexpr std::size_t most_json = std::size_t{1} << 20U;
constexpr int deepest_json = 32;

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8U | std::to_integer<std::uint32_t>(bytes[offset + i]);
  return word;
}

/// Brackets outside of texts; no library of ours recurses deeper.
void check_depth(std::string_view json) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest_json)
        throw Unreadable{"its JSON is nested deeper than " + std::to_string(deepest_json) + " levels"};
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

}  // namespace

Array<std::byte> bytes_of_base64(std::string_view text, const Job& job) {
  const std::string_view digits = without_padding(text);
  if (digits.size() % 4 == 1) throw Unreadable{"its base64 text is truncated"};
  Array<std::byte> bytes(job, base64_bytes(digits.size()));
  const Base64End end = read_base64(digits, reinterpret_cast<std::uint8_t*>(bytes.data()));
  if (end.bad != std::string_view::npos) {
    throw Unreadable{"character " + std::to_string(end.bad + 1) +
                     " of its base64 text is not a base64 digit"};
  }
  return bytes;
}

std::string_view checked_json(std::span<const std::byte> glb) {
  if (glb.size() < 20 || word_at(glb, 0) != glb_magic) throw Unreadable{"found no GLB (glTF binary)"};
  if (const std::uint32_t version = word_at(glb, 4); version != 2)
    throw Unreadable{"found glTF version " + std::to_string(version) + ", expected 2"};
  if (word_at(glb, 8) != glb.size()) {
    throw Unreadable{"its header states " + std::to_string(word_at(glb, 8)) + " bytes, but there are " +
                     std::to_string(glb.size())};
  }
  const std::size_t size = word_at(glb, 12);
  if (word_at(glb, 16) != json_chunk) throw Unreadable{"its first chunk is not JSON"};
  if (size > glb.size() - 20) throw Unreadable{"its JSON chunk is truncated"};
  if (size > most_json) {
    throw Unreadable{"its JSON has " + std::to_string(size) + " bytes, expected at most " +
                     std::to_string(most_json)};
  }
  const std::string_view json(reinterpret_cast<const char*>(glb.data()) + 20, size);
  check_depth(json);
  return json;
}

}  // namespace seedmesh::gltf

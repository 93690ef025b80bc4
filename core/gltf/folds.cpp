#include "core/gltf/folds.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/gltf/mend.h"

namespace seedmesh::gltf {
namespace {

constexpr std::size_t look_every = 65'536;

bool is_flat(const Column& position, const std::uint32_t* corners) {
  glm::i64vec3 p[3];
  for (std::size_t c = 0; c < 3; ++c) p[c] = glm::i64vec3(load<glm::u16vec4>(position.slice, corners[c]));
  const glm::i64vec3 a = p[1] - p[0], b = p[2] - p[0];
  return glm::i64vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x) == glm::i64vec3(0);
}

/// A position in one word.
std::uint64_t word_of(const Column& position, std::uint32_t vertex) {
  const auto p = load<glm::u16vec4>(position.slice, vertex);
  return std::uint64_t{p.x} << 32U | std::uint64_t{p.y} << 16U | p.z;
}

/// A triangle by where its corners lie.
struct Face {
  std::array<std::uint64_t, 3> at;  ///< rising
  std::size_t triangle;
  bool turned;
};

Face face_of(const Column& position, const Array<std::uint32_t>& corners, std::size_t triangle) {
  Face face{{}, triangle, false};
  for (std::size_t c = 0; c < 3; ++c) face.at[c] = word_of(position, corners[3 * triangle + c]);
  std::rotate(face.at.begin(), std::min_element(face.at.begin(), face.at.end()), face.at.end());
  face.turned = !std::is_sorted(face.at.begin(), face.at.end());
  std::sort(face.at.begin(), face.at.end());
  return face;
}

/// 32 bits that equal triangles agree in, and hardly any others.
std::uint64_t hash_of(const Face& face) {
  std::uint64_t hash = 0;
  for (const std::uint64_t each : face.at) {
    hash = (hash ^ each) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  }
  return hash >> 32U;
}

/// Marks those of equal triangles that go.
void mark_folds(std::vector<Face>& faces, std::vector<bool>& goes) {
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.at != b.at ? a.at < b.at : a.triangle < b.triangle;
  });
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i, turned = 0;
    for (; end < faces.size() && faces[end].at == faces[i].at; ++end) turned += faces[end].turned ? 1 : 0;
    const std::size_t straight = end - i - turned;
    // One stays where the sides differ in number, of the side that has more.
    bool kept = straight == turned;
    for (; i < end; ++i) {
      const bool stays = !kept && faces[i].turned == (turned > straight);
      kept = kept || stays;
      goes[faces[i].triangle] = !stays;
    }
  }
}

}  // namespace

bool any_flat(const Column& position, std::span<const std::uint32_t> corners) {
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    if (is_flat(position, corners.data() + t)) return true;
  }
  return false;
}

void drop_flat(const Column& position, Array<std::uint32_t>& corners) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    if (is_flat(position, corners.data() + t)) continue;
    for (std::size_t c = 0; c < 3; ++c) corners[kept++] = corners[t + c];
  }
  corners.resize(kept);
}

void drop_folds(const Column& position, Array<std::uint32_t>& corners, Job& job) {
  const std::size_t triangles = corners.size() / 3;
  Array<std::uint64_t> hashes(job, triangles);  // the hash above, the triangle below
  for (std::size_t t = 0; t < triangles; ++t) {
    if (t % look_every == 0) job.check();
    hashes[t] = hash_of(face_of(position, corners, t)) << 32U | t;
  }
  std::sort(hashes.begin(), hashes.end());
  std::vector<bool> goes(triangles, false);
  std::vector<Face> alike;
  for (std::size_t i = 0; i < triangles;) {
    std::size_t end = i + 1;
    while (end < triangles && hashes[end] >> 32U == hashes[i] >> 32U) ++end;
    alike.clear();
    for (std::size_t k = i; end - i > 1 && k < end; ++k)
      alike.push_back(face_of(position, corners, hashes[k] & 0xFFFFFFFFU));
    mark_folds(alike, goes);
    i = end;
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles; ++t) {
    if (goes[t]) continue;
    for (std::size_t c = 0; c < 3; ++c) corners[kept++] = corners[3 * t + c];
  }
  corners.resize(kept);
}

}  // namespace seedmesh::gltf

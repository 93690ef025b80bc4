#include "core/gltf/compress/flat_triangles.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/gltf/compress/vertex_data.h"

namespace seedmesh::gltf {
namespace {

glm::ivec3 point_at(const Column& position, std::uint32_t vertex) {
  return glm::ivec3(load<glm::u16vec4>(position.slice, vertex));
}

bool is_flat(const Column& position, const std::uint32_t* corners) {
  return gltf::is_flat(point_at(position, corners[0]), point_at(position, corners[1]),
                       point_at(position, corners[2]));
}

/// A triangle by the positions of its corners.
struct Face {
  std::array<std::uint64_t, 3> at;  ///< ascending
  std::size_t triangle;
  bool turned;  ///< ascending order reverses its winding
};

Face face_of(const Column& position, const Array<std::uint32_t>& corners, std::size_t triangle) {
  Face face{{}, triangle, false};
  for (std::size_t c = 0; c < 3; ++c) face.at[c] = word_of(point_at(position, corners[3 * triangle + c]));
  std::rotate(face.at.begin(), std::min_element(face.at.begin(), face.at.end()), face.at.end());
  face.turned = !std::is_sorted(face.at.begin(), face.at.end());
  std::sort(face.at.begin(), face.at.end());
  return face;
}

/// 32 bits, equal for equal triangles.
std::uint64_t hash_of(const Face& face) {
  std::uint64_t hash = 0;
  for (const std::uint64_t each : face.at) {
    hash = (hash ^ each) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  }
  return hash >> 32U;
}

/// Marks which of equal triangles are dropped.
void mark_doubled(std::vector<Face>& faces, std::vector<bool>& dropped) {
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.at != b.at ? a.at < b.at : a.triangle < b.triangle;
  });
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i, turned = 0;
    for (; end < faces.size() && faces[end].at == faces[i].at; ++end) turned += faces[end].turned ? 1 : 0;
    const std::size_t straight = end - i - turned;
    // One stays where the windings differ in number: one of the more frequent winding.
    bool kept = straight == turned;
    for (; i < end; ++i) {
      const bool stays = !kept && faces[i].turned == (turned > straight);
      kept = kept || stays;
      dropped[faces[i].triangle] = !stays;
    }
  }
}

}  // namespace

bool has_flat_triangle(const Column& position, std::span<const std::uint32_t> corners) {
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    if (is_flat(position, corners.data() + t)) return true;
  }
  return false;
}

void drop_flat_triangles(const Column& position, Array<std::uint32_t>& corners) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    if (is_flat(position, corners.data() + t)) continue;
    for (std::size_t c = 0; c < 3; ++c) corners[kept++] = corners[t + c];
  }
  corners.resize(kept);
}

void drop_doubled_triangles(const Column& position, Array<std::uint32_t>& corners, Job& job) {
  const std::size_t triangles = corners.size() / 3;
  Array<std::uint64_t> hashes(job, triangles);  // upper half: hash; lower half: triangle
  for (std::size_t t = 0; t < triangles; ++t) {
    if (t % check_interval == 0) job.check();
    hashes[t] = hash_of(face_of(position, corners, t)) << 32U | t;
  }
  std::size_t steps = 0;
  std::sort(hashes.begin(), hashes.end(), [&](std::uint64_t a, std::uint64_t b) {
    if (++steps % check_interval == 0) job.check();
    return a < b;
  });
  std::vector<bool> dropped(triangles, false);
  std::vector<Face> alike;
  for (std::size_t i = 0; i < triangles;) {
    if (++steps % check_interval == 0) job.check();
    std::size_t end = i + 1;
    while (end < triangles && hashes[end] >> 32U == hashes[i] >> 32U) ++end;
    alike.clear();
    for (std::size_t k = i; end - i > 1 && k < end; ++k)
      alike.push_back(face_of(position, corners, hashes[k] & 0xFFFFFFFFU));
    mark_doubled(alike, dropped);
    i = end;
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles; ++t) {
    if (dropped[t]) continue;
    for (std::size_t c = 0; c < 3; ++c) corners[kept++] = corners[3 * t + c];
  }
  corners.resize(kept);
}

}  // namespace seedmesh::gltf

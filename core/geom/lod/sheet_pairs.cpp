#include "core/geom/lod/sheet_pairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/base/disjoint_sets.h"
#include "core/base/math.h"
#include "core/geom/mesh/point_grid.h"

namespace seedmesh {
namespace {

constexpr std::size_t check_interval = 4096;
// Stalks of one leaf in two levels are at most this apart, as a share of its length. Levels that are thinned out scale
// leaves about a vertex instead of the stalk.
constexpr float reach = 0.6F;
// The greatest difference of frames: the distance of the stalks by the length, and 1 - cos of the angle of each axis.
constexpr float most_different = 0.8F;

struct Pair {
  float difference;
  std::uint32_t fine, coarse;
};

float difference(const Sheets::Frame& a, const Sheets::Frame& b) {
  return glm::length(a.stalk - b.stalk) / std::max(b.length, 1e-9F) + 3 - glm::dot(a.along, b.along) -
         glm::dot(a.across, b.across) - glm::dot(a.face, b.face);
}

std::vector<Sheets::Frame> frames_of(const Sheets& sheets, const Job& job) {
  std::vector<Sheets::Frame> frames(sheets.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i % check_interval == 0) job.check();
    frames[i] = sheets.frame(i);
  }
  return frames;
}

/// The numbers of stalks by the cells of a grid.
class StalkGrid {
 public:
  explicit StalkGrid(const std::vector<Sheets::Frame>& frames) : grid_(box_of(frames), mean_length(frames)) {
    for (std::size_t i = 0; i < frames.size(); ++i)
      cells_.emplace_back(grid_.key(frames[i].stalk), static_cast<std::uint32_t>(i));
    std::sort(cells_.begin(), cells_.end());
  }

  template <class Visit>
  void each_near(const glm::vec3& point, float distance, const Visit& visit) const {
    grid_.each_near(point, distance, [&](std::uint64_t key) {
      for (auto at = std::lower_bound(cells_.begin(), cells_.end(), std::pair(key, 0U));
           at != cells_.end() && at->first == key; ++at)
        visit(at->second);
    });
  }

 private:
  static Box box_of(const std::vector<Sheets::Frame>& frames) {
    Box box{frames.front().stalk, frames.front().stalk};
    for (const Sheets::Frame& each : frames)
      box = {glm::min(box.min, each.stalk), glm::max(box.max, each.stalk)};
    return box;
  }
  static float mean_length(const std::vector<Sheets::Frame>& frames) {
    constexpr float least_share = 1e-5F;  // of the box: a grid has at most 2^20 cells along an axis
    const Box box = box_of(frames);
    float sum = 0;
    for (const Sheets::Frame& each : frames) sum += each.length;
    return std::max(
        {sum / static_cast<float>(frames.size()), least_share * glm::distance(box.min, box.max), 1e-9F});
  }

  PointGrid grid_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> cells_;
};

}  // namespace

Sheets::Sheets(const Mesh& mesh, const Job& job) : mesh_(mesh) {
  const std::size_t triangles = mesh.index.size() / 3;
  DisjointSets sets(mesh.position.size());
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    if (i % check_interval == 0) job.check();
    sets.join(mesh.index.at(i / 3 * 3), mesh.index.at(i));
  }
  std::vector<std::uint32_t> key(triangles);
  for (std::size_t t = 0; t < triangles; ++t) key[t] = sets.of(mesh.index.at(3 * t));
  triangle_.resize(triangles);
  std::iota(triangle_.begin(), triangle_.end(), 0U);
  std::sort(triangle_.begin(), triangle_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::tuple(key[a], a) < std::tuple(key[b], b); });
  for (std::size_t i = 0; i < triangles; ++i) {
    if (i == 0 || key[triangle_[i]] != key[triangle_[i - 1]]) begin_.push_back(static_cast<std::uint32_t>(i));
  }
  begin_.push_back(static_cast<std::uint32_t>(triangles));
}

glm::vec3 Sheets::at(std::size_t sheet, const glm::vec2& uv) const {
  glm::dvec3 best(1, 0, 0);
  std::uint32_t in = triangles(sheet).front();
  double inside = -1e30;
  const auto corner = [this](std::uint32_t t, std::size_t k) {
    return mesh_.index.at(3 * std::size_t{t} + k);
  };
  for (const std::uint32_t t : triangles(sheet)) {
    const glm::dvec2 a(mesh_.uv[0][corner(t, 0)]), b = glm::dvec2(mesh_.uv[0][corner(t, 1)]) - a,
                                                   c = glm::dvec2(mesh_.uv[0][corner(t, 2)]) - a,
                                                   p = glm::dvec2(uv) - a;
    const double area = b.x * c.y - b.y * c.x;
    if (std::abs(area) < 1e-9) continue;
    const double second = (p.x * c.y - p.y * c.x) / area, third = (b.x * p.y - b.y * p.x) / area;
    const glm::dvec3 weights(1 - second - third, second, third);
    const double least = std::min({weights.x, weights.y, weights.z});
    if (least <= inside) continue;
    inside = least;
    best = weights;
    in = t;
  }
  glm::dvec3 point(0);
  for (int k = 0; k < 3; ++k)
    point += best[k] * glm::dvec3(mesh_.position[corner(in, static_cast<std::size_t>(k))]);
  return glm::vec3(point) + 0.0F;
}

Sheets::Frame Sheets::frame(std::size_t sheet) const {
  const auto unit = [](const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0 ? v / length : glm::vec3(0);
  };
  Frame frame;
  frame.stalk = at(sheet, {0.5F, 1});
  const glm::vec3 along = at(sheet, {0.5F, 0}) - frame.stalk;
  frame.length = glm::length(along);
  frame.along = unit(along);
  frame.across = unit(at(sheet, {1, 0.5F}) - at(sheet, {0, 0.5F}));
  glm::vec3 sum(0);
  for (const std::uint32_t t : triangles(sheet)) {
    const std::size_t first = 3 * std::size_t{t};
    const glm::vec3& a = mesh_.position[mesh_.index.at(first)];
    sum += glm::cross(mesh_.position[mesh_.index.at(first + 1)] - a,
                      mesh_.position[mesh_.index.at(first + 2)] - a);
  }
  frame.face = unit(sum);
  return frame;
}

std::vector<std::uint32_t> paired_sheets(const Sheets& fine, const Sheets& coarse, const Job& job) {
  const auto none = static_cast<std::uint32_t>(coarse.size());
  std::vector<std::uint32_t> pair_of(fine.size(), none);
  if (fine.size() == 0 || coarse.size() == 0) return pair_of;
  const std::vector<Sheets::Frame> of_fine = frames_of(fine, job), of_coarse = frames_of(coarse, job);
  const StalkGrid grid(of_fine);
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < of_coarse.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const Sheets::Frame& own = of_coarse[i];
    grid.each_near(own.stalk, reach * own.length, [&](std::uint32_t k) {
      const float by = difference(of_fine[k], own);
      if (by <= most_different) pairs.push_back({by, k, i});
    });
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.difference, a.coarse, a.fine) < std::tie(b.difference, b.coarse, b.fine);
  });
  std::vector<bool> used(coarse.size(), false);
  for (const Pair& each : pairs) {
    if (pair_of[each.fine] != none || used[each.coarse]) continue;
    pair_of[each.fine] = each.coarse;
    used[each.coarse] = true;
  }
  return pair_of;
}

}  // namespace seedmesh

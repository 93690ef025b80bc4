#include "core/gltf/compress/merged_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/gltf/compress/vertex_data.h"

namespace seedmesh::gltf {
namespace {

// A move may pinch or flatten other triangles.
constexpr int rounds = 6;

using Word = std::uint64_t;  ///< a point of the grid

glm::ivec3 point_of(Word word) {
  return {static_cast<int>(word >> 32U & 0xFFFFU), static_cast<int>(word >> 16U & 0xFFFFU),
          static_cast<int>(word & 0xFFFFU)};
}

using Exact = std::tuple<float, float, float>;

/// A vertex at a point that several vertices share.
struct Occupant {
  Word at = 0;
  Exact exact;
  std::uint32_t vertex = 0;
};

using Points = std::span<const glm::u16vec4>;

/// Vertices by their grid points; open addressing.
class PointTable {
 public:
  PointTable(std::size_t vertices, Job& job)
      : slot_(job, std::bit_ceil(2 * vertices + 1), none), mask_(slot_.size() - 1) {}

  /// Inserts a vertex; returns the first vertex at its point.
  std::uint32_t insert(Points points, std::uint32_t vertex) {
    std::uint32_t& there = slot_[find(points, word_of(glm::ivec3(points[vertex])))];
    if (there == none) there = vertex;
    return there;
  }
  bool has(Points points, Word at) const { return slot_[find(points, at)] != none; }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  std::size_t find(Points points, Word at) const {
    std::size_t i = (at * 0x9E3779B97F4A7C15U >> 20U) & mask_;
    while (slot_[i] != none && word_of(glm::ivec3(points[slot_[i]])) != at) i = (i + 1) & mask_;
    return i;
  }
  Array<std::uint32_t> slot_;
  std::size_t mask_;
};

class Separation {
 public:
  Separation(Part& part, const Slice& exact, Job& job)
      : position_(part.columns.front()),
        index_(*part.index),
        exact_(exact),
        job_(job),
        point_(reinterpret_cast<const glm::u16vec4*>(position_.slice.bytes.data()), position_.count),
        moved_(job) {}

  /// False where an edge with more than two faces remains.
  bool run() {
    bool is_pinched = false;
    for (int round = 0; round <= rounds; ++round) {
      PointTable table(point_.size(), job_);
      table_ = &table;
      find_merged();
      const std::vector<Word> pinched = merged_.empty() ? std::vector<Word>() : find_pinched();
      is_pinched = !pinched.empty();
      if (round == rounds) break;
      bool moves = false;
      for (const Word at : pinched) moves = part_from(at) || moves;
      if (!moves) moves = lift_flat();
      if (!moves) break;
    }
    if (!moved_.empty()) position_.slice = keep(std::move(moved_));
    return !is_pinched;
  }

 private:
  std::uint32_t corner(std::size_t i) const { return corner_at(index_, i); }
  Word word(std::uint32_t vertex) const { return word_of(glm::ivec3(point_[vertex])); }
  /// Copies the points before the first move.
  void move(std::uint32_t vertex, Word to) {
    if (moved_.empty()) moved_.append(point_);
    point_ = moved_.span();
    moved_[vertex] = glm::u16vec4(point_of(to), 0);
  }
  Exact exact(std::uint32_t vertex) const {
    const auto p = load<glm::vec3>(exact_, vertex);
    return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
  }

  /// Finds points with several different exact positions, and the vertices there.
  void find_merged() {
    occupants_.clear();
    merged_.clear();
    taken_.clear();
    for (std::uint32_t vertex = 0; vertex < point_.size(); ++vertex) {
      if (vertex % check_interval == 0) job_.check();
      const std::uint32_t first = table_->insert(point_, vertex);
      if (first != vertex && exact(first) != exact(vertex)) merged_.push_back(word(vertex));
    }
    if (merged_.empty()) return;
    std::sort(merged_.begin(), merged_.end());
    merged_.erase(std::unique(merged_.begin(), merged_.end()), merged_.end());
    for (std::uint32_t vertex = 0; vertex < point_.size(); ++vertex) {
      if (vertex % check_interval == 0) job_.check();
      if (is_merged(word(vertex))) occupants_.push_back({word(vertex), exact(vertex), vertex});
    }
    std::size_t steps = 0;
    std::sort(occupants_.begin(), occupants_.end(), [&](const Occupant& a, const Occupant& b) {
      if (++steps % check_interval == 0) job_.check();
      return std::tie(a.at, a.exact, a.vertex) < std::tie(b.at, b.exact, b.vertex);
    });
  }
  bool is_merged(Word at) const { return std::binary_search(merged_.begin(), merged_.end(), at); }

  /// Merged points at edges that more than two faces share, flat triangles left out.
  std::vector<Word> find_pinched() {
    struct Face {
      std::array<Word, 3> at, sorted;
      bool turned = false;
    };
    std::vector<Face> faces;
    for (std::size_t i = 0; i + 2 < index_.count; i += 3) {
      if (i % check_interval == 0) job_.check();
      Face face;
      for (std::size_t k = 0; k < 3; ++k) face.at[k] = word(corner(i + k));
      if (!is_merged(face.at[0]) && !is_merged(face.at[1]) && !is_merged(face.at[2])) continue;
      if (is_flat(point_of(face.at[0]), point_of(face.at[1]), point_of(face.at[2]))) continue;
      face.sorted = face.at;
      std::rotate(face.sorted.begin(), std::min_element(face.sorted.begin(), face.sorted.end()),
                  face.sorted.end());
      face.turned = face.sorted[1] > face.sorted[2];
      std::sort(face.sorted.begin(), face.sorted.end());
      faces.push_back(face);
    }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
    std::vector<std::pair<Word, Word>> edges;
    for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
      std::size_t turned = 0;
      for (end = i; end < faces.size() && faces[end].sorted == faces[i].sorted; ++end)
        turned += faces[end].turned ? 1 : 0;
      if (2 * turned == end - i) continue;  // two coincident sides, which are dropped
      for (std::size_t k = 0; k < 3; ++k) {
        const Word a = faces[i].at[k], b = faces[i].at[(k + 1) % 3];
        if (is_merged(a) || is_merged(b)) edges.emplace_back(std::min(a, b), std::max(a, b));
      }
    }
    job_.check();
    std::sort(edges.begin(), edges.end());
    job_.check();
    std::vector<Word> pinched;
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
      for (end = i; end < edges.size() && edges[end] == edges[i];) ++end;
      if (end - i <= 2) continue;
      for (const Word at : {edges[i].first, edges[i].second}) {
        if (is_merged(at)) pinched.push_back(at);
      }
    }
    std::sort(pinched.begin(), pinched.end());
    pinched.erase(std::unique(pinched.begin(), pinched.end()), pinched.end());
    return pinched;
  }

  bool is_free(Word at) const { return !table_->has(point_, at) && !taken_.contains(at); }

  /// The free neighbour of `at` that is nearest to `wanted` (in steps); `at` where none is free.
  Word nearest_free(Word at, const glm::dvec3& wanted) const {
    Word best = at;
    double least = 1e30;
    const glm::ivec3 middle = point_of(at);
    for (int i = 0; i < 27; ++i) {
      const glm::ivec3 p = middle + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (std::min({p.x, p.y, p.z}) < 0 || std::max({p.x, p.y, p.z}) > 65'535) continue;
      const glm::dvec3 off = glm::dvec3(p) - wanted;
      const double far = glm::dot(off, off);
      if (far >= least || !is_free(word_of(p))) continue;
      least = far;
      best = word_of(p);
    }
    return best;
  }

  /// Moves all vertices at a point except those of the first exact position.
  bool part_from(Word at) {
    auto occupant = std::lower_bound(occupants_.begin(), occupants_.end(), at,
                                     [](const Occupant& a, Word b) { return a.at < b; });
    const Exact first = occupant->exact;
    const glm::dvec3 stays(std::get<0>(first), std::get<1>(first), std::get<2>(first));
    bool has_moved = false;
    while (occupant != occupants_.end() && occupant->at == at) {
      const Exact own = occupant->exact;
      Word to = at;
      if (own != first) {
        // Away from the position that stays: both are within a step of the point.
        glm::dvec3 away = glm::dvec3(std::get<0>(own), std::get<1>(own), std::get<2>(own)) - stays;
        const double length = std::sqrt(glm::dot(away, away));
        away = length > 0 ? away / length : glm::dvec3(1, 0, 0);
        to = nearest_free(at, glm::dvec3(point_of(at)) + away);
        taken_.insert(to);
      }
      for (; occupant != occupants_.end() && occupant->at == at && occupant->exact == own; ++occupant) {
        if (to == at) continue;
        move(occupant->vertex, to);
        has_moved = true;
      }
    }
    return has_moved;
  }

  struct Corners {
    Word at[3];
    bool is_flat() const { return gltf::is_flat(point_of(at[0]), point_of(at[1]), point_of(at[2])); }
    bool has_twice() const { return at[0] == at[1] || at[1] == at[2] || at[2] == at[0]; }
  };
  Corners corners_of(std::size_t first) const {
    return {{word(corner(first)), word(corner(first + 1)), word(corner(first + 2))}};
  }

  /// Moves one corner of each triangle whose three different corners lie on a line: its removal would leave a
  /// hole.
  bool lift_flat() {
    std::vector<Word> touched;
    std::vector<std::size_t> flat;
    for (std::size_t i = 0; i + 2 < index_.count; i += 3) {
      if (i % check_interval == 0) job_.check();
      const Corners corners = corners_of(i);
      if (corners.has_twice() || !corners.is_flat()) continue;
      flat.push_back(i);
      touched.insert(touched.end(), corners.at, corners.at + 3);
    }
    if (flat.empty()) return false;
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    std::vector<std::pair<Word, std::size_t>> around;  // triangles of each point
    for (std::size_t i = 0; i + 2 < index_.count; i += 3) {
      if (i % check_interval == 0) job_.check();
      for (const Word at : corners_of(i).at) {
        if (std::binary_search(touched.begin(), touched.end(), at)) around.emplace_back(at, i);
      }
    }
    std::sort(around.begin(), around.end());
    std::vector<std::pair<Word, Word>> moves;
    std::set<Word> busy;  // points of triangles that this round has changed
    for (const std::size_t triangle : flat) lift(corners_of(triangle), around, busy, moves);
    if (moves.empty()) return false;
    std::sort(moves.begin(), moves.end());
    for (std::uint32_t vertex = 0; vertex < point_.size(); ++vertex) {
      const auto move = std::lower_bound(moves.begin(), moves.end(), std::pair(word(vertex), Word{0}));
      if (move != moves.end() && move->first == word(vertex)) this->move(vertex, move->second);
    }
    return true;
  }

  void lift(const Corners& line, const std::vector<std::pair<Word, std::size_t>>& around,
            std::set<Word>& busy, std::vector<std::pair<Word, Word>>& moves) {
    if (std::any_of(line.at, line.at + 3, [&](Word at) { return busy.contains(at); })) return;
    for (const Word at : line.at) {
      const auto first = std::lower_bound(around.begin(), around.end(), std::pair(at, std::size_t{0}));
      for (int i = 0; i < 27; ++i) {
        const glm::ivec3 p = point_of(at) + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (std::min({p.x, p.y, p.z}) < 0 || std::max({p.x, p.y, p.z}) > 65'535) continue;
        const Word to = word_of(p);
        if (!is_free(to)) continue;
        bool fits = true;
        for (auto each = first; fits && each != around.end() && each->first == at; ++each) {
          Corners corners = corners_of(each->second);
          const bool was_flat = corners.has_twice();
          for (Word& corner : corners.at) corner = corner == at ? to : corner;
          fits = was_flat || !corners.is_flat();
        }
        if (!fits) continue;
        taken_.insert(to);
        moves.emplace_back(at, to);
        for (auto each = first; each != around.end() && each->first == at; ++each) {
          const Corners corners = corners_of(each->second);
          busy.insert(corners.at, corners.at + 3);
        }
        return;
      }
    }
  }

  Column& position_;
  const Column& index_;
  Slice exact_;
  Job& job_;
  Points point_;
  Array<glm::u16vec4> moved_;  ///< the points once one has moved
  PointTable* table_ = nullptr;
  std::vector<Occupant> occupants_;  ///< of merged points, ordered by point
  std::vector<Word> merged_;
  std::set<Word> taken_;  ///< points that were free in this round
};

}  // namespace

bool split_merged_points(Part& part, const Slice& exact, Job& job) {
  if (part.topology != Topology::triangles || !part.index || part.columns.front().component != Component::u16)
    return true;
  return Separation(part, exact, job).run();
}

}  // namespace seedmesh::gltf

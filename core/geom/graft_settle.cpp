#include <algorithm>
#include <cmath>

#include "core/base/quick_math.h"
#include "core/base/wide.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// Area of a face that cannot be told from none, as a share of the squared size of the model.
constexpr float least_area = 4e-12F;

// A normal nearer to the plane of its face than this may be found on the other side by who reckons otherwise.
constexpr float least_cosine = 1e-4F;

// Normals of loops that come nearer than this to the plane of a face, or behind it, are turned toward it by a
// little more, again and again.
constexpr float least_lean = 0.03F, wanted_lean = 0.06F;
constexpr int most_turns = 24;

}  // namespace

/// Faces side by side: their corners; then twice their area, the normals as long as that, the angles.
struct GraftWriter::FaceBlock {
  static constexpr std::size_t most = 16;
  float corner[3][3][most];  ///< by corner and axis
  float normal[3][most], size[most], angle[3][most];
  float own[3][3][most];  ///< normals at the corners
  std::uint32_t is_bad[most];

  void put(std::size_t lane, const glm::vec3* position, const std::uint32_t* of) {
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) corner[k][axis][lane] = position[of[k]][axis];
    }
  }
  void put_own(std::size_t lane, const glm::vec3* normal_of, const std::uint32_t* of) {
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) own[k][axis][lane] = normal_of[of[k]][axis];
    }
  }
  glm::vec3 at(std::size_t k, std::size_t lane) const {
    return {corner[k][0][lane], corner[k][1][lane], corner[k][2][lane]};
  }
};

/// The angles at the corners, by which faces count, so that it does not matter how the surface is cut into
/// triangles.
SEEDMESH_WIDE void GraftWriter::weigh(FaceBlock& block) {
  for (std::size_t l = 0; l < FaceBlock::most; ++l) {
    const glm::vec3 p[3] = {block.at(0, l), block.at(1, l), block.at(2, l)};
    const glm::vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float size = std::sqrt(glm::dot(normal, normal));
    block.normal[0][l] = normal.x;
    block.normal[1][l] = normal.y;
    block.normal[2][l] = normal.z;
    block.size[l] = size;
    const auto angle_at = [&](const glm::vec3& here, const glm::vec3& one, const glm::vec3& other) {
      const float along = glm::dot(one - here, other - here);
      return static_cast<float>(math::quick_atan2(static_cast<double>(size), static_cast<double>(along)));
    };
    block.angle[0][l] = angle_at(p[0], p[1], p[2]);
    block.angle[1][l] = angle_at(p[1], p[2], p[0]);
    block.angle[2][l] = angle_at(p[2], p[0], p[1]);
  }
}

/// Limbs that were written, those that they grow from, and those that begin at one of them.
void GraftWriter::find_concerned() {
  concern_.assign(range_.size(), Concern::nothing);
  for (std::size_t limb = 0; limb < range_.size(); ++limb) {
    const std::uint32_t parent = parent_.empty() ? none : parent_[limb];
    if (parent != none && dirty_[parent]) concern_[limb] = std::max(concern_[limb], Concern::loop);
    if (!dirty_[limb]) continue;
    concern_[limb] = Concern::all;
    if (parent != none) concern_[parent] = Concern::all;
  }
}

/// Is one of three corners of a loop that has changed?
bool GraftWriter::is_touched(const std::uint32_t* corner) const {
  return std::any_of(corner, corner + 3, [&](std::uint32_t vertex) {
    return group_[vertex] != none && touched_[group_[vertex] / 2];
  });
}

/// Up to where the triangles of a limb have to be looked at.
std::uint32_t GraftWriter::last_triangle(std::size_t limb) const {
  const Range& range = range_[limb];
  return concern_[limb] == Concern::all    ? range.end.triangle
         : concern_[limb] == Concern::loop ? range.first_end
                                           : range.begin.triangle;
}

/// What the faces of all limbs give to the normals of the loops that they touch. These faces are noted in
/// `faces`.
void GraftWriter::add_loop_normals(std::vector<LoopFace>& faces) {
  std::vector<std::uint32_t> corners;
  corners.reserve(parent_.empty() ? mesh_.index.wide.size() : 0);
  for (std::size_t limb = 0; limb < range_.size(); ++limb) {
    const std::uint32_t* corner = mesh_.index.wide.data() + std::size_t{3} * range_[limb].begin.triangle;
    const std::uint32_t* end = mesh_.index.wide.data() + std::size_t{3} * last_triangle(limb);
    for (; corner < end; corner += 3) {
      if ((group_[corner[0]] & group_[corner[1]] & group_[corner[2]]) == none || !is_touched(corner))
        continue;
      for (int k = 0; k < 3; ++k) corners.push_back(corner[k]);
    }
  }
  faces.reserve(corners.size() / 3);
  for (std::size_t first = 0; first < corners.size(); first += 3 * FaceBlock::most) {
    const std::size_t count = std::min(FaceBlock::most, (corners.size() - first) / 3);
    FaceBlock block;
    for (std::size_t l = 0; l < FaceBlock::most; ++l)
      block.put(l, mesh_.position.data(), corners.data() + first + 3 * std::min(l, count - 1));
    weigh(block);
    for (std::size_t l = 0; l < count; ++l) add_loop_face(block, l, corners.data() + first + 3 * l, faces);
  }
}

/// `lane` of a block that has been weighed, with these corners.
void GraftWriter::add_loop_face(const FaceBlock& block, std::size_t lane, const std::uint32_t* corner,
                                std::vector<LoopFace>& faces) {
  if (!(block.size[lane] > 0)) return;
  const glm::vec3 normal{block.normal[0][lane], block.normal[1][lane], block.normal[2][lane]};
  const std::uint32_t groups[3] = {group_[corner[0]], group_[corner[1]], group_[corner[2]]};
  faces.push_back({normal * (1 / block.size[lane]), {groups[0], groups[1], groups[2]}});
  for (std::size_t k = 0; k < 3; ++k) {
    if (groups[k] != none && touched_[groups[k] / 2])
      group_normal_[groups[k]] += normal * (block.angle[k][lane] / block.size[lane]);
  }
}

/// Where a limb leaves at a narrow angle, the mean of both surfaces may look away from one of their faces;
/// the normal gives way, so that the limb need not.
void GraftWriter::ease_loop_normals(const std::vector<LoopFace>& faces) {
  const auto looks_away = [&](const LoopFace& face, std::uint32_t group) {
    return group != none && touched_[group / 2] &&
           glm::dot(group_normal_[group & ~1U], face.normal) < least_lean;
  };
  std::vector<std::uint8_t> strained(touched_.size(), 0);
  for (const LoopFace& face : faces) {
    for (const std::uint32_t group : face.group) {
      if (looks_away(face, group)) strained[group / 2] = 1;
    }
  }
  std::vector<LoopFace> hard;
  for (const LoopFace& face : faces) {
    const auto is_strained = [&](std::uint32_t group) { return group != none && strained[group / 2]; };
    if (std::any_of(std::begin(face.group), std::end(face.group), is_strained)) hard.push_back(face);
  }
  // A face is looked at again only if one of its normals has turned since it was.
  std::uint32_t step = 1;
  std::vector<std::uint32_t> seen(hard.size(), 0), turned(touched_.size(), 1);
  const auto has_turned = [&](const LoopFace& face, std::uint32_t since) {
    return std::any_of(std::begin(face.group), std::end(face.group),
                       [&](std::uint32_t group) { return group != none && turned[group / 2] >= since; });
  };
  bool turns = !hard.empty();
  for (int turn = 0; turns && turn < most_turns; ++turn) {
    turns = false;
    for (std::size_t i = 0; i < hard.size(); ++i) {
      const LoopFace& face = hard[i];
      if (!has_turned(face, seen[i])) continue;
      seen[i] = ++step;
      for (const std::uint32_t group : face.group) {
        if (!looks_away(face, group)) continue;
        glm::vec3& normal = group_normal_[group & ~1U];
        normal =
            math::quick_unit(normal + face.normal * (wanted_lean - glm::dot(normal, face.normal)), normal);
        turned[group / 2] = step;
        turns = true;
      }
    }
  }
}

/// What is wrong with the faces of a block, which has the normals of their corners.
SEEDMESH_WIDE void GraftWriter::look_at(FaceBlock& block, float least_square) {
  constexpr float flattest = least_cosine * least_cosine;
  for (std::size_t l = 0; l < FaceBlock::most; ++l) {
    const glm::vec3 a = block.at(0, l);
    const glm::vec3 normal = glm::cross(block.at(1, l) - a, block.at(2, l) - a);
    const float size = glm::dot(normal, normal);
    const auto looks_along = [&](std::size_t k) {
      const glm::vec3 own{block.own[k][0][l], block.own[k][1][l], block.own[k][2][l]};
      const float over = glm::dot(normal, own);
      const bool is_before = over > 0, is_steep = over * over > flattest * size;
      return is_before & is_steep;
    };
    const bool first = looks_along(0), second = looks_along(1), third = looks_along(2);
    const bool has_area = size > least_square;
    const bool is_sound = has_area & first & second & third;
    block.is_bad[l] = is_sound ? 0U : 1U;
  }
}

/// Looks at the triangles of a limb; returns how many are bad.
std::size_t GraftWriter::judge(std::size_t limb, std::vector<Trust>& trust, bool is_late) const {
  const float least = 2 * least_area * context_.scale.size * context_.scale.size;
  const std::uint32_t* index = mesh_.index.wide.data();
  const std::size_t end = last_triangle(limb);
  std::size_t bad = 0;
  bool is_bad = false;
  for (std::size_t t = range_[limb].begin.triangle; t < end; t += FaceBlock::most) {
    const std::size_t count = std::min(FaceBlock::most, end - t);
    FaceBlock block;
    for (std::size_t l = 0; l < FaceBlock::most; ++l) {
      const std::uint32_t* corner = index + 3 * (t + std::min(l, count - 1));
      block.put(l, mesh_.position.data(), corner);
      block.put_own(l, mesh_.normal.data(), corner);
    }
    look_at(block, least * least);
    for (std::size_t l = 0; l < count; ++l) {
      const std::uint32_t* corner = index + 3 * (t + l);
      if (!block.is_bad[l] || (!dirty_[limb] && !is_touched(corner))) continue;
      is_bad = !blame(corner, trust, is_late) || is_bad;
      ++bad;
    }
  }
  if (is_bad) trust[limb] = trust[limb] < Trust::closed && !is_late ? Trust::closed : Trust::none;
  return bad;
}

/// A bad face is the fault of the openings that it touches. False: it touches none.
bool GraftWriter::blame(const std::uint32_t* corner, std::vector<Trust>& trust, bool is_late) const {
  bool touches = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t group = group_[corner[k]];
    if (group == none) continue;
    touches = true;
    Trust& child = trust[group_limb_[group / 2]];
    child = std::max(child, is_late ? Trust::closed : Trust::detached);
  }
  return touches;
}

std::size_t GraftWriter::settle(std::vector<Trust>& trust, bool is_late) {
  mark_touched();
  const std::size_t count = range_.size();
  find_concerned();
  for (std::size_t pair = 0; pair < touched_.size(); ++pair) {
    if (touched_[pair]) group_normal_[2 * pair] = group_normal_[2 * pair + 1] = glm::vec3(0);
  }
  std::vector<LoopFace> faces;
  if (!group_limb_.empty()) add_loop_normals(faces);
  for (std::size_t pair = 0; pair < touched_.size(); ++pair) {
    if (!touched_[pair]) continue;
    // The mean of both surfaces, whatever the size of their faces. From here on the even group has it.
    const glm::vec3 one = math::quick_unit(group_normal_[2 * pair], glm::vec3{0});
    const glm::vec3 other = math::quick_unit(group_normal_[2 * pair + 1], glm::vec3{0});
    group_normal_[2 * pair] = math::quick_unit(one + other, glm::vec3{0, 1, 0});
  }
  ease_loop_normals(faces);
  for (std::size_t limb = 0; limb < count; ++limb) {
    if (concern_[limb] == Concern::nothing) continue;
    const Range& range = range_[limb];
    const std::uint32_t loop_end = range.begin.vertex + loops_[limb].count + 1;
    const std::size_t end = std::min(range.end.vertex, concern_[limb] == Concern::all ? none : loop_end);
    for (std::size_t i = range.begin.vertex; i < end; ++i) {
      if (group_[i] == none || !touched_[group_[i] / 2]) continue;
      mesh_.normal[i] = group_normal_[group_[i] & ~1U] + 0.0F;
    }
  }
  std::size_t bad = 0;
  for (std::size_t limb = 0; limb < count; ++limb) {
    if (limb % 64 == 0) job_.check();
    bad += judge(limb, trust, is_late);
  }
  return bad;
}

}  // namespace seedmesh

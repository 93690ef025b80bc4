#include "core/geom/plant/graft/fallback_skin.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/geom/plant/skin.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
// The most corners of limbs that skin() makes, except for trunks and limbs with contours.
constexpr int most_sides_of_branches = 8;
// Joint numbers must fit Mesh::bone.
constexpr std::size_t most_joints = 0xFFFF;

std::size_t joints_of(const Chains& chains, std::uint32_t head) {
  std::size_t count = 1;
  for (std::uint32_t joint = head; joint != none; joint = chains.next[joint]) ++count;
  return count;
}

/// Limbs copied for skin(), each with a root of its own where it begins.
struct LimbCopy {
  Limbs limbs;
  std::vector<std::uint32_t> original;  ///< of each joint
};

std::uint32_t copy_joint(const GraftInput& in, std::uint32_t joint, std::uint32_t parent, LimbCopy& to) {
  const Limbs& from = in.limbs;
  Limbs& limbs = to.limbs;
  limbs.position.push_back(from.position[joint]);
  limbs.radius.push_back(from.radius[joint]);
  limbs.base_radius.push_back(from.base_radius[joint]);
  limbs.parent.push_back(parent);
  limbs.starts_limb.push_back(0);
  limbs.color.push_back(in.options.colors && !from.color.empty() ? from.color[joint] : std::int16_t{0});
  if (!in.options.contours.empty() && !from.contour.empty()) {
    limbs.contour.push_back(from.contour[joint]);
    limbs.frame.push_back(from.frame[joint]);
  }
  limbs.order.push_back(0);
  limbs.key.push_back(in.key_of(joint));
  to.original.push_back(joint);
  return static_cast<std::uint32_t>(limbs.size() - 1);
}

/// A copy with two joints without limbs, which give it the extent of the whole: skin() decides by that what
/// is too small.
LimbCopy empty_copy(const GraftInput& in, const Job& job) {
  LimbCopy copy{Limbs(job), {}};
  for (const glm::vec3& corner : {in.scale.box.min, in.scale.box.max}) {
    copy_joint(in, 0, none, copy);
    copy.limbs.position.back() = corner;
  }
  return copy;
}

void copy_limb(const GraftInput& in, std::uint32_t head, LimbCopy& to) {
  const bool is_root = in.limbs.parent[head] == none;
  std::uint32_t last = copy_joint(in, is_root ? head : in.limbs.parent[head], none, to);
  for (std::uint32_t joint = is_root ? in.chains.next[head] : head; joint != none;
       joint = in.chains.next[joint])
    last = copy_joint(in, joint, last, to);
}

/// skin() may fail as well for limbs that are much thicker than long and bend sharply.
void refuse_inward_faces(const Mesh& mesh, const GraftOptions& options, const Job& job) {
  for (std::size_t t = 0; t + 2 < mesh.index.wide.size(); t += 3) {
    const std::uint32_t* corner = mesh.index.wide.data() + t;
    const glm::vec3& a = mesh.position[corner[0]];
    const glm::vec3 face = glm::cross(mesh.position[corner[1]] - a, mesh.position[corner[2]] - a);
    for (int k = 0; k < 3; ++k) {
      if (glm::dot(face, mesh.normal[corner[k]]) < 0) {
        return refuse_bark(options,
                           "a limb bends so sharply for its thickness that its bark would face inward", job);
      }
    }
  }
}

/// Extends `twin` to all vertices of the mesh: 1 for those with the position of another new vertex.
void append_twins(const Mesh& mesh, Array<std::uint8_t>& twin) {
  const std::size_t first = twin.size(), count = mesh.position.size() - first;
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), first);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const glm::vec3 &p = mesh.position[a], &q = mesh.position[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  std::fill_n(twin.extend(count), count, std::uint8_t{0});
  for (std::size_t i = 1; i < count; ++i)
    twin[order[i]] = mesh.position[order[i]] == mesh.position[order[i - 1]] ? 1 : 0;
}

void append_mesh(Mesh& to, const Mesh& from) {
  to.no_minus_zero = to.no_minus_zero && from.no_minus_zero;
  const auto first = static_cast<std::uint32_t>(to.position.size());
  to.position.append(from.position.span());
  to.normal.append(from.normal.span());
  to.uv[0].append(from.uv[0].span());
  to.tangent = {};  // add_tangents() makes all of them
  for (const std::uint32_t index : from.index.wide) to.index.wide.push_back(first + index);
}

/// Appends what skin() makes of a copy.
void append_skin_of(const GraftInput& in, const LimbCopy& copy, int sides, JoinedBark& bark, Job& job) {
  const GraftOptions& options = in.options;
  SkinOptions plain;
  plain.wrap = options.wrap;
  plain.least_repeats = options.least_repeats;
  plain.contours = options.contours;
  plain.sides = std::max(sides, least_sides_of(plain));
  std::vector<std::uint16_t> number(copy.original.size() <= most_joints ? copy.original.size() : 0);
  std::iota(number.begin(), number.end(), std::uint16_t{0});
  if (options.joints) plain.bones = number;
  for (const Bark& part : skin(copy.limbs, plain, job)) {
    refuse_inward_faces(part.mesh, options, job);
    if (options.colors) {
      const std::size_t triangles = part.mesh.index.size() / 3;
      std::fill_n(bark.colors.extend(triangles), triangles, part.color);
    }
    append_mesh(bark.mesh, part.mesh);
    append_twins(bark.mesh, bark.twin);
    for (std::size_t i = 0; options.joints && i < part.mesh.position.size(); ++i)
      bark.joints.push_back(part.mesh.bone.empty() ? copy.original.back() : copy.original[part.mesh.bone[i]]);
  }
}

/// Appends trunks or branches, as many at once as their joints fit Mesh::bone.
void append_some(const GraftInput& in, bool are_trunks, int sides, JoinedBark& bark, Job& job) {
  const Array<std::uint32_t>& head = in.chains.head;
  const auto is_wanted = [&](std::size_t limb) {
    return in.join[limb] == JoinMode::none && (in.limbs.parent[head[limb]] == none) == are_trunks;
  };
  for (std::size_t limb = 0; limb < head.size();) {
    if (!is_wanted(limb)) {
      ++limb;
      continue;
    }
    LimbCopy copy = empty_copy(in, job);
    for (const std::size_t first = limb; limb < head.size(); ++limb) {
      if (!is_wanted(limb)) continue;
      if (limb > first && copy.limbs.size() + joints_of(in.chains, head[limb]) > most_joints) break;
      copy_limb(in, head[limb], copy);
    }
    append_skin_of(in, copy, sides, bark, job);
  }
}

}  // namespace

void find_fallback_limbs(const Limbs& limbs, const Chains& chains, const Scale& scale,
                         const GraftOptions& options, Job& job, std::vector<JoinMode>& join) {
  Chains overlaps;
  if (options.overlaps) overlaps = find_chains(limbs, scale, job);
  const bool has_contours = !options.contours.empty() && !limbs.contour.empty();
  if (!options.overlaps && !options.points && !has_contours) return;
  for (std::size_t i = 0; i < chains.head.size(); ++i) {
    for (std::uint32_t joint = chains.head[i]; joint != none; joint = chains.next[joint]) {
      const std::uint32_t next = chains.next[joint];
      const float least =
          next == none ? limbs.base_radius[joint] : std::min(limbs.base_radius[joint], limbs.radius[joint]);
      const bool is_internode = limbs.parent[joint] != none;
      if ((options.overlaps && (overlaps.mark[joint] & drawn_before) != 0) ||
          (options.points && is_internode && !(least >= 2 * scale.thinnest)) ||
          (has_contours && limbs.contour[joint] != 0))
        join[i] = JoinMode::none;
    }
  }
}

void append_skinned(const GraftInput& in, JoinedBark& bark, Job& job) {
  const int sides = in.options.sides;
  append_some(in, true, sides, bark, job);
  append_some(in, false, in.options.contours.empty() ? std::min(sides, most_sides_of_branches) : sides, bark,
              job);
}

void refuse_bark(const GraftOptions& options, const char* reason, const Job& job) {
  if (!options.has_no_surface) job.refuse({IssueKind::evaluation, "", reason});
  *options.has_no_surface = true;
}

}  // namespace seedmesh

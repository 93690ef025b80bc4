#include "core/geom/graft.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/geom/apart.h"
#include "core/geom/crowd.h"
#include "core/geom/graft_plan.h"
#include "core/geom/graft_writer.h"
#include "core/geom/skin.h"

namespace seedmesh {
namespace {

// A limb whose faces look inward is made again closed, and if that does not help by skin(); from this round
// on at once by skin(), and after twice as many the whole.
constexpr int rounds = 4;
// Of limbs that skin() makes, but for trunks.
constexpr int most_sides_of_leftover = 8;

constexpr std::size_t points_a_chunk = std::size_t{1} << 14U;

/// The limbs that skin() must make, trunks or the others, each with a root of its own where it begins. At
/// most so many joints at once that their numbers fit Mesh::bone.
class Leftover {
 public:
  static constexpr std::size_t most_joints = 0xFFFF;

  struct Looks {
    bool colors = false, contours = false;  ///< that the limbs keep
  };
  Leftover(const Limbs& limbs, const Chains& chains, const std::vector<Trust>& trust, const Box& box,
           bool are_trunks, Looks looks)
      : limbs_(limbs),
        chains_(chains),
        trust_(trust),
        box_(box),
        are_trunks_(are_trunks),
        looks_{looks.colors && !limbs.color.empty(), looks.contours && !limbs.contour.empty()} {}

  /// The next limbs; empty at the end. `was` gets the joint that each was.
  Limbs next(std::vector<std::uint32_t>& was, const Job& job);

 private:
  std::size_t joints_of(std::size_t limb) const {
    std::size_t count = 1;
    for (std::uint32_t joint = chains_.head[limb]; joint != Limbs::none; joint = chains_.next[joint]) ++count;
    return count;
  }

  bool is_wanted(std::size_t limb) const {
    const bool is_trunk = limbs_.parent[chains_.head[limb]] == Limbs::none;
    return trust_[limb] == Trust::none && is_trunk == are_trunks_;
  }

  const Limbs& limbs_;
  const Chains& chains_;
  const std::vector<Trust>& trust_;
  const Box& box_;
  bool are_trunks_;
  Looks looks_;
  std::size_t at_ = 0;
};

Limbs Leftover::next(std::vector<std::uint32_t>& was, const Job& job) {
  const Limbs& limbs = limbs_;
  Limbs out(job);
  was.clear();
  const auto add = [&](std::uint32_t joint, std::uint32_t parent) {
    out.position.push_back(limbs.position[joint]);
    out.radius.push_back(limbs.radius[joint]);
    out.base_radius.push_back(limbs.base_radius[joint]);
    out.parent.push_back(parent);
    out.starts_limb.push_back(0);
    out.color.push_back(looks_.colors ? limbs.color[joint] : std::int16_t{0});
    if (looks_.contours) {
      out.contour.push_back(limbs.contour[joint]);
      out.frame.push_back(limbs.frame[joint]);
    }
    out.order.push_back(0);
    out.key.push_back(limbs.key.empty() ? joint : limbs.key[joint]);
    was.push_back(joint);
    return static_cast<std::uint32_t>(out.size() - 1);
  };
  while (at_ < chains_.head.size() && !is_wanted(at_)) ++at_;
  if (at_ == chains_.head.size()) return out;
  // Two joints without limbs give it the extent of the whole, by which skin() tells what is too small.
  for (const glm::vec3& corner : {box_.min, box_.max}) {
    add(0, Limbs::none);
    out.position.back() = corner;
  }
  for (const std::size_t first = at_; at_ < chains_.head.size(); ++at_) {
    if (!is_wanted(at_)) continue;
    if (at_ > first && out.size() + joints_of(at_) > most_joints) break;
    const std::uint32_t head = chains_.head[at_];
    const bool is_root = limbs.parent[head] == Limbs::none;
    std::uint32_t last = add(is_root ? head : limbs.parent[head], Limbs::none);
    for (std::uint32_t joint = is_root ? chains_.next[head] : head; joint != Limbs::none;
         joint = chains_.next[joint])
      last = add(joint, last);
  }
  return out;
}

/// Limbs with a piece that lies on another's go to skin(), which knows how to draw it once.
void distrust_overlaps(const Limbs& limbs, const Chains& chains, const Scale& scale, Job& job,
                       std::vector<Trust>& trust) {
  const Chains found = find_chains(limbs, scale, job);
  for (std::size_t i = 0; i < chains.head.size(); ++i) {
    for (std::uint32_t joint = chains.head[i]; joint != Limbs::none; joint = chains.next[joint]) {
      if (found.mark[joint] & drawn_before) trust[i] = Trust::none;
    }
  }
}

/// Limbs that begin in a point, or are one on the way, go to skin(), which knows how to close them there.
void distrust_points(const Limbs& limbs, const Chains& chains, const Scale& scale,
                     std::vector<Trust>& trust) {
  for (std::size_t i = 0; i < chains.head.size(); ++i) {
    const std::uint32_t head = chains.head[i];
    for (std::uint32_t joint = limbs.parent[head] == Limbs::none ? chains.next[head] : head;
         joint != Limbs::none; joint = chains.next[joint]) {
      const std::uint32_t next = chains.next[joint];
      const float least = next == Limbs::none ? limbs.base_radius[joint]
                                              : std::min(limbs.base_radius[joint], limbs.radius[joint]);
      if (!(least >= 2 * scale.thinnest)) trust[i] = Trust::none;
    }
  }
}

void distrust_contours(const Limbs& limbs, const Chains& chains, std::vector<Trust>& trust) {
  for (std::size_t i = 0; i < chains.head.size() && !limbs.contour.empty(); ++i) {
    for (std::uint32_t joint = chains.head[i]; joint != Limbs::none; joint = chains.next[joint]) {
      if (limbs.contour[joint] != 0) trust[i] = Trust::none;
    }
  }
}

template <class T>
void append(Array<T>& to, const Array<T>& from) {
  to.append(from.span());
}

void append(Mesh& to, const Mesh& from) {
  to.no_minus_zero = to.no_minus_zero && from.no_minus_zero;
  const auto first = static_cast<std::uint32_t>(to.position.size());
  append(to.position, from.position);
  append(to.normal, from.normal);
  append(to.uv[0], from.uv[0]);
  for (const std::uint32_t index : from.index.wide) to.index.wide.push_back(first + index);
}

/// Tells of a heap whoever asked to be told, and refuses it otherwise.
void refuse_heap(const GraftOptions& options, const char* why) {
  if (!options.is_heap) Job::refuse(why);
  *options.is_heap = true;
}

/// Limbs much thicker than long that bend sharply can be too much for skin(), too.
void refuse_inward_faces(const Mesh& mesh, const GraftOptions& options) {
  for (std::size_t t = 0; t + 2 < mesh.index.wide.size(); t += 3) {
    const std::uint32_t* corner = mesh.index.wide.data() + t;
    const glm::vec3& a = mesh.position[corner[0]];
    const glm::vec3 face = glm::cross(mesh.position[corner[1]] - a, mesh.position[corner[2]] - a);
    for (int k = 0; k < 3; ++k) {
      if (glm::dot(face, mesh.normal[corner[k]]) < 0)
        return refuse_heap(options,
                           "a limb bends so sharply for its thickness that its bark would look inward");
    }
  }
}

/// Marks in `twin`, which goes up to the vertices of the last part of a mesh, those of them that stand where
/// others do.
void add_twins(const Mesh& mesh, Array<std::uint8_t>& twin) {
  const std::size_t first = twin.size(), count = mesh.position.size() - first;
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), first);
  const auto place = [&](std::size_t i) {
    const glm::vec3& p = mesh.position[i];
    return std::tuple(p.x, p.y, p.z, i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  std::fill_n(twin.extend(count), count, std::uint8_t{0});
  for (std::size_t i = 1; i < count; ++i)
    twin[order[i]] = mesh.position[order[i]] == mesh.position[order[i - 1]] ? 1 : 0;
}

/// What skin() makes of the limbs that nothing else can be made of.
void append_leftover(GraftWriter::Written& to, Leftover limbs, int sides, const GraftOptions& options,
                     Job& job) {
  std::vector<std::uint32_t> was;
  std::vector<std::uint16_t> number;
  for (Limbs others = limbs.next(was, job); others.size() > 0; others = limbs.next(was, job)) {
    SkinOptions plain;
    plain.sides = sides;
    plain.wrap = options.wrap;
    plain.contours = options.contours;
    plain.sides = std::max(plain.sides, least_sides_of(plain));
    if (options.joints && was.size() <= Leftover::most_joints) {
      number.resize(was.size());
      for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<std::uint16_t>(i);
      plain.bones = number;
    }
    for (const Bark& bark : skin(others, plain, job)) {
      refuse_inward_faces(bark.mesh, options);
      if (options.colors)
        std::fill_n(to.colors.extend(bark.mesh.index.size() / 3), bark.mesh.index.size() / 3, bark.color);
      append(to.mesh, bark.mesh);
      to.mesh.tangent = {};  // for add_tangents(), which makes all
      add_twins(to.mesh, to.twin);
      if (!options.joints) continue;
      for (std::size_t i = 0; i < bark.mesh.position.size(); ++i)
        options.joints->push_back(bark.mesh.bone.empty() ? was.back() : was[bark.mesh.bone[i]]);
    }
  }
}

/// The triangles that have a marked vertex.
Mesh around(const Mesh& mesh, const Array<std::uint8_t>& marked, const Job& job) {
  Mesh part;
  part.position = Array<glm::vec3>(job);
  part.index.wide = Array<std::uint32_t>(job);
  const Array<std::uint32_t>& index = mesh.index.wide;
  Array<std::uint32_t> number(job, mesh.position.size(), Limbs::none);
  const auto is_wanted = [&](std::size_t t) {
    return (marked[index[t]] | marked[index[t + 1]] | marked[index[t + 2]]) != 0;
  };
  for (std::size_t t = 0; t < index.size(); t += 3) {
    for (std::size_t k = 0; k < 3 && is_wanted(t); ++k) number[index[t + k]] = 0;
  }
  // In their order, by which vertices are welded.
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == Limbs::none) continue;
    number[i] = static_cast<std::uint32_t>(part.position.size());
    part.position.push_back(mesh.position[i]);
  }
  for (std::size_t t = 0; t < index.size(); t += 3) {
    for (std::size_t k = 0; k < 3 && is_wanted(t); ++k) part.index.wide.push_back(number[index[t + k]]);
  }
  return part;
}

Box box_of(std::span<const glm::vec3> points, const Job& job) {
  std::vector<Box> boxes(chunk_count(points.size(), points_a_chunk));
  parallel_for(job, points.size(), points_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                 boxes[chunk] = bounds_of(points.subspan(begin, end - begin));
               });
  Box box = boxes.empty() ? Box{} : boxes.front();
  for (const Box& each : boxes) box = {glm::min(box.min, each.min), glm::max(box.max, each.max)};
  return box;
}

/// Limbs that go through each other may touch in points that a reader takes for one. `twin` of the vertices
/// as GraftWriter::Written has it.
void refuse_crowds(const Mesh& mesh, const Array<std::uint8_t>& twin, const Scale& scale,
                   const GraftOptions& options, const Job& job) {
  const Box box = box_of(mesh.position.span(), job);
  const float reach = 1e-6F * std::min(scale.size, glm::length(box.max - box.min));
  // Each limb's surface is closed, and what stands apart keeps it so: faults are at what does not.
  const Array<std::uint8_t> near = near_others(mesh.position.span(), twin.span(), box, reach, job);
  if (near.empty() || !is_crowded(around(mesh, near, job), reach, job)) return;
  refuse_heap(
      options,
      "the limbs lie in heaps so dense, less than a millionth of the tree apart, that their bark is no "
      "surface; fewer or thicker limbs are needed");
}

}  // namespace

Mesh graft(const Limbs& limbs, const GraftOptions& options, Job& job, GraftCounts* counts) {
  assert(options.sides >= 3 && options.sides <= 64);
  if (limbs.size() == 0) return {};
  // By the ring with the most corners: those must stay apart too.
  const Scale scale = scale_of(limbs, with_ribs(options, options.sides));
  const Chains chains = link_chains(limbs, job);
  std::vector<Trust> trust(chains.head.size(), options.weld ? Trust::full : Trust::closed);
  std::optional<GraftWriter> writer;
  const std::function<void()> tasks[] = {
      [&] {
        writer.emplace(GraftWriter::Context{limbs, chains, scale, options, trust}, job);
      },
      [&] {
        if (options.overlaps) distrust_overlaps(limbs, chains, scale, job, trust);
        if (options.points) distrust_points(limbs, chains, scale, trust);
        if (!options.contours.empty()) distrust_contours(limbs, chains, trust);
      },
  };
  parallel_for(job, std::size(tasks), 1, [&](std::size_t i, std::size_t, std::size_t) { tasks[i](); });
  writer->write_round();
  for (int round = 0; writer->settle(trust, round >= rounds) > 0; ++round) {
    if (round + 1 == 2 * rounds) std::fill(trust.begin(), trust.end(), Trust::none);
    writer->write_round();
  }
  if (counts) *counts = writer->counts();
  if (options.grown) writer->tell_grown(*options.grown);
  // Rings of more corners than a cache has entries come in once more.
  const bool is_ordered = 10 * writer->wide_corners() < writer->corners();
  const auto fallen_back = static_cast<std::uint32_t>(std::count(trust.begin(), trust.end(), Trust::none));
  GraftWriter::Written written = writer->take();
  written.mesh.no_minus_zero = true;
  writer.reset();  // others need its memory
  if (options.joints) *options.joints = std::move(written.joints);
  const Leftover::Looks looks{options.colors != nullptr, !options.contours.empty()};
  append_leftover(written, Leftover(limbs, chains, trust, scale.box, true, looks), options.sides, options,
                  job);
  const int most_sides = options.contours.empty() ? most_sides_of_leftover : options.sides;
  append_leftover(written, Leftover(limbs, chains, trust, scale.box, false, looks),
                  std::min(options.sides, most_sides), options, job);
  if (options.colors) *options.colors = std::move(written.colors);
  refuse_crowds(written.mesh, written.twin, scale, options, job);
  if (counts) counts->fallen_back = fallen_back;
  written.mesh.cache_ordered = is_ordered;
  return std::move(written.mesh);
}

}  // namespace seedmesh

#include <algorithm>
#include <bit>
#include <optional>

#include "core/base/parallel.h"
#include "core/geom/plant/skin.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
constexpr std::size_t chunk = 1U << 16U;

// Curves that return to their own corners have vertices that coincide. The search for them takes longer than
// everything else. It is made for small models. For larger models a sample of the positions is searched
// first, and the rest only if at least one in this many coincides. Very large models are not searched.
constexpr unsigned sampled_bits = 6;
constexpr std::uint64_t tolerated_of = 2000;
constexpr std::size_t always_merged = std::size_t{1} << 17U, never_merged = std::size_t{1} << 20U;

/// 0 and -0 are the same position.
std::uint64_t position_hash(const glm::vec3& point) {
  const glm::vec3 p = point + 0.0F;
  const std::uint64_t xy =
      std::uint64_t{std::bit_cast<std::uint32_t>(p.x)} << 32U | std::bit_cast<std::uint32_t>(p.y);
  return mix(key_at(xy, std::bit_cast<std::uint32_t>(p.z)));
}

/// Numbers of points, found by exact position.
class PointTable {
 public:
  PointTable(const Job& job, std::size_t expected)
      : slots_(job, std::bit_ceil(expected + expected / 2 + 16), none), last_(slots_.size() - 1) {}

  /// The number of an earlier point at this position, or `number`, which later ones then get.
  template <class PointOf>
  std::uint32_t find_or_add(const glm::vec3& point, std::uint32_t number, PointOf point_of) {
    std::size_t at = position_hash(point) & last_;
    while (slots_[at] != none && point_of(slots_[at]) != point) at = (at + 1) & last_;
    if (slots_[at] == none) slots_[at] = number;
    return slots_[at];
  }

 private:
  Array<std::uint32_t> slots_;
  std::size_t last_;
};

/// Selects one position in 2^sampled_bits by a hash of the position: of joints that coincide, all or none are
/// selected.
bool is_sampled(const glm::vec3& point) {
  const glm::vec3 p = point + 0.0F;
  const std::uint64_t mixed = std::bit_cast<std::uint32_t>(p.x) * 0x9E3779B97F4A7C15U ^
                              std::bit_cast<std::uint32_t>(p.y) * 0xC2B2AE3D27D4EB4FU ^
                              std::bit_cast<std::uint32_t>(p.z) * 0x165667B19E3779F9U;
  return mixed >> (64U - sampled_bits) == 0;
}

/// The results of one pass over all joints.
struct JointScan {
  std::size_t segments = 0;
  bool has_one_color = true;
  std::int16_t color = 0;                    ///< of the first internode
  std::vector<std::uint32_t> sample;         ///< joints at the selected positions
  std::vector<std::size_t> segments_before;  ///< of each chunk; only in the sum of all chunks
};

JointScan scan_chunk(const Limbs& limbs, std::size_t begin, std::size_t end) {
  const bool samples = limbs.size() > always_merged && limbs.size() <= never_merged;
  JointScan scan;
  for (std::size_t i = begin; i < end; ++i) {
    if (samples && is_sampled(limbs.position[i])) scan.sample.push_back(static_cast<std::uint32_t>(i));
    if (limbs.parent[i] == none) continue;
    const std::int16_t color = limbs.color.empty() ? std::int16_t{0} : limbs.color[i];
    if (scan.segments++ == 0) scan.color = color;
    scan.has_one_color = scan.has_one_color && color == scan.color;
  }
  return scan;
}

JointScan scan_all(const Limbs& limbs, const Job& job) {
  std::vector<JointScan> parts(chunk_count(limbs.size(), chunk));
  parallel_for(job, limbs.size(), chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
    job.check();
    parts[index] = scan_chunk(limbs, begin, end);
  });
  JointScan all;
  for (const JointScan& part : parts) {
    all.segments_before.push_back(all.segments);
    if (part.segments == 0) continue;
    if (all.segments == 0) all.color = part.color;
    all.segments += part.segments;
    all.has_one_color = all.has_one_color && part.has_one_color && part.color == all.color;
  }
  for (const JointScan& part : parts)
    all.sample.insert(all.sample.end(), part.sample.begin(), part.sample.end());
  return all;
}

bool has_repeated_positions(const Limbs& limbs, const JointScan& scan, const Job& job) {
  if (limbs.size() <= always_merged) return true;
  if (limbs.size() > never_merged) return false;
  PointTable table(job, scan.sample.size());
  std::uint64_t repeated = 0;
  for (std::uint32_t joint : scan.sample) {
    const auto at = [&](std::uint32_t other) { return limbs.position[other]; };
    if (table.find_or_add(limbs.position[joint], joint, at) != joint) ++repeated;
  }
  return repeated * tolerated_of > scan.sample.size();
}

/// Internodes by colour, in order within each colour; a counting sort.
struct ColorLists {
  ColorLists(const Limbs& limbs, const Job& job) : joint(job) {
    const auto color_of = [&](std::size_t i) { return limbs.color.empty() ? 0 : limbs.color[i] + 32'768; };
    std::vector<std::size_t> counts(65'537);
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs.parent[i] != none) ++counts[static_cast<std::size_t>(color_of(i)) + 1];
    }
    for (std::size_t c = 0; c + 1 < counts.size(); ++c) {
      if (counts[c + 1]) {
        color.push_back(static_cast<std::int16_t>(limbs.color.empty() ? 0 : static_cast<int>(c) - 32'768));
        first.push_back(counts[c]);
      }
      counts[c + 1] += counts[c];
    }
    first.push_back(counts.back());
    joint.resize(counts.back());
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs.parent[i] != none)
        joint[counts[static_cast<std::size_t>(color_of(i))]++] = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<std::int16_t> color;
  std::vector<std::size_t> first;  ///< index of `joint` where each colour begins, and the end
  Array<std::uint32_t> joint;
};

/// Numbers the vertices of one colour's mesh by joint: a sparse set, which need not be cleared between
/// colours.
class VertexNames {
 public:
  VertexNames(const Limbs& limbs, const Job& job)
      : limbs_(limbs), vertex_of_(job, limbs.size(), std::uint32_t{0}), joint_of_(job) {}

  std::uint32_t name(std::uint32_t joint, Array<glm::vec3>& position, PointTable* table) {
    const std::uint32_t known = vertex_of_[joint];
    if (known < joint_of_.size() && joint_of_[known] == joint) return known;
    const auto fresh = static_cast<std::uint32_t>(joint_of_.size());
    const glm::vec3 point = limbs_.position[joint] + 0.0F;
    if (table) {
      const auto at = [&](std::uint32_t vertex) { return position[vertex]; };
      const std::uint32_t found = table->find_or_add(point, fresh, at);
      if (found != fresh) return found;
    }
    vertex_of_[joint] = fresh;
    joint_of_.push_back(joint);
    position.push_back(point);
    return fresh;
  }
  void clear() { joint_of_.clear(); }

 private:
  const Limbs& limbs_;
  Array<std::uint32_t> vertex_of_;
  Array<std::uint32_t> joint_of_;
};

std::vector<Bark> named_wires(const Limbs& limbs, bool merges, const Job& job) {
  const ColorLists lists(limbs, job);
  VertexNames names(limbs, job);
  std::vector<Bark> barks;
  for (std::size_t c = 0; c < lists.color.size(); ++c) {
    const std::size_t count = lists.first[c + 1] - lists.first[c];
    Mesh mesh;
    mesh.topology = Topology::lines;
    mesh.position = Array<glm::vec3>(job);
    mesh.position.reserve(count + 1);
    mesh.index.wide = Array<std::uint32_t>(job, 2 * count);
    std::optional<PointTable> table;
    if (merges) table.emplace(job, count + count / 4 + 1);
    names.clear();
    std::uint32_t* out = mesh.index.wide.data();
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 4096 == 0) job.check();
      const std::uint32_t joint = lists.joint[lists.first[c] + i];
      *out++ = names.name(limbs.parent[joint], mesh.position, table ? &*table : nullptr);
      *out++ = names.name(joint, mesh.position, table ? &*table : nullptr);
    }
    mesh.position.shrink_to_fit();
    barks.push_back({lists.color[c], std::move(mesh)});
  }
  return barks;
}

/// True where every joint is an end of an internode and all have one colour: joints are then vertices as they
/// are.
bool is_plain(const Limbs& limbs, const JointScan& scan, const Job& job) {
  if (!scan.has_one_color) return false;
  const std::size_t roots = limbs.size() - scan.segments;
  if (roots == 1 && limbs.parent[0] == none) return true;
  Array<std::uint8_t> is_used(job, limbs.size(), std::uint8_t{0});
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] == none) continue;
    is_used[i] = 1;
    is_used[limbs.parent[i]] = 1;
  }
  return std::find(is_used.begin(), is_used.end(), 0) == is_used.end();
}

/// `position`: of the joints; or empty, then it is copied.
Bark plain_wires(const Limbs& limbs, Array<glm::vec3> position, const JointScan& scan, const Job& job) {
  const std::size_t count = limbs.parent.size();
  const bool copies = position.empty();
  if (copies) position = Array<glm::vec3>(job, count);
  Bark bark;
  bark.color = scan.color;
  bark.mesh.topology = Topology::lines;
  bark.mesh.index.wide = Array<std::uint32_t>(job, 2 * scan.segments);
  parallel_for(job, count, chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
    job.check();
    std::uint32_t* out = bark.mesh.index.wide.data() + 2 * scan.segments_before[index];
    for (std::size_t i = begin; i < end; ++i) {
      position[i] = (copies ? limbs.position[i] : position[i]) + 0.0F;
      if (limbs.parent[i] == none) continue;
      *out++ = limbs.parent[i];
      *out++ = static_cast<std::uint32_t>(i);
    }
  });
  bark.mesh.position = std::move(position);
  return bark;
}

/// `spent`: the same limbs, where their positions may be moved out.
std::vector<Bark> drawn(const Limbs& limbs, Limbs* spent, Job& job) {
  if (limbs.size() == 0) return {};
  const JointScan scan = scan_all(limbs, job);
  if (scan.segments == 0) return {};
  const bool merges = has_repeated_positions(limbs, scan, job);
  if (merges || !is_plain(limbs, scan, job)) return named_wires(limbs, merges, job);
  std::vector<Bark> barks;
  barks.push_back(plain_wires(limbs, spent ? std::move(spent->position) : Array<glm::vec3>(), scan, job));
  return barks;
}

}  // namespace

std::vector<Bark> wires(const Limbs& limbs, Job& job) { return drawn(limbs, nullptr, job); }

std::vector<Bark> wires(Limbs&& limbs, Job& job) {
  Limbs own = std::move(limbs);
  return drawn(own, &own, job);
}

}  // namespace seedmesh

#include "core/generators/fractal/pieces.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/mesh/weld.h"
#include "core/model/build.h"
#include "core/model/empty_mesh.h"

namespace seedmesh::fractal {
namespace {

constexpr std::uint64_t most_nodes = 400;
constexpr std::uint64_t node_bytes = 150;  ///< of JSON
constexpr double largest_count = 0x1p62;

/// Calls visit(map) for all copies after `rounds`, but point(map) for those for which is_small(map) is true, which
/// are not divided. Needs only a stack with one map for each round.
template <class IsSmall, class Visit, class Point>
void each_division(const Affine& outer, const Instructions& instructions, int rounds, const IsSmall& is_small,
                   const Visit& visit, const Point& point) {
  std::vector<Affine> stack{outer};
  std::vector<std::size_t> next{0};
  while (!stack.empty()) {
    const auto depth = static_cast<int>(stack.size()) - 1;
    if (next.back() == 0 && is_small(stack.back())) {
      point(compose(stack.back(), instructions.stem));
      stack.pop_back();
      next.pop_back();
      continue;
    }
    const bool whole = depth == rounds;
    if (next.back() == 0 && (whole || instructions.keeps)) visit(compose(stack.back(), instructions.stem));
    if (whole || next.back() == instructions.maps.size()) {
      stack.pop_back();
      next.pop_back();
      continue;
    }
    const Affine copy = compose(stack.back(), instructions.maps[next.back()++]);
    stack.push_back(copy);
    next.push_back(0);
  }
}

/// Calls visit(map) for all copies after `rounds`.
template <class Visit>
void each_copy(const Instructions& instructions, int rounds, const Visit& visit) {
  const auto never = [](const Affine&) { return false; };
  each_division({}, instructions, rounds, never, visit, [](const Affine&) {});
}

const std::vector<Affine>& around_of(const Instructions& instructions) {
  static const std::vector<Affine> once{Affine{}};
  return instructions.arrangement.empty() ? once : instructions.arrangement;
}

bool can_be_nodes(const Instructions& instructions) {
  if (instructions.keeps || !instructions.arrangement.empty()) return false;
  return std::ranges::all_of(instructions.maps,
                             [](const Affine& map) { return similarity(map).has_value(); });
}

std::uint64_t whole(double count) { return static_cast<std::uint64_t>(std::min(count, largest_count)); }

/// Joins copies of a mesh under several maps.
class CopyJoiner {
 public:
  CopyJoiner(const Mesh& element, std::uint64_t copies, double size, Job& job)
      : element_(element), size_(size), job_(job) {
    const std::size_t count = static_cast<std::size_t>(copies);
    mesh_ = empty_mesh(job);
    mesh_.topology = element.topology;
    mesh_.uv[0] = Array<glm::vec2>(job);
    mesh_.color = Array<glm::u8vec4>(job);
    mesh_.position.reserve(count * element.position.size());
    mesh_.normal.reserve(count * element.normal.size());
    mesh_.uv[0].reserve(count * element.uv[0].size());
    mesh_.color.reserve(count * element.color.size());
    mesh_.index.wide.reserve(count * element.index.size());
  }

  void add(const Affine& map) {
    if (++copies_ % 256 == 0) job_.check();
    const double determinant = glm::determinant(map.linear);
    if (determinant == 0 && element_.topology == Topology::triangles) return;  // a flat solid is invisible
    const auto first = static_cast<std::uint32_t>(mesh_.position.size());
    glm::vec3* position = mesh_.position.extend(element_.position.size());
    for (const glm::vec3& p : element_.position) *position++ = glm::vec3(size_ * map(glm::dvec3(p)));
    if (!element_.normal.empty()) add_normals(map, determinant);
    mesh_.uv[0].append(element_.uv[0].span());
    mesh_.color.append(element_.color.span());
    const bool mirrored = determinant < 0 && element_.topology == Topology::triangles;
    std::uint32_t* corner = mesh_.index.wide.extend(element_.index.size());
    for (std::size_t i = 0; i < element_.index.size(); ++i)
      *corner++ = first + element_.index.at(mirrored ? i / 3 * 3 + 2 - i % 3 : i);
  }

  Mesh take() {
    weld(mesh_, job_);
    return std::move(mesh_);
  }

 private:
  void add_normals(const Affine& map, double determinant) {
    // The cofactors are the transposed inverse times the determinant, which may be very small.
    const glm::dmat3& m = map.linear;
    glm::dmat3 turn(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double largest = std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
    turn *= (determinant < 0 ? -1 : 1) / largest;
    glm::vec3* normal = mesh_.normal.extend(element_.normal.size());
    for (const glm::vec3& n : element_.normal)
      *normal++ = glm::vec3(math::unit(turn * glm::dvec3(n), {0, 1, 0}));
  }

  const Mesh& element_;
  double size_;
  Job& job_;
  Mesh mesh_;
  std::uint64_t copies_ = 0;
};

void refuse_too_many(double elements, std::uint64_t limit, int rounds, const Instructions& instructions,
                     const Element& element, const Job& job) {
  int fewer = rounds;
  while (fewer > 0 && pieces_after(instructions, fewer) * static_cast<double>(element.elements) >
                          static_cast<double>(limit)) {
    --fewer;
  }
  const std::string least = elements < largest_count ? "" : "more than ";
  job.refuse(limit_issue({Resource::triangles, limit, whole(elements)},
                         "needs " + least + std::to_string(whole(elements)) + " triangles or lines after " +
                             std::to_string(rounds) + " rounds; the limit is " + std::to_string(limit) +
                             ", which " + std::to_string(fewer) + " rounds keep",
                         "/iterations"));
}

}  // namespace

double pieces_after(const Instructions& instructions, int rounds) {
  const auto copies = static_cast<double>(instructions.maps.size());
  double pieces = 1;
  for (int round = 0; round < rounds; ++round) pieces = copies * pieces + (instructions.keeps ? 1 : 0);
  return instructions.arrangement.empty() ? pieces
                                          : pieces * static_cast<double>(instructions.arrangement.size());
}

Plan plan_of(const Instructions& instructions, const Element& element, int rounds, const Job& job) {
  const double pieces = pieces_after(instructions, rounds);
  const bool nodes_allowed = can_be_nodes(instructions) && rounds > 0;
  Plan best;
  bool found = false;
  for (int meshed = rounds; meshed >= 0; --meshed) {
    const double nodes = pieces / pieces_after(instructions, meshed);
    if (meshed < rounds && (!nodes_allowed || nodes > most_nodes)) break;
    const double in_mesh = meshed == rounds ? pieces : pieces_after(instructions, meshed);
    const double wide = in_mesh * static_cast<double>(element.bytes);
    const double bytes = wide + nodes * static_cast<double>(node_bytes);
    const double elements = in_mesh * static_cast<double>(element.elements);
    if (elements > static_cast<double>(job.limits().triangles)) continue;
    if (found && bytes >= static_cast<double>(best.bytes)) continue;
    best = {meshed, pieces, whole(elements), whole(nodes), whole(bytes)};
    found = true;
  }
  // The limit also applies to what is drawn.
  const double drawn = pieces * static_cast<double>(element.elements);
  if (!found || drawn > static_cast<double>(job.limits().triangles))
    refuse_too_many(drawn, job.limits().triangles, rounds, instructions, element, job);
  return best;
}

void add_pieces(Model& model, int parent, const Instructions& instructions, const Element& element,
                const Copies& given, Job& job) {
  const int rounds = given.rounds;
  const double size = given.size;
  const Plan plan = plan_of(instructions, element, rounds, job);
  job.spend(Resource::triangles, whole(plan.pieces) * element.elements);
  MeshGroup group;
  group.name = "copies";
  const std::uint64_t copies = whole(plan.pieces) / std::max<std::uint64_t>(plan.nodes, 1);
  for (const Primitive& primitive : element.primitives) {
    CopyJoiner joiner(primitive.mesh, copies, size, job);
    for (const Affine& outer : around_of(instructions))
      each_copy(instructions, plan.meshed, [&](const Affine& map) { joiner.add(compose(outer, map)); });
    group.primitives.push_back({joiner.take(), primitive.material, {}});
  }
  Node& node = add_node(model, "copies", parent, add_mesh(model, std::move(group)));
  if (plan.nodes <= 1) return;
  each_copy(instructions, rounds - plan.meshed, [&](const Affine& map) {
    Affine moved = map;
    moved.offset *= size;
    node.instances.transforms.push_back(transform_of(moved, similarity(map).value_or(1)));
  });
}

DividedCount count_divided(const Instructions& instructions, const Element& element, const Division& division,
                           const Job& job) {
  DividedCount count;
  std::uint64_t visits = 0;
  const auto check = [&] {
    if (++visits % 4096 == 0) job.check();
    const std::uint64_t drawn = count.elements * element.elements + count.points;
    if (drawn > job.limits().triangles) {
      job.refuse(limit_issue({Resource::triangles, job.limits().triangles, drawn},
                             "needs more than " + std::to_string(job.limits().triangles) +
                                 " triangles, lines and points for pieces down to " +
                                 number_text(division.smallest) + " m, which is the limit",
                             "/smallest"));
    }
  };
  const auto is_small = [&](const Affine& map) {
    check();
    return norm(map) * division.size < division.smallest;
  };
  for (const Affine& outer : around_of(instructions)) {
    each_division(
        outer, instructions, division.rounds, is_small, [&](const Affine&) { ++count.elements; },
        [&](const Affine&) { ++count.points; });
  }
  return count;
}

void add_divided(Model& model, int parent, const Instructions& instructions, const Element& element,
                 const Division& division, Job& job) {
  const DividedCount count = count_divided(instructions, element, division, job);
  job.spend(Resource::triangles, count.elements * element.elements + count.points);
  const auto is_small = [&](const Affine& map) { return norm(map) * division.size < division.smallest; };
  Mesh points;
  points.topology = Topology::points;
  points.position = Array<glm::vec3>(job);
  points.position.reserve(static_cast<std::size_t>(count.points));
  MeshGroup group;
  group.name = "copies";
  for (const Primitive& primitive : element.primitives) {
    CopyJoiner joiner(primitive.mesh, count.elements, division.size, job);
    const bool is_first = group.primitives.empty();
    for (const Affine& outer : around_of(instructions)) {
      each_division(
          outer, instructions, division.rounds, is_small, [&](const Affine& map) { joiner.add(map); },
          [&](const Affine& map) {
            if (is_first) points.position.push_back(glm::vec3(division.size * map.offset));
          });
    }
    group.primitives.push_back({joiner.take(), primitive.material, {}});
  }
  if (count.elements > 0) add_node(model, "copies", parent, add_mesh(model, std::move(group)));
  if (count.points > 0) add_node(model, "points", parent, add_mesh(model, "points", std::move(points), 0));
}

Mesh scattered(const Mesh& element, std::span<const glm::vec3> positions, double edge, Job& job) {
  job.spend(Resource::triangles, positions.size() * element.elements());
  CopyJoiner joiner(element, positions.size(), 1, job);
  for (const glm::vec3& position : positions) joiner.add({glm::dmat3(edge), glm::dvec3(position)});
  return joiner.take();
}

}  // namespace seedmesh::fractal

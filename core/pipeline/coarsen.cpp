#include "core/pipeline/coarsen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/geom/lod/simplify.h"
#include "core/geom/lod/thin.h"
#include "core/model/build.h"
#include "core/model/index_width.h"

namespace seedmesh {
namespace {

constexpr int attempts = 6;             ///< each with a smaller share, because some meshes lose too little
constexpr double largest_piece = 0.01;  ///< that may be removed: root of its area, as a share of the diagonal

bool is_packed(const MeshGroup& group) {
  return std::ranges::any_of(group.primitives,
                             [](const Primitive& each) { return each.mesh.packed != nullptr; });
}

std::uint64_t copies_of(const Node& node) {
  return std::max<std::size_t>(1, node.instances.transforms.size());
}

/// Meshes that are simplified together, so that their common borders still match.
struct MeshFamily {
  std::vector<Mesh*> meshes;
  std::vector<bool> foliage;  ///< for each mesh: it is thinned out instead
};

/// All meshes that are shown once and untransformed form one family; every other mesh forms its own. Meshes
/// that a finer level also shows belong to none.
std::vector<MeshFamily> families_of(Model& model, std::size_t level, bool leaves, const Job& job) {
  std::vector<std::uint64_t> uses(model.meshes.size(), 0);
  std::vector<bool> plain(model.nodes.size()), together(model.meshes.size(), false);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    plain[i] =
        is_identity(node.transform) && (node.parent < 0 || plain[static_cast<std::size_t>(node.parent)]);
    if (node.mesh < 0 || node.lods.size() < level) continue;
    const auto shown = static_cast<std::size_t>(mesh_at(node, level));
    uses[shown] += copies_of(node);
    together[shown] = plain[i] && node.instances.transforms.empty();
  }
  std::vector<MeshFamily> families(1);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] == 0) continue;
    const bool joins = uses[i] == 1 && together[i];
    if (!joins) families.emplace_back();
    MeshFamily& family = joins ? families.front() : families.back();
    for (Primitive& primitive : model.meshes[i].primitives) {
      if (primitive.mesh.topology != Topology::triangles) continue;
      family.meshes.push_back(&primitive.mesh);
      family.foliage.push_back(leaves && is_foliage(primitive.mesh, job));
    }
  }
  return families;
}

std::uint64_t share_of(std::uint64_t triangles, double share) {
  return static_cast<std::uint64_t>(static_cast<double>(triangles) * share);
}

std::uint64_t triangles_of(const MeshFamily& family, bool foliage) {
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; i < family.meshes.size(); ++i) {
    if (family.foliage[i] == foliage) triangles += family.meshes[i]->elements();
  }
  return triangles;
}

std::uint64_t elements_of(const MeshFamily& family) {
  return triangles_of(family, true) + triangles_of(family, false);
}

/// Limits of what is removed: cost of an edge collapse, area of a piece.
struct Detail {
  double cost = std::numeric_limits<double>::infinity(), area = std::numeric_limits<double>::infinity();
};

/// Simplifies all meshes but foliage to `wanted` triangles, and removes their smallest pieces where that is
/// not enough.
void coarsen_limbs(MeshFamily& family, std::uint64_t wanted, const Detail& detail, Job& job) {
  const std::uint64_t leaves = triangles_of(family, true);
  const std::uint64_t left =
      simplify(family.meshes, leaves + wanted, family.foliage, job, detail.cost) - leaves;
  if (left <= wanted) return;
  const double further = static_cast<double>(wanted) / static_cast<double>(left);
  for (std::size_t i = 0; i < family.meshes.size(); ++i) {
    Mesh& mesh = *family.meshes[i];
    if (!family.foliage[i]) drop_smallest_pieces(mesh, share_of(mesh.elements(), further), job, detail.area);
  }
}

/// Reduces a family to `share` of its triangles. Where limbs cannot lose enough, leaves lose more, down to a
/// tenth of their share.
void coarsen(MeshFamily& family, double share, const Detail& detail, Job& job) {
  const std::uint64_t leaves = triangles_of(family, true), limbs = triangles_of(family, false);
  if (limbs > 0) coarsen_limbs(family, share_of(limbs, share), detail, job);
  if (leaves == 0) return;
  const std::uint64_t total = share_of(leaves + limbs, share), left = triangles_of(family, false);
  const double rest = static_cast<double>(total > left ? total - left : 0) / static_cast<double>(leaves);
  const double kept = std::clamp(rest, share / 10, share);
  for (std::size_t i = 0; i < family.meshes.size(); ++i) {
    Mesh& mesh = *family.meshes[i];
    if (family.foliage[i]) thin_sheets(mesh, share_of(mesh.elements(), kept), job);
  }
}

Detail detail_of(const Model& model, const SimplifyLimits& limits) {
  if (!std::isfinite(limits.detail)) return {};
  const Box box = bounds_of(model);
  const auto diagonal = static_cast<double>(glm::distance(box.min, box.max));
  const double step = limits.detail * diagonal, piece = largest_piece * diagonal;
  return {step * step * step * step, piece * piece};
}

}  // namespace

MeshGroup copy_of(const MeshGroup& group) {
  MeshGroup out;
  out.name = group.name;
  for (const Primitive& each : group.primitives)
    out.primitives.push_back({copy_of(each.mesh), each.material, each.variant_materials});
  return out;
}

std::uint64_t drawn_at(const Model& model, std::size_t level) {
  std::uint64_t drawn = 0;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    drawn += copies_of(node) * triangles_of(model.meshes[static_cast<std::size_t>(mesh_at(node, level))]);
  }
  return drawn;
}

void coarsen_all(Model& model, std::size_t level, std::uint64_t most, std::uint64_t least,
                 const SimplifyLimits& limits, Job& job) {
  const Detail detail = detail_of(model, limits);
  std::vector<MeshFamily> families = families_of(model, level, limits.leaves, job);
  std::erase_if(families, [least](const MeshFamily& family) { return elements_of(family) < least; });
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::uint64_t before = drawn_at(model, level);
    if (before <= most) return;
    const double share = static_cast<double>(most) / static_cast<double>(before);
    for (MeshFamily& family : families) coarsen(family, share, detail, job);
    if (drawn_at(model, level) == before) return;
  }
}

bool coarsen_if_it_fits(Model& model, std::size_t level, std::uint64_t most, const SimplifyLimits& limits,
                        Job& job) {
  std::vector<std::optional<MeshGroup>> before(model.meshes.size());
  for (const Node& node : model.nodes) {
    const int shown = mesh_at(node, level);
    if (shown < 0 || before[static_cast<std::size_t>(shown)]) continue;
    const MeshGroup& group = model.meshes[static_cast<std::size_t>(shown)];
    if (!is_packed(group)) before[static_cast<std::size_t>(shown)] = copy_of(group);
  }
  const Detail detail = detail_of(model, limits);
  std::vector<MeshFamily> families = families_of(model, level, limits.leaves, job);
  std::uint64_t drawn = drawn_at(model, level);
  for (int attempt = 0; attempt < attempts && drawn > most; ++attempt) {
    const double share = static_cast<double>(most) / static_cast<double>(drawn);
    for (MeshFamily& family : families) coarsen(family, share, detail, job);
    const std::uint64_t left = drawn_at(model, level), lost = drawn - left;
    if (lost < (drawn - most) / 2) break;  // too slow to reach the budget
    drawn = left;
  }
  if (drawn <= most) return true;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i]) model.meshes[i] = *std::move(before[i]);
  }
  return false;
}

bool add_level(Model& model, std::uint64_t least, double share, const SimplifyLimits& limits, Job& job) {
  const std::size_t last = levels_of(model) - 1, meshes = model.meshes.size();
  const std::uint64_t drawn = drawn_at(model, last);
  std::vector<std::vector<int>> before;
  std::vector<int> next(meshes, -1);
  for (Node& node : model.nodes) {
    before.push_back(node.lods);
    if (node.mesh < 0 || node.collision != CollisionShape::none) continue;
    const int coarsest = mesh_at(node, last);
    if (coarsest < 0) continue;
    const MeshGroup& group = model.meshes[static_cast<std::size_t>(coarsest)];
    if (triangles_of(group) < least || is_packed(group)) continue;
    int& copy = next[static_cast<std::size_t>(coarsest)];
    if (copy < 0) copy = add_mesh(model, copy_of(group));
    node.lods.resize(last, coarsest);
    node.lods.push_back(copy);
  }
  if (levels_of(model) > last + 1) {
    coarsen_all(model, last + 1, drawn / 2, least, limits, job);
    if (static_cast<double>(drawn_at(model, last + 1)) <= share * static_cast<double>(drawn)) return true;
  }
  for (std::size_t i = 0; i < before.size(); ++i) model.nodes[i].lods = std::move(before[i]);
  model.meshes.resize(meshes);
  return false;
}

}  // namespace seedmesh

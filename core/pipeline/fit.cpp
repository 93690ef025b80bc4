#include "core/pipeline/fit.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/geom/simplify.h"
#include "core/geom/thin.h"
#include "core/model/levels.h"
#include "core/model/widen.h"

namespace seedmesh {
namespace {

constexpr const char* pointer = "/output/max_triangles";
constexpr int attempts = 6;  ///< at a smaller share each time, where some meshes cannot do theirs

std::uint64_t triangles_of(const MeshGroup& group) {
  std::uint64_t triangles = 0;
  for (const Primitive& primitive : group.primitives) {
    if (primitive.mesh.topology == Topology::triangles) triangles += primitive.mesh.elements();
  }
  return triangles;
}

std::uint64_t copies_of(const Node& node) {
  return std::max<std::size_t>(1, node.instances.transforms.size());
}

std::uint64_t drawn_at(const Model& model, std::size_t level) {
  std::uint64_t drawn = 0;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    drawn += copies_of(node) * triangles_of(model.meshes[static_cast<std::size_t>(mesh_at(node, level))]);
  }
  return drawn;
}

/// `level` becomes the finest, with at most `lods` - 1 behind it; meshes that no node shows any more go.
void promote(Model& model, std::size_t level, std::size_t lods) {
  std::vector<bool> shown(model.meshes.size(), false);
  for (Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const std::size_t passed = std::min(level, node.lods.size());
    node.mesh = mesh_at(node, level);
    node.lods.erase(node.lods.begin(), node.lods.begin() + static_cast<std::ptrdiff_t>(passed));
    if (node.lods.size() > lods - 1) node.lods.resize(lods - 1);
    shown[static_cast<std::size_t>(node.mesh)] = true;
    for (const int lod : node.lods) shown[static_cast<std::size_t>(lod)] = true;
  }
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i]) model.meshes[i].primitives.clear();
  }
}

bool is_identity(const Transform& t) {
  return t.translation == glm::vec3(0) && t.rotation == glm::quat(1, 0, 0, 0) && t.scale == glm::vec3(1);
}

/// Meshes that are made simpler together, so that their common borders stay common.
struct Family {
  std::vector<Mesh*> meshes;
  std::vector<bool> foliage;  ///< of each: it loses leaves instead
};

/// All meshes that stand once and untransformed are one family; every other is one of its own.
std::vector<Family> families_of(Model& model, std::size_t level, const Job& job) {
  std::vector<std::uint64_t> uses(model.meshes.size(), 0);
  std::vector<bool> plain(model.nodes.size()), together(model.meshes.size(), false);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    plain[i] =
        is_identity(node.transform) && (node.parent < 0 || plain[static_cast<std::size_t>(node.parent)]);
    if (node.mesh < 0) continue;
    const auto shown = static_cast<std::size_t>(mesh_at(node, level));
    uses[shown] += copies_of(node);
    together[shown] = plain[i] && node.instances.transforms.empty();
  }
  std::vector<Family> families(1);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] == 0) continue;
    const bool joins = uses[i] == 1 && together[i];
    if (!joins) families.emplace_back();
    Family& family = joins ? families.front() : families.back();
    for (Primitive& primitive : model.meshes[i].primitives) {
      if (primitive.mesh.topology != Topology::triangles) continue;
      family.meshes.push_back(&primitive.mesh);
      family.foliage.push_back(is_foliage(primitive.mesh, job));
    }
  }
  return families;
}

std::uint64_t share_of(std::uint64_t triangles, double share) {
  return static_cast<std::uint64_t>(static_cast<double>(triangles) * share);
}

std::uint64_t triangles_of(const Family& family, bool foliage) {
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; i < family.meshes.size(); ++i) {
    if (family.foliage[i] == foliage) triangles += family.meshes[i]->elements();
  }
  return triangles;
}

/// What is no foliage, with at most `wanted` triangles if that can be: simpler, and without its smallest
/// pieces where that is not enough.
void coarsen_limbs(Family& family, std::uint64_t wanted, Job& job) {
  const std::uint64_t leaves = triangles_of(family, true);
  const std::uint64_t left = simplify(family.meshes, leaves + wanted, family.foliage, job) - leaves;
  if (left <= wanted) return;
  const double further = static_cast<double>(wanted) / static_cast<double>(left);
  for (std::size_t i = 0; i < family.meshes.size(); ++i) {
    Mesh& mesh = *family.meshes[i];
    if (!family.foliage[i]) drop_smallest_pieces(mesh, share_of(mesh.elements(), further), job);
  }
}

/// The family with `share` of its triangles. Leaves make up for limbs that could not lose as many, down to a
/// tenth of what was theirs.
void coarsen(Family& family, double share, Job& job) {
  const std::uint64_t leaves = triangles_of(family, true), limbs = triangles_of(family, false);
  if (limbs > 0) coarsen_limbs(family, share_of(limbs, share), job);
  if (leaves == 0) return;
  const std::uint64_t total = share_of(leaves + limbs, share), left = triangles_of(family, false);
  const double room = static_cast<double>(total > left ? total - left : 0) / static_cast<double>(leaves);
  const double kept = std::clamp(room, share / 10, share);
  for (std::size_t i = 0; i < family.meshes.size(); ++i) {
    Mesh& mesh = *family.meshes[i];
    if (family.foliage[i]) thin_sheets(mesh, share_of(mesh.elements(), kept), job);
  }
}

/// Every family gives up the same share of its triangles of a level; again where some could not.
void coarsen_all(Model& model, std::size_t level, std::uint64_t most, Job& job) {
  std::vector<Family> families = families_of(model, level, job);
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::uint64_t before = drawn_at(model, level);
    if (before <= most) return;
    const double share = static_cast<double>(most) / static_cast<double>(before);
    for (Family& family : families) coarsen(family, share, job);
    if (drawn_at(model, level) == before) return;
  }
}

MeshGroup copy_of(const MeshGroup& group) {
  MeshGroup out;
  out.name = group.name;
  for (const Primitive& each : group.primitives)
    out.primitives.push_back({copy_of(each.mesh), each.material, each.variant_materials});
  return out;
}

/// One more level behind the coarsest, of half its triangles. False where it cannot be made coarser.
bool deepen(Model& model, Job& job) {
  const std::size_t last = levels_of(model) - 1;
  const std::uint64_t drawn = drawn_at(model, last);
  std::vector<int> next(model.meshes.size(), -1);
  for (Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const int coarsest = mesh_at(node, last);
    int& copy = next[static_cast<std::size_t>(coarsest)];
    if (copy < 0) {
      copy = static_cast<int>(model.meshes.size());
      model.meshes.push_back(copy_of(model.meshes[static_cast<std::size_t>(coarsest)]));
    }
    node.lods.resize(last, coarsest);
    node.lods.push_back(copy);
  }
  coarsen_all(model, last + 1, drawn / 2, job);
  return drawn_at(model, last + 1) < drawn;
}

}  // namespace

std::optional<Issue> fit(Model& model, std::uint64_t most, int lods, Job& job) {
  widen(model, job);
  const auto wanted = static_cast<std::size_t>(lods);
  const std::size_t levels = levels_of(model);
  std::size_t level = 0;
  while (level + 1 < levels && drawn_at(model, level) > most) ++level;
  promote(model, level, wanted);
  if (drawn_at(model, 0) > most) coarsen_all(model, 0, most, job);
  const std::uint64_t drawn = drawn_at(model, 0);
  if (drawn > most) {
    return Issue{pointer, "the model has " + std::to_string(drawn) +
                              " triangles where it is coarsest; found a budget of " + std::to_string(most)};
  }
  while (levels_of(model) < std::min(wanted, levels)) {
    const std::size_t last = levels_of(model) - 1;
    if (deepen(model, job)) continue;
    return Issue{pointer, "the model cannot have fewer than the " + std::to_string(drawn_at(model, last)) +
                              " triangles of its level " + std::to_string(last) +
                              " within this budget; found " + std::to_string(lods) + " levels wanted"};
  }
  return std::nullopt;
}

}  // namespace seedmesh

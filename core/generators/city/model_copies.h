#pragma once
/// Adds models with many copies to the model of a city: houses, landmarks, furniture and trees.
#include <optional>
#include <string>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/city/chunks.h"
#include "core/generators/city/merged_copies.h"

namespace seedmesh::city {

/// The levels of detail of a model.
struct LevelInfo {
  std::vector<std::uint64_t> triangles;  ///< finest first
  double radius = 0;                     ///< radius of the bounding sphere, metres
  double middle = 0;                     ///< height of the centre of that sphere, metres
};

/// The camera of the request. It chooses the level of each copy by the share of the screen's height that the copy
/// fills, as scenes do.
class ViewPoint {
 public:
  explicit ViewPoint(const CityParams& params);

  /// Whether the request has a camera.
  bool is_given() const { return half_height_ > 0; }
  /// Returns the level of a copy; 0 without a camera. Level 0 is for shares of the screen's height from 0.5, level 1
  /// from 0.25, 2 from 0.12, 3 from 0.06; level 4 is for smaller ones.
  std::size_t level(const LevelInfo& info, const Transform& at) const;

 private:
  glm::dvec3 at_{0};
  double half_height_ = 0;
};

/// Returns the number of levels that models of a city need.
int level_count(const ViewPoint& view, const Demand& demand);

struct Copy {
  Transform at;
  std::uint32_t chunk = 0;
};

/// Writes models and their copies into the model of a city.
class CopyWriter {
 public:
  CopyWriter(Model& city, ChunkNodes& nodes, const ViewPoint& view, const GenerateContext& context)
      : city_(city), nodes_(nodes), view_(view), context_(context) {}

  enum class Bodies { none, boxes };

  /// From now on, models with a single copy are merged by chunk and material, without levels, until write_merged().
  void merge_single() { merged_.emplace(context_.job); }
  /// Writes what was merged as meshes of this name.
  void write_merged(const char* group, const char* name);

  /// Adds a model below the group of each chunk. Spends the triangles of all copies except one. With Bodies::boxes, each
  /// copy gets a collision box if the output has collision bodies.
  void add(Model made, const std::string& name, const char* group, const std::vector<Copy>& copies,
           Bodies bodies);

 private:
  int add_material(Material material, const Model& made);
  int add_level(std::string name, std::vector<Primitive> primitives, const std::vector<int>& materials);
  void add_bodies(int mesh, const char* group, const std::vector<Copy>& copies);
  void merge(const std::vector<std::vector<Primitive>>& levels, const std::vector<int>& materials,
             const Copy& copy);

  Model& city_;
  ChunkNodes& nodes_;
  const ViewPoint& view_;
  const GenerateContext& context_;
  std::optional<MergedCopies> merged_;
};

/// Measures the levels of a model, and destroys the model.
LevelInfo level_info_of(Model made, Job& job);

}  // namespace seedmesh::city

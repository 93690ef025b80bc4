#pragma once
/// The division of a city's model into chunks, and the nodes that have their contents.
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <utility>

#include "core/generators/city/plan.h"
#include "core/model/model.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Adds a node without a mesh and returns its number.
int add_node(Model& model, std::string name, int parent);

/// The chunks of a city: its blocks, or squares, as the request selects.
class Chunks {
 public:
  Chunks(const CityPlan& plan, const CityParams& params);

  /// Returns the chunk of a position in metres; `block` is no_index in the street space. Returns 0 if the city is
  /// not divided.
  std::uint32_t at(const glm::dvec2& metres, std::uint32_t block) const;
  /// Returns the chunk of a part, by the middle of its outline.
  std::uint32_t of(const Part& part) const;

  bool is_divided() const { return by_ != By::nothing; }
  std::string name(std::uint32_t chunk) const;

 private:
  enum class By { nothing, blocks, squares };
  By by_ = By::nothing;
  glm::dvec2 low_{0};
  double size_ = 1;
  std::uint32_t columns_ = 1, rows_ = 1;
};

/// The nodes of chunks and of groups inside them, made at their first use.
class ChunkNodes {
 public:
  ChunkNodes(Model& model, const Chunks& chunks) : model_(model), chunks_(chunks) {}

  /// Returns the node "city" > chunk > group, or "city" > group where the city is not divided.
  int group(std::uint32_t chunk, const char* name);
  /// Returns the node of the chunk, or of the city.
  int chunk(std::uint32_t chunk);
  const Chunks& chunks() const { return chunks_; }

 private:
  Model& model_;
  const Chunks& chunks_;
  std::map<std::pair<std::uint32_t, std::string>, int> nodes_;
};

}  // namespace seedmesh::city

#include "core/generators/city/chunks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/math.h"
#include "generated/params/city.h"

namespace seedmesh::city {

int add_node(Model& model, std::string name, int parent) {
  Node node;
  node.name = std::move(name);
  node.parent = parent;
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

Chunks::Chunks(const CityPlan& plan, const CityParams& params) {
  if (!params.chunks) return;
  by_ = params.chunks->by == CityBy::blocks ? By::blocks : By::squares;
  size_ = params.chunks->size;
  glm::dvec2 high = low_ = in_metres(plan.area[0][0]);
  for (const CmPoint& p : plan.area[0]) {
    low_ = glm::min(low_, in_metres(p));
    high = glm::max(high, in_metres(p));
  }
  const auto count = [this](double extent) {
    return std::max(1U, math::to_uint32(std::ceil(extent / size_)));
  };
  columns_ = count(high.x - low_.x);
  rows_ = count(high.y - low_.y);
}

std::uint32_t Chunks::at(const glm::dvec2& metres, std::uint32_t block) const {
  if (by_ == By::nothing) return 0;
  if (by_ == By::blocks) return block == no_index ? 0 : block + 1;
  const auto cell = [this](double offset, std::uint32_t count) {
    return math::to_uint32(std::clamp(std::floor(offset / size_), 0.0, count - 1.0));
  };
  return cell(metres.y - low_.y, rows_) * columns_ + cell(metres.x - low_.x, columns_);
}

std::uint32_t Chunks::of(const Part& part) const {
  if (by_ == By::nothing) return 0;
  glm::dvec2 sum{0};
  for (const CmPoint& p : part.rings[0]) sum += in_metres(p);
  return at(sum / static_cast<double>(part.rings[0].size()), part.block);
}

std::string Chunks::name(std::uint32_t chunk) const {
  if (by_ == By::blocks) return chunk == 0 ? "streets" : "block_" + std::to_string(chunk - 1);
  return "chunk_" + std::to_string(chunk % columns_) + "_" + std::to_string(chunk / columns_);
}

int ChunkNodes::chunk(std::uint32_t chunk) {
  if (!chunks_.is_divided()) return 0;
  const auto [at, is_new] = nodes_.try_emplace({chunk, std::string()}, 0);
  if (is_new) at->second = add_node(model_, chunks_.name(chunk), 0);
  return at->second;
}

int ChunkNodes::group(std::uint32_t chunk, const char* name) {
  const auto found = nodes_.find({chunk, name});
  if (found != nodes_.end()) return found->second;
  const int node = add_node(model_, name, this->chunk(chunk));
  nodes_[{chunk, name}] = node;
  return node;
}

}  // namespace seedmesh::city

#include "core/generators/terrain/layers.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <memory>
#include <utility>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/terrain/height_expression.h"
#include "core/generators/terrain/layer_algorithms.h"
#include "core/generators/terrain/plan.h"
#include "core/lang/text_positions.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t width = lang::RowEvaluator::width;
constexpr std::size_t blocks_a_chunk = 32;
constexpr double highest = 1e7;  // metres

/// Slots of expressions; those of earlier layers follow.
enum Slot : std::uint32_t {
  slot_x,
  slot_y,
  slot_z,
  slot_latitude,
  slot_longitude,
  slot_height,
  slot_slope,
  slot_layers
};

using Source = TerrainLayerAlgorithm;

std::string pointer_of(std::size_t layer, const char* member) {
  return "/layers/" + std::to_string(layer) + "/" + member;
}

/// The names that an expression may use: that of the terrain itself has no heights yet.
lang::Names names_of(const TerrainParams& params, std::size_t layers_before, bool is_layer) {
  lang::Names names;
  names.bind_constant("size", params.size);
  names.bind_slot("x", slot_x);
  names.bind_slot("y", slot_y);
  const bool is_sphere = params.shape == TerrainShape::sphere;
  if (is_sphere) {
    names.bind_slot("z", slot_z);
    names.bind_slot("latitude", slot_latitude);
    names.bind_slot("longitude", slot_longitude);
  }
  if (!is_layer) return names;
  names.bind_slot("height", slot_height);
  if (!is_sphere) names.bind_slot("slope", slot_slope);
  for (std::size_t i = 0; i < layers_before; ++i) {
    if (params.layers[i].name)
      names.bind_slot(*params.layers[i].name, slot_layers + static_cast<std::uint32_t>(i));
  }
  return names;
}

std::unique_ptr<HeightExpression> compiled(const TerrainParams& params, const std::string& text,
                                           std::size_t layers_before, bool is_layer,
                                           std::vector<lang::TextError>& errors) {
  const auto slots = slot_layers + static_cast<std::uint32_t>(params.layers.size());
  return std::make_unique<HeightExpression>(text, names_of(params, layers_before, is_layer), slots, errors);
}

/// An expression whose text has been checked.
std::unique_ptr<HeightExpression> checked(const TerrainParams& params, const std::string& text,
                                          std::size_t layers_before, bool is_layer) {
  std::vector<lang::TextError> none;
  return compiled(params, text, layers_before, is_layer, none);
}

/// Where a name exists that the expression cannot use; `behind` begins with an unknown name.
const char* hint_of(const TerrainParams& params, std::string_view behind) {
  const auto is_name = [&](std::string_view name) {
    const auto next = static_cast<unsigned char>(behind.size() > name.size() ? behind[name.size()] : ' ');
    return behind.starts_with(name) && next != '_' && next != '(' && std::isalnum(next) == 0;
  };
  const bool is_plane = params.shape != TerrainShape::sphere;
  if (is_plane && is_name("z")) return "; a plane has x, to the east, and y, to the north";
  if (is_plane && (is_name("latitude") || is_name("longitude"))) return "; only the shape sphere has it";
  if (!is_plane && is_name("slope")) return "; a sphere has no slope";
  if (is_name("height") || is_name("slope")) return "; only the expressions of layers have it";
  return "";
}

void check_text(const TerrainParams& params, const std::string& text, const std::string& pointer,
                std::size_t layer, bool is_layer, std::vector<Issue>& issues) {
  std::vector<lang::TextError> errors;
  compiled(params, text, layer, is_layer, errors);
  for (lang::TextError& error : errors) {
    if (error.kind != IssueKind::unknown_name) continue;
    const std::string_view hint = hint_of(params, std::string_view(text).substr(error.offset));
    if (!hint.empty()) error.message = error.message.substr(0, error.message.find("; did you")).append(hint);
  }
  lang::add_issues(pointer, text, errors, issues);
}

/// Rows of slots, and the row of results, of one thread.
class Rows {
 public:
  explicit Rows(std::size_t layers)
      : values_((slot_layers + layers + 1) * width), slots_(slot_layers + layers), rngs_(width, Rng(0)) {
    for (std::size_t i = 0; i < slots_.size(); ++i) slots_[i] = values_.data() + i * width;
  }
  double* of(std::size_t slot) { return values_.data() + slot * width; }
  std::vector<Rng>& rngs() { return rngs_; }
  double* run(HeightRows& rows, std::size_t count) {
    double* const result = of(slots_.size());
    rows.run(slots_, count, {rngs_.data(), count}, result);
    return result;
  }
  void take(std::size_t slot, const float* from, std::size_t count) {
    double* const to = of(slot);
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<double>(from[i]);
  }

 private:
  std::vector<double> values_;
  std::vector<const double*> slots_;
  std::vector<Rng> rngs_;
};

/// What the expressions of one layer are evaluated on: the samples of a field, or the points of a sphere, in blocks.
struct Ground {
  const TerrainParams& params;
  const Job& job;
  Rng rng;
  const Window* window = nullptr;  ///< null: a sphere
  double cell = 1;
  const Planet* planet = nullptr;
  const Array<float>* height = nullptr;               ///< so far; null: none yet
  const Array<float>* slope = nullptr;                ///< in degrees; null: not needed
  const std::vector<Array<float>>* layers = nullptr;  ///< of earlier named layers

  std::size_t blocks_a_row() const { return (static_cast<std::size_t>(window->width) + width - 1) / width; }
  std::size_t blocks() const {
    if (window != nullptr) return blocks_a_row() * static_cast<std::size_t>(window->depth);
    return (planet->direction.size() + width - 1) / width;
  }
};

/// The first sample of a block, and their number.
struct Block {
  std::size_t first = 0, count = 0;
  std::int64_t x = 0, z = 0;  ///< of the first sample, in the world
};

Block block_of(const Ground& ground, std::size_t index) {
  if (ground.window == nullptr) {
    const std::size_t first = index * width;
    return {first, std::min(width, ground.planet->direction.size() - first), 0, 0};
  }
  const Window& window = *ground.window;
  const std::size_t row = index / ground.blocks_a_row(), column = index % ground.blocks_a_row() * width;
  const auto wide = static_cast<std::size_t>(window.width);
  return {row * wide + column, std::min(width, wide - column), window.x + static_cast<std::int64_t>(column),
          window.z + static_cast<std::int64_t>(row)};
}

std::uint64_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }

void fill_plane(const Ground& ground, const Block& block, bool draws, Rows& rows) {
  const bool is_image = ground.params.algorithm == TerrainAlgorithm::image;
  const double half = ground.params.size / 2;
  const double north = is_image ? ground.cell * (ground.window->depth - 1) / 2 : half;
  double *const x = rows.of(slot_x), *const y = rows.of(slot_y);
  for (std::size_t i = 0; i < block.count; ++i) {
    x[i] = static_cast<double>(block.x + static_cast<std::int64_t>(i)) * ground.cell - half;
    y[i] = north - static_cast<double>(block.z) * ground.cell;
  }
  if (!draws) return;
  const Rng row = ground.rng.at("cell").at(static_cast<std::uint64_t>(block.z));
  for (std::size_t i = 0; i < block.count; ++i)
    rows.rngs()[i] = row.at(static_cast<std::uint64_t>(block.x + static_cast<std::int64_t>(i)));
}

void fill_sphere(const Ground& ground, const Block& block, const HeightExpression& expression, Rows& rows) {
  const bool has_angles = expression.uses("latitude") || expression.uses("longitude");
  const bool draws = expression.draws();
  for (std::size_t i = 0; i < block.count; ++i) {
    const glm::vec3& d = ground.planet->direction[block.first + i];
    const glm::dvec3 unit(d), position = unit * ground.planet->radius;
    for (const Slot slot : {slot_x, slot_y, slot_z}) rows.of(slot)[i] = position[static_cast<int>(slot)];
    if (has_angles) {
      rows.of(slot_latitude)[i] = math::degrees(math::asin(std::clamp(unit.y, -1.0, 1.0)));
      rows.of(slot_longitude)[i] = math::degrees(math::atan2(unit.x, unit.z));
    }
    if (draws) rows.rngs()[i] = ground.rng.at("cell").at(bits_of(d.x)).at(bits_of(d.y)).at(bits_of(d.z));
  }
}

/// An expression and where the request has it.
struct PlacedText {
  const HeightExpression& expression;
  std::string_view text;
  std::string pointer;
};

/// Refuses the request if a value is not finite. The position is that of the text, not of an operator.
void refuse_invalid(const Ground& ground, const PlacedText& placed, std::span<const double> values) {
  const auto found = std::ranges::find_if(values, [](double value) { return !(std::abs(value) <= highest); });
  if (found == values.end()) return;
  ground.job.refuse(issue_at(IssueKind::evaluation, placed.pointer, placed.text, 0,
                             "gives a value that is not finite, or beyond 10,000,000, at some samples"));
}

/// Calls use(first sample, number, values) for each block of samples.
template <class Use>
void each_block(const Ground& ground, const PlacedText& placed, const Use& use) {
  const HeightExpression& expression = placed.expression;
  const bool draws = expression.draws(), has_slope = ground.slope != nullptr && expression.uses("slope");
  parallel_for(ground.job, ground.blocks(), blocks_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 Rows rows(ground.params.layers.size());
                 HeightRows evaluator(expression, ground.rng.at("noise"));
                 for (std::size_t index = begin; index < end; ++index) {
                   ground.job.check();
                   const Block block = block_of(ground, index);
                   ground.window != nullptr ? fill_plane(ground, block, draws, rows)
                                            : fill_sphere(ground, block, expression, rows);
                   if (ground.height != nullptr)
                     rows.take(slot_height, ground.height->data() + block.first, block.count);
                   if (has_slope) rows.take(slot_slope, ground.slope->data() + block.first, block.count);
                   for (std::size_t i = 0; ground.layers != nullptr && i < ground.layers->size(); ++i) {
                     const Array<float>& layer = (*ground.layers)[i];
                     if (!layer.empty()) rows.take(slot_layers + i, layer.data() + block.first, block.count);
                   }
                   const double* const values = rows.run(evaluator, block.count);
                   refuse_invalid(ground, placed, {values, block.count});
                   use(block.first, block.count, values);
                 }
               });
}

/// Slopes in degrees by the differences to the neighbours; at the border to the only one.
Array<float> slopes_of(const Array<float>& height, const Window& window, double cell, const Job& job) {
  Array<float> slope(job, height.size(), 0.0F);
  const auto wide = static_cast<std::size_t>(window.width), deep = static_cast<std::size_t>(window.depth);
  parallel_for(job, deep, 32, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t z = begin; z < end; ++z) {
      job.check();
      const std::size_t north = z > 0 ? z - 1 : z, south = z + 1 < deep ? z + 1 : z;
      for (std::size_t x = 0; x < wide; ++x) {
        const std::size_t west = x > 0 ? x - 1 : x, east = x + 1 < wide ? x + 1 : x;
        const double dx = (double{height[z * wide + east]} - double{height[z * wide + west]}) /
                          (cell * static_cast<double>(std::max<std::size_t>(east - west, 1)));
        const double dz = (double{height[south * wide + x]} - double{height[north * wide + x]}) /
                          (cell * static_cast<double>(std::max<std::size_t>(south - north, 1)));
        slope[z * wide + x] = static_cast<float>(math::degrees(math::atan2(std::sqrt(dx * dx + dz * dz), 1)));
      }
    }
  });
  return slope;
}

double combined(TerrainCombine combine, double height, double own) {
  switch (combine) {
    case TerrainCombine::add:
      return height + own;
    case TerrainCombine::subtract:
      return height - own;
    case TerrainCombine::multiply:
      return height * own;
    case TerrainCombine::max:
      return std::max(height, own);
    case TerrainCombine::min:
      return std::min(height, own);
    case TerrainCombine::replace:
      return own;
    case TerrainCombine::none:
      break;
  }
  return height;
}

/// Combines layers with `height`. make(layer, its stream) gives the heights of an algorithm.
template <class Make>
void combine_layers(Ground ground, Array<float>& height, const Make& make) {
  const TerrainParams& params = ground.params;
  const Rng all = ground.rng;
  std::vector<Array<float>> kept(params.layers.size());
  ground.layers = &kept;
  ground.height = &height;
  for (std::size_t i = 0; i < params.layers.size(); ++i) {
    const TerrainLayer& layer = params.layers[i];
    ground.rng = all.at("layer").at(i);
    std::unique_ptr<HeightExpression> text, mask;
    if (layer.expression) text = checked(params, *layer.expression, i, true);
    if (layer.mask) mask = checked(params, *layer.mask, i, true);
    Array<float> slope;
    const bool needs_slope = (text && text->uses("slope")) || (mask && mask->uses("slope"));
    if (needs_slope && ground.window != nullptr) {
      slope = slopes_of(height, *ground.window, ground.cell, ground.job);
      ground.slope = &slope;
    }
    Array<float> own;
    if (text) {
      own = Array<float>(ground.job, height.size());
      each_block(ground, {*text, *layer.expression, pointer_of(i, "expression")},
                 [&](std::size_t first, std::size_t count, const double* values) {
                   for (std::size_t k = 0; k < count; ++k) own[first + k] = static_cast<float>(values[k]);
                 });
    } else {
      own = make(layer, ground.rng);
    }
    const auto blend = [&](std::size_t k, double share) {
      const double before = double{height[k]};
      const double after = combined(layer.combine, before, double{own[k]});
      height[k] = static_cast<float>(before + (after - before) * share);
    };
    if (mask) {
      each_block(ground, {*mask, *layer.mask, pointer_of(i, "mask")},
                 [&](std::size_t first, std::size_t count, const double* values) {
                   for (std::size_t k = 0; k < count; ++k) blend(first + k, std::clamp(values[k], 0.0, 1.0));
                 });
    } else {
      for (std::size_t k = 0; k < height.size(); ++k) {
        if (k % 65'536 == 0) ground.job.check();
        blend(k, 1);
      }
    }
    if (layer.name) kept[i] = std::move(own);
  }
}

void check_layer(const TerrainParams& params, std::size_t index, std::vector<Issue>& issues) {
  const TerrainLayer& layer = params.layers[index];
  const bool is_text = layer.layer_algorithm == Source::expression;
  if (is_text && !layer.expression) {
    issues.emplace_back(missing_for({"expression", "algorithm"}), "/layers/" + std::to_string(index),
                        "\"expression\" is missing; the algorithm expression takes its heights from it");
  }
  check_layer_algorithm(params, index, issues);
  if (layer.expression && is_text)
    check_text(params, *layer.expression, pointer_of(index, "expression"), index, true, issues);
  if (layer.mask) check_text(params, *layer.mask, pointer_of(index, "mask"), index, true, issues);
}

}  // namespace

std::vector<Issue> layer_errors(const TerrainParams& params) {
  std::vector<Issue> issues;
  if (params.expression && params.algorithm == TerrainAlgorithm::expression)
    check_text(params, *params.expression, "/expression", 0, false, issues);
  for (std::size_t i = 0; i < params.layers.size(); ++i) check_layer(params, i, issues);
  return issues;
}

Field expressed_field(const TerrainParams& params, const Window& window, double cell, Rng rng,
                      const Job& job) {
  Field field(job, window.width, window.depth, 0);
  const auto text = checked(params, *params.expression, 0, false);
  const Ground ground{params, job, rng, &window, cell};
  each_block(ground, {*text, *params.expression, "/expression"},
             [&](std::size_t first, std::size_t count, const double* values) {
               for (std::size_t k = 0; k < count; ++k)
                 field.heights[first + k] = static_cast<float>(values[k]);
             });
  return field;
}

void add_layers(const TerrainParams& params, Field& field, const Window& window, double cell, Rng rng,
                const Job& job) {
  if (params.layers.empty()) return;
  combine_layers({params, job, rng, &window, cell}, field.heights, [&](const TerrainLayer& layer, Rng own) {
    return std::move(layer_field(params, layer, window, {cell, own}, job).heights);
  });
}

void express_sphere(const TerrainParams& params, Planet& planet, Rng rng, const Job& job) {
  const auto text = checked(params, *params.expression, 0, false);
  Ground ground{params, job, rng};
  ground.planet = &planet;
  each_block(ground, {*text, *params.expression, "/expression"},
             [&](std::size_t first, std::size_t count, const double* values) {
               for (std::size_t k = 0; k < count; ++k)
                 planet.height[first + k] = static_cast<float>(values[k]);
             });
}

void add_layers(const TerrainParams& params, Planet& planet, Rng rng, const Job& job) {
  if (params.layers.empty()) return;
  Ground ground{params, job, rng};
  ground.planet = &planet;
  combine_layers(ground, planet.height, [&](const TerrainLayer& layer, Rng own) {
    // The algorithm writes the heights of the sphere, so the heights so far are put aside.
    Array<float> before = std::exchange(planet.height, Array<float>(job, planet.height.size(), 0.0F));
    layer_sphere(params, layer, planet, own, job);
    return std::exchange(planet.height, std::move(before));
  });
}

}  // namespace seedmesh::terrain

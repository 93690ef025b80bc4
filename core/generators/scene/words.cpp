#include "core/generators/scene/words.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/generators/child.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t longest_word = std::size_t{64} << 10U, longest_sum = std::size_t{16} << 20U;

std::uint64_t count_of(const Json& counts, const char* symbol) {
  const auto found = counts.find(symbol);
  return found == counts.end() ? 0 : found->get<std::uint64_t>();
}

std::uint64_t deepest_bracket(std::string_view word) {
  std::uint64_t depth = 0, deepest = 0;
  for (const char c : word) {
    if (c == '[') deepest = std::max(deepest, ++depth);
    if (c == ']' && depth > 0) --depth;
  }
  return deepest;
}

std::vector<bool> placed_variants(const ScenePlacements& all_placements, const VariantTable& variant_table) {
  std::vector<bool> placed(variant_table.variants.size());
  for (std::size_t layer = 0; layer < all_placements.layers.size(); ++layer) {
    for (const Placement& placement : all_placements.layers[layer])
      placed[variant_table.variant_at(layer, placement)] = true;
  }
  return placed;
}

}  // namespace

Result<Json> words_of(const ScenePlacements& all_placements, const VariantTable& variant_table,
                      const GenerateContext& context) {
  const std::vector<bool> placed = placed_variants(all_placements, variant_table);
  std::size_t left = longest_sum;
  Json words = Json::object();
  for (std::size_t i = 0; i < variant_table.variants.size(); ++i) {
    const ModelVariant& variant = variant_table.variants[i];
    if (!placed[i] || variant.request.generator != "lsystem") continue;
    context.job.check();
    Result<Json> derived = derive_child(variant.request, variant.pointer, Rng(0), context);
    if (!derived) return derived;
    std::string word = derived->at("string");
    const bool is_cut = derived->at("truncated").get<bool>() || word.size() > std::min(longest_word, left);
    Json depth = nullptr;
    if (!is_cut) depth = deepest_bracket(word);
    word.resize(std::min({word.size(), longest_word, left}));
    left -= word.size();
    words[variant.name] = {{"string", std::move(word)},
                           {"truncated", is_cut},
                           {"length", derived->at("length")},
                           {"branches", count_of(derived->at("counts"), "[")},
                           {"depth", std::move(depth)}};
  }
  return words;
}

}  // namespace seedmesh::scene

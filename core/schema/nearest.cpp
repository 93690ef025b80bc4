#include "core/schema/nearest.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "core/schema/json.h"

namespace seedmesh::schema {
namespace {

constexpr std::size_t longest = 64;
using Row = std::array<std::size_t, longest + 1>;

/// Edits between `a` and `b`, neighbours swapped counting as one. Both at most `longest`.
std::size_t edits(std::string_view a, std::string_view b) {
  Row before{}, last{}, row{};
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U);
      row[j] = std::min({changed, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> words) {
  if (word.size() > longest) return {};
  std::string_view nearest;
  std::size_t fewest = std::min<std::size_t>(3, std::max<std::size_t>(1, word.size() / 3)) + 1;
  for (const std::string_view candidate : words) {
    if (candidate.size() > longest) continue;
    const std::size_t count = edits(word, candidate);
    if (count < fewest) {
      fewest = count;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string unknown_word(std::string_view what, std::string_view word,
                         std::span<const std::string_view> known) {
  std::string message = "there is no " + std::string(what) + " \"" + shortened(word, 40) + "\"";
  const std::string_view nearest = nearest_word(word, known);
  return nearest.empty() ? message : message + "; did you mean \"" + std::string(nearest) + "\"?";
}

}  // namespace seedmesh::schema

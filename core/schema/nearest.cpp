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

/// The Damerau distance of `a` and `b`, each of at most `longest` bytes.
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

/// The words without regard to case and to what joins their parts.
std::string plain(std::string_view word) {
  std::string text;
  for (const char c : word) {
    if (c == '_' || c == '-' || c == ' ') continue;
    text.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  }
  return text;
}

/// Other words for names of parameters and values.
constexpr std::pair<std::string_view, std::string_view> synonyms[] = {
    {"fall", "autumn"},
    {"octaves", "iterations"},
    {"generations", "iterations"},
    {"depth", "iterations"},
    {"steps", "iterations"},
    {"persistence", "hurst"},
    {"roughness", "hurst"},
    {"frequency", "wavelength"},
    {"scale", "size"},
    {"height", "amplitude"},
    {"rules", "productions"},
    {"productions", "rules"},
    {"start", "axiom"},
    {"axiom", "start"},
    {"thickness", "width"},
    {"segments", "sides"},
    {"method", "algorithm"},
    {"algorithm", "method"},
    {"type", "generator"},
    {"params", "parameters"},
    {"options", "output"},
    {"polygon", "footprint"},
    {"outline", "footprint"},
    {"binary", "glb"},
    {"height", "scale"},
    {"grid", "raster"},
    {"mandelbrot", "escape"},
    {"julia", "escape"},
    {"ifs", "mrcm"},
    {"plant", "tree"},
    {"rock", "terrain"},
    {"landscape", "terrain"},
    {"house", "building"},
    {"town", "city"},
    {"planet", "world"},
    {"forest", "scene"},
};

/// The candidate that `word` spells in other letters, or that it is a synonym of; empty if there is none.
std::string_view same_meaning(std::string_view word, std::span<const std::string_view> words) {
  const std::string own = plain(word);
  const auto find = [&](std::string_view wanted) {
    const auto found = std::find_if(words.begin(), words.end(),
                                    [&](std::string_view each) { return plain(each) == wanted; });
    return found == words.end() ? std::string_view() : *found;
  };
  if (const std::string_view same = find(own); !same.empty()) return same;
  for (const auto& [other, meant] : synonyms) {
    if (other != own) continue;
    if (const std::string_view same = find(meant); !same.empty()) return same;
  }
  return {};
}

/// The only candidate that begins with `own`, or with which `own` begins; empty if there is none, or several.
std::string_view only_continuation(const std::string& own, std::span<const std::string_view> words) {
  constexpr std::size_t least = 4;
  std::string_view only;
  for (const std::string_view each : words) {
    const std::string other = plain(each);
    if (std::min(own.size(), other.size()) < least || !(other.starts_with(own) || own.starts_with(other)))
      continue;
    if (!only.empty()) return {};
    only = each;
  }
  return only;
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> words) {
  if (word.size() > longest) return {};
  if (const std::string_view same = same_meaning(word, words); !same.empty()) return same;
  std::string_view nearest;
  const std::string own = plain(word);
  std::size_t fewest = std::min<std::size_t>(3, std::max<std::size_t>(1, word.size() / 3)) + 1;
  for (const std::string_view candidate : words) {
    if (candidate.size() > longest) continue;
    const std::size_t count = std::min(edits(word, candidate), edits(own, plain(candidate)));
    if (count < fewest) {
      fewest = count;
      nearest = candidate;
    }
  }
  return nearest.empty() ? only_continuation(own, words) : nearest;
}

std::string unknown_word_of_few(std::string_view what, std::string_view word,
                                std::span<const std::string_view> known) {
  std::string message = unknown_word(what, word, known);
  if (!nearest_word(word, known).empty()) return message;
  for (std::size_t i = 0; i < known.size(); ++i)
    message.append(i > 0 ? ", " : "; there are ").append(known[i]);
  return message;
}

std::string unknown_word(std::string_view what, std::string_view word,
                         std::span<const std::string_view> known) {
  std::string message = "there is no " + std::string(what) + " \"" + shortened(word, 40) + "\"";
  const std::string_view nearest = nearest_word(word, known);
  return nearest.empty() ? message : message + "; did you mean \"" + std::string(nearest) + "\"?";
}

}  // namespace seedmesh::schema

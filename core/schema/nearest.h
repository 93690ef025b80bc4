#pragma once
#include <span>
#include <string>
#include <string_view>

namespace seedmesh::schema {

/// The one of `words` that `word` is most likely a misspelling of, or empty: at most a third of its letters,
/// and never more than three, inserted, left out, changed or swapped with a neighbour (Damerau, "A technique
/// for computer detection and correction of spelling errors", 1964). The first of equals. Words beyond 64
/// bytes have no neighbours.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> words);

/// "there is no preset "ferm"; did you mean "fern"?"
std::string unknown_word(std::string_view what, std::string_view word,
                         std::span<const std::string_view> known);

}  // namespace seedmesh::schema

#pragma once
#include <span>
#include <string>
#include <string_view>

namespace seedmesh::schema {

/// Returns the one of `words` that `word` most likely means, or an empty text. It is a word that differs in case, "_"
/// and "-" only, or one that a short list of synonyms names, such as autumn for fall. Otherwise it is the word with
/// the smallest Damerau distance (insertions, deletions, changes, swaps of neighbours; Damerau, "A technique for
/// computer detection and correction of spelling errors", 1964), the first of several. The distance is at most a third
/// of the letters and at most 3. Words of more than 64 bytes are not compared. Cost: length squared for each word.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> words);

/// The message for a name that does not exist: there is no preset "ferm"; did you mean "fern"?
std::string unknown_word(std::string_view what, std::string_view word,
                         std::span<const std::string_view> known);

/// The same for a short list of words. If none is similar, the message ends with all: "; there are tree, scene".
std::string unknown_word_of_few(std::string_view what, std::string_view word,
                                std::span<const std::string_view> known);

}  // namespace seedmesh::schema

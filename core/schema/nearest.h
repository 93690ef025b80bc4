#pragma once
#include <span>
#include <string>
#include <string_view>

namespace seedmesh::schema {

/// Returns the one of `words` that `word` most likely means, or an empty text. These are tried in turn:
/// 1. a word that differs only in case, "_" and "-";
/// 2. a word of a short list of synonyms, such as autumn for fall;
/// 3. the word with the smallest Damerau distance, the first one of several. The distance counts insertions, deletions,
///    changes and swaps of neighbours (Damerau, "A technique for computer detection and correction of spelling errors",
///    1964). It is at most 3, and at most a third of the letters;
/// 4. the only word that begins with `word`, or with which `word` begins, if the shorter one has four letters.
/// Words of more than 64 bytes are not compared. Cost: length squared for each word.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> words);

/// The message for a name that does not exist: there is no preset "ferm"; did you mean "fern"?
std::string unknown_word(std::string_view what, std::string_view word,
                         std::span<const std::string_view> known);

/// The same for a short list of words. If none is similar, the message ends with all: "; there are tree, scene".
std::string unknown_word_of_few(std::string_view what, std::string_view word,
                                std::span<const std::string_view> known);

}  // namespace seedmesh::schema

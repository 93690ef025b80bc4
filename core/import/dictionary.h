#pragma once
/// Dictionaries of Python, as tree-gen and Sapling write them.
#include <cstddef>
#include <string>
#include <vector>

#include "core/import/foreign_text.h"

namespace seedmesh {

/// A value of the dictionary: numbers (True is 1), one without brackets.
struct DictionaryEntry {
  std::string name;
  std::size_t name_at = 0;
  std::vector<double> numbers;
  std::vector<std::size_t> at;  ///< of the numbers
  bool is_list = false;
};

/// Reads the first dictionary of a text, `{'shape': 7, ...}`. Texts count as the number that they state, or as 0. Errors
/// are reported at their position.
std::vector<DictionaryEntry> read_dictionary(ForeignText& source);

}  // namespace seedmesh

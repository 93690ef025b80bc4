#include "core/generators/building/value_tree.h"

#include "core/generators/building/tree_parser.h"

namespace seedmesh::building {

std::uint32_t parse_tree(Parser& p, std::size_t from, std::size_t to) {
  TreeParser parser(p, from, to);
  const std::uint32_t root = parser.value();
  parser.check_end();
  return root;
}

std::uint32_t parse_selector_tree(Parser& p, std::size_t from, std::size_t to) {
  TreeParser parser(p, from, to);
  parser.allow_selectors();
  const std::uint32_t root = parser.value();
  parser.check_end();
  return root;
}

}  // namespace seedmesh::building

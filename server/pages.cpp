#include "server/pages.h"

#include <algorithm>

#include "server/docs_page.h"

namespace seedmesh {

bool has_hashed_name(std::string_view path) {
  if (path.substr(0, 8) != "/assets/") return false;
  const auto dot = path.rfind('.');
  constexpr std::size_t hash_size = 8;
  if (dot == std::string_view::npos || dot < 8 + hash_size + 2 || path[dot - hash_size - 1] != '-')
    return false;
  const std::string_view hash = path.substr(dot - hash_size, hash_size);
  return std::all_of(hash.begin(), hash.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-';
  });
}

Pages::Pages() : docs_(docs_page()) {}

const Asset* Pages::find(std::string_view path) const {
  if (path == "/") path = "/index.html";
  const auto assets = embedded_assets();
  const auto found =
      std::find_if(assets.begin(), assets.end(), [&](const Asset& asset) { return asset.path == path; });
  return found == assets.end() ? nullptr : &*found;
}

}  // namespace seedmesh

#pragma once
/// What a browser gets: the web client's files, built into the program, and the documentation page.
#include <span>
#include <string>
#include <string_view>

namespace seedmesh {

/// A file that was built into the program (embed_assets.cpp).
struct Asset {
  std::string_view path;  ///< "/index.html", "/assets/main-1a2b3c4d.js"
  std::string_view type;
  std::string_view bytes;
  std::string_view gzip;  ///< "" where compression gains nothing
  std::string_view br;    ///< the same
};
std::span<const Asset> embedded_assets();

/// Whether the name carries a hash of its contents, as Vite names files: such a file never changes.
bool has_hashed_name(std::string_view path);

class Pages {
 public:
  Pages();
  const Asset* find(std::string_view path) const;  ///< "/" is the web client's page
  const std::string& docs() const { return docs_; }

 private:
  std::string docs_;
};

}  // namespace seedmesh

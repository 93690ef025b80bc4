#pragma once
/// Files for browsers: the web client, which is built into the program, and the documentation page.
#include <span>
#include <string>
#include <string_view>

namespace seedmesh {

/// A file of the web client, written by embed_assets.cpp.
struct Asset {
  std::string_view path;  ///< "/index.html", "/assets/main-1a2b3c4d.js"
  std::string_view type;
  std::string_view bytes;
  std::string_view gzip;  ///< `bytes` compressed; empty if that saves less than a tenth
  std::string_view br;    ///< the same with Brotli
};
/// Returns all files of the web client.
std::span<const Asset> embedded_assets();

/// Returns the pages of docs/ as Markdown, such as "/lsystem.md". Their `gzip` and `br` are empty.
std::span<const Asset> embedded_docs();

/// Whether the name contains a hash of the contents, as Vite names files. Such a file never changes.
bool has_hashed_name(std::string_view path);

class Pages {
 public:
  Pages();
  const Asset* find(std::string_view path) const;  ///< "/" means "/index.html"; null where there is no file
  const std::string& docs() const { return docs_; }

 private:
  std::string docs_;
};

}  // namespace seedmesh

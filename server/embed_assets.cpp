/// Build tool: embed_assets <folder> <out.cpp> [docs]
/// Writes every file of the folder as C++ string literals, with its media type and its gzip and Brotli forms.
/// With `docs`, writes only the pages (.md) of the folder itself, without coded forms.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>

#include "server/compress.h"

namespace {

std::string_view type_of(const std::string& extension) {
  static const std::map<std::string, std::string_view> types = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".webp", "image/webp"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".wasm", "application/wasm"},
      {".hdr", "image/vnd.radiance"},
      {".glb", "model/gltf-binary"},
      {".map", "application/json"},
      {".txt", "text/plain; charset=utf-8"},
  };
  const auto found = types.find(extension);
  return found == types.end() ? "application/octet-stream" : found->second;
}

/// The compressed form, or "" where it saves less than a tenth.
std::string compressed(seedmesh::Coding coding, const std::string& bytes) {
  std::string encoded = seedmesh::encode(coding, bytes, seedmesh::Effort::once);
  if (encoded.size() + encoded.size() / 10 > bytes.size()) encoded.clear();
  return encoded;
}

/// Writes a string view of a literal with octal escapes, in short lines, which compilers read quickly.
void write_literal(std::ofstream& out, std::string_view bytes) {
  out << "std::string_view(";
  if (bytes.empty()) out << "\"\"";
  for (std::size_t begin = 0; begin < bytes.size(); begin += 64) {
    out << "\n    \"";
    for (const char c : bytes.substr(begin, 64)) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte >= 0x20 && byte < 0x7F && c != '"' && c != '\\' && c != '?') {
        out << c;
      } else {
        char escape[8];
        std::snprintf(escape, sizeof(escape), "\\%03o", byte);
        out << escape;
      }
    }
    out << '"';
  }
  out << ", " << bytes.size() << ')';
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3 && count != 4) {
    std::fputs("usage: embed_assets <folder> <out.cpp> [docs]\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  const bool only_docs = count == 4;
  std::map<std::string, std::filesystem::path> files;  // sorted, so that the output is reproducible
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const bool is_page = entry.path().extension() == ".md" && entry.path().parent_path() == folder;
    if (entry.is_regular_file() && (!only_docs || is_page))
      files["/" + entry.path().lexically_relative(folder).generic_string()] = entry.path();
  }
  std::ofstream out(arguments[2]);
  out << "// Made by embed_assets. Do not edit.\n#include \"server/pages.h\"\n\nnamespace seedmesh "
         "{\n\n"
      << "std::span<const Asset> " << (only_docs ? "embedded_docs" : "embedded_assets")
      << "() {\n  static constexpr Asset assets[] = {\n";
  for (const auto& [name, path] : files) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    out << "    {\"" << name << "\", \"" << type_of(path.extension().string()) << "\", ";
    write_literal(out, bytes);
    out << ", ";
    write_literal(out, only_docs ? std::string() : compressed(seedmesh::Coding::gzip, bytes));
    out << ", ";
    write_literal(out, only_docs ? std::string() : compressed(seedmesh::Coding::br, bytes));
    out << "},\n";
  }
  out << "  };\n  return assets;\n}\n\n}  // namespace seedmesh\n";
  if (files.empty()) std::fprintf(stderr, "embed_assets: found no file in %s\n", arguments[1]);
  if (!out.good()) std::fprintf(stderr, "embed_assets: cannot write %s\n", arguments[2]);
  return files.empty() || !out.good() ? 1 : 0;
}

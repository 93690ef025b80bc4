/// Host tool:  embed_assets <folder> <out.cpp>
/// Writes every file of the folder as C++ string literals, with its media type and its forms in gzip and br.
#include <brotli/encode.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>

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

std::string gzip(const std::string& bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY) != Z_OK) return {};
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string brotli(const std::string& bytes) {
  std::size_t size = BrotliEncoderMaxCompressedSize(bytes.size());
  std::string out(size, '\0');
  if (!BrotliEncoderCompress(BROTLI_MAX_QUALITY, BROTLI_DEFAULT_WINDOW, BROTLI_MODE_GENERIC, bytes.size(),
                             reinterpret_cast<const std::uint8_t*>(bytes.data()), &size,
                             reinterpret_cast<std::uint8_t*>(out.data()))) {
    return {};
  }
  out.resize(size);
  return out;
}

/// "" where the form is not worth the client's time.
std::string worthy(std::string packed, const std::string& bytes) {
  if (packed.size() + packed.size() / 10 > bytes.size()) packed.clear();
  return packed;
}

/// A string view of a literal in octal escapes, in lines that compilers take quickly.
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
  if (count != 3) {
    std::fputs("usage: embed_assets <folder> <out.cpp>\n", stderr);
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  std::map<std::string, std::filesystem::path>
      files;  // in order of path, so that the output is the same each time
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      files["/" + entry.path().lexically_relative(folder).generic_string()] = entry.path();
  }
  std::ofstream out(arguments[2]);
  out << "// Made by embed_assets. Do not edit.\n#include \"server/pages.h\"\n\nnamespace seedmesh {\n\n"
      << "std::span<const Asset> embedded_assets() {\n  static constexpr Asset assets[] = {\n";
  for (const auto& [name, path] : files) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    out << "    {\"" << name << "\", \"" << type_of(path.extension().string()) << "\", ";
    write_literal(out, bytes);
    out << ", ";
    write_literal(out, worthy(gzip(bytes), bytes));
    out << ", ";
    write_literal(out, worthy(brotli(bytes), bytes));
    out << "},\n";
  }
  out << "  };\n  return assets;\n}\n\n}  // namespace seedmesh\n";
  return files.empty() || !out.good() ? 1 : 0;
}

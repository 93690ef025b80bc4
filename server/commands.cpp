#include "server/commands.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/pipeline.h"
#include "server/base64url.h"
#include "server/problem.h"
#include "server/service.h"
#include "server/signature.h"

namespace seedmesh {
namespace {

int refused(const Error& error) {
  const std::string text = problem_json(problem_of(error), "", 2);
  std::fprintf(stderr, "%s\n", text.c_str());
  return 1;
}

int unusable(const std::string& name) {
  std::fprintf(stderr, "seedmesh: %s: %s\n", name.c_str(), std::strerror(errno));
  return 2;
}

std::optional<std::string> read_file(const std::string& name) {
  std::FILE* file = name == "-" ? stdin : std::fopen(name.c_str(), "rb");
  if (!file) return std::nullopt;
  std::string text;
  char part[64 * 1'024];
  while (const std::size_t count = std::fread(part, 1, sizeof(part), file)) text.append(part, count);
  const bool failed = std::ferror(file) != 0;  // a folder opens, but cannot be read
  const int reason = errno;
  if (file != stdin) std::fclose(file);
  errno = reason;
  if (failed) return std::nullopt;
  return text;
}

bool write_all(std::FILE* file, const Payload& payload) {
  for (const auto piece : payload.pieces()) {
    if (std::fwrite(piece.data(), 1, piece.size(), file) != piece.size()) return false;
  }
  return std::fflush(file) == 0;
}

bool write_file(const std::string& name, const Payload& payload) {
  if (name == "-") return write_all(stdout, payload);
  std::FILE* file = std::fopen(name.c_str(), "wb");
  if (!file) return false;
  const bool written = write_all(file, payload);
  return std::fclose(file) == 0 && written;
}

void print_warning(const std::string& file, const std::string& place, const std::string& message) {
  std::fprintf(stderr, "%s:%s: warning: %s\n", file.c_str(), place.c_str(), message.c_str());
}

/// "4:2", a place in a text.
std::string place_in_text(const Warning& warning) {
  return std::to_string(warning.line) + ":" + std::to_string(warning.column);
}

Job::Options options_of(const Config& config) {
  Job::Options options;
  options.limits = config.limits;
  options.threads = config.threads;
  options.deadline = Job::Clock::now() + std::chrono::duration_cast<Job::Clock::duration>(
                                             std::chrono::duration<double>(config.time_limit));
  return options;
}

constexpr std::string_view extensions[] = {"glb", "gltf", "zip", "png", "r16", "ply"};

/// "model.glb" -> "glb".
std::string extension_in(const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension().string();
  return extension.empty() ? "" : extension.substr(1);
}

/// A request in the format that the extension of a file's name asks for; names without one leave it as it is.
Result<Request> in_form_of(const Request& request, const std::string& extension) {
  if (extension.empty() || extension_of(request.format()) == extension) return request;
  return with_format(request, extension == "png" ? "png16" : extension);
}

int print_result(const Config& config, const std::string& in,
                 Result<std::string> (*work)(const Request&, Job&)) {
  const auto text = read_file(in);
  if (!text) return unusable(in);
  Result<Request> request = read_request(*text, config.limits);
  if (!request) return refused(request.error());
  Job job(request->seed(), options_of(config));
  const Result<std::string> result = work(*request, job);
  if (!result) return refused(result.error());
  std::printf("%s\n", result->c_str());
  return 0;
}

}  // namespace

int generate_command(const Config& config, const std::string& in, const std::string& out) {
  const std::string extension = extension_in(out);
  if (!extension.empty() && std::ranges::find(extensions, extension) == std::end(extensions)) {
    std::fprintf(stderr,
                 "seedmesh: found the extension .%s; expected .glb, .gltf, .zip, .png, .r16 or .ply\n",
                 extension.c_str());
    return 2;
  }
  const auto text = read_file(in);
  if (!text) return unusable(in);
  Result<Request> request = read_request(*text, config.limits);
  if (request) request = in_form_of(*request, extension);
  if (!request) return refused(request.error());
  if (out == "-" && request->format() != "gltf" && isatty(STDOUT_FILENO) != 0) {
    std::fputs("seedmesh: a model is no text for a terminal; name a file, as in -o model.glb, or pipe it\n",
               stderr);
    return 2;
  }
  Job job(request->seed(), options_of(config));
  const Result<Product> product = produce(*request, job);
  if (!product) return refused(product.error());
  for (const Warning& warning : product->warnings) {
    print_warning(in, warning.pointer + (warning.line > 0 ? ":" + place_in_text(warning) : ""),
                  warning.message);
  }
  if (!write_file(out, product->payload)) return unusable(out);
  return 0;
}

int validate_command(const Config& config, const std::string& in) {
  return print_result(config, in, validate);
}

int derive_command(const Config& config, const std::string& in) { return print_result(config, in, derive); }

int import_command(const Config& config, const ImportFiles& files) {
  const auto text = read_file(files.in);
  if (!text) return unusable(files.in);
  const Result<ImportedRequest> imported = import_request({files.format, files.entry, *text}, config.limits);
  if (!imported) return refused(imported.error());
  for (const Warning& warning : imported->warnings) {
    print_warning(files.in, warning.line > 0 ? place_in_text(warning) : warning.pointer, warning.message);
  }
  const auto request = nlohmann::ordered_json::parse(imported->request.canonical());
  Payload payload;
  payload.add(request.dump(2) + "\n");
  return write_file(files.out, payload) ? 0 : unusable(files.out);
}

int sign_command(const Config& config, const std::string& target, double valid_for) {
  if (config.signing_keys.empty()) {
    std::fputs("seedmesh: there are no signing-keys\n", stderr);
    return 2;
  }
  if (target.empty() || target.front() != '/') {
    std::fputs("seedmesh: a target begins with a slash\n", stderr);
    return 2;
  }
  std::optional<std::int64_t> expires;
  if (valid_for > 0) expires = std::time(nullptr) + static_cast<std::int64_t>(valid_for);
  std::printf("%s\n", sign_target(target, config.signing_keys.front(), expires).c_str());
  return 0;
}

int key_command(const std::string& name) {
  const std::string key = base64url(secret_bytes(24));
  std::printf("API key      %s\n", key.c_str());
  std::printf("api-keys     %s:%s\n", name.c_str(), hex(sha256(key)).c_str());
  std::printf("signing-keys %s:%s\n", name.c_str(), hex(secret_bytes(32)).c_str());
  return 0;
}

int presets_command(const std::string& name) {
  if (name.empty()) {
    for (const PresetInfo& preset : presets())
      std::printf("%-28s %s\n", preset.name.c_str(), preset.title.c_str());
    return 0;
  }
  const auto text = preset_json(name);
  if (!text) return refused({Code::invalid, {{"/preset", no_preset(name)}}});
  std::printf("%s\n", text->c_str());
  return 0;
}

}  // namespace seedmesh

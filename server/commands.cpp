#include "server/commands.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/base64url.h"
#include "core/pipeline.h"
#include "server/files.h"
#include "server/http/text.h"
#include "server/keys.h"
#include "server/problem.h"
#include "server/service.h"
#include "server/signature.h"

namespace seedmesh {
namespace {

int print_refusal(const Error& error) {
  const std::string text = problem_json(problem_of(error), "", 2);
  std::fprintf(stderr, "%s\n", text.c_str());
  return 1;
}

int print_file_error(const std::string& name) {
  std::fprintf(stderr, "seedmesh: %s: %s\n", name.c_str(), system_error_text().c_str());
  return 2;
}

void print_warning(const std::string& file, const std::string& position, const std::string& message) {
  std::fprintf(stderr, "%s:%s: warning: %s\n", file.c_str(), position.c_str(), message.c_str());
}

/// Line and column of a warning: "4:2".
std::string position_of(const Warning& warning) {
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

/// "model.glb" -> "glb".
std::string extension_in(const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension().string();
  return extension.empty() ? "" : extension.substr(1);
}

/// The request in the format that a file extension selects; unchanged without an extension.
Result<Request> in_format(const Request& request, const std::string& extension) {
  if (extension.empty() || format_named(request.format()).extension == extension) return request;
  return with_format(request, format_with_extension(extension)->name);
}

/// The format that a request names itself; "" where it names none. The text is valid.
std::string named_format(const std::string& text) {
  const nlohmann::json request = nlohmann::json::parse(text, nullptr, false);
  const auto output = request.find("output");
  return output != request.end() && output->is_object() ? output->value("format", "") : "";
}

int print_result(const Config& config, const std::string& in,
                 Result<std::string> (*work)(const Request&, const Job::Options&)) {
  const auto text = read_file(in);
  if (!text) return print_file_error(in);
  Result<Request> request = read_request(*text, config.limits);
  if (!request) return print_refusal(request.error());
  const Result<std::string> result = work(*request, options_of(config));
  if (!result) return print_refusal(result.error());
  std::printf("%s\n", result->c_str());
  return 0;
}

/// Writes the request as a file of the program `files.to`.
int export_command(const Config& config, const ImportFiles& files, const Request& request) {
  const Result<ExportedFile> file = export_request(request, files.to, options_of(config));
  if (!file) return print_refusal(file.error());
  for (const Warning& warning : file->warnings) print_warning(files.in, warning.pointer, warning.message);
  Payload payload;
  payload.add(file->text);
  return write_file(files.out, payload) ? 0 : print_file_error(files.out);
}

}  // namespace

int generate_command(const Config& config, const std::string& in, const std::string& out) {
  const std::string extension = extension_in(out);
  if (!extension.empty() && !format_with_extension(extension)) {
    std::fprintf(stderr, "seedmesh: found the extension .%s; expected %s\n", extension.c_str(),
                 output_extension_list().c_str());
    return 2;
  }
  const auto text = read_file(in);
  if (!text) return print_file_error(in);
  Result<Request> request = read_request(*text, config.limits);
  if (const std::string format = request ? named_format(*text) : "";
      !format.empty() && !extension.empty() && format_named(format).extension != extension) {
    std::fprintf(stderr,
                 "seedmesh: found the file %s, but \"format\": \"%s\" in the request; name a file with .%s\n",
                 out.c_str(), format.c_str(), std::string(format_named(format).extension).c_str());
    return 2;
  }
  if (request) request = in_format(*request, extension);
  if (!request) return print_refusal(request.error());
  if (out == "-" && request->format() != "gltf" && isatty(STDOUT_FILENO) != 0) {
    std::fputs(
        "seedmesh: a model cannot be shown in a terminal; name a file, as in -o model.glb, or use a pipe\n",
        stderr);
    return 2;
  }
  const Result<Product> product = produce(*request, options_of(config));
  if (!product) return print_refusal(product.error());
  for (const Warning& warning : product->warnings) {
    print_warning(in, warning.pointer + (warning.line > 0 ? ":" + position_of(warning) : ""),
                  warning.message);
  }
  if (!write_file(out, product->payload)) return print_file_error(out);
  return 0;
}

int validate_command(const Config& config, const std::string& in) {
  return print_result(config, in, validate);
}

int derive_command(const Config& config, const std::string& in) { return print_result(config, in, derive); }

int import_command(const Config& config, const ImportFiles& files) {
  const auto text = read_file(files.in);
  if (!text) return print_file_error(files.in);
  ImportInput question{files.format, files.entry, *text};
  for (const std::string& each : files.with) {
    const auto further = read_file(each);
    if (!further) return print_file_error(each);
    question.files[each.substr(each.find_last_of('/') + 1)] = *further;
  }
  if (!files.to.empty() && likely_import_format(*text).empty()) {
    const Result<Request> request = read_request(*text, config.limits);
    return request ? export_command(config, files, *request) : print_refusal(request.error());
  }
  const Result<ImportedRequest> imported = import_request(question, options_of(config));
  if (!imported) return print_refusal(imported.error());
  for (const Warning& warning : imported->warnings) {
    print_warning(files.in, warning.line > 0 ? position_of(warning) : warning.pointer, warning.message);
  }
  if (!files.to.empty()) return export_command(config, files, imported->request);
  const auto request = nlohmann::ordered_json::parse(imported->request.canonical());
  Payload payload;
  payload.add(request.dump(2) + "\n");
  return write_file(files.out, payload) ? 0 : print_file_error(files.out);
}

/// Whether a client can send these characters as path and query. White space ends a request line, and a fragment
/// is never sent.
static bool is_sendable(const std::string& target) {
  return std::all_of(target.begin(), target.end(), [](char c) { return c > 0x20 && c < 0x7F && c != '#'; });
}

int sign_command(const Config& config, const std::string& target, double valid_for) {
  constexpr double longest = 1e10;  // seconds, as for the setting link-lifetime
  if (config.signing_keys.empty()) {
    std::fputs("seedmesh: the setting signing-keys is empty\n", stderr);
    return 2;
  }
  if (target.empty() || target.front() != '/') {
    std::fputs("seedmesh: the target has to begin with a slash\n", stderr);
    return 2;
  }
  if (!is_sendable(target)) {
    std::fputs(
        "seedmesh: the target contains white space, a fragment or characters without percent encoding\n",
        stderr);
    return 2;
  }
  if (!(valid_for >= 0 && valid_for <= longest)) {
    std::fprintf(stderr, "seedmesh: --valid-for is \"%g\": it must be a number from 0 to 1e10\n", valid_for);
    return 2;
  }
  std::optional<std::int64_t> expires;
  if (valid_for > 0) expires = std::time(nullptr) + static_cast<std::int64_t>(valid_for);
  std::printf("%s\n", sign_target(target, config.signing_keys.front(), expires).c_str());
  return 0;
}

int key_command(const std::string& name) {
  if (!is_key_name(name)) {
    std::fprintf(stderr,
                 "seedmesh: found the name \"%s\", expected 1 to 64 letters, digits, - _ and .; the settings "
                 "would refuse the key\n",
                 name.c_str());
    return 2;
  }
  const std::string key = base64url(secret_bytes(24));
  std::printf("API key      %s\n", key.c_str());
  std::printf("api-keys     %s:%s\n", name.c_str(), http::hex(sha256(key)).c_str());
  std::printf("signing-keys %s:%s\n", name.c_str(), http::hex(secret_bytes(32)).c_str());
  return 0;
}

int presets_command(const std::string& name) {
  if (name.empty()) {
    for (const PresetInfo& preset : presets())
      std::printf("%-28s %s\n", preset.name.c_str(), preset.title.c_str());
    return 0;
  }
  const auto text = preset_json(name);
  if (!text) return print_refusal({Code::invalid, {{IssueKind::unknown_name, "/preset", no_preset(name)}}});
  std::printf("%s\n", text->c_str());
  return 0;
}

}  // namespace seedmesh

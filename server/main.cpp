/// The program: seedmesh serve | generate | validate | derive | import | presets | manifest |
/// sign | key | healthcheck.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <string>

#include "core/pipeline.h"
#include "server/commands.h"
#include "server/config.h"
#include "server/manifest.h"
#include "server/serve.h"

namespace {

using namespace seedmesh;

constexpr int usage_error = 2;

/// Flags of every setting, kept as text: load_config judges all of them at once, with the environment's.
using Texts = std::map<std::string, std::string>;

void add_settings(CLI::App& command, Texts& texts) {
  command.add_option("--config", texts["config"],
                     "File with settings: an object of JSON, keys as the flags.");
  for (const SettingInfo& setting : settings()) {
    const std::string text = setting.text + " [" + setting.fallback + "]";
    if (setting.is_switch) {
      command.add_flag("--" + setting.name, texts[setting.name], text);
    } else {
      command.add_option("--" + setting.name, texts[setting.name], text);
    }
  }
}

std::vector<std::pair<std::string, std::string>> given(const CLI::App& command, const Texts& texts) {
  std::vector<std::pair<std::string, std::string>> flags;
  for (const auto& [name, text] : texts) {
    const CLI::Option* option = command.get_option_no_throw("--" + name);
    if (option && option->count() > 0) flags.emplace_back(name, text);
  }
  return flags;
}

/// The formats of an import, for its flag.
std::string formats_text() {
  std::string text = "Whose file it is; left out: the one that it looks like. ";
  bool first = true;
  for (const ImportFormatInfo& format : import_format_list()) {
    text += (first ? "" : ", ") + format.name + " (" + format.title + ")";
    first = false;
  }
  return text + ".";
}

}  // namespace

#ifdef __SANITIZE_THREAD__
/// What the thread sanitizer cannot see, since Debian's libraries are not instrumented: how cpp-httplib
/// guards the table of methods that it makes at its first request, and how the C library guards the time zone
/// that libzip asks for.
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libcpp-httplib.so\nrace:tzset_internal\n";
}
#endif

int main(int count, char** arguments) {
  CLI::App app("Seeded 3D models from grammars, as glTF over HTTP.", "seedmesh");
  app.set_version_flag("--version", [] {
    return "seedmesh " + std::string(program_version()) + "\nengine " + std::string(engine_version());
  });
  app.require_subcommand(1);
  app.footer(
      "Every flag is also a variable: --time-limit is SEEDMESH_TIME_LIMIT.\n"
      "Exit status: 0, 1 (refused: the problem as JSON on standard error) or 2 (usage).");

  Texts texts;
  std::string in, out = "-", preset, target, key_name;
  double valid_for = 0;
  ManifestOptions manifest;
  ImportFiles files{"", "-", "", ""};
  bool print_config = false;
  const auto command = [&](const char* name, const char* text) { return app.add_subcommand(name, text); };
  CLI::App* serving = command("serve", "Serve over HTTP.");
  serving->add_flag("--print-config", print_config, "Print the effective configuration as JSON and end.");
  CLI::App* generating = command("generate", "Make the model of a request.");
  generating->add_option("request", in, "File with the request as JSON; - is standard input.")->required();
  generating->add_option("-o,--out", out,
                         "File for the model; its extension chooses the format; - is standard output.");
  CLI::App* validating = command("validate", "Check a request and estimate its model.");
  validating->add_option("request", in, "File with the request; - is standard input.")->required();
  CLI::App* deriving = command("derive", "Print the generator's own result before geometry.");
  deriving->add_option("request", in, "File with the request; - is standard input.")->required();
  CLI::App* importing = command("import", "Turn a file of another program into a request.");
  importing->add_option("file", files.in, "The file; - is standard input.")->required();
  importing->add_option("-f,--format", files.format, formats_text());
  importing->add_option("-e,--entry", files.entry, "The system to take from a file that holds several.");
  importing->add_option("-o,--out", files.out, "File for the request; - is standard output.");
  CLI::App* listing = command("presets", "List the presets, or print one.");
  listing->add_option("name", preset, "The one to print.");
  CLI::App* many =
      command("manifest", "Make the models of all requests of a file, on all cores, with resume.");
  many->add_option("file", manifest.file,
                   "Requests, one a line, or {\"name\", \"request\"}; - is standard input.")
      ->required();
  many->add_option("-o,--out", manifest.folder, "Folder for models and results.jsonl.")->required();
  many->add_option("--part", manifest.part,
                   "index/count: every count-th line alone, from index (0 to count - 1).");
  many->add_flag("--quiet", manifest.quiet, "Tell no progress.");
  CLI::App* signing = command("sign", "Sign a URL with the first of the signing keys.");
  signing->add_option("target", target, "Path and query: /v1/presets/koch_island.glb?seed=3")->required();
  signing->add_option("--valid-for", valid_for, "Seconds that the signature holds; 0 is for ever.");
  CLI::App* keying = command("key", "Draw a new API key and signing key, and print what the settings need.");
  keying->add_option("name", key_name, "Name of both.")->required();
  CLI::App* checking = command("healthcheck", "Ask a service on this machine whether it is alive.");
  for (CLI::App* each : {serving, generating, validating, deriving, importing, many, signing, checking})
    add_settings(*each, texts);

  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  const CLI::App& chosen = *app.get_subcommands().front();
  const ConfigResult loaded = load_config(process_environment(), given(chosen, texts));
  for (const std::string& fault : loaded.faults) std::fprintf(stderr, "seedmesh: %s\n", fault.c_str());
  if (!loaded.faults.empty()) return usage_error;
  const Config& config = loaded.config;
  if (serving->parsed()) {
    if (!print_config) return serve(config, loaded.warnings);
    std::printf("%s\n", config_json(config).c_str());
    return 0;
  }
  if (generating->parsed()) return generate_command(config, in, out);
  if (validating->parsed()) return validate_command(config, in);
  if (deriving->parsed()) return derive_command(config, in);
  if (importing->parsed()) return import_command(config, files);
  if (many->parsed()) return manifest_command(config, manifest);
  if (signing->parsed()) return sign_command(config, target, valid_for);
  if (keying->parsed()) return key_command(key_name);
  if (checking->parsed()) return healthcheck(config);
  return presets_command(preset);
}

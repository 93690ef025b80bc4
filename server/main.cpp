/// The program: seedmesh serve | generate | validate | derive | import | presets | manifest |
/// sign | key | healthcheck.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>

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

/// Which settings a command reads, and so has as flags. Variables and the file may hold all of them.
using Reads = bool (*)(std::string_view name);

bool reads_all(std::string_view) { return true; }

/// What bounds one model.
bool reads_limits(std::string_view name) {
  return name == "threads" || name == "time-limit" || name.starts_with("max-");
}

bool reads_limits_and_textures(std::string_view name) {
  return reads_limits(name) || name == "texture-bytes";
}

bool reads_keys(std::string_view name) { return name == "signing-keys"; }

bool reads_address(std::string_view name) {
  return name == "host" || name == "port" || name.starts_with("tls-");
}

void add_settings(CLI::App& command, Texts& texts, Reads reads) {
  command.add_option("--config", texts["config"],
                     "File with settings: an object of JSON, keys as the flags.");
  for (const SettingInfo& setting : settings()) {
    if (!reads(setting.name)) continue;
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

/// What the commands are told, besides the settings.
struct Told {
  std::string in, out = "-", preset, target, key_name;
  double valid_for = 0;
  ManifestOptions manifest;
  ImportFiles files{"", "-", "", ""};
  bool print_config = false;
};

/// Declares the commands, what each is told, and the settings that it reads.
void add_commands(CLI::App& app, Told& told, Texts& texts) {
  const auto command = [&](const char* name, const char* text) { return app.add_subcommand(name, text); };
  CLI::App* serving = command("serve", "Serve over HTTP.");
  serving->add_flag("--print-config", told.print_config,
                    "Print the effective configuration as JSON and end.");
  CLI::App* generating = command("generate", "Make the model of a request.");
  CLI::App* validating = command("validate", "Check a request and estimate its model.");
  CLI::App* deriving = command("derive", "Print the generator's own result before geometry.");
  for (CLI::App* each : {generating, validating, deriving}) {
    each->add_option("request", told.in,
                     "File with the request as JSON; - is standard input, as is none where one is piped in.");
  }
  generating->add_option("-o,--out", told.out,
                         "File for the model; its extension chooses the format; - is standard output.");
  CLI::App* importing = command("import", "Turn a file of another program into a request.");
  importing->add_option("file", told.files.in, "The file; - is standard input.")->required();
  importing->add_option("-f,--format", told.files.format, formats_text());
  importing->add_option("-e,--entry", told.files.entry, "The system to take from a file that holds several.");
  importing->add_option("-o,--out", told.files.out, "File for the request; - is standard output.");
  command("presets", "List the presets, or print one.")->add_option("name", told.preset, "The one to print.");
  CLI::App* many =
      command("manifest", "Make the models of all requests of a file, on all cores, with resume.");
  many->add_option("file", told.manifest.file,
                   "Requests, one a line, or {\"name\", \"request\"}; - is standard input.")
      ->required();
  many->add_option("-o,--out", told.manifest.folder, "Folder for models and results.jsonl.")->required();
  many->add_option("--part", told.manifest.part,
                   "index/count: every count-th line alone, from index (0 to count - 1).");
  many->add_flag("--quiet", told.manifest.quiet, "Tell no progress.");
  CLI::App* signing = command("sign", "Sign a URL with the first of the signing keys.");
  signing->add_option("target", told.target, "Path and query: /v1/presets/koch_island.glb?seed=3")
      ->required();
  signing->add_option("--valid-for", told.valid_for, "Seconds that the signature holds; 0 is for ever.");
  command("key", "Draw a new API key and signing key, and print what the settings need.")
      ->add_option("name", told.key_name, "Name of both.")
      ->required();
  CLI::App* checking = command("healthcheck", "Ask a service on this machine whether it is alive.");
  add_settings(*serving, texts, reads_all);
  for (CLI::App* each : {generating, validating, deriving, importing})
    add_settings(*each, texts, reads_limits);
  add_settings(*many, texts, reads_limits_and_textures);
  add_settings(*signing, texts, reads_keys);
  add_settings(*checking, texts, reads_address);
}

/// Where no file with the request is named, it is what is piped in. False: nothing is.
bool find_request(std::string& in) {
  if (!in.empty()) return true;
  if (isatty(STDIN_FILENO) != 0) return false;
  in = "-";
  return true;
}

int run(const std::string& command, Told& told, const ConfigResult& loaded) {
  const Config& config = loaded.config;
  if (command == "serve") {
    if (!told.print_config) return serve(config, loaded.warnings);
    std::printf("%s\n", config_json(config).c_str());
    return 0;
  }
  if (command == "import") return import_command(config, told.files);
  if (command == "manifest") return manifest_command(config, told.manifest);
  if (command == "sign") return sign_command(config, told.target, told.valid_for);
  if (command == "key") return key_command(told.key_name);
  if (command == "healthcheck") return healthcheck(config);
  if (command == "presets") return presets_command(told.preset);
  if (!find_request(told.in)) {
    std::fprintf(stderr, "seedmesh: expected a file with the request, or a request piped in\n");
    return usage_error;
  }
  if (command == "generate") return generate_command(config, told.in, told.out);
  return command == "validate" ? validate_command(config, told.in) : derive_command(config, told.in);
}

int no_command(const CLI::App& app, const char* word) {
  std::string all;
  for (const CLI::App* each : app.get_subcommands({})) all += (all.empty() ? "" : ", ") + each->get_name();
  std::fprintf(stderr, "seedmesh: there is no command \"%s\"; there are %s\n", word, all.c_str());
  return usage_error;
}

}  // namespace

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
  Told told;
  add_commands(app, told, texts);
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    if (count > 1 && arguments[1][0] != '-' && app.get_subcommands().empty())
      return no_command(app, arguments[1]);
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  const CLI::App& chosen = *app.get_subcommands().front();
  const ConfigResult loaded = load_config(process_environment(), given(chosen, texts));
  for (const std::string& fault : loaded.faults) std::fprintf(stderr, "seedmesh: %s\n", fault.c_str());
  return loaded.faults.empty() ? run(chosen.get_name(), told, loaded) : usage_error;
}

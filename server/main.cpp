/// The command line: seedmesh serve | generate | validate | derive | import | presets | manifest | sync | tiles |
/// mcp | sign | key | healthcheck.
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
#include "server/mcp.h"
#include "server/serve.h"
#include "server/sync.h"
#include "server/tiles_command.h"

namespace {

using namespace seedmesh;

constexpr int usage_error = 2;

/// The flags of settings as text. load_config checks them together with file and environment.
using Texts = std::map<std::string, std::string>;

/// Selects the settings that a command has as flags. Environment and file may contain all settings.
using Selection = bool (*)(std::string_view name);

bool all_settings(std::string_view) { return true; }

/// Settings that limit one model.
bool limits(std::string_view name) {
  return name == "threads" || name == "time-limit" || name.starts_with("max-");
}

bool limits_and_textures(std::string_view name) { return limits(name) || name == "texture-bytes"; }

bool key_settings(std::string_view name) { return name == "signing-keys"; }

bool address_settings(std::string_view name) {
  return name == "host" || name == "port" || name.starts_with("tls-");
}

void add_settings(CLI::App& command, Texts& texts, Selection selected) {
  command.add_option("--config", texts["config"],
                     "File with settings: a JSON object with the names of flags as keys.");
  for (const SettingInfo& setting : settings()) {
    if (!selected(setting.name)) continue;
    const std::string text = setting.text + " [" + setting.fallback + "]";
    if (setting.is_switch) {
      command.add_flag("--" + setting.name, texts[setting.name], text);
    } else {
      command.add_option("--" + setting.name, texts[setting.name], text)->type_name(setting.unit);
    }
  }
}

std::vector<std::pair<std::string, std::string>> given_flags(const CLI::App& command, const Texts& texts) {
  std::vector<std::pair<std::string, std::string>> flags;
  for (const auto& [name, text] : texts) {
    const CLI::Option* option = command.get_option_no_throw("--" + name);
    if (option && option->count() > 0) flags.emplace_back(name, text);
  }
  return flags;
}

/// The formats of an import, for its flag.
std::string formats_text() {
  std::string text = "Format of the file; detected if omitted: ";
  bool first = true;
  for (const ImportFormatInfo& format : import_format_list()) {
    text += (first ? "" : ", ") + format.name + " (" + format.title + ")";
    first = false;
  }
  return text + ".";
}

/// Arguments of the commands besides the settings.
struct Arguments {
  std::string in, out = "-", preset, target, key_name;
  double valid_for = 0;
  ManifestOptions manifest;
  SyncOptions sync;
  TilesOptions tiles;
  ImportFiles files{"", "-", "", ""};
  bool print_config = false;
  std::string models = ".";
};

/// Declares the arguments and settings of the command sync.
void add_sync(CLI::App& command, SyncOptions& sync, Texts& texts) {
  command
      .add_option("directory", sync.directory, "Directory with request files, whose names end in .seedmesh.")
      ->required();
  command.add_flag("--check", sync.check, "Write nothing; exit status 1 if a model would change.");
  command.add_flag("--list", sync.list, "Print the paths of the models and exit.");
  command.add_option("--server", sync.server, "Get models from this server; do not make them here.")
      ->type_name("URL");
  command.add_option("--key", sync.key, "API key for the server.")->envname("SEEDMESH_KEY");
  add_settings(command, texts, limits_and_textures);
}

/// Declares the arguments and settings of the command tiles.
void add_tiles(CLI::App& command, TilesOptions& tiles, Texts& texts) {
  command
      .add_option("world", tiles.world,
                  "File with the request of a world, or preset.seed; - means standard input.")
      ->required();
  command.add_option("-o,--out", tiles.folder, "Folder for tileset.json and the tiles.")->required();
  command.add_option(
      "--levels", tiles.levels,
      "first-last: 0 is the whole world, each level halves the side of tiles; all if omitted.");
  command.add_option("--box", tiles.box,
                     "west,south,east,north in metres from the middle of the world; all of it if omitted.");
  command.add_option("--part", tiles.part,
                     "index/count: make only this share of the files; index is 0 to count - 1.");
  command.add_flag("--quiet", tiles.quiet, "Do not print progress.");
  add_settings(command, texts, limits);
}

/// Declares the commands with their arguments and settings.
void add_commands(CLI::App& app, Arguments& arguments, Texts& texts) {
  const auto command = [&](const char* name, const char* text) { return app.add_subcommand(name, text); };
  CLI::App* serving = command("serve", "Serve over HTTP.");
  serving->add_flag("--print-config", arguments.print_config,
                    "Print the effective configuration as JSON and exit.");
  CLI::App* generating = command("generate", "Generate the model of a request.");
  CLI::App* validating = command("validate", "Check a request and estimate the size of its model.");
  CLI::App* deriving = command("derive", "Print the result of the generator before geometry is made.");
  for (CLI::App* each : {generating, validating, deriving}) {
    each->add_option("request", arguments.in,
                     "File with the request as JSON; - or a pipe without a file means standard input.");
  }
  generating->add_option("-o,--out", arguments.out,
                         "File for the model; its extension selects the format; - means standard output.");
  CLI::App* importing = command("import", "Convert a file of another program into a request.");
  importing->add_option("file", arguments.files.in, "The file; - means standard input.")->required();
  importing->add_option("-f,--format", arguments.files.format, formats_text());
  importing->add_option("-e,--entry", arguments.files.entry,
                        "The system to import, if the file has several.");
  importing->add_option("-w,--with", arguments.files.with,
                        "A further file, such as a view file of cpfg; may be repeated.");
  importing->add_option(
      "-t,--to", arguments.files.to,
      "Write a file of this program instead: proctree or proctree_js. The input can then be a request, too.");
  importing->add_option("-o,--out", arguments.files.out, "File for the result; - means standard output.");
  command("presets", "List the presets, or print the request of one.")
      ->add_option("name", arguments.preset, "The preset to print.");
  CLI::App* many =
      command("manifest", "Generate the models of all requests in a file, on all cores; can be resumed.");
  many->add_option("file", arguments.manifest.file,
                   "File with one request, or {\"name\", \"request\"}, on each line; - means standard input.")
      ->required();
  many->add_option("-o,--out", arguments.manifest.folder, "Folder for the models and results.jsonl.")
      ->required();
  many->add_option("--part", arguments.manifest.part,
                   "index/count: only every count-th line, starting at index (0 to count - 1).");
  many->add_flag("--times", arguments.manifest.times, "Add the time of each model to its result.");
  many->add_flag("--quiet", arguments.manifest.quiet, "Do not print progress.");
  add_sync(*command("sync",
                    "Make the models of the request files below a directory, and only those that changed."),
           arguments.sync, texts);
  add_tiles(*command("tiles", "Write a part of a world as a static tileset, on all cores; can be resumed."),
            arguments.tiles, texts);
  CLI::App* agents = command("mcp", "Serve an agent program on standard input and output (MCP).");
  agents->add_option("-o,--out", arguments.models, "Folder for the models.");
  CLI::App* signing = command("sign", "Sign a URL with the first of the signing keys.");
  signing->add_option("target", arguments.target, "Path and query: /v1/presets/koch_island.glb?seed=3")
      ->required();
  signing->add_option("--valid-for", arguments.valid_for,
                      "Seconds that the signature is valid; 0 means no end.");
  command("key", "Create a new API key and signing key, and print the settings that contain them.")
      ->add_option("name", arguments.key_name, "Name of both keys.")
      ->required();
  CLI::App* checking = command("healthcheck", "Check that a service on this machine responds.");
  add_settings(*serving, texts, all_settings);
  for (CLI::App* each : {generating, validating, deriving, importing}) add_settings(*each, texts, limits);
  for (CLI::App* each : {many, agents}) add_settings(*each, texts, limits_and_textures);
  add_settings(*signing, texts, key_settings);
  add_settings(*checking, texts, address_settings);
}

/// Selects standard input where no file is named and input is piped in. False without any input.
bool find_request(std::string& in) {
  if (!in.empty()) return true;
  if (isatty(STDIN_FILENO) != 0) return false;
  in = "-";
  return true;
}

int run(const std::string& command, Arguments& arguments, const ConfigResult& loaded) {
  const Config& config = loaded.config;
  if (command == "serve") {
    if (!arguments.print_config) return serve(config, loaded.warnings);
    std::printf("%s\n", config_json(config).c_str());
    return 0;
  }
  if (command == "import") return import_command(config, arguments.files);
  if (command == "manifest") return manifest_command(config, arguments.manifest);
  if (command == "sync") return sync_command(config, arguments.sync);
  if (command == "tiles") return tiles_command(config, arguments.tiles);
  if (command == "mcp") return mcp::serve_stdio(config, arguments.models);
  if (command == "sign") return sign_command(config, arguments.target, arguments.valid_for);
  if (command == "key") return key_command(arguments.key_name);
  if (command == "healthcheck") return healthcheck(config);
  if (command == "presets") return presets_command(arguments.preset);
  if (!find_request(arguments.in)) {
    std::fprintf(stderr, "seedmesh: expected a file with a request, or a request on standard input\n");
    return usage_error;
  }
  if (command == "generate") return generate_command(config, arguments.in, arguments.out);
  return command == "validate" ? validate_command(config, arguments.in)
                               : derive_command(config, arguments.in);
}

/// Writes what is left of standard output. A full disk or a closed pipe must not pass for success, because what
/// was printed is then cut.
int finish_output(int status) {
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (is_written || status != 0) return status;
  std::fprintf(stderr, "seedmesh: standard output could not be written completely\n");
  return usage_error;
}

int no_command(const CLI::App& app, const char* word) {
  std::string all;
  for (const CLI::App* each : app.get_subcommands({})) all += (all.empty() ? "" : ", ") + each->get_name();
  std::fprintf(stderr, "seedmesh: \"%s\" is not a command; the commands are %s\n", word, all.c_str());
  return usage_error;
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("Seeded 3D models from grammars, as glTF over HTTP.", "seedmesh");
  app.set_version_flag("--version", [] {
    return "seedmesh " + std::string(program_version()) + "\nengine " + std::string(engine_version());
  });
  app.require_subcommand(1);
  app.footer(
      "All commands read the flags of serve from environment variables, too: SEEDMESH_TIME_LIMIT sets "
      "--time-limit.\n"
      "Exit status: 0 on success; 1 for a refused request, with the problem as JSON on standard error; 2 for "
      "wrong "
      "usage.");
  Texts texts;
  Arguments arguments;
  add_commands(app, arguments, texts);
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    if (count > 1 && words[1][0] != '-' && app.get_subcommands().empty()) return no_command(app, words[1]);
    return finish_output(app.exit(error) == 0 ? 0 : usage_error);
  }
  const CLI::App& chosen = *app.get_subcommands().front();
  const ConfigResult loaded = load_config(process_environment(), given_flags(chosen, texts));
  for (const std::string& error : loaded.errors) std::fprintf(stderr, "seedmesh: %s\n", error.c_str());
  if (!loaded.errors.empty()) return usage_error;
  return finish_output(run(chosen.get_name(), arguments, loaded));
}

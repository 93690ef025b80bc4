/// Prints one line for each request of the golden table: its name, the XXH3-128 of the bytes that it makes,
/// and their number. The requests are every preset (with its own seed and with seed 3) and those of the given
/// files, each a JSON object of named requests; {"import": {"format", "text"}} is a foreign file, and {"picture": {"size",
/// "view", "ground"}, "of": REQUEST} the picture of a model, {"tile": [level, x, y], "of": REQUEST} a tile of a world, and
/// {"tileset": [level, x, y], "of": REQUEST} the boxes below a tile. The promise
/// behind `seed` is that this table is the same from every compiler, at every level of optimisation, on every
/// CPU and with any number of threads. tests/golden/golden.mjs compares the tables.
///
///   golden_table [--threads N] [--engine NAME] [--only NAME] [--match WORDS] [--summaries FILE] FILE...
///
///   --engine     hashes the bytes as if the engine had this name, so that tables of different libraries can
///                be compared where only the name differs
///   --only       the row of this name; --match: the rows whose names contain these words
///   --summaries  writes counts, bounds, area and names of each preset's model to this file
#include <xxhash.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pipeline.h"
#include "core/pipeline/world.h"
#include "tests/golden/glb_summary.h"

namespace {

using namespace seedmesh;
using Json = nlohmann::ordered_json;

struct Options {
  int threads = 1;
  std::string engine, only, match, summaries;
  std::vector<std::string> files;
};

/// One row before it is made.
struct Row {
  std::string name;
  std::function<Result<Request>()> read;
  bool is_summarised = false;
  std::optional<PictureOptions> picture = {};  ///< the picture of the model instead of the model
  std::optional<TileAddress> tile = {};        ///< a tile of the world, or
  std::optional<TileAddress> tileset = {};     ///< the tileset of what is below a tile
};

std::string hash_of(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  char text[40];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

std::string bytes_of(const Payload& payload) {
  std::string bytes;
  bytes.reserve(payload.size());
  for (std::span<const std::byte> piece : payload.pieces())
    bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
  return bytes;
}

/// Puts `name` in place of this program's engine, where both are equally long.
void rename_engine(std::string& bytes, const std::string& name) {
  const std::string own(engine_version());
  if (name.empty() || name == own || name.size() != own.size()) return;
  for (std::size_t at = bytes.find(own); at != std::string::npos; at = bytes.find(own, at + own.size()))
    bytes.replace(at, own.size(), name);
}

Result<Request> imported(const Json& file) {
  const auto format = file.at("format").get<std::string>(), text = file.at("text").get<std::string>();
  const Result<ImportedRequest> result = import_request({format, "", text}, Limits{});
  if (!result) return Error(result.error());
  return result->request;
}

Row row_of(const std::string& name, const Json& request) {
  if (request.contains("import")) return {name, [file = request["import"]] { return imported(file); }};
  const Json& of = request.contains("of") ? request["of"] : request;
  Row row{name, [text = of.dump()] { return read_request(text, Limits{}); }};
  if (request.contains("picture")) {
    Overrides query;
    for (const auto& [key, value] : request["picture"].items())
      query.emplace_back(key, value.get<std::string>());
    row.picture = *read_picture_options(query);
  }
  const auto address = [&](const char* member) -> std::optional<TileAddress> {
    if (!request.contains(member)) return std::nullopt;
    const Json& list = request[member];
    return TileAddress{list.at(0).get<int>(), list.at(1).get<std::int64_t>(), list.at(2).get<std::int64_t>()};
  };
  row.tile = address("tile");
  row.tileset = address("tileset");
  return row;
}

std::vector<Row> all_rows(const Options& options) {
  std::vector<Row> rows;
  for (const PresetInfo& preset : presets()) {
    const auto read = [name = preset.name](const Overrides& overrides) {
      return [name, overrides]() -> Result<Request> { return **read_preset(name, overrides, Limits{}); };
    };
    rows.push_back({"preset/" + preset.name, read({}), true});
    rows.push_back({"preset/" + preset.name + "?seed=3", read({{"seed", "3"}})});
  }
  for (const std::string& path : options.files) {
    const std::string file = path.substr(path.rfind('/') + 1);
    const std::string group = file.substr(0, file.find('.')) + "/";
    std::ifstream stream(path);
    const Json requests = Json::parse(stream);
    for (const auto& [name, request] : requests.items()) rows.push_back(row_of(group + name, request));
  }
  std::erase_if(rows, [&](const Row& row) {
    return (!options.only.empty() && row.name != options.only) ||
           row.name.find(options.match) == std::string::npos;
  });
  return rows;
}

bool complain(const Row& row, const Error& error) {
  for (const Issue& issue : error.issues)
    std::fprintf(stderr, "%s: %s: %s\n", row.name.c_str(), issue.pointer.c_str(), issue.message.c_str());
  return false;
}

/// False, after a line on stderr, where a warning is about something that the request does not contain.
bool points_into(const Request& request, const Row& row, const std::vector<Warning>& warnings) {
  const Json canonical = Json::parse(request.canonical());
  bool is_good = true;
  for (const Warning& warning : warnings) {
    if (canonical.contains(Json::json_pointer(warning.pointer))) continue;
    std::fprintf(stderr, "%s: the request has no %s: %s\n", row.name.c_str(), warning.pointer.c_str(),
                 warning.message.c_str());
    is_good = false;
  }
  return is_good;
}

/// The bytes of a row that is a part of a world.
Result<std::string> part_of_world(const Request& request, const Row& row, const Job::Options& job) {
  const Result<OpenWorld> world = open_world(request, nullptr);
  if (!world) return world.error();
  return row.tile ? world_tile(*world, *row.tile, job)
                  : world_tileset(*world, *row.tileset, "../../../", job);
}

/// Prints the line of a row.
void print_line(const Row& row, const Options& options, std::string bytes) {
  rename_engine(bytes, options.engine);
  std::printf("%s %s %zu\n", row.name.c_str(), hash_of(bytes).c_str(), bytes.size());
}

/// False, after a line on stderr, when the request is refused or a warning points nowhere.
bool print(const Row& row, const Options& options, std::ofstream& summaries) {
  const Result<Request> request = row.read();
  if (!request) return complain(row, request.error());
  const Job::Options job = {.threads = options.threads};
  if (row.tile || row.tileset) {
    const Result<std::string> bytes = part_of_world(*request, row, job);
    if (!bytes) return complain(row, bytes.error());
    print_line(row, options, *bytes);
    return true;
  }
  const Result<Product> product =
      row.picture ? draw_picture(*request, *row.picture, job) : produce(*request, job);
  if (!product) return complain(row, product.error());
  std::string bytes = bytes_of(product->payload);
  if (row.is_summarised && summaries.is_open()) {
    summaries << row.name << "\n" << golden::summary_of_glb(bytes);
    for (const Warning& warning : product->warnings)
      summaries << "  warning " << warning.pointer << ": " << warning.message << "\n";
  }
  if (!points_into(*request, row, product->warnings)) return false;
  print_line(row, options, std::move(bytes));
  return true;
}

Options options_of(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--threads" && has_value) {
      options.threads = std::atoi(argv[++i]);
    } else if (word == "--engine" && has_value) {
      options.engine = argv[++i];
    } else if (word == "--only" && has_value) {
      options.only = argv[++i];
    } else if (word == "--match" && has_value) {
      options.match = argv[++i];
    } else if (word == "--summaries" && has_value) {
      options.summaries = argv[++i];
    } else {
      options.files.push_back(word);
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = options_of(argc, argv);
  if (options.threads < 1) return 2;
  std::ofstream summaries;
  if (!options.summaries.empty()) summaries.open(options.summaries);
  const std::vector<Row> rows = all_rows(options);
  std::printf("# engine %s\n", std::string(engine_version()).c_str());
  bool is_good = !rows.empty();
  for (const Row& row : rows) is_good = print(row, options, summaries) && is_good;
  return is_good ? 0 : 1;
}

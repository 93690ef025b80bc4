#include "server/tiles_command.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

#include "server/files.h"
#include "server/http/text.h"
#include "server/manifest.h"
#include "server/worlds.h"

namespace seedmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t memory_bytes = std::uint64_t{256} << 20U;  ///< of regions, roads and towns
constexpr std::chrono::seconds progress_interval{10};
constexpr const char* identity = "seedmesh.json";  ///< file with the world and engine of a folder

int print_refusal(const Problem& problem) {
  std::fprintf(stderr, "%s\n", problem_json(problem, "", 2).c_str());
  return 1;
}

Payload payload_of(std::string bytes) {
  Payload payload;
  payload.add(std::move(bytes));
  return payload;
}

/// One row of tiles of a level, or of nested tilesets.
struct Row {
  bool is_tileset = false;
  int level = 0;
  std::int64_t y = 0, west = 0, east = 0;
};

/// "../../../a/<name>" inside the JSON of a tile.
void collect_shared(std::string_view glb, std::set<std::string>& names) {
  constexpr std::string_view mark = "\"../../../a/";
  for (auto at = glb.find(mark); at != std::string_view::npos; at = glb.find(mark, at)) {
    at += mark.size();
    const auto end = glb.find('"', at);
    if (end == std::string_view::npos) return;
    names.emplace(glb.substr(at, end - at));
  }
}

/// Whether a file is as long as it was when it was written. A machine that stops suddenly may leave an empty or a short
/// file. A tile states its own length in bytes 8 to 11.
bool is_whole(std::string_view bytes, bool is_tile) {
  if (!is_tile || bytes.size() < 12) return !is_tile && !bytes.empty();
  std::size_t length = 0;
  for (std::size_t k = 4; k-- > 0;) length = length << 8U | static_cast<unsigned char>(bytes[8 + k]);
  return length == bytes.size();
}

/// The threads of one run and their shared state.
class TilesRun {
 public:
  TilesRun(const Config& config, const OpenWorld& world, const WorldPart& part, const TilesOptions& options,
           ManifestPart share)
      : config_(config), world_(world), part_(part), options_(options), share_(share) {
    for (int level = 0; level <= part.last; ++level) {
      const TileRange range = tiles_in(world, level, part.box);
      for (std::int64_t y = range.south; y <= range.north; ++y) {
        if (level >= part.first) rows_.push_back({false, level, y, range.west, range.east});
        if (level > 0 && level % world_tileset_levels == 0)
          rows_.push_back({true, level, y, range.west, range.east});
      }
    }
    for (const Row& row : rows_) files_ += static_cast<std::uint64_t>(row.east - row.west + 1);
  }

  int run() {
    const auto begun = std::chrono::steady_clock::now();
    if (share_.index == 0) make_root();
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(config_.threads));
    for (int i = 0; i < config_.threads; ++i) threads.emplace_back([this] { work(); });
    watch();
    for (std::thread& thread : threads) thread.join();
    if (!failed_) make_shared_files();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    std::fprintf(stderr, "%llu made, %llu unchanged, in %.1f s\n",
                 static_cast<unsigned long long>(made_.load()), static_cast<unsigned long long>(kept_.load()),
                 seconds);
    return failed_ ? status_.load() : 0;
  }

 private:
  Job::Options job_options() const {
    Job::Options options;
    options.limits = config_.limits;
    return options;
  }

  void make_root() {
    make("tileset.json", [&] { return world_tileset(world_, {}, "", job_options(), &part_); });
  }

  /// Rows are given out whole; the tiles of a part are every count-th column and row.
  void work() {
    for (std::size_t i = next_++; i < rows_.size() && !failed_; i = next_++) {
      const Row& row = rows_[i];
      for (std::int64_t x = row.west; x <= row.east && !failed_; ++x) {
        if (static_cast<std::uint64_t>(x + row.y) % share_.count != share_.index) continue;
        const TileAddress at{row.level, x, row.y};
        const std::string place =
            std::to_string(at.level) + "/" + std::to_string(x) + "/" + std::to_string(at.y);
        if (row.is_tileset) {
          make("e/" + place + ".json",
               [&] { return world_tileset(world_, at, "../../../", job_options(), &part_); });
        } else {
          make("c/" + place + ".glb", [&] { return world_tile(world_, at, job_options()); });
        }
      }
    }
    const std::lock_guard lock(mutex_);
    ++ended_;
    changed_.notify_all();
  }

  /// Makes a file unless it is there and whole. Tiles name the files that they share.
  template <class Make>
  void make(const std::string& name, const Make& make_bytes) {
    const std::string path = (fs::path(options_.folder) / name).string();
    const bool is_tile = name.ends_with(".glb");
    if (const auto known = read_file(path); known && is_whole(*known, is_tile)) {
      ++kept_;
      if (is_tile) note_shared(*known);
      return;
    }
    Result<std::string> bytes = make_bytes();
    if (!bytes) return stop(print_refusal(problem_of(bytes.error())));
    if (is_tile) note_shared(*bytes);
    if (!write_file_atomically(path, payload_of(*std::move(bytes))))
      return stop(fail(path, system_error_text()));
    ++made_;
  }

  void note_shared(std::string_view glb) {
    std::set<std::string> names;
    collect_shared(glb, names);
    const std::lock_guard lock(mutex_);
    shared_.merge(names);
  }

  void make_shared_files() {
    for (const std::string& name : shared_) {
      make("a/" + name, [&]() -> Result<std::string> {
        Result<std::optional<WorldFile>> file = world_file(world_, name, job_options());
        if (!file) return std::move(file).error();
        if (!*file)
          return Error{Code::internal, {{IssueKind::internal, "", "a tile refers to an unknown file"}}};
        return std::move((*file)->bytes);
      });
    }
  }

  void stop(int status) {
    status_ = status;
    failed_ = true;
  }

  void watch() {
    const auto count = static_cast<std::size_t>(config_.threads);
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, progress_interval, [&] { return ended_ == count; })) {
      if (options_.quiet) continue;
      std::fprintf(stderr, "%llu of about %llu files\n", static_cast<unsigned long long>(made_ + kept_),
                   static_cast<unsigned long long>(files_ / share_.count));
    }
  }

  const Config& config_;
  const OpenWorld& world_;
  const WorldPart& part_;
  const TilesOptions& options_;
  const ManifestPart share_;
  std::vector<Row> rows_;
  std::uint64_t files_ = 1;
  std::set<std::string> shared_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::uint64_t> made_{0}, kept_{0};
  std::atomic<bool> failed_{false};
  std::atomic<int> status_{0};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t ended_ = 0;
};

/// The request of a world: the text of a file or, without one, the name of a preset with a seed.
std::variant<std::shared_ptr<const NamedWorld>, Problem> read_world(const Config& config,
                                                                    const std::optional<std::string>& text,
                                                                    const std::string& name) {
  const auto memory = make_world_memory(memory_bytes);
  Job::Options options;
  options.limits = config.limits;
  if (!text) return read_world_name(name, options, memory);
  const Result<Request> request = read_request(*text, options);
  if (!request) return problem_of(request.error());
  if (const auto error = output_error_of_tiles(*request)) return problem_of(*error);
  Result<OpenWorld> open = open_world(*request, memory);
  if (!open) return problem_of(open.error());
  return std::make_shared<const NamedWorld>(
      NamedWorld{NamedWorld::Kind::own, *request, *std::move(open), {}});
}

/// "3-9" or "7" within the levels of a world.
std::optional<std::pair<int, int>> read_levels(std::string_view text, int count) {
  if (text.empty()) return std::pair(0, count - 1);
  const auto dash = std::min(text.find('-'), text.size());
  const auto first = http::parse_number<int>(text.substr(0, dash));
  const auto last = dash == text.size() ? first : http::parse_number<int>(text.substr(dash + 1));
  if (!first || !last || *first < 0 || *first > *last || *last >= count) return std::nullopt;
  return std::pair(*first, *last);
}

/// Writes into an empty folder which world and part its files are of. Returns why the folder cannot take them, or nothing.
std::string claim(const fs::path& folder, const Request& request, const WorldPart& part) {
  const nlohmann::ordered_json own = {
      {"engine", engine_version()},
      {"request", nlohmann::ordered_json::parse(request.canonical())},
      {"levels", {part.first, part.last}},
      {"box", {part.box.west, part.box.south, part.box.east, part.box.north}}};
  const std::string text = own.dump(2) + "\n", path = (folder / identity).string();
  if (const auto known = read_file(path)) {
    return *known == text
               ? ""
               : "has files of another world, engine, box or other levels; expected an empty folder";
  }
  return write_file_atomically(path, payload_of(text)) ? "" : "cannot be written: " + system_error_text();
}

}  // namespace

int tiles_command(const Config& config, const TilesOptions& options) {
  const auto text = read_file(options.world);
  const bool is_path = options.world.find('/') != std::string::npos || options.world.ends_with(".json");
  if (!text && is_path) return fail(options.world, system_error_text());
  auto read = read_world(config, text, options.world);
  if (const auto* refused = std::get_if<Problem>(&read)) return print_refusal(*refused);
  const auto world = std::get<std::shared_ptr<const NamedWorld>>(std::move(read));
  ManifestPart share;
  if (!options.part.empty()) {
    const auto given = read_part(options.part);
    if (!given) {
      return fail("--part",
                  "found \"" + options.part + "\", expected index/count, with an index from 0 to count - 1");
    }
    share = *given;
  }
  const int levels = world->open.levels();
  const auto wanted = read_levels(options.levels, levels);
  if (!wanted) {
    return fail("--levels", "found \"" + options.levels + "\", expected first-last or one level, from 0 to " +
                                std::to_string(levels - 1));
  }
  const double half = world->open.extent() / 2;
  WorldPart part{wanted->first, wanted->second, {-half, -half, half, half}};
  if (!options.box.empty()) {
    const Result<WorldBox> box = read_world_box(world->open, options.box, world->open.extent());
    if (!box) return fail("--box", box.error().issues.front().message);
    part.box = *box;
  }
  if (const std::string why = claim(options.folder, world->request, part); !why.empty())
    return fail(options.folder, why);
  return TilesRun(config, world->open, part, options, share).run();
}

}  // namespace seedmesh

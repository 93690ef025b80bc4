#include "server/manifest.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <thread>

#include "core/base/reserve.h"
#include "core/pipeline.h"
#include "server/negotiate.h"
#include "server/problem.h"
#include "server/texture_cache.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr std::chrono::milliseconds drawn_every{200};  ///< the progress bar
constexpr std::chrono::seconds told_every{10};         ///< a line of progress where nobody looks

std::string extension_of_format(std::string_view format) {
  const bool png = format == "png16" || format == "png8" || format == "rgb24" || format == "rgba32";
  return std::string(png ? "png" : format);
}

/// What earlier runs made: tag by file name.
std::map<std::string, std::string> read_results(const fs::path& folder) {
  std::map<std::string, std::string> tags;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(folder, fault)) {
    const std::string name = entry.path().filename().string();
    if (name.compare(0, 7, "results") != 0 || entry.path().extension() != ".jsonl") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const Json result =
          Json::parse(line, nullptr, false);  // the last line of a run that was killed may be cut
      if (!result.is_object() || !result.contains("file") || !result.contains("tag")) continue;
      tags[result["file"].get<std::string>()] = result["tag"].get<std::string>();
    }
  }
  return tags;
}

bool write_whole(const fs::path& path, const Payload& payload) {
  std::error_code fault;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), fault);
  const fs::path partial = path.string() + "." + std::to_string(::getpid()) + ".part";
  std::FILE* file = std::fopen(partial.c_str(), "wb");
  if (!file) return false;
  bool sound = true;
  for (const auto piece : payload.pieces())
    sound = sound && std::fwrite(piece.data(), 1, piece.size(), file) == piece.size();
  sound = std::fflush(file) == 0 && sound;
  sound = std::fclose(file) == 0 && sound;
  if (sound) fs::rename(partial, path, fault);
  if (sound && !fault) return true;
  const int reason = fault ? fault.value() : errno;
  fs::remove(partial, fault);
  errno = reason;
  return false;
}

/// "[#########...........] 451/1000, 12 refused, 103.2/s, 5 s left"
std::string bar(std::size_t done, std::size_t all, std::size_t refused, double rate) {
  constexpr std::size_t width = 30;
  const std::size_t filled = all == 0 ? width : done * width / all;
  char text[160];
  std::snprintf(text, sizeof(text), "[%s%s] %zu/%zu, %zu refused, %.1f/s", std::string(filled, '#').c_str(),
                std::string(width - filled, '.').c_str(), done, all, refused, rate);
  std::string line = text;
  if (rate > 0 && done < all)
    line +=
        ", " + std::to_string(static_cast<long>(static_cast<double>(all - done) / rate + 0.5)) + " s left";
  return line;
}

/// All threads of a run, and what they share.
class ManifestRun {
 public:
  ManifestRun(const Config& config, const ManifestOptions& options, std::vector<ManifestJob> jobs)
      : config_(config), options_(options), jobs_(std::move(jobs)), textures_(config.texture_bytes) {}

  int go(const fs::path& results) {
    made_before_ = read_results(options_.folder);
    results_ = std::fopen(results.c_str(), "ab");
    if (!results_) return 2;
    const auto begun = Clock::now();
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(config_.threads), jobs_.size());
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count; ++i) threads.emplace_back([this] { work(); });
    watch(begun);
    for (std::thread& thread : threads) thread.join();
    const bool written = std::fclose(results_) == 0;
    const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
    std::fprintf(stderr, "%zu made, %zu there already, %zu refused, %zu not done, in %.1f s\n", made_.load(),
                 there_.load(), refused_.load(), jobs_.size() - done(), seconds);
    if (!written || unwritable_) return 2;
    return refused_ > 0 || done() < jobs_.size() ? 1 : 0;
  }

 private:
  std::size_t done() const { return made_ + there_ + refused_; }

  void work() {
    while (!stop_.stop_requested() && !unwritable_) {
      const std::size_t index = next_++;
      if (index >= jobs_.size()) break;
      make(jobs_[index]);
    }
    const std::lock_guard lock(mutex_);
    ++ended_;
    changed_.notify_all();
  }

  void make(const ManifestJob& job) {
    const Result<Request> request = read_request(job.request, config_.limits);
    if (!request) return refuse(job, request.error());
    const std::string file = job.name + "." + extension_of_format(request->format());
    const std::string tag = tag_of(request->canonical(), engine_version());
    const fs::path path = fs::path(options_.folder) / file;
    const auto before = made_before_.find(file);
    std::error_code fault;
    if (before != made_before_.end() && before->second == tag && fs::exists(path, fault)) {
      ++there_;
      return;
    }
    Job::Options options;
    options.limits = config_.limits;
    options.threads = std::max(1, config_.threads / static_cast<int>(std::max<std::size_t>(1, jobs_.size())));
    options.stop = stop_.get_token();
    options.reserve = reserve_;
    const auto begun = Clock::now();
    options.deadline = begun + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(config_.time_limit));
    const Result<Product> product = produced(*request, std::move(options));
    if (!product && product.error().code == Code::cancelled) return;  // neither made nor refused
    if (!product) return refuse(job, product.error());
    if (!write_whole(path, product->payload)) {
      std::fprintf(stderr, "\nseedmesh: %s: %s\n", path.c_str(), std::strerror(errno));
      unwritable_ = true;
      return;
    }
    const double milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    tell({{"line", job.line},
          {"name", job.name},
          {"file", file},
          {"tag", tag},
          {"bytes", product->payload.size()},
          {"triangles", product->statistics.triangles},
          {"milliseconds", milliseconds}});
    ++made_;
  }

  Result<Product> produced(const Request& request, Job::Options options) {
    try {
      Job work(request.seed(), std::move(options));
      return produce(request, work, &textures_);
    } catch (const std::exception& error) {  // one line shall not end the others
      return Error{Code::internal, {{"", error.what()}}};
    }
  }

  void refuse(const ManifestJob& job, const Error& error) {
    tell({{"line", job.line},
          {"name", job.name},
          {"problem", Json::parse(problem_json(problem_of(error), ""))}});
    ++refused_;
  }

  void tell(const Json& result) {
    const std::string line = result.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    const std::lock_guard lock(mutex_);
    std::fwrite(line.data(), 1, line.size(), results_);
    std::fflush(results_);
  }

  /// Until all threads have ended: draws the bar, and ends them on a signal (blocked, taken here).
  void watch(Clock::time_point begun) {
    const bool seen = ::isatty(STDERR_FILENO) == 1;
    auto told = Clock::now();
    sigset_t ending;
    ::sigemptyset(&ending);
    ::sigaddset(&ending, SIGINT);
    ::sigaddset(&ending, SIGTERM);
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(config_.threads), jobs_.size());
    while (true) {
      {
        std::unique_lock lock(mutex_);
        if (changed_.wait_for(lock, drawn_every, [&] { return ended_ == count; })) break;
      }
      const timespec at_once{0, 0};
      if (::sigtimedwait(&ending, nullptr, &at_once) > 0) stop_.request_stop();
      if (options_.quiet || (!seen && Clock::now() - told < told_every)) continue;
      told = Clock::now();
      const double seconds = std::chrono::duration<double>(told - begun).count();
      const std::string line =
          bar(done(), jobs_.size(), refused_, static_cast<double>(made_ + refused_) / seconds);
      std::fprintf(stderr, seen ? "\r\033[K%s" : "%s\n", line.c_str());
    }
    if (seen && !options_.quiet) std::fputs("\r\033[K", stderr);
  }

  const Config& config_;
  const ManifestOptions& options_;
  const std::vector<ManifestJob> jobs_;
  TextureCache textures_;
  const std::shared_ptr<Reserve> reserve_ = std::make_shared<Reserve>();
  std::map<std::string, std::string> made_before_;
  std::FILE* results_ = nullptr;
  std::stop_source stop_;
  std::atomic<std::size_t> next_{0}, made_{0}, there_{0}, refused_{0};
  std::atomic<bool> unwritable_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t ended_ = 0;
};

std::optional<std::string> read_whole(const std::string& name) {
  std::FILE* file = name == "-" ? stdin : std::fopen(name.c_str(), "rb");
  if (!file) return std::nullopt;
  std::string text;
  char part[64 * 1'024];
  while (const std::size_t count = std::fread(part, 1, sizeof(part), file)) text.append(part, count);
  const bool failed = std::ferror(file) != 0;
  if (file != stdin) std::fclose(file);
  if (failed) return std::nullopt;
  return text;
}

}  // namespace

int manifest_command(const Config& config, const ManifestOptions& options) {
  const auto unusable = [](const std::string& what, const std::string& why) {
    std::fprintf(stderr, "seedmesh: %s: %s\n", what.c_str(), why.c_str());
    return 2;
  };
  ManifestPart part;
  if (!options.part.empty()) {
    const auto given = read_part(options.part);
    if (!given) return unusable("--part", "must be index/count, with index from 0 to count - 1");
    part = *given;
  }
  const auto text = read_whole(options.file);
  if (!text) return unusable(options.file, std::strerror(errno));
  auto jobs = read_manifest(*text);
  if (!jobs) {
    for (const Issue& issue : jobs.error().issues) {
      std::fprintf(stderr, "%s:%d: %s%s%s\n", options.file.c_str(), issue.line, issue.pointer.c_str(),
                   issue.pointer.empty() ? "" : ": ", issue.message.c_str());
    }
    return 1;
  }
  std::erase_if(*jobs, [&](const ManifestJob& job) { return (job.line - 1) % part.count != part.index; });
  std::error_code fault;
  fs::create_directories(options.folder, fault);
  if (fault) return unusable(options.folder, fault.message());

  sigset_t ending;  // taken by the thread that watches
  ::sigemptyset(&ending);
  ::sigaddset(&ending, SIGINT);
  ::sigaddset(&ending, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);
  const std::string results = part.count == 1 ? "results.jsonl"
                                              : "results-" + std::to_string(part.index) + "-of-" +
                                                    std::to_string(part.count) + ".jsonl";
  const fs::path path = fs::path(options.folder) / results;
  const int status = ManifestRun(config, options, std::move(*jobs)).go(path);
  if (status == 2) return unusable(path.string(), "the folder cannot be written to");
  return status;
}

}  // namespace seedmesh

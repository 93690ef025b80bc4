#include "server/manifest.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <thread>

#include "core/base/huge_page_cache.h"
#include "core/pipeline.h"
#include "server/files.h"
#include "server/negotiate.h"
#include "server/problem.h"
#include "server/texture_cache.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr std::chrono::milliseconds bar_interval{200};  ///< between two drawings of the progress bar
constexpr std::chrono::seconds line_interval{10};       ///< between two lines of progress without a terminal

/// The results of earlier runs by file name.
using Results = std::map<std::string, Json>;

/// Adds the results of one file. The last line of a run that was killed may be incomplete.
void read_results(const fs::path& path, Results& results) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    Json result = Json::parse(line, nullptr, false);
    if (!result.is_object() || !result.contains("file") || !result.contains("tag")) continue;
    std::string name = result["file"].get<std::string>();
    results[std::move(name)] = std::move(result);
  }
}

/// The results of all parts in a folder.
Results read_all_results(const fs::path& folder) {
  Results results;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("results") && entry.path().extension() == ".jsonl")
      read_results(entry.path(), results);
  }
  return results;
}

std::string line_of(const Json& result) {
  return result.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// "[#########...........] 451/1000, 12 refused, 103.2/s, 5 s left"
std::string bar(std::size_t done, std::size_t all, std::size_t refused, double rate) {
  constexpr std::size_t width = 30;
  const std::size_t filled = all == 0 ? width : done * width / all;
  char text[160];
  std::snprintf(text, sizeof(text), "[%s%s] %zu/%zu, %zu refused, %.1f/s", std::string(filled, '#').c_str(),
                std::string(width - filled, '.').c_str(), done, all, refused, rate);
  std::string line = text;
  if (rate > 0 && done < all) {
    line +=
        ", " + std::to_string(static_cast<long>(static_cast<double>(all - done) / rate + 0.5)) + " s left";
  }
  return line;
}

/// The threads of one run and their shared state.
class ManifestRun {
 public:
  ManifestRun(const Config& config, const ManifestOptions& options, std::vector<ManifestJob> jobs)
      : config_(config),
        options_(options),
        jobs_(std::move(jobs)),
        in_order_(jobs_.size()),
        textures_(config.texture_bytes) {}

  /// Returns the exit status. Results are appended to the file `results`, which is put in order at the end.
  int run(const fs::path& results) {
    earlier_ = read_all_results(options_.folder);
    results_ = std::fopen(results.c_str(), "ab");
    if (!results_) return 2;
    const auto begun = Clock::now();
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(config_.threads), jobs_.size());
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count; ++i) threads.emplace_back([this] { work(); });
    watch(begun);
    for (std::thread& thread : threads) thread.join();
    const bool written = std::fclose(results_) == 0 && put_in_order(results);
    const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
    std::fprintf(stderr, "%zu made, %zu unchanged, %zu refused, %zu not done, in %.1f s\n", made_.load(),
                 unchanged_.load(), refused_.load(), jobs_.size() - done(), seconds);
    if (!written || unwritable_) return 2;
    return refused_ > 0 || done() < jobs_.size() ? 1 : 0;
  }

 private:
  std::size_t done() const { return made_ + unchanged_ + refused_; }

  void work() {
    while (!stop_.stop_requested() && !unwritable_) {
      const std::size_t index = next_++;
      if (index >= jobs_.size()) break;
      make(index);
    }
    const std::lock_guard lock(mutex_);
    ++ended_;
    changed_.notify_all();
  }

  void make(std::size_t index) {
    const ManifestJob& job = jobs_[index];
    const Result<Request> request = read_request(job.request, config_.limits);
    if (!request) return refuse(index, request.error());
    const std::string file = job.name + "." + std::string(format_named(request->format()).extension);
    const std::string tag = tag_of(request->canonical(), engine_version());
    const fs::path path = fs::path(options_.folder) / file;
    const auto before = earlier_.find(file);
    std::error_code error;
    if (before != earlier_.end() && before->second["tag"] == tag && fs::exists(path, error)) {
      in_order_[index] = before->second;
      in_order_[index]["line"] = job.line;
      if (!options_.times) in_order_[index].erase("milliseconds");
      ++unchanged_;
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
    if (!product && product.error().code == Code::cancelled) return;  // interrupted: neither made nor refused
    if (!product) return refuse(index, product.error());
    if (!write_file_atomically(path.string(), product->payload)) {
      std::fprintf(stderr, "\nseedmesh: %s: %s\n", path.c_str(), system_error_text().c_str());
      unwritable_ = true;
      return;
    }
    Json result = {{"line", job.line},
                   {"name", job.name},
                   {"file", file},
                   {"tag", tag},
                   {"bytes", product->payload.size()},
                   {"triangles", product->statistics.triangles}};
    if (options_.times)
      result["milliseconds"] = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    record(index, std::move(result));
    ++made_;
  }

  Result<Product> produced(const Request& request, const Job::Options& options) {
    try {
      return produce(request, options, &textures_);
    } catch (const std::exception& error) {  // an error in one line does not end the others
      return Error{Code::internal, {{IssueKind::internal, "", error.what()}}};
    }
  }

  void refuse(std::size_t index, const Error& error) {
    record(index, {{"line", jobs_[index].line},
                   {"name", jobs_[index].name},
                   {"problem", Json::parse(problem_json(problem_of(error), ""))}});
    ++refused_;
  }

  /// Appends a line to the results.
  void record(std::size_t index, Json result) {
    const std::string line = line_of(result);
    in_order_[index] = std::move(result);
    const std::lock_guard lock(mutex_);
    std::fwrite(line.data(), 1, line.size(), results_);
    std::fflush(results_);
  }

  /// Writes the results anew: those of the input in its order, then those of other models.
  bool put_in_order(const fs::path& path) const {
    Results others;
    read_results(path, others);
    std::string text;
    for (const Json& result : in_order_) {
      if (result.is_null()) continue;  // the run was interrupted
      text += line_of(result);
      if (result.contains("file")) others.erase(result["file"].get<std::string>());
    }
    for (const auto& [file, result] : others) text += line_of(result);
    Payload payload;
    payload.add(std::move(text));
    return write_file_atomically(path.string(), payload);
  }

  /// Draws the progress until all threads have ended. Stops them on SIGINT and SIGTERM, which are blocked.
  void watch(Clock::time_point begun) {
    const bool terminal = ::isatty(STDERR_FILENO) == 1;
    auto last = Clock::now();
    sigset_t ending;
    ::sigemptyset(&ending);
    ::sigaddset(&ending, SIGINT);
    ::sigaddset(&ending, SIGTERM);
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(config_.threads), jobs_.size());
    while (true) {
      {
        std::unique_lock lock(mutex_);
        if (changed_.wait_for(lock, bar_interval, [&] { return ended_ == count; })) break;
      }
      const timespec at_once{0, 0};
      if (::sigtimedwait(&ending, nullptr, &at_once) > 0) stop_.request_stop();
      if (options_.quiet || (!terminal && Clock::now() - last < line_interval)) continue;
      last = Clock::now();
      const double seconds = std::chrono::duration<double>(last - begun).count();
      const std::string line =
          bar(done(), jobs_.size(), refused_, static_cast<double>(made_ + refused_) / seconds);
      std::fprintf(stderr, terminal ? "\r\033[K%s" : "%s\n", line.c_str());
    }
    if (terminal && !options_.quiet) std::fputs("\r\033[K", stderr);
  }

  const Config& config_;
  const ManifestOptions& options_;
  const std::vector<ManifestJob> jobs_;
  std::vector<Json> in_order_;  ///< the result of each job; each thread writes those of its jobs
  TextureCache textures_;
  const std::shared_ptr<HugePageCache> reserve_ = std::make_shared<HugePageCache>();
  Results earlier_;
  std::FILE* results_ = nullptr;
  std::stop_source stop_;
  std::atomic<std::size_t> next_{0}, made_{0}, unchanged_{0}, refused_{0};
  std::atomic<bool> unwritable_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t ended_ = 0;
};

}  // namespace

int manifest_command(const Config& config, const ManifestOptions& options) {
  ManifestPart part;
  if (!options.part.empty()) {
    const auto given = read_part(options.part);
    if (!given) return fail("--part", "must be index/count, with index from 0 to count - 1");
    part = *given;
  }
  const auto text = read_file(options.file);
  if (!text) return fail(options.file, system_error_text());
  auto jobs = read_manifest(*text);
  if (!jobs) {
    for (const Issue& issue : jobs.error().issues) {
      std::fprintf(stderr, "%s:%d: %s%s%s\n", options.file.c_str(), issue.line, issue.pointer.c_str(),
                   issue.pointer.empty() ? "" : ": ", issue.message.c_str());
    }
    return 1;
  }
  std::erase_if(*jobs, [&](const ManifestJob& job) { return (job.line - 1) % part.count != part.index; });
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (error) return fail(options.folder, error.message());

  sigset_t ending;  // watch() receives them
  ::sigemptyset(&ending);
  ::sigaddset(&ending, SIGINT);
  ::sigaddset(&ending, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);
  const std::string results = part.count == 1 ? "results.jsonl"
                                              : "results-" + std::to_string(part.index) + "-of-" +
                                                    std::to_string(part.count) + ".jsonl";
  const fs::path path = fs::path(options.folder) / results;
  const int status = ManifestRun(config, options, std::move(*jobs)).run(path);
  if (status == 2) return fail(path.string(), "cannot be written");
  return status;
}

}  // namespace seedmesh

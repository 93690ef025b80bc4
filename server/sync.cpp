#include "server/sync.h"

#include <signal.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <thread>

#include "server/files.h"
#include "server/http/text.h"
#include "server/model_source.h"
#include "server/signature.h"
#include "server/sync_scan.h"

namespace seedmesh {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Kind = SourceResponse::Kind;

constexpr std::chrono::milliseconds signal_interval{100};  ///< time between two checks for SIGINT and SIGTERM
constexpr std::chrono::seconds lock_interval{1};  ///< between two writes of the lock file during a run
constexpr int remote_jobs = 4;                    ///< requests to a server at the same time

std::string reason_of(int error) { return std::generic_category().message(error); }

void print(const char* word, const std::string& line) { std::printf("%s %s\n", word, line.c_str()); }

/// A model that has to be made.
struct Task {
  const ScannedFile* file = nullptr;
  std::string output;
  std::optional<LockedOutput> known;  ///< what the lock has of it
};

/// What became of a task.
struct Outcome {
  Kind kind = Kind::stopped;
  LockedOutput output;  ///< of made and same
  ErrorLines errors;    ///< of refused
  std::string failure;  ///< of unreachable, or why the file cannot be written
};

class SyncRun {
 public:
  SyncRun(const SyncOptions& options, Lock lock, const Scan& scan, ModelSource& source, int threads)
      : options_(options),
        lock_(std::move(lock)),
        scan_(scan),
        source_(source),
        threads_(threads),
        jobs_(options.server.empty() ? threads : std::max(remote_jobs, threads)) {}

  int check() {
    list_tasks();
    const SourceEngine engine = source_.engine();
    if (engine.version.empty()) return fail(engine.reason);
    add_outdated(engine.version);
    for (const Task& task : tasks_) print("changed", folder_of(task.file->key) + task.output);
    const auto surplus = surplus_of();
    for (const auto& [key, name] : surplus) print("surplus", folder_of(key) + name);
    const std::size_t changed = tasks_.size() + surplus.size();
    std::printf("%zu changed, %zu same, %zu refused\n", changed, same_, refused_);
    return changed + refused_ > 0 ? 1 : 0;
  }

  int run() {
    std::error_code error;
    for (const std::string& part : scan_.parts) fs::remove(part, error);
    list_tasks();
    const SourceEngine engine = source_.engine();
    if (engine.version.empty() && !tasks_.empty()) return fail(engine.reason);
    if (engine.version.empty()) {
      std::printf("note: the engine is not compared: %s\n", engine.reason.c_str());
    } else {
      add_outdated(engine.version);
    }
    const bool is_complete = make_all(engine.version);
    forget();
    if (!write_lock()) return fail(path_in(options_.directory, lock_file_name) + ": " + reason_of(errno));
    if (!failure_.empty()) return fail(failure_);
    std::printf("%zu made, %zu same, %zu refused%s\n", made_, same_, refused_,
                is_complete ? "" : ", interrupted");
    return refused_ > 0 || !is_complete ? 1 : 0;
  }

 private:
  static int fail(const std::string& reason) {
    std::fflush(stdout);
    std::fprintf(stderr, "seedmesh: %s\n", reason.c_str());
    return 2;
  }

  void refuse(const ErrorLines& lines) {
    ++refused_;
    for (const std::string& line : lines) print("refused", line);
  }

  std::optional<LockedOutput> known(const std::string& key, const std::string& name) const {
    const auto entry = lock_.find(key);
    if (entry == lock_.end()) return std::nullopt;
    const auto output = entry->second.outputs.find(name);
    return output == entry->second.outputs.end() ? std::nullopt : std::optional(output->second);
  }

  /// Finds what differs from the lock, and two request files that make one file.
  void list_tasks() {
    std::map<std::string, const ScannedFile*> owners;
    for (const ScannedFile& file : scan_.files) {
      if (!file.errors.empty()) refuse(file.errors);
      for (const ScannedOutput& output : file.outputs) {
        const auto [owner, is_new] = owners.emplace(folder_of(file.key) + output.name, &file);
        if (!is_new) {
          refuse(
              {file.path + ":1:1: makes " + output.name + ", which " + owner->second->path + " makes, too"});
        } else if (output.is_current) {
          ++same_;
        } else {
          tasks_.push_back({&file, output.name, known(file.key, output.name)});
        }
      }
    }
  }

  /// Adds models that another engine made.
  void add_outdated(const std::string& engine) {
    for (const ScannedFile& file : scan_.files) {
      for (const ScannedOutput& output : file.outputs) {
        if (!output.is_current) continue;
        const auto made = known(file.key, output.name);
        if (made->engine == engine) continue;
        tasks_.push_back({&file, output.name, made});
        --same_;
      }
    }
  }

  /// Makes all models on several threads; reports and locks them in the order of the tasks. False if interrupted.
  bool make_all(const std::string& engine) {
    outcomes_.resize(tasks_.size());
    std::vector<std::thread> threads;
    for (int i = 0; i < jobs_ && static_cast<std::size_t>(i) < tasks_.size(); ++i)
      threads.emplace_back([this, engine] { work(engine); });
    auto last_write = Clock::now();
    bool is_complete = true;
    for (std::size_t index = 0; index < tasks_.size(); ++index) {
      Outcome outcome = wait_for(index);
      is_complete = is_complete && outcome.kind != Kind::stopped;
      store(tasks_[index], std::move(outcome));
      if (Clock::now() - last_write < lock_interval) continue;
      write_lock();  // so that the models of a run that is killed are not made again
      last_write = Clock::now();
    }
    for (std::thread& thread : threads) thread.join();
    return is_complete;
  }

  void work(const std::string& engine) {
    for (std::size_t index = next_++; index < tasks_.size(); index = next_++) {
      Outcome outcome = stop_.stop_requested() ? Outcome{} : make(tasks_[index], engine);
      if (!outcome.failure.empty()) stop_.request_stop();
      const std::lock_guard guard(mutex_);
      outcomes_[index] = std::move(outcome);
      changed_.notify_all();
    }
  }

  /// Waits for the outcome of a task. Stops all threads on SIGINT and SIGTERM, which are blocked.
  Outcome wait_for(std::size_t index) {
    sigset_t ending;
    ::sigemptyset(&ending);
    ::sigaddset(&ending, SIGINT);
    ::sigaddset(&ending, SIGTERM);
    const timespec at_once{0, 0};
    std::unique_lock guard(mutex_);
    do {
      if (::sigtimedwait(&ending, nullptr, &at_once) > 0) stop_.request_stop();
    } while (!changed_.wait_for(guard, signal_interval, [&] { return outcomes_[index].has_value(); }));
    return std::move(*outcomes_[index]);
  }

  int threads_of_model() const {
    return std::max(1, threads_ / static_cast<int>(std::min<std::size_t>(tasks_.size(), 1'000)));
  }

  /// Makes one model and writes its file.
  Outcome make(const Task& task, const std::string& engine) {
    const auto text = read_file(task.file->path);
    if (!text || http::hex(sha256(*text)) != task.file->digest)
      return {Kind::refused, {}, {task.file->path + ":1:1: the file changed during the run"}, ""};
    const auto read = read_request_file(task.file->path, *text);
    if (const auto* errors = std::get_if<ErrorLines>(&read)) return {Kind::refused, {}, *errors, ""};
    const RequestFile& file = std::get<RequestFile>(read);
    const auto output = std::ranges::find(file.outputs, task.output, &RequestFileOutput::name);
    if (output == file.outputs.end())  // the lock file was changed by hand
      return {Kind::refused, {}, {task.file->path + ":1:1: does not make " + task.output}, ""};
    const std::string path = path_in(options_.directory, folder_of(task.file->key) + task.output);
    const bool is_there = task.known && task.known->engine == engine && has_digest(path, task.known->sha256);
    SourceResponse answer = source_.make(output->request, is_there ? task.known->etag : "",
                                         threads_of_model(), stop_.get_token());
    switch (answer.kind) {
      case Kind::same:
        return {Kind::same, *task.known, {}, ""};
      case Kind::refused:
        return {Kind::refused, {}, error_lines(file, task.output, answer.issues), ""};
      case Kind::unreachable:
        return {Kind::unreachable, {}, {}, answer.reason};
      case Kind::stopped:
        return {};
      case Kind::made:
        break;
    }
    if (!write_file_atomically(path, answer.payload, part_suffix))
      return {Kind::unreachable, {}, {}, path + ": " + reason_of(errno)};
    return {
        Kind::made, {answer.payload.size(), engine, answer.etag, http::hex(sha256(answer.payload))}, {}, ""};
  }

  void store(const Task& task, Outcome outcome) {
    if (outcome.kind == Kind::refused) return refuse(outcome.errors);
    if (outcome.kind == Kind::unreachable && failure_.empty()) failure_ = outcome.failure;
    if (outcome.kind != Kind::made && outcome.kind != Kind::same) return;
    LockEntry& entry = lock_[task.file->key];
    if (entry.request != task.file->digest) {
      const LockEntry old = std::exchange(entry, {task.file->digest, {}});
      for (const auto& [name, output] : old.outputs) {
        if (std::ranges::find(task.file->outputs, name, &ScannedOutput::name) == task.file->outputs.end())
          remove(task.file->key, name, output);
      }
    }
    entry.outputs[task.output] = std::move(outcome.output);
    if (outcome.kind == Kind::same) {
      ++same_;
      return;
    }
    ++made_;
    print("made", folder_of(task.file->key) + task.output);
    std::fflush(stdout);
  }

  /// Outputs of the lock that no request file makes any more: keys and names.
  std::vector<std::pair<std::string, std::string>> surplus_of() const {
    std::set<std::string> made, readable;
    for (const ScannedFile& file : scan_.files) {
      if (!file.errors.empty()) continue;
      readable.insert(file.key);
      for (const ScannedOutput& output : file.outputs) made.insert(folder_of(file.key) + output.name);
    }
    std::vector<std::pair<std::string, std::string>> surplus;
    for (const auto& [key, entry] : lock_) {
      const bool is_gone = !fs::exists(path_in(options_.directory, key));
      if (!is_gone && !readable.contains(key)) continue;
      for (const auto& [name, output] : entry.outputs) {
        if (!made.contains(folder_of(key) + name)) surplus.emplace_back(key, name);
      }
    }
    return surplus;
  }

  void forget() {
    for (const auto& [key, name] : surplus_of()) {
      remove(key, name, lock_[key].outputs[name]);
      lock_[key].outputs.erase(name);
    }
    std::erase_if(lock_,
                  [&](const auto& each) { return !fs::exists(path_in(options_.directory, each.first)); });
  }

  /// Removes a model that is as it was made. Another one is somebody's work and stays.
  void remove(const std::string& key, const std::string& name, const LockedOutput& output) {
    const std::string path = path_in(options_.directory, folder_of(key) + name);
    std::error_code error;
    if (has_digest(path, output.sha256) && fs::remove(path, error)) print("removed", folder_of(key) + name);
  }

  /// Writes the lock if it changed. An entry without all outputs of its request file has no hash, so that the next run
  /// makes the others.
  bool write_lock() {
    Lock lock = lock_;
    for (const ScannedFile& file : scan_.files) {
      const auto entry = lock.find(file.key);
      if (entry != lock.end() && file.errors.empty() && entry->second.outputs.size() != file.outputs.size())
        entry->second.request.clear();
    }
    const std::string path = path_in(options_.directory, lock_file_name);
    std::string text = lock_text(lock);
    if (const auto before = read_file(path); before && *before == text) return true;
    Payload payload;
    payload.add(std::move(text));
    return write_file_atomically(path, payload, part_suffix);
  }

  const SyncOptions& options_;
  Lock lock_;
  const Scan& scan_;
  ModelSource& source_;
  const int threads_;
  const int jobs_;  ///< models at the same time
  std::vector<Task> tasks_;
  std::vector<std::optional<Outcome>> outcomes_;
  std::string failure_;
  std::size_t made_ = 0, same_ = 0, refused_ = 0;
  std::stop_source stop_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::condition_variable changed_;
};

int fail(const std::string& what, const std::string& why) {
  std::fprintf(stderr, "seedmesh: %s: %s\n", what.c_str(), why.c_str());
  return 2;
}

/// The lock file of a directory; an empty one if there is none, nothing if it cannot be read.
std::optional<Lock> lock_of(const std::string& directory) {
  const std::string path = path_in(directory, lock_file_name);
  std::error_code error;
  if (!fs::exists(path, error)) return Lock{};
  const auto text = read_file(path);
  return text ? read_lock(*text) : std::nullopt;
}

/// Prints the paths of all models. Request files that cannot be read are left to a run.
int list(const SyncOptions& options, const Scan& scan) {
  for (const ScannedFile& file : scan.files) {
    for (const ScannedOutput& output : file.outputs)
      std::printf("%s\n", path_in(options.directory, folder_of(file.key) + output.name).c_str());
  }
  return 0;
}

void block_signals() {
  sigset_t ending;
  ::sigemptyset(&ending);
  ::sigaddset(&ending, SIGINT);
  ::sigaddset(&ending, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);
}

}  // namespace

int sync_command(const Config& config, const SyncOptions& options) {
  std::error_code error;
  if (!fs::is_directory(options.directory, error)) return fail(options.directory, "found no such directory");
  const auto lock = lock_of(options.directory);
  if (!lock) {
    return fail(path_in(options.directory, lock_file_name),
                "is no lock file; remove it to make all models again");
  }
  const Scan scan = scan_directory(options.directory, *lock, options.check, config.threads);
  if (!scan.failure.empty()) return fail(scan.failure, "cannot be read");
  if (scan.files.empty())
    std::fprintf(stderr, "seedmesh: %s: found no request files; their names end in .seedmesh\n",
                 options.directory.c_str());
  if (options.list) return list(options, scan);
  const std::unique_ptr<ModelSource> source =
      options.server.empty() ? local_source(config) : remote_source(options.server, options.key);
  if (!source) return fail("--server", "expected an address like http://127.0.0.1:8080");
  block_signals();
  SyncRun run(options, *lock, scan, *source, config.threads);
  return options.check ? run.check() : run.run();
}

}  // namespace seedmesh

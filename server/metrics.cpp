#include "server/metrics.h"

#include <dirent.h>
#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <vector>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

using prometheus::BuildCounter;
using prometheus::BuildGauge;
using prometheus::BuildHistogram;
using prometheus::Counter;
using prometheus::Family;
using prometheus::Histogram;

const Histogram::BucketBoundaries answer_seconds = {.0005, .001, .0025, .005, .01, .025, .05, .1,
                                                    .25,   .5,   1,     2.5,  5,   10,   30};

/// What the kernel reports about this process.
struct Process {
  double cpu_seconds = 0, started = 0;
  double resident = 0, virtual_bytes = 0, threads = 0, open_files = 0, most_files = 0;
};

Process read_process() {
  Process seen;
  std::ifstream stat("/proc/self/stat");
  std::string text((std::istreambuf_iterator<char>(stat)), {});
  // The second field is the name of the program in parentheses, which may contain spaces.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  const double ticks = static_cast<double>(::sysconf(_SC_CLK_TCK));
  std::string value;
  for (int field = 3; fields >> value; ++field) {
    if (field == 14 || field == 15) seen.cpu_seconds += std::stod(value) / ticks;
    if (field == 20) seen.threads = std::stod(value);
    if (field == 22) seen.started = std::stod(value) / ticks;
    if (field == 23) seen.virtual_bytes = std::stod(value);
    if (field == 24) seen.resident = std::stod(value) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  }
  std::ifstream system("/proc/stat");
  for (std::string line; std::getline(system, line);) {
    if (line.compare(0, 6, "btime ") == 0) seen.started += std::stod(line.substr(6));
  }
  if (DIR* directory = ::opendir("/proc/self/fd")) {
    while (::readdir(directory) != nullptr) seen.open_files += 1;
    seen.open_files -= 3;  // ".", ".." and the directory itself
    ::closedir(directory);
  }
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0) seen.most_files = static_cast<double>(files.rlim_cur);
  return seen;
}

/// A series whose value is read when /metrics is requested.
struct Level {
  template <class Number>
  Level(const char* given_name, const char* given_help, Number given)
      : name(given_name), help(given_help), value(static_cast<double>(given)) {}
  const char* name;
  const char* help;
  double value;
};

std::vector<Level> gauges(const Metrics::Levels& l, const Process& p) {
  return {
      {"seedmesh_in_flight", "Requests in progress, without health and metrics.", l.in_flight},
      {"seedmesh_memory_in_flight_bytes", "Bytes of responses that are being sent.", l.memory_in_flight},
      {"seedmesh_queue_depth", "Requests that wait for a worker.", l.waiting},
      {"seedmesh_workers", "Largest number of concurrent generations.", l.workers},
      {"seedmesh_workers_busy", "Generations that run now.", l.busy},
      {"seedmesh_workers_utilization", "Share of the workers that are busy, 0 to 1.",
       l.workers > 0 ? static_cast<double>(l.busy) / l.workers : 0.0},
      {"seedmesh_cache_bytes", "Bytes of finished models in memory.", l.cache.bytes},
      {"seedmesh_cache_entries", "Finished models in memory.", l.cache.entries},
      {"seedmesh_shared_cache_connections", "Open connections to the shared cache.", l.shared.connections},
      {"process_start_time_seconds", "Start time of the process since the epoch.", p.started},
      {"process_resident_memory_bytes", "Resident memory.", p.resident},
      {"process_virtual_memory_bytes", "Virtual memory.", p.virtual_bytes},
      {"process_threads", "Threads of the process.", p.threads},
      {"process_open_fds", "Open file descriptors.", p.open_files},
      {"process_max_fds", "Largest number of open file descriptors.", p.most_files},
  };
}

std::vector<Level> counters(const Metrics::Levels& l, const Process& p) {
  return {
      {"seedmesh_cache_hits_total", "Models answered from memory.", l.cache.hits},
      {"seedmesh_cache_joins_total", "Requests that waited for an equal request.", l.cache.joins},
      {"seedmesh_cache_misses_total", "Models that were not in memory.", l.cache.misses},
      {"seedmesh_cache_evictions_total", "Models removed from memory for others.", l.cache.evictions},
      {"seedmesh_shared_cache_hits_total", "Models found in the shared cache.", l.shared.hits},
      {"seedmesh_shared_cache_misses_total", "Models not found in the shared cache.", l.shared.misses},
      {"seedmesh_shared_cache_writes_total", "Models written to the shared cache.", l.shared.writes},
      {"seedmesh_shared_cache_errors_total", "Failed commands to the shared cache.", l.shared.errors},
      {"seedmesh_shared_cache_skips_total",
       "Commands not sent, because the shared cache was not available or busy.", l.shared.skips},
      {"process_cpu_seconds_total", "User and system time of the process.", p.cpu_seconds},
  };
}

}  // namespace

struct Metrics::Series {
  prometheus::Registry registry;
  Family<Counter>& requests =
      counters_by("seedmesh_requests_total", "Requests answered, by route and status.");
  Family<Histogram>& seconds = histograms_by(
      "seedmesh_request_duration_seconds", "Time from the arrival of a request to the end of its response.");
  Family<Histogram>& spans =
      histograms_by("seedmesh_span_duration_seconds",
                    "Parts of a response: waiting for a worker, deriving, meshing, encoding, compressing.");
  Family<Counter>& rejected =
      counters_by("seedmesh_rejected_total", "Requests refused before any work, by reason.");
  Family<Counter>& denied =
      counters_by("seedmesh_denied_total", "Requests that were not admitted (401, 403), by reason.");
  Family<Counter>& limited =
      counters_by("seedmesh_limited_total", "Requests refused because they would exceed a limit, by limit.");
  Family<Counter>& cancelled =
      counters_by("seedmesh_cancelled_total", "Requests stopped before their end, by reason.");
  Family<Counter>& used =
      counters_by("seedmesh_key_requests_total", "Requests admitted with an API key, by its name.");
  Counter& bytes = counters_by("seedmesh_response_bytes_total", "Bytes sent, with heads.").Add({});
  Counter& models = counters_by("seedmesh_models_total", "Models generated.").Add({});
  Counter& pictures = counters_by("seedmesh_pictures_total", "Pictures of models drawn.").Add({});
  Counter& triangles = counters_by("seedmesh_triangles_total", "Triangles generated.").Add({});
  Counter& vertices = counters_by("seedmesh_vertices_total", "Vertices generated.").Add({});

  std::mutex mutex;
  std::map<std::pair<std::string, int>, std::pair<Counter*, Histogram*>, std::less<>> by_route;
  std::mutex scraping;

  Family<Counter>& counters_by(const char* name, const char* help) {
    return BuildCounter().Name(name).Help(help).Register(registry);
  }
  Family<Histogram>& histograms_by(const char* name, const char* help) {
    return BuildHistogram().Name(name).Help(help).Register(registry);
  }
};

Metrics::Metrics() : series_(std::make_unique<Series>()) {
  Series& s = *series_;
  BuildGauge()
      .Name("seedmesh_build_info")
      .Help("Always 1; the labels are the versions.")
      .Register(s.registry)
      .Add({{"version", std::string(program_version())}, {"engine", std::string(engine_version())}})
      .Set(1);
  // The values of labels that are known exist from the start, so that a first event is an increase from 0.
  for (const char* reason : {"queue_full", "deadline", "draining", "connections", "bodies",
                             "memory_in_flight", "key_rate", "key_concurrency"})
    s.rejected.Add({{"reason", reason}});
  for (const char* reason :
       {"key_missing", "key_wrong", "signature_wrong", "signature_expired", "generator", "only_presets"})
    s.denied.Add({{"reason", reason}});
  for (const char* reason : {"client_gone", "deadline", "slow_client"}) s.cancelled.Add({{"reason", reason}});
  for (const char* limit : {"modules", "shapes", "triangles", "memory_bytes", "output_bytes", "body"})
    s.limited.Add({{"limit", limit}});
}

Metrics::~Metrics() = default;

void Metrics::answered(std::string_view route, int status, double seconds, std::uint64_t bytes) {
  std::pair<Counter*, Histogram*> found;
  {
    const std::lock_guard lock(series_->mutex);
    // The registry hashes all labels on each look-up; this map costs a tenth of that.
    auto& row = series_->by_route[{std::string(route), status}];
    if (!row.first) {
      row.first = &series_->requests.Add({{"route", std::string(route)}, {"status", std::to_string(status)}});
      row.second = &series_->seconds.Add({{"route", std::string(route)}}, answer_seconds);
    }
    found = row;
  }
  found.first->Increment();
  found.second->Observe(seconds);
  series_->bytes.Increment(static_cast<double>(bytes));
}

void Metrics::rejected(std::string_view reason) {
  series_->rejected.Add({{"reason", std::string(reason)}}).Increment();
}

void Metrics::denied(std::string_view reason) {
  series_->denied.Add({{"reason", std::string(reason)}}).Increment();
}

void Metrics::limited(std::string_view limit) {
  series_->limited.Add({{"limit", std::string(limit)}}).Increment();
}

void Metrics::cancelled(std::string_view reason) {
  series_->cancelled.Add({{"reason", std::string(reason)}}).Increment();
}

void Metrics::used(std::string_view key) { series_->used.Add({{"key", std::string(key)}}).Increment(); }

void Metrics::spent(std::string_view span, double seconds) {
  series_->spans.Add({{"span", std::string(span)}}, answer_seconds).Observe(seconds);
}

void Metrics::drawn() { series_->pictures.Increment(); }

void Metrics::made(const Statistics& statistics) {
  series_->models.Increment();
  series_->triangles.Increment(static_cast<double>(statistics.triangles));
  series_->vertices.Increment(static_cast<double>(statistics.vertices));
}

std::string Metrics::text(const Levels& levels) {
  const std::lock_guard lock(series_->scraping);  // two scrapes must not add the same difference twice
  const Process process = read_process();
  for (const Level& level : gauges(levels, process))
    BuildGauge().Name(level.name).Help(level.help).Register(series_->registry).Add({}).Set(level.value);
  for (const Level& level : counters(levels, process)) {
    Counter& counter = series_->counters_by(level.name, level.help).Add({});
    counter.Increment(std::max(0.0, level.value - counter.Value()));
  }
  return prometheus::TextSerializer().Serialize(series_->registry.Collect());
}

}  // namespace seedmesh

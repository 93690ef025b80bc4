#include "server/metrics.h"

#include <dirent.h>
#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

using prometheus::BuildCounter;
using prometheus::BuildGauge;
using prometheus::BuildHistogram;
using prometheus::Counter;
using prometheus::Family;
using prometheus::Gauge;
using prometheus::Histogram;

const Histogram::BucketBoundaries answer_seconds = {.0005, .001, .0025, .005, .01, .025, .05, .1,
                                                    .25,   .5,   1,     2.5,  5,   10,   30};

/// What the kernel tells of this process.
struct Process {
  double cpu_seconds = 0, started = 0;
  double resident = 0, virtual_bytes = 0, threads = 0, open_files = 0, most_files = 0;
};

Process look_at_process() {
  Process seen;
  std::ifstream stat("/proc/self/stat");
  std::string text((std::istreambuf_iterator<char>(stat)), {});
  // The name of the program stands in parentheses and may hold spaces; the fields after it are counted
  // from 3.
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

}  // namespace

struct Metrics::Series {
  prometheus::Registry registry;
  Family<Counter>& requests = BuildCounter()
                                  .Name("seedmesh_requests_total")
                                  .Help("Requests answered, by route and status.")
                                  .Register(registry);
  Family<Histogram>& seconds = BuildHistogram()
                                   .Name("seedmesh_request_duration_seconds")
                                   .Help("From a request's arrival to the last byte of its answer.")
                                   .Register(registry);
  Family<Histogram>& spans =
      BuildHistogram()
          .Name("seedmesh_span_duration_seconds")
          .Help("Parts of a generation: waiting for a worker, deriving, meshing, encoding.")
          .Register(registry);
  Family<Counter>& rejected = BuildCounter()
                                  .Name("seedmesh_rejected_total")
                                  .Help("Requests turned away before any work, by reason.")
                                  .Register(registry);
  Family<Counter>& denied = BuildCounter()
                                .Name("seedmesh_denied_total")
                                .Help("Requests that were not let in (401, 403), by reason.")
                                .Register(registry);
  Family<Counter>& limited = BuildCounter()
                                 .Name("seedmesh_limited_total")
                                 .Help("Requests refused because they would pass a limit, by limit.")
                                 .Register(registry);
  Family<Counter>& cancelled = BuildCounter()
                                   .Name("seedmesh_cancelled_total")
                                   .Help("Generations stopped before their end, by reason.")
                                   .Register(registry);
  Family<Counter>& used = BuildCounter()
                              .Name("seedmesh_key_requests_total")
                              .Help("Requests let in with an API key, by its name.")
                              .Register(registry);
  Counter& bytes = counter("seedmesh_response_bytes_total", "Bytes sent, heads included.");
  Counter& models = counter("seedmesh_models_total", "Models generated.");
  Counter& triangles = counter("seedmesh_triangles_total", "Triangles generated.");
  Counter& vertices = counter("seedmesh_vertices_total", "Vertices generated.");
  Gauge& in_flight = gauge("seedmesh_in_flight", "Requests being answered, health and metrics not counted.");
  Gauge& queue_depth = gauge("seedmesh_queue_depth", "Requests waiting for a worker.");
  Gauge& workers = gauge("seedmesh_workers", "Generations that may run at once.");
  Gauge& workers_busy = gauge("seedmesh_workers_busy", "Generations that run now.");
  Gauge& utilization = gauge("seedmesh_workers_utilization", "Share of the workers that is busy, 0 to 1.");
  Gauge& cache_bytes = gauge("seedmesh_cache_bytes", "Bytes of finished models in memory.");
  Gauge& cache_entries = gauge("seedmesh_cache_entries", "Finished models in memory.");
  Counter& cache_hits = counter("seedmesh_cache_hits_total", "Models answered from memory.");
  Counter& cache_joins = counter("seedmesh_cache_joins_total", "Requests that waited for an equal one.");
  Counter& cache_misses = counter("seedmesh_cache_misses_total", "Models that had to be made.");
  Counter& cache_evictions = counter("seedmesh_cache_evictions_total", "Models dropped to make room.");
  Gauge& shared_up = gauge("seedmesh_shared_cache_connections", "Open connections to the shared cache.");
  Counter& shared_hits = counter("seedmesh_shared_cache_hits_total", "Models found in the shared cache.");
  Counter& shared_misses = counter("seedmesh_shared_cache_misses_total", "Models not found there.");
  Counter& shared_writes = counter("seedmesh_shared_cache_writes_total", "Models written there.");
  Counter& shared_errors = counter("seedmesh_shared_cache_errors_total", "Exchanges with it that failed.");
  Counter& shared_skips =
      counter("seedmesh_shared_cache_skips_total", "Exchanges not tried: it was away or busy.");
  Counter& cpu = counter("process_cpu_seconds_total", "User and system time of the process.");
  Gauge& started = gauge("process_start_time_seconds", "Start of the process since the epoch.");
  Gauge& resident = gauge("process_resident_memory_bytes", "Resident memory.");
  Gauge& virtual_bytes = gauge("process_virtual_memory_bytes", "Virtual memory.");
  Gauge& threads = gauge("process_threads", "Threads of the process.");
  Gauge& open_files = gauge("process_open_fds", "Open file descriptors.");
  Gauge& most_files = gauge("process_max_fds", "Most file descriptors that may be open.");

  std::mutex mutex;
  std::map<std::pair<std::string, int>, std::pair<Counter*, Histogram*>, std::less<>> by_route;
  std::mutex scraping;

  Counter& counter(const char* name, const char* help) {
    return BuildCounter().Name(name).Help(help).Register(registry).Add({});
  }
  Gauge& gauge(const char* name, const char* help) {
    return BuildGauge().Name(name).Help(help).Register(registry).Add({});
  }
};

Metrics::Metrics() : series_(std::make_unique<Series>()) {
  BuildGauge()
      .Name("seedmesh_build_info")
      .Help("Always 1; the labels tell the versions.")
      .Register(series_->registry)
      .Add({{"version", std::string(program_version())}, {"engine", std::string(engine_version())}})
      .Set(1);
  for (const char* reason :
       {"queue_full", "deadline", "draining", "connections", "bodies", "key_rate", "key_concurrency"})
    series_->rejected.Add({{"reason", reason}});
  for (const char* reason :
       {"key_missing", "key_wrong", "signature_wrong", "signature_expired", "generator", "only_presets"})
    series_->denied.Add({{"reason", reason}});
  for (const char* reason : {"client_gone", "deadline"}) series_->cancelled.Add({{"reason", reason}});
  for (const char* limit : {"modules", "shapes", "triangles", "memory", "output", "body"})
    series_->limited.Add({{"limit", limit}});
}

Metrics::~Metrics() = default;

void Metrics::answered(std::string_view route, int status, double seconds, std::uint64_t bytes) {
  std::pair<Counter*, Histogram*> found;
  {
    const std::lock_guard lock(series_->mutex);
    // The registry hashes all labels on each look-up; this map is an order of magnitude cheaper.
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

void Metrics::made(const Statistics& statistics) {
  series_->models.Increment();
  series_->triangles.Increment(static_cast<double>(statistics.triangles));
  series_->vertices.Increment(static_cast<double>(statistics.vertices));
}

std::string Metrics::text(const Levels& levels) {
  const std::lock_guard lock(series_->scraping);  // two scrapes must not add the same difference twice
  Series& s = *series_;
  const auto raise = [](Counter& counter, double to) {
    counter.Increment(std::max(0.0, to - counter.Value()));
  };
  s.in_flight.Set(static_cast<double>(levels.in_flight));
  s.queue_depth.Set(static_cast<double>(levels.waiting));
  s.workers.Set(levels.workers);
  s.workers_busy.Set(levels.busy);
  s.utilization.Set(levels.workers > 0 ? static_cast<double>(levels.busy) / levels.workers : 0);
  s.cache_bytes.Set(static_cast<double>(levels.cache.bytes));
  s.cache_entries.Set(static_cast<double>(levels.cache.entries));
  raise(s.cache_hits, static_cast<double>(levels.cache.hits));
  raise(s.cache_joins, static_cast<double>(levels.cache.joins));
  raise(s.cache_misses, static_cast<double>(levels.cache.misses));
  raise(s.cache_evictions, static_cast<double>(levels.cache.evictions));
  s.shared_up.Set(static_cast<double>(levels.shared.connections));
  raise(s.shared_hits, static_cast<double>(levels.shared.hits));
  raise(s.shared_misses, static_cast<double>(levels.shared.misses));
  raise(s.shared_writes, static_cast<double>(levels.shared.writes));
  raise(s.shared_errors, static_cast<double>(levels.shared.errors));
  raise(s.shared_skips, static_cast<double>(levels.shared.skips));
  const Process process = look_at_process();
  raise(s.cpu, process.cpu_seconds);
  s.started.Set(process.started);
  s.resident.Set(process.resident);
  s.virtual_bytes.Set(process.virtual_bytes);
  s.threads.Set(process.threads);
  s.open_files.Set(process.open_files);
  s.most_files.Set(process.most_files);
  return prometheus::TextSerializer().Serialize(s.registry.Collect());
}

}  // namespace seedmesh

#include "server/serve.h"

#include <signal.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "server/cors.h"
#include "server/files.h"
#include "server/http/server.h"
#include "server/memory_trimmer.h"
#include "server/routes.h"
#include "server/service.h"
#include "server/trace.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

std::chrono::seconds whole_seconds(double seconds) {
  return std::chrono::seconds(static_cast<long>(seconds + 0.5));
}

http::ServerOptions server_options(const Config& config) {
  http::ServerOptions options;
  options.host = config.host;
  options.port = config.port;
  options.limits.body = config.body_limit;
  options.tls = config.tls;
  options.body_memory = config.body_memory;
  options.connections = static_cast<std::size_t>(config.connections);
  options.head_time = whole_seconds(config.head_timeout);
  options.body_time = whole_seconds(config.body_timeout);
  options.idle_time = whole_seconds(config.idle_timeout);
  options.pace.timeout = whole_seconds(config.write_timeout);
  options.pace.grace = whole_seconds(config.min_rate_grace);
  options.pace.rate = config.min_rate;
  return options;
}

bool is_probe(std::string_view path) { return path == "/healthz" || path == "/readyz" || path == "/metrics"; }

/// Adds what every response has: CORS fields and the trace.
http::Response finish(const Service& service, const http::Request& request, http::Response response) {
  allow_origin(service.config.cors_origins, request, response);
  const auto trace = read_traceparent(request.header("Traceparent"));
  if (!trace) return response;
  response.set("Traceparent", traceparent(*trace));
  response.log_fields.insert(
      response.log_fields.end(),
      {{"trace_id", trace->trace_id}, {"span_id", trace->span_id}, {"parent_span_id", trace->parent_id}});
  return response;
}

http::Response handle(Service& service, const http::Request& request) {
  if (is_probe(request.path)) return finish(service, request, route(service, request));
  struct InFlight {
    explicit InFlight(std::atomic<std::int64_t>& given) : count(given) { ++count; }
    ~InFlight() { --count; }
    std::atomic<std::int64_t>& count;
  } in_flight(service.in_flight);
  return finish(service, request, route(service, request));
}

/// The response to a request that no route sees.
http::Response refuse_unread(Service& service, const http::Request& request, const http::Refusal& refusal) {
  if (refusal.status == 503) service.metrics.rejected(refusal.reason);
  if (refusal.status == 413) service.metrics.limited("body");
  std::optional<http::Response> response;
  if (refusal.status == 411) response = refuse_target(service, request);
  if (!response) {
    response = to_response(problem(refusal.status, refusal.detail), request.id);
    response->route = "unread";
  }
  return finish(service, request, *std::move(response));
}

http::Response fail(const Service& service, const http::Request& request, const std::string& what) {
  http::Response response = to_response(internal_error(what), request.id);
  response.route = "failed";
  return finish(service, request, std::move(response));
}

void record(Service& service, const http::Exchange& exchange) {
  const http::Request& request = exchange.request;
  const http::Response& response = exchange.response;
  ++service.answered;
  service.metrics.answered(response.route, response.status, exchange.seconds, exchange.sent);
  if (exchange.slow) service.metrics.cancelled("slow_client");
  const auto level = response.status == 500   ? Log::Level::error
                     : is_probe(request.path) ? Log::Level::debug
                                              : Log::Level::info;
  if (!service.log.writes(level)) return;
  constexpr std::size_t shown = 256;  // a permalink may have 8,000 characters
  Json fields = {{"request_id", request.id},
                 {"method", request.method},
                 {"path", request.path.substr(0, shown)},
                 {"route", response.route},
                 {"status", response.status},
                 {"bytes", exchange.sent},
                 {"duration_ms", exchange.seconds * 1e3},
                 {"remote", request.remote}};
  if (!response.cache_use.empty()) fields["cache"] = response.cache_use;
  for (const auto& [name, value] : response.log_fields) fields[name] = value;
  if (!response.log_text.empty()) fields["reason"] = response.log_text;
  if (!exchange.complete) fields["complete"] = false;
  if (exchange.slow) fields["reason"] = "the client read too slowly";
  service.log.write(level, "request", fields);
}

std::string url_of(const Config& config, int port) {
  const std::string host = config.host.find(':') == std::string::npos ? config.host : "[" + config.host + "]";
  return (config.tls ? "https://" : "http://") + host + ":" + std::to_string(port);
}

}  // namespace

int serve(const Config& config, const std::vector<std::string>& warnings) {
  configure_malloc(config.threads);
  ::signal(SIGPIPE, SIG_IGN);
  sigset_t ending;
  ::sigemptyset(&ending);
  ::sigaddset(&ending, SIGTERM);
  ::sigaddset(&ending, SIGINT);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);  // later threads inherit the mask

  const Log log(config.log_level);
  for (const std::string& warning : warnings) log.write(Log::Level::warn, warning);
  Service service(config, log);
  http::Callbacks callbacks;
  callbacks.handle = [&](const http::Request& request) { return handle(service, request); };
  callbacks.refuse = [&](const auto& request, const auto& refusal) {
    return refuse_unread(service, request, refusal);
  };
  callbacks.fail = [&](const auto& request, const auto& what) { return fail(service, request, what); };
  callbacks.done = [&](const http::Exchange& exchange) { record(service, exchange); };
  http::Server server(server_options(config), std::move(callbacks));
  const int port = server.bind();
  if (port == 0) {
    log.write(Log::Level::error, "cannot listen",
              {{"url", url_of(config, config.port)}, {"reason", system_error_text()}});
    return 1;
  }
  const std::string url = url_of(config, port);
  std::printf("Listening on %s\n", url.c_str());
  std::fflush(stdout);
  log.write(Log::Level::info, "listening",
            {{"url", url},
             {"version", program_version()},
             {"engine", engine_version()},
             {"threads", config.threads}});

  const MemoryTrimmer memory_trimmer(
      [&] {
        return MemoryTrimmer::Activity{service.answered.load(), service.in_flight.load()};
      },
      [&] { service.huge_pages->clear(); });
  std::thread listening([&] { server.run(); });
  int signal = 0;
  ::sigwait(&ending, &signal);
  service.draining = true;
  log.write(Log::Level::info, "draining", {{"in_flight", service.in_flight.load()}});
  std::this_thread::sleep_for(std::chrono::duration<double>(config.drain_delay));
  service.admission.drain();
  server.drain();
  listening.join();
  log.write(Log::Level::info, "ended");
  return 0;
}

}  // namespace seedmesh

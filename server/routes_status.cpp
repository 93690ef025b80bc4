/// Routes for operators and browsers. They need no worker.
#include <nlohmann/json.hpp>

#include "server/negotiate.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

/// For the web client: all files come from this service, without inline scripts and styles. The viewer reads the
/// textures of a model through blob URLs.
constexpr const char* client_security =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'self'";

/// For the reference: one file with an inline style and without scripts.
constexpr const char* docs_security =
    "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'self'";

/// The codings that embed_assets.cpp writes.
constexpr Coding asset_codings[] = {Coding::br, Coding::gzip};

http::Response status_answer(int status, std::string_view word) {
  http::Response response;
  response.status = status;
  response.type = "application/json";
  response.body = nlohmann::json{{"status", word}}.dump();
  response.set("Cache-Control", "no-store");
  return response;
}

void add_page_headers(http::Response& response, const char* security) {
  response.set("Content-Security-Policy", security);
  response.set("Referrer-Policy", "no-referrer");
}

}  // namespace

http::Response get_healthz(RequestContext&) { return status_answer(200, "ok"); }

http::Response get_readyz(RequestContext& call) {
  if (!call.service.draining) return status_answer(200, "ready");
  return refuse(call, problem(503, "The service is shutting down."));
}

http::Response get_version(RequestContext&) {
  http::Response response;
  response.type = "application/json";
  response.body =
      nlohmann::ordered_json{
          {"name", "seedmesh"}, {"version", program_version()}, {"engine", engine_version()}}
          .dump();
  response.set("Cache-Control", "no-cache");
  return response;
}

http::Response get_metrics(RequestContext& call) {
  Service& service = call.service;
  Metrics::Levels levels;
  levels.in_flight = service.in_flight;
  levels.memory_in_flight = service.in_flight_memory.bytes();
  levels.waiting = service.admission.waiting();
  levels.workers = service.admission.workers();
  levels.busy = service.admission.busy();
  levels.cache = service.cache.counters();
  levels.shared = service.shared.counters();
  http::Response response;
  response.type = "text/plain; version=0.0.4; charset=utf-8";
  response.body = service.metrics.text(levels);
  response.set("Cache-Control", "no-store");
  return response;
}

http::Response get_docs(RequestContext& call) {
  http::Response response =
      static_response(call, "/docs", "text/html; charset=utf-8", [&] { return call.service.pages.docs(); });
  add_page_headers(response, docs_security);
  return response;
}

http::Response get_asset(RequestContext& call) {
  const Asset& asset = *call.service.pages.find(call.request.path);
  const auto coding = choose_coding(call.request.header("Accept-Encoding"), asset_codings);
  if (!coding) return refuse(call, not_acceptable());
  const std::string_view packed = *coding == Coding::br     ? asset.br
                                  : *coding == Coding::gzip ? asset.gzip
                                                            : "";
  const Coding used = packed.empty() ? Coding::identity : *coding;
  const std::string tag = tag_of(asset.bytes, asset.path);
  http::Response response;
  response.set("ETag", etag(tag, used));
  response.set("Vary", "Accept-Encoding");
  response.set("Cache-Control",
               has_hashed_name(asset.path) ? "public, max-age=31536000, immutable" : "no-cache");
  add_page_headers(response, client_security);
  if (matches(call.request.header("If-None-Match"), tag)) {
    response.status = 304;
    return response;
  }
  response.type = asset.type;
  if (used != Coding::identity) response.set("Content-Encoding", std::string(name_of(used)));
  response.body = std::string(used == Coding::identity ? asset.bytes : packed);
  return response;
}

}  // namespace seedmesh

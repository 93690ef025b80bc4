#pragma once
/// From a request to its answer: one table of patterns, methods and functions.
#include "server/service.h"

namespace seedmesh {

/// Answers any request; never throws what a client can cause.
http::Response route(Service& service, const http::Request& request);

// The functions of the table, by file.
http::Response post_generate(Call& call);  // routes_models.cpp
http::Response get_model(Call& call);
http::Response get_preset(Call& call);

http::Response post_validate(Call& call);  // routes_json.cpp
http::Response post_derive(Call& call);
http::Response post_import(Call& call);
http::Response get_presets(Call& call);
http::Response get_schema(Call& call);
http::Response get_vocabulary(Call& call);
http::Response get_openapi(Call& call);

http::Response get_healthz(Call& call);  // routes_status.cpp
http::Response get_readyz(Call& call);
http::Response get_metrics(Call& call);
http::Response get_version(Call& call);
http::Response get_docs(Call& call);
http::Response get_asset(Call& call);

/// Progress, heartbeats and the end of a generation as server-sent events (events.cpp).
http::Response generate_events(Call& call, const Known& known);

/// The query as pairs, or nothing where an escape is malformed.
std::optional<Overrides> read_query(std::string_view query);

/// Reads a text as a request that is allowed here, with a worker where that takes long, or gives the refusal.
std::variant<Request, http::Response> read_text(Call& call, const std::string& text);

/// Reads the body of a POST as a request, or gives the refusal: 415, 400, 422.
std::variant<Request, http::Response> read_body(Call& call);

}  // namespace seedmesh

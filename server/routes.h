#pragma once
/// Routing: one table of patterns, methods and functions.
#include <optional>

#include "server/caching.h"
#include "server/service.h"

namespace seedmesh {

/// Answers any request. A client cannot cause an exception.
http::Response route(Service& service, const http::Request& request);

/// Returns the response to a request whose body is not read, if no body would help: 404 without such a resource, 405
/// if the resource does not have the method.
std::optional<http::Response> refuse_target(Service& service, const http::Request& request);

// The functions of the table, by file.
http::Response post_generate(RequestContext& call);  // routes_models.cpp
http::Response get_model(RequestContext& call);
http::Response get_preset(RequestContext& call);
/// Returns the Server-Timing field of a response whose head is about to be sent. `asked` is the time when the model
/// was requested from the caches, and `found` when it was available. The parts, whose sum is the total, are:
/// - `parse`: from the arrival of the request to `asked`;
/// - the parts of the generation, unless the model is from a cache;
/// - `wait`: the rest up to `found`, for a worker, a cache or another request;
/// - `compress`. Large models are compressed later, while they are sent.
std::string server_timing(const RequestContext& call, std::string_view cache_use, const CachedModel& made,
                          Clock::time_point asked, Clock::time_point found);

/// Whether a query may have keys beside those of a picture.
enum class OtherQueryKeys { refused, kept };
/// Reads the keys of a picture and removes them from the query. Returns the response on an error (routes_pictures.cpp).
std::variant<PictureOptions, http::Response> read_options(const RequestContext& call, Overrides& query,
                                                          OtherQueryKeys rest);
/// Returns a picture of the model of a request.
http::Response picture_response(RequestContext& call, const Request& request, const PictureOptions& picture,
                                Caching caching);

http::Response get_card(RequestContext& call);  // routes_card.cpp

http::Response get_texture(RequestContext& call);  // routes_textures.cpp

http::Response get_world(RequestContext& call);  // routes_worlds.cpp
/// Returns the tileset of a posted world.
http::Response post_world(RequestContext& call, const Request& request);
/// Returns the map of a posted world inside the box that the query names; 422 for another generator.
http::Response derive_world(RequestContext& call, const Request& request);
/// Lets pages of all origins read a response, unless the settings name some origins. Answers their preflight requests.
void open_to_pages(const Service& service, const http::Request& request, http::Response& response);

http::Response post_validate(RequestContext& call);  // routes_json.cpp
http::Response post_derive(RequestContext& call);
http::Response post_import(RequestContext& call);
http::Response get_presets(RequestContext& call);
http::Response get_schema(RequestContext& call);
http::Response get_vocabulary(RequestContext& call);
http::Response get_openapi(RequestContext& call);

http::Response post_mcp(RequestContext& call);  // mcp_http.cpp

http::Response get_healthz(RequestContext& call);  // routes_status.cpp
http::Response get_readyz(RequestContext& call);
http::Response get_metrics(RequestContext& call);
http::Response get_version(RequestContext& call);
http::Response get_docs(RequestContext& call);
http::Response get_asset(RequestContext& call);

/// Reports the progress and result of a generation as server-sent events (events.cpp).
http::Response generate_events(RequestContext& call, const TaggedRequest& wanted);

/// Returns the query as decoded pairs; nothing where an escape is malformed.
std::optional<Overrides> read_query(std::string_view query);

/// Returns the query of a call; the response (400) where an escape is malformed.
std::variant<Overrides, http::Response> parse_query(const RequestContext& call);

/// Parses the text of a request and checks that it is allowed. A large text waits for a worker. Returns the
/// response on an error.
std::variant<Request, http::Response> read_text(RequestContext& call, const std::string& text);

/// Parses the body of a POST as a request. Returns the response on an error (415, 400, 422).
std::variant<Request, http::Response> read_body(RequestContext& call);

}  // namespace seedmesh

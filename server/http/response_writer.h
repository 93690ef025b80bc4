#pragma once
#include "server/http/connection.h"
#include "server/http/message.h"

namespace seedmesh::http {

/// Returns the status line and header fields of a response, with Date, X-Request-Id, X-Content-Type-Options and the
/// framing of the body: its length, or chunks for a stream. A field whose name or value contains a line break
/// is left out, so that no value can add a field.
std::string response_head(const Request& request, const Response& response);

/// Sends head and body. HEAD, 204 and 304 have no body. A stream is sent as it is written, in chunks.
/// False when the client left before the end.
bool write_response(Connection& connection, const Request& request, const Response& response);

}  // namespace seedmesh::http

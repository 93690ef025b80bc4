#pragma once
/// Cross-origin resource sharing (Fetch standard, "CORS protocol").
#include <string>
#include <vector>

#include "server/http/message.h"

namespace seedmesh {

/// Adds the fields that let a page of the request's origin read the response, if `origins` contain the origin or
/// "*". Adds Vary where the response depends on the origin. Without `origins` it adds nothing.
void allow_origin(const std::vector<std::string>& origins, const http::Request& request,
                  http::Response& response);

}  // namespace seedmesh

#pragma once
/// Pages of other origins (Fetch standard, "CORS protocol"): which may read answers, and what they may send.
#include <string>
#include <vector>

#include "server/http/message.h"

namespace seedmesh {

/// Adds what lets a page of the request's origin read the answer, where `origins` name it. Answers that
/// depend on the origin say so in Vary. No origins: nothing is added.
void allow_origin(const std::vector<std::string>& origins, const http::Request& request,
                  http::Response& response);

}  // namespace seedmesh

#pragma once
/// Refusals as RFC 9457 "problem details". What the client reads and what the operator reads are different
/// fields: nothing of the inside of the program goes into the public ones.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "server/http/message.h"

namespace seedmesh {

struct Problem {
  int status = 500;
  std::string word;           ///< ends the problem's type: "invalid-request"; part of the contract
  std::string detail;         ///< one sentence
  std::vector<Issue> errors;  ///< every fault, with its place
  int retry_after = 0;        ///< seconds, 0 = not said
  std::string log_text;       ///< for the operator only
};

/// 400 malformed, 422 invalid or over a limit, 504 over time, 500 otherwise with nothing but the request's
/// id. A client that has gone gets 499, which only the log sees.
Problem problem_of(const Error& error);

/// A problem that needs no list of faults, by status: 401, 403, 404, 405, 406, 411, 413, 414, 415, 416, 417,
/// 429, 431, 503, 505, ...
Problem problem(int status, std::string detail);

/// Which limit a "limit-exceeded" is about, in one word of a bounded set; "other" where its text tells none.
std::string_view limit_of(const Problem& problem);

/// The whole object as JSON; `instance` is the request's id, `indent` as of nlohmann (-1 = one line).
std::string problem_json(const Problem& problem, std::string_view instance, int indent = -1);

http::Response to_response(const Problem& problem, std::string_view instance);

/// Every word with its title and status, for the documentation.
struct ProblemKind {
  int status;
  std::string_view word;
  std::string_view title;
};
const std::vector<ProblemKind>& problem_kinds();

}  // namespace seedmesh

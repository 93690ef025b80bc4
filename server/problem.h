#pragma once
/// Error responses as "problem details" (RFC 9457). Texts for the client and texts for the operator are separate
/// fields, so that internal details never reach a client.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "server/http/message.h"

namespace seedmesh {

struct Problem {
  int status = 500;
  std::string word;  ///< the end of the problem type, such as "invalid-request"; part of the public contract
  std::string detail;         ///< one sentence
  std::vector<Issue> errors;  ///< every error, with its pointer
  std::string format;         ///< for an import, the format as which the file was read; else empty
  int retry_after = 0;        ///< seconds; 0: no Retry-After
  std::string log_text;       ///< for the operator only
};

/// Status 400 for malformed, 422 for invalid and for a limit, 504 for the deadline. Internal errors are 500 with
/// only the request id. A cancelled request is 499, which appears only in the log.
Problem problem_of(const Error& error);

/// Returns a problem without a list of errors, by status: 401, 403, 404, 405, 406, 411, 413, 414, 415, 416, 417,
/// 429, 431, 503, 505, ...
Problem problem(int status, std::string detail);

/// 500 without details for the client; `log_text` goes to the log.
Problem internal_error(std::string log_text);

/// Returns the resource whose limit a "limit-exceeded" is about, a word_of(Resource); "other" where no error names one.
std::string_view limit_of(const Problem& problem);

/// Returns the problem as JSON. `instance` is the request id; `indent` is that of nlohmann::json (-1: one line).
std::string problem_json(const Problem& problem, std::string_view instance, int indent = -1);

/// Makes the response of a problem. `instance` is the request id.
http::Response to_response(const Problem& problem, std::string_view instance);

/// All problem types with status and title, for the documentation.
struct ProblemKind {
  int status;
  std::string_view word;
  std::string_view title;
};
const std::vector<ProblemKind>& problem_kinds();

}  // namespace seedmesh

#pragma once
/// The contents of a Request, for core/pipeline only.
#include <string>

#include "core/pipeline.h"
#include "core/registry/registry.h"
#include "generated/params/output.h"

namespace seedmesh {

struct Request::Body {
  const Generator* generator = nullptr;  ///< never null in a Request
  Generator::Params params;              ///< parameters of that generator
  OutputParams output;
  std::uint64_t seed = 0;
  std::string canonical;
  std::string name;  ///< name of the model (names.h)
};

/// Canonical JSON of generator, parameters, seed and output.
std::string canonical_request(const Request::Body& body);

/// Reads a request without its canonical text and name. Code::invalid lists all errors. Throws Stop.
Result<Request::Body> read_parts(const Json& json, const Job& job);

inline WantedFormat wanted_format(const OutputParams& output) {
  return {text_of(output.format), text_of(output.profile)};
}

/// Returns the part of a request that has a member of this name: "output", "parameters" (of `generator`), or "" for
/// none.
std::string_view part_with(std::string_view member, std::string_view generator);

/// Reads a request from parsed JSON within the limits, stop and deadline of `options`. Code::invalid lists all errors.
Result<Request> read_request_body(const Json& json, const Job::Options& options);

}  // namespace seedmesh

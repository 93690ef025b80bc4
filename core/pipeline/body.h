#pragma once
/// What a Request holds, for the files of core/pipeline alone.
#include <string>

#include "core/generators/registry.h"
#include "core/pipeline.h"
#include "generated/params/output.h"

namespace seedmesh {

struct Request::Body {
  const Generator* generator = nullptr;  ///< never null in a Request
  Generator::Params params;              ///< of that generator
  OutputParams output;
  std::uint64_t seed = 0;
  std::string canonical;
};

inline WantedForm wanted_form(const OutputParams& output) {
  return {text_of(output.format), text_of(output.profile)};
}

/// Reads a whole request that is JSON already. Every fault at once, as Code::invalid.
Result<Request> read_request_body(const Json& json, const Limits& limits);

}  // namespace seedmesh

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

/// Which part of a request has a member of this name: "output", "parameters" (of the generator, which may be
/// empty), or "": none.
std::string_view part_with(std::string_view member, std::string_view generator);

/// Reads a whole request that is JSON already. Every fault at once, as Code::invalid.
Result<Request> read_request_body(const Json& json, const Limits& limits);

}  // namespace seedmesh

#pragma once
/// The body of a model's response in a content coding.
#include <string_view>

#include "server/service.h"

namespace seedmesh {

/// A body with the coding that was used. The memory of the model counts as in flight while the body exists.
struct CodedBody {
  Coding used = Coding::identity;
  std::variant<http::Slice, http::Stream> body;
};

/// Returns the model in the best coding that the client accepts; nothing if the limit of memory in flight
/// would be exceeded. The model is not encoded if it is small, or if compression would save less than 15 %.
/// It is also not encoded if the request has a Range, or if a setting excludes it. Small models are encoded
/// here, large ones while they are sent. The cache keeps the encoded form of models up to 64 MiB.
std::optional<CodedBody> coded_body(const RequestContext& call, const TaggedRequest& wanted,
                                    const Cache::Entry& model, Coding best);

/// Whether an IP address, as text, belongs to this machine or to a private network (RFC 1918, RFC 4193,
/// link-local).
bool is_private_address(std::string_view address);

}  // namespace seedmesh

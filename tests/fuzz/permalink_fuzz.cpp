/// A permalink's token of any characters: it opens within its bound or is refused, and has one spelling.
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/base64url.h"
#include "core/base/deflate.h"
#include "server/permalink.h"

namespace {

constexpr std::size_t most = 1U << 20U;
constexpr std::size_t most_rewritten = 1U << 12U;  // depth is the request reader's to bound

void check(std::string_view text) {
  using namespace seedmesh;
  const Result<Token> token = read_token(text, most);
  if (!token) {
    if (token.error().code != Code::malformed || token.error().issues.empty()) std::abort();
    return;
  }
  if (token->request.size() > most) std::abort();
  if (!token->engine || token->request.size() > most_rewritten) return;
  const nlohmann::json request = nlohmann::json::parse(token->request, nullptr, false);
  if (!request.is_object() || request.contains("engine")) return;  // of two engines one counts
  try {
    const Result<Token> again = read_token(write_token(request.dump(), *token->engine), 2 * most);
    if (!again || again->engine != token->engine) std::abort();
  } catch (const nlohmann::json::type_error&) {  // an engine that is no UTF-8: no such token is written
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check(text);
  if (const auto bytes = seedmesh::from_base64url(text)) {
    if (seedmesh::base64url(*bytes) != text) std::abort();
  }
  // The same bytes as what is inside of a sound wrapping, so that the fuzzer gets there.
  check(seedmesh::base64url(seedmesh::deflate_raw(text)));
  check(seedmesh::base64url(text));
  return 0;
}

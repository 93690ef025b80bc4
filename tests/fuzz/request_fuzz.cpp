/// A request body of any bytes: it is taken or refused, and what is taken keeps the promise of its canonical
/// form.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/pipeline.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  const std::string_view body(reinterpret_cast<const char*>(data), size);
  const Result<Request> request = read_request(body, Limits{});
  if (!request) {
    if (request.error().issues.empty()) std::abort();
    return 0;
  }
  const Result<Request> again = read_request(request->canonical(), Limits{});
  if (!again || again->canonical() != request->canonical() || again->seed() != request->seed()) std::abort();
  return 0;
}

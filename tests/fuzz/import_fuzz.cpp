/// The readers of foreign files: the first byte chooses the format, the rest is the text. Whatever stands
/// there ends in faults with places inside the text, or in a request that its generator takes.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/import/import.h"
#include "core/pipeline.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  if (size == 0) return 0;
  const auto formats = import_formats();
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  Limits limits;
  limits.modules = 20'000;
  const Result<ImportedRequest> result =
      import_request({formats[data[0] % formats.size()].name, "", text}, limits);
  if (!result) {
    for (const Issue& issue : result.error().issues) {
      if (issue.message.empty() || issue.line < 0) std::abort();
    }
    return 0;
  }
  if (!read_request(result->request.canonical(), limits)) std::abort();
  return 0;
}

#include "core/schema/writer.h"

namespace seedmesh::schema {

Json write_seed(std::uint64_t seed) {
  constexpr std::uint64_t exact = (std::uint64_t{1} << 53U) - 1;  // Number.MAX_SAFE_INTEGER
  return seed <= exact ? Json(seed) : Json(std::to_string(seed));
}

}  // namespace seedmesh::schema

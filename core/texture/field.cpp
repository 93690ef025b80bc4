#include "core/texture/field.h"

#include "core/base/parallel.h"

namespace seedmesh::texture {

Field::Field(const Job& job, int size)
    : size_(size), values_(job, static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

Field::Field(const Job& job, int size, float value)
    : size_(size), values_(job, static_cast<std::size_t>(size) * static_cast<std::size_t>(size), value) {}

void for_rows(const Job& job, int rows, const std::function<void(int begin, int end)>& body) {
  constexpr std::size_t rows_a_chunk = 32;
  parallel_for(job, static_cast<std::size_t>(rows), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 body(static_cast<int>(begin), static_cast<int>(end));
               });
}

}  // namespace seedmesh::texture

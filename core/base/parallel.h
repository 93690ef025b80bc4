#pragma once
/// Loops on several threads, over oneTBB. This is the only way in which core uses more than one thread.
///
/// A loop is cut into chunks whose bounds do not depend on the number of threads. Results of chunks are
/// joined in the order of their indices, so the number of threads never changes a result.
#include <cstddef>
#include <functional>

#include "core/base/job.h"

namespace seedmesh {

/// Calls body(begin, end, index) once for every chunk [index * chunk, min((index + 1) * chunk, count)). It
/// uses at most job.threads() threads, and at most one for each core. The order of the calls is not defined.
/// The first exception of a body (Stop) ends the loop and is rethrown to the caller; chunks that have not
/// begun are left out. The calling thread runs all chunks if has_threads(job) is false.
/// Cost: about 10 microseconds, and 0.1 ms until a sleeping thread helps.
void parallel_for(const Job& job, std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t begin, std::size_t end, std::size_t index)>& body);

/// True where parallel_for may use more than one thread: job.threads() is above 1, and the caller is not
/// itself inside a chunk.
bool has_threads(const Job& job);

constexpr std::size_t chunk_count(std::size_t count, std::size_t chunk) {
  return (count + chunk - 1) / chunk;
}

}  // namespace seedmesh

#pragma once
/// Turns the exception that stopped a request into an error.
#include <new>
#include <string>
#include <utility>

#include "core/base/job.h"
#include "core/base/result.h"

namespace seedmesh {

/// Converts the pointer of a generator, which is relative to its parameters, to one into the request. Empty
/// pointers and those that begin with "/output/" stay.
inline std::string in_request(std::string pointer) {
  if (pointer.empty() || pointer.starts_with("/output/")) return pointer;
  return "/parameters" + pointer;
}

/// The same for all issues of an error.
inline Error in_request(Error error) {
  for (Issue& issue : error.issues) issue.pointer = in_request(std::move(issue.pointer));
  return error;
}

/// Returns the result of `work`, or the error of the Stop or std::bad_alloc that ended it.
template <class T, class Work>
Result<T> guarded(Work&& work) {
  try {
    return work();
  } catch (const Stop& stop) {
    return in_request(Error{stop.code(), {stop.issue()}});
  } catch (const std::bad_alloc&) {
    return Error{Code::limit,
                 {{IssueKind::not_available, "", "the machine has no memory left for this request"}}};
  }
}

}  // namespace seedmesh

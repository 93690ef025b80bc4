#pragma once
/// Limits that are passed on the way, told of where they belong.
#include <string>
#include <utility>

#include "core/base/job.h"

namespace seedmesh::scene {

/// What `work` gives. A limit that it passes and that points nowhere points to `pointer`.
template <class Work>
auto blaming(const std::string& pointer, const Work& work) {
  try {
    return work();
  } catch (const Stop& stop) {  // the same stop, told of where it belongs
    Issue issue = stop.issue();
    if (stop.code() == Code::limit && issue.pointer.empty()) issue.pointer = pointer;
    throw Stop(stop.code(), std::move(issue));
  }
}

}  // namespace seedmesh::scene

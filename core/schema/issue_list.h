#pragma once
/// The errors that a reader found, and the pointers of the values that cannot be used.
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace seedmesh {

/// Collects the errors of one request. It keeps the first hundred and counts the rest, so that the response to a
/// body with a million wrong values stays short.
class IssueList {
 public:
  static constexpr std::size_t most = 100;

  /// Adds an error. The value at `issue.pointer` counts as unusable from now on.
  void add(Issue issue);

  /// Adds the error that the object at `pointer` lacks `member`. The pointer of the error is that of the
  /// object, because the member does not exist. covers() is then true for the pointer of the member.
  void add_missing(const std::string& pointer, std::string_view member, std::string message);

  /// Whether the value at `pointer`, or an object or list around it, already has an error. Further errors there
  /// would only repeat the first. Cost: one look-up for each level of the pointer.
  bool covers(std::string_view pointer) const;

  /// Whether further errors are only counted. Callers then call count() and save the work of a message.
  bool full() const { return issues_.size() >= most; }
  void count() { ++uncounted_; }

  bool empty() const { return issues_.empty(); }
  const std::vector<Issue>& issues() const { return issues_; }

  /// Moves the errors out. The last one is a truncated_list if not all were kept. The list is empty afterwards.
  std::vector<Issue> take();

 private:
  void keep(Issue issue);

  std::vector<Issue> issues_;
  std::set<std::string, std::less<>> refused_;  ///< pointers of unusable values
  std::size_t uncounted_ = 0;
};

}  // namespace seedmesh

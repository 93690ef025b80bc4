#pragma once
/// What a reader found wrong, and where a value could not be used.
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace seedmesh {

/// Collects the faults of one request. Keeps the first hundred and counts the rest, so that a hostile body of
/// a million wrong values gets a short answer.
class Faults {
 public:
  static constexpr std::size_t most = 100;

  /// A value at `issue.pointer` that cannot be used as it stands.
  void add(Issue issue);

  /// A member that the object at `pointer` lacks: reported at the object, remembered at the member's own
  /// place.
  void add_missing(const std::string& pointer, std::string_view member, std::string message);

  /// Has the value at `pointer`, or one that it is part of, been refused already? Then what others find wrong
  /// with it is but an echo.
  bool covers(std::string_view pointer) const;

  /// From here on faults are only counted: their messages need not be made.
  bool full() const { return issues_.size() >= most; }
  void count() { ++uncounted_; }

  bool empty() const { return issues_.empty(); }
  const std::vector<Issue>& issues() const { return issues_; }

  /// All that were kept, and one last line that counts the others. Leaves this empty.
  std::vector<Issue> take();

 private:
  void keep(Issue issue);

  std::vector<Issue> issues_;
  std::set<std::string, std::less<>> refused_;
  std::size_t uncounted_ = 0;
};

}  // namespace seedmesh

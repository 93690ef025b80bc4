#include "core/schema/issue_list.h"

#include <utility>

#include "core/base/json_pointer.h"

namespace seedmesh {

void IssueList::add(Issue issue) {
  if (!full()) refused_.insert(issue.pointer);
  keep(std::move(issue));
}

void IssueList::add_missing(const std::string& pointer, std::string_view member, std::string message) {
  if (!full()) refused_.insert(pointer + pointer_token(member));
  keep({missing_for({member}), pointer, std::move(message)});
}

void IssueList::keep(Issue issue) {
  if (!full()) {
    issues_.push_back(std::move(issue));
  } else {
    ++uncounted_;
  }
}

bool IssueList::covers(std::string_view pointer) const {
  while (true) {
    if (refused_.find(pointer) != refused_.end()) return true;
    const std::size_t slash = pointer.rfind('/');
    if (slash == std::string_view::npos) return false;
    pointer = pointer.substr(0, slash);
  }
}

std::vector<Issue> IssueList::take() {
  if (uncounted_ > 0) issues_.push_back(truncated_list(uncounted_));
  refused_.clear();
  uncounted_ = 0;
  return std::exchange(issues_, {});
}

}  // namespace seedmesh

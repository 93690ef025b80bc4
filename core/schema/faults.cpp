#include "core/schema/faults.h"

#include <utility>

#include "core/schema/json.h"

namespace seedmesh {

void Faults::add(Issue issue) {
  if (!full()) refused_.insert(issue.pointer);
  keep(std::move(issue));
}

void Faults::add_missing(const std::string& pointer, std::string_view member, std::string message) {
  if (!full()) refused_.insert(pointer + pointer_token(member));
  keep({pointer, std::move(message)});
}

void Faults::keep(Issue issue) {
  if (!full()) {
    issues_.push_back(std::move(issue));
  } else {
    ++uncounted_;
  }
}

bool Faults::covers(std::string_view pointer) const {
  while (true) {
    if (refused_.find(pointer) != refused_.end()) return true;
    const std::size_t slash = pointer.rfind('/');
    if (slash == std::string_view::npos) return false;
    pointer = pointer.substr(0, slash);
  }
}

std::vector<Issue> Faults::take() {
  if (uncounted_ > 0) issues_.push_back({"", "and " + std::to_string(uncounted_) + " more faults"});
  refused_.clear();
  uncounted_ = 0;
  return std::exchange(issues_, {});
}

}  // namespace seedmesh

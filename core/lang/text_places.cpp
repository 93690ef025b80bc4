#include "core/lang/text_places.h"

#include <algorithm>

namespace seedmesh::lang {

TextPlace TextPlaces::of(std::size_t offset) {
  if (offset < at_) {
    at_ = 0;
    place_ = {};
  }
  const TextPlace further = place_of(text_.substr(at_), offset - at_);
  place_.column = further.line == 1 ? place_.column + further.column - 1 : further.column;
  place_.line += further.line - 1;
  at_ = std::min(offset, text_.size());
  return place_;
}

void add_issues(const std::string& pointer, std::string_view text, std::vector<Fault>& faults,
                std::vector<Issue>& issues) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const Fault& a, const Fault& b) { return a.offset < b.offset; });
  TextPlaces places(text);
  const std::size_t told = std::min(faults.size(), max_faults);
  for (std::size_t i = 0; i < told; ++i) {
    const TextPlace place = places.of(faults[i].offset);
    issues.push_back({pointer, std::move(faults[i].message), place.line, place.column});
  }
  if (told == faults.size()) return;
  const TextPlace place = places.of(faults[told].offset);
  issues.push_back(
      {pointer, "too many faults: the text is not judged from here on", place.line, place.column});
}

}  // namespace seedmesh::lang

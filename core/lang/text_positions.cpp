#include "core/lang/text_positions.h"

#include <algorithm>

namespace seedmesh::lang {

TextPosition TextPositions::of(std::size_t offset) {
  if (offset < at_) {
    at_ = 0;
    position_ = {};
  }
  const TextPosition further = text_position(text_.substr(at_), offset - at_);
  position_.column = further.line == 1 ? position_.column + further.column - 1 : further.column;
  position_.line += further.line - 1;
  at_ = std::min(offset, text_.size());
  return position_;
}

void add_issues(const std::string& pointer, std::string_view text, std::vector<TextError>& errors,
                std::vector<Issue>& issues) {
  std::stable_sort(errors.begin(), errors.end(),
                   [](const TextError& a, const TextError& b) { return a.offset < b.offset; });
  TextPositions positions(text);
  const std::size_t listed = std::min(errors.size(), max_errors);
  for (std::size_t i = 0; i < listed; ++i) {
    const TextPosition position = positions.of(errors[i].offset);
    issues.push_back({errors[i].kind, pointer, std::move(errors[i].message), position.line, position.column});
  }
  if (listed == errors.size()) return;
  const TextPosition position = positions.of(errors[listed].offset);
  Issue cut = truncated_list(errors.size() - listed);
  cut.pointer = pointer;
  cut.line = position.line;
  cut.column = position.column;
  issues.push_back(std::move(cut));
}

}  // namespace seedmesh::lang

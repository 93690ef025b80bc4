#pragma once
/// Lines and columns of many offsets in one text, and the errors of a text as issues. A text is read once for all of
/// its offsets.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/lang/lexer.h"

namespace seedmesh::lang {

/// Lines and columns by byte offset, as text_position() computes them. If offsets do not decrease, the text
/// is scanned once in all; an offset before the last one starts again at the beginning.
class TextPositions {
 public:
  explicit TextPositions(std::string_view text) : text_(text) {}
  TextPosition of(std::size_t offset);

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  TextPosition position_;
};

/// Returns true while there are at most max_errors errors, so that a reader should go on. One more error shows that the
/// list was cut.
inline bool can_add_error(const std::vector<TextError>& errors) { return errors.size() <= max_errors; }

/// Adds the errors of `text`, the value at `pointer`, in the order of the text. It adds the first max_errors, and a
/// truncated_list if there are more.
void add_issues(const std::string& pointer, std::string_view text, std::vector<TextError>& errors,
                std::vector<Issue>& issues);

}  // namespace seedmesh::lang

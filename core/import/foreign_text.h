#pragma once
/// What the readers of foreign texts share: faults and warnings at their line, and words.
#include <string>
#include <string_view>
#include <vector>

#include "core/import/import.h"

namespace seedmesh {

/// A foreign text with what was found in it.
class ForeignText {
 public:
  explicit ForeignText(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }
  void fault(std::size_t offset, std::string message);
  void warn(std::size_t offset, std::string message, std::string pointer = "");
  bool sound() const { return issues_.empty(); }
  std::size_t fault_count() const { return issues_.size() + untold_; }

  /// What `imported` became, with the faults and warnings in the order of the text.
  Imported finish(Imported imported);

 private:
  static constexpr std::size_t most = 100;  // faults and warnings that are told

  std::string_view text_;
  std::vector<Issue> issues_;
  std::vector<Warning> warnings_;
  std::size_t untold_ = 0;  // faults beyond the most
};

/// A line without its end: bytes [from, to) of the text.
struct Line {
  std::size_t from = 0, to = 0;
};
std::vector<Line> lines_of(std::string_view text);

bool is_blank(char c);
bool is_letter(char c);
bool is_digit(char c);
char lower(char c);
std::string lower(std::string_view text);

/// text[from, to) without blanks at its ends.
Line trimmed(std::string_view text, Line line);

/// The number that stands at text[at, to) with digits, one point and no sign; `at` moves behind it. False:
/// there is none.
bool take_number(std::string_view text, std::size_t& at, std::size_t to, double& number);

}  // namespace seedmesh

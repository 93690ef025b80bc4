#pragma once
/// A text that is made piece by piece from a foreign one and knows where each of its bytes came from.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/import.h"

namespace seedmesh {

class TracedText {
 public:
  TracedText() = default;

  /// source[from, to), byte for byte.
  TracedText(std::string_view source, std::size_t from, std::size_t to) { copy(source, from, to); }

  const std::string& text() const { return text_; }
  std::size_t size() const { return text_.size(); }
  char operator[](std::size_t at) const { return text_[at]; }

  void copy(std::string_view source, std::size_t from, std::size_t to);

  /// other.text()[from, to) with its origins.
  void copy(const TracedText& other, std::size_t from, std::size_t to);
  TracedText part(std::size_t from, std::size_t to) const;

  /// `text`, which the source does not have, for what stands at its byte `from`.
  void write(std::string_view text, std::size_t from);

  /// One byte for another.
  void replace(std::size_t at, char with) { text_[at] = with; }

  /// The byte of the source that text()[at] came from; the end has the place behind the last one.
  std::size_t origin(std::size_t at) const;

  const std::vector<TextRun>& runs() const { return runs_; }

 private:
  void begin_run(TextRun run);

  std::string text_;
  std::vector<TextRun> runs_;
};

/// The place of byte `at` in runs; 0 where there are none.
std::size_t origin_in(const std::vector<TextRun>& runs, std::size_t at);

}  // namespace seedmesh

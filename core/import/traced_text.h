#pragma once
/// A text that is built from pieces of a foreign text, and the source position of each of its bytes.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/import.h"

namespace seedmesh {

class TracedText {
 public:
  TracedText() = default;

  /// Copies source[from, to), byte for byte.
  TracedText(std::string_view source, std::size_t from, std::size_t to) { copy(source, from, to); }

  const std::string& text() const { return text_; }
  std::size_t size() const { return text_.size(); }
  char operator[](std::size_t at) const { return text_[at]; }

  void copy(std::string_view source, std::size_t from, std::size_t to);

  /// Appends other.text()[from, to) with its origins.
  void copy(const TracedText& other, std::size_t from, std::size_t to);
  TracedText part(std::size_t from, std::size_t to) const;

  /// Appends a `text` that replaces byte `from` of the source.
  void write(std::string_view text, std::size_t from);

  /// Replaces one byte.
  void replace(std::size_t at, char with) { text_[at] = with; }

  /// Returns the source offset of text()[at]; for the end, the offset behind the last byte.
  std::size_t origin(std::size_t at) const;

  const std::vector<TextRun>& runs() const { return runs_; }

 private:
  void begin_run(TextRun run);

  std::string text_;
  std::vector<TextRun> runs_;
};

/// Returns the source offset of byte `at`; 0 without runs.
std::size_t origin_in(const std::vector<TextRun>& runs, std::size_t at);

}  // namespace seedmesh

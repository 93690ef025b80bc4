#pragma once
/// Where the values of a JSON text begin, so that an error with a JSON Pointer names a line of a file.
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace seedmesh {

class JsonPositions {
 public:
  /// Reads a valid JSON text, which has to outlive this object. Recurses as deep as the text nests.
  explicit JsonPositions(std::string_view text);

  /// Whether the text has a value with this pointer.
  bool contains(std::string_view pointer) const { return starts_.find(pointer) != starts_.end(); }

  /// Returns line and column of the value, or of the nearest value around it if the text has no such value.
  TextPosition of(std::string_view pointer) const;

  /// A key that its object has twice.
  struct Duplicate {
    std::string key;
    TextPosition position;  ///< position of the second one
  };
  /// Returns the first duplicate key in the text; none if all keys are unique.
  const std::optional<Duplicate>& duplicate() const { return duplicate_; }

 private:
  void skip_space();
  std::string read_key(const std::string& pointer);
  void read_text();
  void read_value(const std::string& pointer);
  void read_members(const std::string& pointer);

  std::string_view text_;
  std::size_t at_ = 0;
  std::map<std::string, std::size_t, std::less<>> starts_;  ///< offsets by pointer
  std::optional<Duplicate> duplicate_;
};

}  // namespace seedmesh

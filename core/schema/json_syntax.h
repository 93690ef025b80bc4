#pragma once
/// Explains why a text is not JSON: what was found at which place, and what was expected there.
#include <cstddef>
#include <string>
#include <string_view>

namespace seedmesh {

/// The state of a parser that stopped.
struct JsonState {
  bool in_object = false;    ///< the innermost open container is an object; else a list, or there is none
  bool has_key = false;      ///< the name of a member was read, and its value not yet
  bool is_complete = false;  ///< a whole value was read at the top
};

struct JsonFault {
  std::size_t offset = 0;
  std::string message;
};

/// Explains the error of a parser that could not read byte `stop`; the end of the text is its size. The text is valid
/// UTF-8. Cost: linear.
JsonFault json_fault(std::string_view text, std::size_t stop, JsonState state);

/// Returns the offset of the name of member `index`, counted over all objects from 0, in a text that is valid JSON up
/// to there; the size of the text if there are fewer.
std::size_t offset_of_member(std::string_view text, std::size_t index);

/// Returns the offset of the first `{` or `[` at a depth above `depth`; the size of the text without one.
std::size_t offset_of_depth(std::string_view text, std::size_t depth);

/// Returns what bytes that are not UTF-8 JSON probably are: the name of another encoding or of a compression, such as
/// "UTF-16". Empty if they resemble none.
std::string_view foreign_encoding(std::string_view bytes);

}  // namespace seedmesh

#pragma once
/// Lines and columns of many places of one text, and faults as issues: each text is walked once, however many
/// places are asked for.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/lang/lexer.h"

namespace seedmesh::lang {

/// Lines and columns by byte offset, as place_of gives them. Offsets that rise cost one walk of the text
/// together; one that lies before the last begins a new walk.
class TextPlaces {
 public:
  explicit TextPlaces(std::string_view text) : text_(text) {}
  TextPlace of(std::size_t offset);

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  TextPlace place_;
};

/// Room for one more fault of a text: beyond max_faults and one nobody reads on.
inline bool has_room(const std::vector<Fault>& faults) { return faults.size() <= max_faults; }

/// Adds the faults of `text`, which stands at `pointer`, in the order of the text: the first max_faults, and
/// where there are more one last that says so.
void add_issues(const std::string& pointer, std::string_view text, std::vector<Fault>& faults,
                std::vector<Issue>& issues);

}  // namespace seedmesh::lang

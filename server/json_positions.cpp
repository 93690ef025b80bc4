#include "server/json_positions.h"

#include <nlohmann/json.hpp>

#include "core/base/json_pointer.h"

namespace seedmesh {

JsonPositions::JsonPositions(std::string_view text) : text_(text) {
  skip_space();
  read_value("");
}

TextPosition JsonPositions::of(std::string_view pointer) const {
  auto found = starts_.find(pointer);
  while (found == starts_.end() && !pointer.empty()) {
    const auto slash = pointer.find_last_of('/');
    pointer = pointer.substr(0, slash == std::string_view::npos ? 0 : slash);
    found = starts_.find(pointer);
  }
  return text_position(text_, found == starts_.end() ? 0 : found->second);
}

void JsonPositions::skip_space() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

/// Passes a string with its quotation marks.
void JsonPositions::read_text() {
  for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
    if (text_[at_] == '\\') ++at_;
  }
  at_ = std::min(at_ + 1, text_.size());
}

/// The pointer of a member whose key is next; `pointer` is that of its object.
std::string JsonPositions::read_key(const std::string& pointer) {
  const std::size_t begin = at_;
  read_text();
  const auto key = nlohmann::json::parse(text_.substr(begin, at_ - begin)).get<std::string>();
  std::string own = pointer + pointer_token(key);
  if (contains(own) && !duplicate_) duplicate_ = Duplicate{key, text_position(text_, begin)};
  return own;
}

void JsonPositions::read_value(const std::string& pointer) {
  starts_.emplace(pointer, at_);
  if (at_ >= text_.size()) return;
  if (text_[at_] == '"') return read_text();
  if (text_[at_] == '{' || text_[at_] == '[') return read_members(pointer);
  at_ = std::min(text_.find_first_of(" \t\r\n,]}", at_), text_.size());
}

void JsonPositions::read_members(const std::string& pointer) {
  const bool is_object = text_[at_] == '{';
  ++at_;
  skip_space();
  for (std::size_t count = 0; at_ < text_.size() && text_[at_] != ']' && text_[at_] != '}'; ++count) {
    std::string member;
    if (is_object) {
      member = read_key(pointer);
      skip_space();
      ++at_;  // the colon
      skip_space();
    } else {
      member = pointer + "/" + std::to_string(count);
    }
    read_value(member);
    skip_space();
    if (at_ < text_.size() && text_[at_] == ',') {
      ++at_;
      skip_space();
    }
  }
  at_ = std::min(at_ + 1, text_.size());
}

}  // namespace seedmesh

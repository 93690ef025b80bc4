#include "core/import/dictionary.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

constexpr std::size_t most_values = 10'000;

class DictionaryReader {
 public:
  explicit DictionaryReader(ForeignText& source) : source_(source), text_(source.text()) {}

  std::vector<DictionaryEntry> read() {
    std::vector<DictionaryEntry> entries;
    at_ = open_of_dictionary();
    if (at_ == text_.size()) {
      source_.report(0, "found no dictionary; expected `{'shape': 7, ...}`");
      return entries;
    }
    ++at_;
    for (skip(); at_ < text_.size() && text_[at_] != '}' && entries.size() < most_values; skip()) {
      DictionaryEntry entry;
      entry.name_at = at_;
      const std::optional<std::string> name = quoted();
      skip();
      if (!name || at_ == text_.size() || text_[at_] != ':') {
        source_.report(entry.name_at, "expected a name in quotes and a colon, such as `'shape': 7`");
        return entries;
      }
      ++at_;
      entry.name = *name;
      if (!value(entry)) return entries;
      entries.push_back(std::move(entry));
      skip();
      if (at_ < text_.size() && text_[at_] == ',') ++at_;
    }
    if (at_ >= text_.size()) source_.report(text_.size(), "found `{` without its `}`");
    return entries;
  }

 private:
  /// The first brace outside of texts and comments.
  std::size_t open_of_dictionary() {
    at_ = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '{') return at_;
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (c == '"' || c == '\'') {
        if (!quoted()) ++at_;
      } else {
        ++at_;
      }
    }
    return at_;
  }

  void skip() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else {
        ++at_;
      }
    }
  }

  /// A text in one or three quotes of either kind.
  std::optional<std::string> quoted() {
    if (at_ == text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return std::nullopt;
    const std::string three(3, text_[at_]);
    const std::string mark = text_.substr(at_, 3) == three ? three : three.substr(0, 1);
    const std::size_t end = text_.find(mark, at_ + mark.size());
    if (end == std::string_view::npos) return std::nullopt;
    const std::string inside(text_.substr(at_ + mark.size(), end - at_ - mark.size()));
    at_ = end + mark.size();
    return inside;
  }

  bool value(DictionaryEntry& entry) {
    skip();
    const char open = at_ < text_.size() ? text_[at_] : ' ';
    entry.is_list = open == '[' || open == '(';
    if (!entry.is_list) return number(entry);
    const char close = open == '[' ? ']' : ')';
    ++at_;
    for (skip(); at_ < text_.size() && text_[at_] != close && entry.numbers.size() < most_values; skip()) {
      if (!number(entry)) return false;
      skip();
      if (at_ < text_.size() && text_[at_] == ',') ++at_;
    }
    if (at_ == text_.size()) source_.report(entry.name_at, "found a list without its end");
    ++at_;
    return at_ <= text_.size();
  }

  bool number(DictionaryEntry& entry) {
    const std::size_t begin = at_;
    std::string word;
    if (std::optional<std::string> text = quoted()) {
      word = *text;
    } else {
      while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '.' ||
                                    text_[at_] == '-' || text_[at_] == '+' || text_[at_] == '_'))
        ++at_;
      word = text_.substr(begin, at_ - begin);
      if (word.empty()) {
        source_.report(begin, "expected a number, a text or a list");
        return false;
      }
    }
    double found = word == "True" ? 1 : 0;
    const bool is_word =
        word == "True" || word == "False" || word == "None" || text_[begin] == '\'' || text_[begin] == '"';
    const auto read = std::from_chars(word.data(), word.data() + word.size(), found);
    if (!is_word && (read.ec != std::errc() || !std::isfinite(found))) {
      source_.report(begin, "found " + lang::in_quotes(word) + ", expected a number");
      return false;
    }
    entry.numbers.push_back(std::isfinite(found) ? found : 0);
    entry.at.push_back(begin);
    return true;
  }

  ForeignText& source_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<DictionaryEntry> read_dictionary(ForeignText& source) { return DictionaryReader(source).read(); }

}  // namespace seedmesh

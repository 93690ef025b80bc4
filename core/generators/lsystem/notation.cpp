#include "core/generators/lsystem/notation.h"

#include <algorithm>
#include <optional>

#include "core/generators/lsystem/commands.h"

namespace seedmesh::lsystem {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

std::size_t skip_spaces(std::string_view text, std::size_t at, std::size_t to) {
  while (at < to && is_space(text[at])) ++at;
  return at;
}

std::size_t closing(std::string_view text, std::size_t open, std::size_t to) {
  const char opens = text[open], closes = opens == '(' ? ')' : opens == '[' ? ']' : '}';
  int depth = 0;
  for (std::size_t i = open; i < to; ++i) {
    if (text[i] == opens) ++depth;
    if (text[i] == closes && --depth == 0) return i;
  }
  return to;
}

namespace {

using lang::Fault;

/// Bytes of the UTF-8 code point at `at`. One that is cut short ends where the next begins, so that a bracket
/// is never part of it.
std::size_t code_point_length(std::string_view text, std::size_t at) {
  const auto byte_at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte_at(at);
  const std::size_t most = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  std::size_t length = 1;
  while (length < most && at + length < text.size() && (byte_at(at + length) & 0xC0U) == 0x80U) ++length;
  return length;
}

/// Splits text(open, close) at the commas that stand in no inner parentheses.
std::vector<Slice> arguments_between(std::string_view text, std::size_t open, std::size_t close,
                                     std::vector<Fault>& faults) {
  std::vector<Slice> found;
  int depth = 0;
  std::size_t from = open + 1;
  for (std::size_t i = open + 1; i <= close; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && i != close) --depth;
    if (i == close || (text[i] == ',' && depth == 0)) {
      if (skip_spaces(text, from, i) == i)
        faults.push_back({from, "found nothing; expected an argument here"});
      found.push_back({from, i});
      from = i + 1;
    }
  }
  return found;
}

struct Arrow {
  std::size_t from = 0, to = 0;
};

/// The first arrow outside parentheses. "-->" is one arrow, except where its first "-" is all that stands
/// before "->".
std::optional<Arrow> find_arrow(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth > 0) continue;
    if (rest.substr(0, 3) == "→") return Arrow{i, i + 3};
    if (rest.substr(0, 2) == "~>") return Arrow{i, i + 2};
    if (rest.substr(0, 3) == "-->" && skip_spaces(text, 0, i) != i) return Arrow{i, i + 3};
    if (rest.substr(0, 2) == "->") return Arrow{i, i + 2};
  }
  return std::nullopt;
}

/// Place of `mark` outside parentheses in text[slice], from `from` on; slice.to where it does not occur.
std::size_t find_outside(std::string_view text, Slice slice, std::string_view mark) {
  int depth = 0;
  for (std::size_t i = slice.from; i < slice.to; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth == 0 && text.substr(i, std::min(mark.size(), slice.to - i)) == mark) return i;
  }
  return slice.to;
}

/// Takes `part` and the mark behind it off the front of `rest`, where the mark is there. A part that is empty
/// is a fault.
bool take_front(std::string_view text, std::string_view mark, Slice& rest, Slice& part,
                std::vector<Fault>& faults) {
  const std::size_t at = find_outside(text, rest, mark);
  if (at == rest.to) return false;
  part = {rest.from, at};
  rest.from = at + mark.size();
  if (skip_spaces(text, part.from, part.to) == part.to) {
    faults.push_back({part.to, "found no left context before `" + std::string(mark) + "`"});
  }
  return true;
}

/// The same at the back.
bool take_back(std::string_view text, std::string_view mark, Slice& rest, Slice& part,
               std::vector<Fault>& faults) {
  const std::size_t at = find_outside(text, rest, mark);
  if (at == rest.to) return false;
  part = {at + mark.size(), rest.to};
  rest.to = at;
  if (skip_spaces(text, part.from, part.to) == part.to) {
    faults.push_back({part.from, "found no right context after `" + std::string(mark) + "`"});
  }
  return true;
}

/// [ new left "<<" ] [ left "<" ] predecessor [ ">" right ] [ ">>" new right ]
void read_head(std::string_view text, Slice head, WrittenProduction& out, std::vector<Fault>& faults) {
  take_front(text, "<<", head, out.new_left, faults);
  take_back(text, ">>", head, out.new_right, faults);
  out.has_left = take_front(text, "<", head, out.left, faults);
  const std::size_t second = find_outside(text, head, "<");
  if (second < head.to) {
    faults.push_back(
        {second, "found a second `<`; the right context is written after `>`, as in `a < b > c -> d`"});
    head.to = second;
  }
  out.has_right = take_back(text, ">", head, out.right, faults);
  const std::size_t third = find_outside(text, out.right, ">");
  if (third < out.right.to) faults.push_back({third, "found a second `>`; expected one right context"});
  out.predecessor = head;
}

/// [ "{" statements "}" ] condition [ "{" statements "}" ]
void read_condition(std::string_view text, WrittenProduction& out, std::vector<Fault>& faults) {
  Slice& condition = out.condition;
  condition.from = skip_spaces(text, condition.from, condition.to);
  const auto take = [&](Slice& part) {
    const std::size_t open = find_outside(text, condition, "{");
    if (open == condition.to) return;
    const std::size_t close = closing(text, open, condition.to);
    if (close == condition.to) faults.push_back({open, "found `{` without its `}`"});
    part = {open + 1, close};
    if (open == condition.from) {
      condition.from = skip_spaces(text, std::min(close + 1, condition.to), condition.to);
    } else {
      const std::size_t rest = skip_spaces(text, std::min(close + 1, condition.to), condition.to);
      if (rest < condition.to) faults.push_back({rest, "found more after the statements; expected an arrow"});
      condition.to = open;
    }
  };
  const bool begins = condition.from < condition.to && text[condition.from] == '{';
  if (begins) take(out.before);
  take(out.after);
}

}  // namespace

Symbols::Symbols() {
  for (const CommandRow& row : commands()) {
    if (row.symbol.size() > 1) declare(row.symbol);
  }
  for (const char* query : {"?E", "?P", "?H", "?U", "?L"}) declare(query);  // one symbol each, as in cpfg
}

void Symbols::declare(std::string_view name) {
  const auto shorter = [&](const std::string& other) { return other.size() < name.size(); };
  names_.insert(std::find_if(names_.begin(), names_.end(), shorter), std::string(name));
  begins_[static_cast<unsigned char>(name[0])] = true;
}

std::size_t Symbols::length_at(std::string_view text, std::size_t at, std::size_t to) const {
  if (begins_[static_cast<unsigned char>(text[at])]) {
    const std::string_view rest = text.substr(at, to - at);
    for (const std::string& name : names_) {
      if (rest.substr(0, name.size()) == name) return name.size();
    }
  }
  if (text[at] != '@') return code_point_length(text, at);
  return at + 1 >= to || is_space(text[at + 1]) ? 0 : 1 + code_point_length(text, at + 1);
}

std::vector<WrittenModule> read_modules(std::string_view text, Slice slice, const Symbols& symbols,
                                        std::vector<Fault>& faults) {
  std::vector<WrittenModule> modules;
  for (std::size_t at = skip_spaces(text, slice.from, slice.to); at < slice.to;
       at = skip_spaces(text, at, slice.to)) {
    if (modules.size() == most_modules) {
      faults.push_back({at, "found more than 1,000,000 modules in one grammar"});
      break;
    }
    WrittenModule module{{}, at, {}};
    const std::size_t length = symbols.length_at(text, at, slice.to);
    if (length == 0) {
      faults.push_back({at, "found `@` alone; expected a character after it, as in `@v`"});
      ++at;
      continue;
    } else if (text[at] == '(' || text[at] == ')') {
      faults.push_back(
          {at, std::string("found `") + text[at] + "`; expected a symbol before its parameters"});
      ++at;
      continue;
    } else if (text[at] == '*') {
      faults.push_back(
          {at, "found `*` beside other modules; it stands for the empty word and must stand alone"});
      ++at;
      continue;
    }
    module.symbol = text.substr(at, length);
    at += length;
    if (at < slice.to && text[at] == '(') {
      const std::size_t close = closing(text, at, slice.to);
      if (close == slice.to) {
        faults.push_back({at, "found `(` without its `)`"});
        modules.push_back(std::move(module));
        break;
      }
      module.arguments = arguments_between(text, at, close, faults);
      at = close + 1;
    }
    modules.push_back(std::move(module));
  }
  return modules;
}

WrittenProduction read_production(std::string_view text, std::vector<Fault>& faults) {
  WrittenProduction out;
  const std::optional<Arrow> arrow = find_arrow(text);
  if (!arrow) {
    faults.push_back(
        {skip_spaces(text, 0, text.size()), "found no arrow; expected `predecessor -> successor`"});
    return out;
  }
  Slice head{0, arrow->from};
  const std::size_t colon = find_outside(text, head, ":");
  if (colon < head.to) {
    out.has_condition = true;
    out.condition = {colon + 1, head.to};
    head.to = colon;
    read_condition(text, out, faults);
  }
  read_head(text, head, out, faults);
  if (skip_spaces(text, out.predecessor.from, out.predecessor.to) == out.predecessor.to) {
    faults.push_back({out.predecessor.from, "found no predecessor; expected one module before the arrow"});
  }
  out.successor = {arrow->to, text.size()};
  const std::size_t weight = find_outside(text, out.successor, ":");
  if (weight < text.size()) {
    out.has_weight = true;
    out.weight = {weight + 1, text.size()};
    out.successor.to = weight;
  }
  return out;
}

bool erases(std::string_view text, Slice slice) {
  const std::size_t at = skip_spaces(text, slice.from, slice.to);
  if (at == slice.to) return true;
  const std::size_t length = text[at] == '*' ? 1 : text.substr(at, slice.to - at).substr(0, 2) == "ε" ? 2 : 0;
  return length != 0 && skip_spaces(text, at + length, slice.to) == slice.to;
}

}  // namespace seedmesh::lsystem

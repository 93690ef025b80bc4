#include "core/generators/lsystem/notation.h"

#include <algorithm>
#include <optional>

#include "core/generators/lsystem/commands.h"
#include "core/lang/text_positions.h"

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

using lang::TextError;

/// Returns the number of bytes of the UTF-8 code point at `at`. A truncated code point ends before the next
/// one starts, so that it never includes a bracket.
std::size_t code_point_length(std::string_view text, std::size_t at) {
  const auto byte_at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte_at(at);
  const std::size_t most = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  std::size_t length = 1;
  while (length < most && at + length < text.size() && (byte_at(at + length) & 0xC0U) == 0x80U) ++length;
  return length;
}

/// Splits text(open, close) at the commas outside inner parentheses.
std::vector<Slice> arguments_between(std::string_view text, std::size_t open, std::size_t close,
                                     std::vector<TextError>& errors) {
  std::vector<Slice> found;
  int depth = 0;
  std::size_t from = open + 1;
  for (std::size_t i = open + 1; i <= close; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && i != close) --depth;
    if (i == close || (text[i] == ',' && depth == 0)) {
      if (skip_spaces(text, from, i) == i && lang::can_add_error(errors))
        errors.push_back({from, "found nothing; expected an argument here"});
      found.push_back({from, i});
      from = i + 1;
    }
  }
  return found;
}

struct Arrow {
  std::size_t from = 0, to = 0;
};

/// Returns the first arrow outside parentheses. "-->" is one arrow, unless its first "-" is the whole text
/// before "->".
std::optional<Arrow> find_arrow(std::string_view text, Slice slice) {
  int depth = 0;
  text = text.substr(0, slice.to);
  for (std::size_t i = slice.from; i < text.size(); ++i) {
    const std::string_view rest = text.substr(i);
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth > 0) continue;
    if (rest.substr(0, 3) == "→") return Arrow{i, i + 3};
    if (rest.substr(0, 2) == "~>") return Arrow{i, i + 2};
    if (rest.substr(0, 3) == "-->" && skip_spaces(text, slice.from, i) != i) return Arrow{i, i + 3};
    if (rest.substr(0, 2) == "->") return Arrow{i, i + 2};
  }
  return std::nullopt;
}

/// Returns the position of `mark` outside parentheses in text[slice], from `from` on, or slice.to.
std::size_t find_outside(std::string_view text, Slice slice, std::string_view mark) {
  int depth = 0;
  for (std::size_t i = slice.from; i < slice.to; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth == 0 && text.substr(i, std::min(mark.size(), slice.to - i)) == mark) return i;
  }
  return slice.to;
}

/// Removes `part` and the following mark from the front of `rest`, if the mark exists. An empty part is an
/// error.
bool take_front(std::string_view text, std::string_view mark, Slice& rest, Slice& part,
                std::vector<TextError>& errors) {
  const std::size_t at = find_outside(text, rest, mark);
  if (at == rest.to) return false;
  part = {rest.from, at};
  rest.from = at + mark.size();
  if (skip_spaces(text, part.from, part.to) == part.to) {
    errors.push_back({part.to, "found no left context before `" + std::string(mark) + "`"});
  }
  return true;
}

/// Same at the end of `rest`.
bool take_back(std::string_view text, std::string_view mark, Slice& rest, Slice& part,
               std::vector<TextError>& errors) {
  const std::size_t at = find_outside(text, rest, mark);
  if (at == rest.to) return false;
  part = {at + mark.size(), rest.to};
  rest.to = at;
  if (skip_spaces(text, part.from, part.to) == part.to) {
    errors.push_back({part.from, "found no right context after `" + std::string(mark) + "`"});
  }
  return true;
}

/// Reads [ new left "<<" ] [ left "<" ] predecessor [ ">" right ] [ ">>" new right ].
void read_head(std::string_view text, Slice head, WrittenProduction& out, std::vector<TextError>& errors) {
  take_front(text, "<<", head, out.new_left, errors);
  take_back(text, ">>", head, out.new_right, errors);
  out.has_left = take_front(text, "<", head, out.left, errors);
  const std::size_t second = find_outside(text, head, "<");
  if (second < head.to) {
    errors.push_back(
        {second, "found a second `<`; the right context is written after `>`, as in `a < b > c -> d`"});
    head.to = second;
  }
  out.has_right = take_back(text, ">", head, out.right, errors);
  const std::size_t third = find_outside(text, out.right, ">");
  if (third < out.right.to) errors.push_back({third, "found a second `>`; expected one right context"});
  out.predecessor = head;
}

/// Reads [ "{" statements "}" ] condition [ "{" statements "}" ].
void read_condition(std::string_view text, WrittenProduction& out, std::vector<TextError>& errors) {
  Slice& condition = out.condition;
  condition.from = skip_spaces(text, condition.from, condition.to);
  const auto take = [&](Slice& part) {
    const std::size_t open = find_outside(text, condition, "{");
    if (open == condition.to) return;
    const std::size_t close = closing(text, open, condition.to);
    if (close == condition.to) errors.push_back({open, "found `{` without its `}`"});
    part = {open + 1, close};
    if (open == condition.from) {
      condition.from = skip_spaces(text, std::min(close + 1, condition.to), condition.to);
    } else {
      const std::size_t rest = skip_spaces(text, std::min(close + 1, condition.to), condition.to);
      if (rest < condition.to) errors.push_back({rest, "found text after the statements; expected an arrow"});
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
  for (const char* query : {"?E", "?P", "?H", "?U", "?L"}) declare(query);  // each is one symbol, as in cpfg
}

std::uint32_t Symbols::Node::behind(char c) const {
  const auto found =
      std::find_if(next.begin(), next.end(), [c](const auto& each) { return each.first == c; });
  return found == next.end() ? 0 : found->second;
}

void Symbols::declare(std::string_view name) {
  std::uint32_t node = 0;
  for (const char c : name) {
    std::uint32_t behind = node == 0 ? first(c) : nodes_[node].behind(c);
    if (behind == 0) {
      behind = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
      if (node == 0) {
        first_[static_cast<unsigned char>(c)] = behind;
      } else {
        nodes_[node].next.emplace_back(c, behind);
      }
    }
    node = behind;
  }
  nodes_[node].ends = true;
}

bool Symbols::knows(std::string_view name) const {
  std::uint32_t node = name.empty() ? 0 : first(name[0]);
  for (std::size_t i = 1; i < name.size() && node != 0; ++i) node = nodes_[node].behind(name[i]);
  return node != 0 && nodes_[node].ends;
}

std::size_t Symbols::length_at(std::string_view text, std::size_t at, std::size_t to) const {
  std::size_t longest = 0, end = at + 1;
  for (std::uint32_t node = first(text[at]); node != 0; ++end) {
    if (nodes_[node].ends) longest = end - at;
    node = end < to ? nodes_[node].behind(text[end]) : 0;
  }
  if (longest > 0) return longest;
  if (text[at] != '@') return code_point_length(text, at);
  return at + 1 >= to || is_space(text[at + 1]) ? 0 : 1 + code_point_length(text, at + 1);
}

std::vector<WrittenModule> read_modules(std::string_view text, Slice slice, const Symbols& symbols,
                                        std::vector<TextError>& errors) {
  std::vector<WrittenModule> modules;
  for (std::size_t at = skip_spaces(text, slice.from, slice.to); at < slice.to && lang::can_add_error(errors);
       at = skip_spaces(text, at, slice.to)) {
    if (modules.size() == most_modules) {
      errors.push_back({at, "found more than 1,000,000 modules in one grammar"});
      break;
    }
    WrittenModule module{{}, at, {}};
    const std::size_t length = symbols.length_at(text, at, slice.to);
    if (length == 0) {
      errors.push_back({at, "found `@` alone; expected a character after it, as in `@v`"});
      ++at;
      continue;
    } else if (text[at] == '(' || text[at] == ')') {
      errors.push_back(
          {at, std::string("found `") + text[at] + "`; expected a symbol before its parameters"});
      ++at;
      continue;
    } else if (text[at] == '*') {
      errors.push_back({at, "found `*` next to other modules; it means the empty word and must be alone"});
      ++at;
      continue;
    }
    module.symbol = text.substr(at, length);
    at += length;
    if (at < slice.to && text[at] == '(') {
      const std::size_t close = closing(text, at, slice.to);
      if (close == slice.to) {
        errors.push_back({at, "found `(` without its `)`"});
        modules.push_back(std::move(module));
        break;
      }
      module.arguments = arguments_between(text, at, close, errors);
      at = close + 1;
    }
    modules.push_back(std::move(module));
  }
  return modules;
}

std::size_t label_length(std::string_view text, const Symbols& symbols) {
  const std::size_t from = skip_spaces(text, 0, text.size());
  std::size_t end = from;
  if (end < text.size() && text[end] == 'p') ++end;
  const std::size_t digits = end;
  while (end > from && end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
  if (end == digits || symbols.knows(text.substr(from, end - from))) return 0;
  end = skip_spaces(text, end, text.size());
  return end < text.size() && text[end] == ':' ? end + 1 : 0;
}

std::size_t find_second_arrow(std::string_view text, Slice slice) {
  const std::optional<Arrow> arrow = find_arrow(text, slice);
  return arrow ? arrow->from : slice.to;
}

WrittenProduction read_production(std::string_view text, std::vector<TextError>& errors, std::size_t from) {
  WrittenProduction out;
  const std::optional<Arrow> arrow = find_arrow(text, {from, text.size()});
  if (!arrow) {
    errors.push_back(
        {skip_spaces(text, from, text.size()), "found no arrow; expected `predecessor -> successor`"});
    return out;
  }
  Slice head{from, arrow->from};
  const std::size_t colon = find_outside(text, head, ":");
  if (colon < head.to) {
    out.has_condition = true;
    out.condition = {colon + 1, head.to};
    head.to = colon;
    read_condition(text, out, errors);
  }
  read_head(text, head, out, errors);
  if (skip_spaces(text, out.predecessor.from, out.predecessor.to) == out.predecessor.to) {
    errors.push_back({out.predecessor.from, "found no predecessor; expected one module before the arrow"});
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

Marks::Marks(std::string_view text) : partner_(text.size(), static_cast<std::uint32_t>(text.size())) {
  std::vector<std::uint32_t> open[3];  // one stack for each kind of bracket, as in closing()
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const auto position = static_cast<std::uint32_t>(i);
    const std::size_t opens = std::string_view("([{").find(c), closes = std::string_view(")]}").find(c);
    if (opens < 3) open[opens].push_back(position);
    if (closes < 3 && !open[closes].empty()) {
      partner_[open[closes].back()] = position;
      open[closes].pop_back();
    }
    if (c == ';') semicolons_.push_back(position);
    if (std::string_view("<>=!&|").find(c) != std::string_view::npos) comparisons_.push_back(position);
  }
}

std::size_t Marks::closing(std::size_t open, std::size_t to) const {
  return std::min<std::size_t>(partner_[open], to);
}

bool Marks::has(const std::vector<std::uint32_t>& positions, Slice slice) {
  const auto first = std::lower_bound(positions.begin(), positions.end(), slice.from);
  return first != positions.end() && *first < slice.to;
}

bool erases(std::string_view text, Slice slice) {
  const std::size_t at = skip_spaces(text, slice.from, slice.to);
  if (at == slice.to) return true;
  const std::size_t length = text[at] == '*' ? 1 : text.substr(at, slice.to - at).substr(0, 2) == "ε" ? 2 : 0;
  return length != 0 && skip_spaces(text, at + length, slice.to) == slice.to;
}

}  // namespace seedmesh::lsystem

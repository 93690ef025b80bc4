#include "core/import/cpfg_statements.h"

#include <algorithm>

#include "core/import/cpfg_macros.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

using lsystem::Slice;

constexpr int deepest = 60;    // the limit of statements inside each other
constexpr int deepest_do = 4;  // each writes its statement twice
constexpr std::string_view silent[] = {"printf", "fprintf", "fflush", "fclose",
                                       "fopen",  "getchar", "play",   "stop"};
constexpr std::string_view reading[] = {"fscanf", "scanf", "fgets"};

template <class List>
bool contains(const List& list, std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

std::size_t name_end(const TracedText& text, std::size_t at, std::size_t to) {
  if (at < to && is_digit(text[at])) return at;
  while (at < to && is_name_part(text[at])) ++at;
  return at;
}

std::size_t skip(const TracedText& text, std::size_t at, std::size_t to) {
  return lsystem::skip_spaces(text.text(), at, to);
}

/// The end of a statement: its `;`, outside of parentheses and of texts in quotes.
std::size_t find_end(const TracedText& text, std::size_t at, std::size_t to) {
  int depth = 0;
  bool is_quoted = false;
  for (; at < to; ++at) {
    const char c = text[at];
    if (c == '"' && text[at - 1] != '\\') is_quoted = !is_quoted;
    if (is_quoted) continue;
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c == ';' && depth <= 0) break;
  }
  return at;
}

}  // namespace

TracedText CpfgStatements::converted(const TracedText& text, Slice slice) {
  TracedText out;
  for (std::size_t at = skip(text, slice.from, slice.to); at < slice.to;)
    at = skip(text, statement(text, at, slice.to, out), slice.to);
  return out;
}

TracedText CpfgStatements::converted_in_rule(const TracedText& text, Slice slice) {
  const TracedText inner = converted(text, slice);
  TracedText out;
  for (const std::string& name : inner_) {
    if (known_.insert(name).second) out.write(name + " = 0; ", text.origin(std::min(slice.from, slice.to)));
  }
  inner_.clear();
  out.copy(inner, 0, inner.size());
  return out;
}

void CpfgStatements::append(const TracedText& text, Slice slice, TracedText& out) const {
  const TracedText expression = words_.expression(text, slice);
  out.copy(expression, 0, expression.size());
}

std::size_t CpfgStatements::statement(const TracedText& text, std::size_t at, std::size_t to,
                                      TracedText& out) {
  if (text[at] == ';') return at + 1;
  if (text[at] == '{') {
    const std::size_t close = lsystem::closing(text.text(), at, to);
    if (close == to) source_.report(text.origin(at), "found `{` without its `}`");
    const TracedText inner = converted(text, {at + 1, close});
    out.copy(inner, 0, inner.size());
    return std::min(close + 1, to);
  }
  const std::size_t end = name_end(text, at, to);
  const std::string name = text.text().substr(at, end - at);
  const std::size_t open = skip(text, end, to);
  const bool is_call = open < to && text[open] == '(';
  if (is_call && (name == "if" || name == "while" || name == "for")) {
    out.write(name + " (", text.origin(at));
    return branch(text, open, to, out);
  }
  if (name == "do") return do_while(text, {at, end}, to, out);
  if (is_call && !name.empty()) return call(text, {at, open}, to);
  const std::size_t stop = find_end(text, at, to);
  if (stop == to) source_.report(text.origin(at), "found a statement without its `;`");
  change(text, {at, stop}, out);
  return std::min(stop + 1, to);
}

/// The rest of `if`, `while` or `for`, from its parenthesis on.
std::size_t CpfgStatements::branch(const TracedText& text, std::size_t open, std::size_t to,
                                   TracedText& out) {
  const std::size_t close = lsystem::closing(text.text(), open, to);
  if (close == to || depth_ >= deepest) {
    source_.report(text.origin(open),
                   close == to ? "found `(` without its `)`" : "statements nest deeper than 60");
    return to;
  }
  const bool is_loop = find_end(text, open + 1, close) < close;
  if (is_loop) {
    for (std::size_t from = open + 1; from < close;) {
      const std::size_t end = std::min(find_end(text, from, close), close);
      append(text, {from, end}, out);
      if (end < close) out.write(";", text.origin(end));
      from = end + 1;
    }
    const std::size_t begin = skip(text, open + 1, close), end = name_end(text, begin, close);
    if (end > begin) assigned_.insert(text.text().substr(begin, end - begin));
  } else {
    out.write("(", text.origin(open));
    append(text, {open + 1, close}, out);
    out.write(") != 0", text.origin(close));
  }
  out.write(") {", text.origin(close));
  std::size_t at = body(text, close + 1, to, out);
  const std::size_t next = skip(text, at, to);
  if (name_end(text, next, to) == next + 4 && text.text().compare(next, 4, "else") == 0) {
    out.write("else {", text.origin(next));
    at = body(text, next + 4, to, out);
  }
  return at;
}

/// The statement inside a condition or loop, and the brace behind it.
std::size_t CpfgStatements::body(const TracedText& text, std::size_t at, std::size_t to, TracedText& out) {
  at = skip(text, at, to);
  ++depth_;
  if (at < to) at = statement(text, at, to, out);
  --depth_;
  out.write("} ", at > 0 ? text.origin(at - 1) : 0);
  return at;
}

/// do ... while (...);: the statement, and a loop of the same statement. `word` is `do`.
std::size_t CpfgStatements::do_while(const TracedText& text, Slice word, std::size_t to, TracedText& out) {
  if (do_depth_ >= deepest_do) {
    source_.report(text.origin(word.from), "`do` nests deeper than 4");
    return to;
  }
  TracedText inner;
  ++do_depth_;
  std::size_t at = skip(text, word.to, to);
  if (at < to) at = skip(text, statement(text, at, to, inner), to);
  --do_depth_;
  const std::size_t end = name_end(text, at, to), open = skip(text, end, to);
  const std::size_t close = open < to && text[open] == '(' ? lsystem::closing(text.text(), open, to) : to;
  const std::size_t stop = skip(text, std::min(close + 1, to), to);
  if (text.text().substr(at, end - at) != "while" || stop >= to || text[stop] != ';') {
    source_.report(text.origin(word.from), "found `do` without its `while (...);`");
    return to;
  }
  out.copy(inner, 0, inner.size());
  out.write(" while ((", text.origin(at));
  append(text, {open + 1, close}, out);
  out.write(") != 0) {", text.origin(close));
  out.copy(inner, 0, inner.size());
  out.write("} ", text.origin(stop));
  return stop + 1;
}

/// A call that stands alone. Nothing is written for it.
std::size_t CpfgStatements::call(const TracedText& text, Slice slice, std::size_t to) {
  const std::size_t end = name_end(text, slice.from, slice.to);
  const std::string name = text.text().substr(slice.from, end - slice.from);
  const std::size_t at = text.origin(slice.from), stop = find_end(text, slice.to, to);
  if (name == "srand") {
    const std::size_t close = lsystem::closing(text.text(), slice.to, to);
    seed_ = words_.expression(text, {slice.to, std::min(close + 1, to)});
    words_.warn_once(at, name, "starts a sequence of random numbers in cpfg; here all rules use one seed");
  } else if (contains(reading, name)) {
    words_.warn_once(
        at, name, "reads a file of its own and is left out, so that its names stay 0; give them by `Define`");
    for (std::size_t i = slice.to; i < stop; ++i) {  // &name
      const std::size_t last = text[i] == '&' ? name_end(text, i + 1, stop) : i;
      if (last > i + 1 && (last == stop || text[last] != '['))
        assigned_.insert(text.text().substr(i + 1, last - i - 1));
    }
  } else if (contains(silent, name)) {
    words_.warn_once(at, name, "is left out: nothing is printed, stopped or opened");
  } else {
    source_.report(at,
                   "found the call of " + lang::in_quotes(name) + "; expected a statement such as `x = 2;`");
  }
  return std::min(stop + 1, to);
}

/// An assignment, without its `;`.
std::size_t CpfgStatements::change(const TracedText& text, Slice slice, TracedText& out) {
  const std::size_t end = name_end(text, slice.from, slice.to);
  const std::string name = text.text().substr(slice.from, end - slice.from);
  std::size_t sign = skip(text, end, slice.to);
  const bool has_index = sign < slice.to && text[sign] == '[';
  if (has_index) {
    const std::size_t close = lsystem::closing(text.text(), sign, slice.to);
    if (close >= slice.to) {
      source_.report(text.origin(sign), "found `[` without its `]`");
      return slice.to;
    }
    sign = skip(text, close + 1, slice.to);
  }
  const std::string two =
      text.text().substr(sign, std::min<std::size_t>(2, slice.to - std::min(sign, slice.to)));
  const bool is_step = two == "++" || two == "--";
  const bool is_compound =
      two.size() == 2 && two[1] == '=' && std::string_view("+-*/").find(two[0]) != std::string_view::npos;
  const bool is_plain = !two.empty() && two[0] == '=' && two != "==";
  if (name.empty() || !(is_step || is_compound || is_plain)) {
    words_.warn_once(text.origin(slice.from),
                     text.text().substr(slice.from, std::min<std::size_t>(20, slice.to - slice.from)),
                     "changes nothing and is left out");
    return slice.to;
  }
  const std::size_t value = sign + (is_plain ? 1U : 2U);
  const std::size_t first = skip(text, value, slice.to);
  const std::string called = text.text().substr(first, name_end(text, first, slice.to) - first);
  if (contains(silent, called)) {
    words_.warn_once(text.origin(slice.from), called,
                     "is left out: nothing is printed, and no file is opened");
    return slice.to;
  }
  assigned_.insert(name);
  if (has_index) {
    known_.insert(name);
  } else if (depth_ > 0) {
    inner_.insert(name);
  } else if (!inner_.contains(name)) {
    known_.insert(name);
  }
  out.copy(text, slice.from, value);
  append(text, {value, slice.to}, out);
  out.write("; ", text.origin(slice.to - 1));
  return slice.to;
}

}  // namespace seedmesh

#include "core/import/cpfg_rules.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/import/cpfg_macros.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

using lsystem::Slice;

Slice without_blanks(const TracedText& text, Slice slice) {
  const Line line = trimmed(text.text(), {slice.from, slice.to});
  return {line.from, line.to};
}

bool is_star(const TracedText& text, Slice slice) {
  slice = without_blanks(text, slice);
  return slice.to == slice.from + 1 && text[slice.from] == '*';
}

enum class Occurrence { first, last };

/// The offset of `mark` outside of parentheses in text[slice]; slice.to if there is none.
std::size_t find_outside(const TracedText& text, Slice slice, char mark, Occurrence which) {
  int depth = 0;
  std::size_t found = slice.to;
  for (std::size_t i = slice.from; i < slice.to; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth > 0 || text[i] != mark) continue;
    found = i;
    if (which == Occurrence::first) break;
  }
  return found;
}

/// The offset of `-->`, or of `-o>` for objects of rayshade, behind a predecessor.
std::size_t find_arrow(const std::string& text) {
  int depth = 0;
  for (std::size_t i = 0; i + 2 < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth > 0 || text[i] != '-' || text[i + 2] != '>' || (text[i + 1] != '-' && text[i + 1] != 'o'))
      continue;
    if (trimmed(text, {0, i}).from < trimmed(text, {0, i}).to) return i;
  }
  return text.size();
}

}  // namespace

std::set<std::string> cpfg_names_in(std::string_view text) {
  std::set<std::string> out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::size_t end = at;
    while (end < text.size() && is_name_part(text[end])) ++end;
    if (end > at) out.emplace(text.substr(at, end - at));
    at = std::max(at, end);
  }
  return out;
}

namespace {

/// The condition with the statements around it; `*` is always true.
TracedText condition_of(const TracedText& text, Slice slice, const CpfgWords& words,
                        CpfgStatements& statements) {
  slice = without_blanks(text, slice);
  TracedText out;
  const auto block = [&](std::size_t open) {
    const std::size_t close = lsystem::closing(text.text(), open, slice.to);
    const TracedText inner = statements.converted_in_rule(text, {open + 1, close});
    out.write("{", text.origin(open));
    out.copy(inner, 0, inner.size());
    out.write("}", text.origin(std::min(close, slice.to - 1)));
    return std::min(close + 1, slice.to);
  };
  std::size_t at = slice.from;
  if (at < slice.to && text[at] == '{') {
    at = block(at);
    out.write(" ", text.origin(at - 1));
  }
  const std::size_t open = find_outside(text, {at, slice.to}, '{', Occurrence::first);
  const Slice condition = without_blanks(text, {at, open});
  if (is_star(text, condition)) {
    out.write("1", text.origin(condition.from));
  } else {
    const TracedText value = words.expression(text, condition);
    out.copy(value, 0, value.size());
  }
  if (open < slice.to) {
    out.write(" ", text.origin(open));
    block(open);
  }
  return out;
}

class RuleReader {
 public:
  RuleReader(const TracedText& text, ForeignText& source, CpfgWords& words, CpfgStatements& statements)
      : text_(text), source_(source), words_(words), statements_(statements) {}

  std::optional<CpfgRule> read(std::size_t arrow, CpfgContexts contexts) {
    const std::size_t errors = source_.error_count();
    const Slice head{0, arrow};
    const std::size_t colon = find_outside(text_, head, ':', Occurrence::first);
    statements_.begin_rule(cpfg_names_in(text_.text().substr(0, colon)));
    if (colon < arrow) rule_.condition = condition_of(text_, {colon + 1, arrow}, words_, statements_);
    predecessor({0, colon}, contexts);
    Slice successor{arrow + 3, text_.size()};
    const std::size_t weight = find_outside(text_, successor, ':', Occurrence::last);
    if (weight < text_.size()) {
      const Slice chance = without_blanks(text_, {weight + 1, text_.size()});
      rule_.weight = words_.expression(text_, chance);
      if (rule_.weight.size() == 0) source_.report(text_.origin(weight), "found `:` without a probability");
      successor.to = weight;
    }
    if (!is_star(text_, successor)) rule_.successor = words_.modules(text_, successor, CpfgWords::Role::word);
    if (rule_.successor.size() == 0) rule_.successor.write("*", text_.origin(arrow + 3));
    if (source_.error_count() > errors) return std::nullopt;
    return std::move(rule_);
  }

 private:
  void predecessor(Slice head, CpfgContexts contexts) {
    const std::size_t less = find_outside(text_, head, '<', Occurrence::first);
    const std::size_t greater = find_outside(text_, head, '>', Occurrence::last);
    const std::size_t from = less < head.to ? less + 1 : head.from;
    if (less < head.to) rule_.left = context({head.from, less}, contexts);
    if (greater < head.to) rule_.right = context({greater + 1, head.to}, contexts);
    const std::size_t errors = source_.error_count();
    rule_.predecessor = words_.modules(text_, {from, std::max(from, greater)}, CpfgWords::Role::pattern);
    const std::size_t count = CpfgWords::count(rule_.predecessor);
    const std::size_t first = without_blanks(text_, {from, std::max(from, greater)}).from;
    if (count == 0 && source_.error_count() == errors) {
      source_.report(text_.origin(first), "found no predecessor; expected one module before the arrow");
    }
    rule_.is_strict = count > 1;
  }

  TracedText context(Slice slice, CpfgContexts contexts) {
    const Slice inner = without_blanks(text_, slice);
    if (inner.from == inner.to || is_star(text_, slice)) return {};
    if (contexts == CpfgContexts::ignored) {
      words_.warn_once(text_.origin(inner.from), "<", "and `>` of a homomorphism are ignored, as in cpfg");
      return {};
    }
    // [H=] names the beginning of a branch, which is what [H] means here.
    TracedText changed = text_.part(inner.from, inner.to);
    for (std::size_t i = 0; i + 1 < changed.size(); ++i) {
      if (changed[i] == '=' && changed[i + 1] == ']') changed.replace(i, ' ');
    }
    // A branch that does not end is the beginning of one, too.
    const auto open = std::count(changed.text().begin(), changed.text().end(), '['),
               closed = std::count(changed.text().begin(), changed.text().end(), ']');
    for (auto i = closed; i < open; ++i) changed.write("]", changed.origin(changed.size() - 1));
    return words_.modules(changed, {0, changed.size()}, CpfgWords::Role::pattern);
  }

  const TracedText& text_;
  ForeignText& source_;
  CpfgWords& words_;
  CpfgStatements& statements_;
  CpfgRule rule_;
};

/// The same rule for a surface; empty, with a warning, where it writes none.
std::optional<CpfgRule> rule_for_surface(const CpfgRule& rule, CpfgWords& words) {
  const char symbol = rule.predecessor[0];
  const char first = rule.successor[0];
  const std::string surface = "~" + CpfgWords::surface_name(symbol);
  if (!is_letter(first) && !is_digit(first)) {
    words.warn_once(rule.at, surface,
                    "is not rewritten by the rule for " + lang::in_quotes(std::string_view(&symbol, 1)) +
                        ", unlike in cpfg, because that rule writes no surface");
    return std::nullopt;
  }
  words.add_surface(first, rule.at);
  const auto with_surface = [](const TracedText& text) {
    TracedText out;
    out.write("~" + CpfgWords::surface_name(text[0]), text.origin(0));
    out.copy(text, 1, text.size());
    return out;
  };
  CpfgRule other = rule;
  other.predecessor = with_surface(rule.predecessor);
  other.successor = with_surface(rule.successor);
  return other;
}

}  // namespace

TracedText CpfgRule::written() const {
  TracedText out;
  const auto append = [&](std::string_view before, const TracedText& part, std::string_view behind) {
    if (part.size() == 0) return;
    out.write(before, part.origin(0));
    out.copy(part, 0, part.size());
    out.write(behind, part.origin(part.size()));
  };
  append("", left, " < ");
  append("", predecessor, "");
  append(" > ", right, "");
  append(" : ", condition, "");
  append(" --> ", successor, "");
  append(" : ", weight, "");
  return out;
}

std::optional<CpfgRule> read_cpfg_rule(const TracedText& text, CpfgContexts contexts, ForeignText& source,
                                       CpfgWords& words, CpfgStatements& statements) {
  const std::size_t arrow = find_arrow(text.text());
  if (arrow == text.size()) {
    const std::size_t other = text.text().find("->");
    source.report(text.origin(0),
                  other == std::string::npos
                      ? "found no keyword and no production; expected `predecessor --> successor`"
                      : "found no keyword and no production; the arrow of cpfg is `-->`");
    return std::nullopt;
  }
  std::optional<CpfgRule> rule = RuleReader(text, source, words, statements).read(arrow, contexts);
  if (rule) rule->at = text.origin(0);
  return rule;
}

void add_cpfg_rules_for_surfaces(std::span<std::vector<CpfgRule>> lists, CpfgWords& words) {
  std::set<std::pair<std::size_t, std::size_t>> done;
  for (std::size_t known = 0; known != words.surfaces().size();) {
    known = words.surfaces().size();
    for (std::size_t list = 0; list < lists.size(); ++list) {
      for (std::size_t i = 0, count = lists[list].size(); i < count; ++i) {
        const CpfgRule rule = lists[list][i];
        if (!rule.is_for_one_letter() || words.surfaces().count(rule.predecessor[0]) == 0) continue;
        if (!done.insert({list, i}).second) continue;
        std::optional<CpfgRule> more = rule_for_surface(rule, words);
        if (more) lists[list].push_back(std::move(*more));
      }
    }
  }
}

}  // namespace seedmesh

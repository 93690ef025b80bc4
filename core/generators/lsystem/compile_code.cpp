/// Compiles successors with statements, after the FL-systems of Marvie, Perret and Bouatouch ("The FL-system:
/// a functional L-system for procedural geometric modeling", 2005):
///
///   item  = "let" name "=" expression ";" | name change ";"          name: a local
///         | "for" "(" [ name "=" expression ] ";" expression ";" [ name change ] ")" body
///         | "while" "(" expression ")" body | "if" "(" expression ")" body [ "else" body ] | modules ;
///   body  = "{" { item } "}" | one statement | one module ;
///   change = "=" expression | ("+=" | "-=" | "*=" | "/=") expression | "++" | "--" ;
///
/// Text that is a module in plain L-system notation stays a module. Therefore `for` needs its semicolons, and
/// `if` without braces needs a comparison, because no turtle symbol takes a comparison as a length.
#include <algorithm>

#include "core/generators/lsystem/compilation.h"
#include "core/generators/lsystem/statements.h"

namespace seedmesh::lsystem {
namespace {

constexpr int deepest = 64;                 // nesting depth of statements
constexpr std::size_t most_locals = 1'000;  // of one production, including those of closed blocks

class CodeReader {
 public:
  enum class Allowed { modules, statements_alone };
  CodeReader(Compilation& compilation, Source& source, std::uint32_t& slots, Allowed allowed)
      : c_(compilation),
        source_(source),
        text_(source.text),
        marks_(source.marks_of_text()),
        statements_(text_, marks_),
        steps_(compilation.grammar.steps),
        slots_(slots),
        allowed_(allowed) {}

  /// Compiles the items of a block. Brackets must pair inside it.
  void items(Slice slice) {
    const std::size_t names = c_.names.size();
    const std::size_t outer = locals_.size();
    std::vector<std::size_t> open;
    std::size_t at = skip_spaces(text_, slice.from, slice.to);
    while (at < slice.to && sound()) {
      const std::size_t before = at;
      at = statement(at, slice.to);
      if (at == before) at = modules(at, slice.to, open);
      at = skip_spaces(text_, at, slice.to);
    }
    if (!open.empty()) add_error(open.back(), "found `[` without its `]` in the same block");
    c_.names.forget_after(names);
    forget_locals_after(outer);
  }

  /// Compiles the statement at `at` and returns its end, or `at` where there is none.
  std::size_t statement(std::size_t at, std::size_t to) {
    if (const std::size_t open = statements_.loop_at(at, to); open < to) return for_loop(open, to);
    if (const std::size_t open = open_after(text_, "while", at, to); open < to) return while_loop(open, to);
    if (const std::size_t open = statements_.condition_at(at, to); open < to) return choice(open, to);
    if (statements_.is_let(at, to)) {
      const std::size_t name = skip_spaces(text_, at + 3, to);
      return change(name, to, Ends::semicolon, Binds::yes);
    }
    const std::size_t end = end_of_name(text_, at, to);
    const bool binds = allowed_ == Allowed::statements_alone;
    if (binds && end > at && array(text_.substr(at, end - at))) return element_change(at, end, to);
    const bool known = end > at && (binds || local(text_.substr(at, end - at)) != nullptr);
    if (known && statements_.changes(skip_spaces(text_, end, to), to)) {
      return change(at, to, Ends::semicolon, binds ? Binds::yes : Binds::no);
    }
    return at;
  }

 private:
  enum class Ends { semicolon, here };
  enum class Binds { yes, no };

  bool sound() const { return source_.errors.size() < lang::max_errors && !stopped_; }
  void add_error(std::size_t at, std::string message) { source_.errors.push_back({at, std::move(message)}); }

  /// Returns the slot of a local, or null.
  const std::uint32_t* local(std::string_view name) const {
    const auto at = slots_of_.find(name);
    return at == slots_of_.end() ? nullptr : &at->second.back();
  }

  /// Returns the array of this name, or null.
  const lang::Names::Binding* array(std::string_view name) const {
    const lang::Names::Binding* bound = c_.names.find(name);
    return bound && bound->count > 0 ? bound : nullptr;
  }

  /// Compiles `array[index] change;` and returns its end.
  std::size_t element_change(std::size_t at, std::size_t name_end, std::size_t to) {
    const lang::Names::Binding binding = *array(text_.substr(at, name_end - at));
    const std::size_t open = skip_spaces(text_, name_end, to);
    const bool has_index = open < to && text_[open] == '[';
    const std::size_t close = has_index ? marks_.closing(open, to) : to;
    const std::size_t sign = close < to ? skip_spaces(text_, close + 1, to) : to;
    const std::size_t end = sign < to ? statements_.find_semicolon(sign, to) : to;
    if (end == to || !statements_.changes(sign, to)) {
      add_error(at, "expected a new value of an element, as in `list[0] = 1;`");
      stopped_ = true;
      return to;
    }
    Step step;
    step.action = Step::Action::set_element;
    step.slot = binding.slot;
    step.target = binding.count;
    step.index = compile_expression(c_, source_, {open + 1, close});
    step.value = text_[sign] == '=' ? compile_expression(c_, source_, {sign + 1, end})
                                    : changed({at, close + 1}, sign, end);
    steps_.push_back(step);
    return end + 1;
  }

  void bind_local(const std::string& name, std::uint32_t slot) {
    slots_of_[name].push_back(slot);
    locals_.push_back(name);
    c_.names.bind_slot(name, slot);
  }

  void forget_locals_after(std::size_t count) {
    for (; locals_.size() > count; locals_.pop_back()) {
      const auto at = slots_of_.find(locals_.back());
      at->second.pop_back();
      if (at->second.empty()) slots_of_.erase(at);
    }
  }

  /// Compiles `name change [";"]` and returns its end.
  std::size_t change(std::size_t at, std::size_t to, Ends ends, Binds binds) {
    const std::size_t name_end = end_of_whole_name(text_, at, to);
    const std::string name(text_.substr(at, name_end - at));
    const std::size_t sign = skip_spaces(text_, name_end, to);
    if (name.empty() || !statements_.changes(sign, to)) {
      add_error(at, "expected a name and its new value, as in `i = 0` or `i++`");
      stopped_ = true;
      return to;
    }
    std::size_t end = to;
    if (ends == Ends::semicolon) {
      end = statements_.find_semicolon(sign, to);
      if (end == to) add_error(at, "found a statement without its `;`");
    }
    const bool assigns = text_[sign] == '=';
    lang::Expression value;
    if (assigns) {
      value = compile_expression(c_, source_, {sign + 1, end});
    } else {
      value = changed({at, name_end}, sign, end);
    }
    set(name, value, binds == Binds::yes && assigns, at);
    return std::min(end + (ends == Ends::semicolon ? 1U : 0U), to);
  }

  /// Returns the new value of `old op= expression`, `old++` or `old--` as an expression.
  lang::Expression changed(Slice old, std::size_t sign, std::size_t end) {
    const bool by_one = text_[sign] == text_[sign + 1];
    if (by_one && skip_spaces(text_, sign + 2, end) < end) {
      add_error(sign + 2, "found text after `" + std::string(text_.substr(sign, 2)) + "`");
    }
    const std::size_t before = source_.errors.size();
    std::vector<lang::Token> tokens = lang::tokenize(text_, old.from, old.to, source_.errors);
    tokens.pop_back();  // the end
    const auto symbol = [&](std::string_view text) {
      tokens.push_back({lang::TokenKind::symbol, text, sign, 1, 0});
    };
    symbol(text_.substr(sign, 1));
    symbol("(");
    if (by_one) {
      tokens.push_back({lang::TokenKind::number, "1", sign, 1, 1});
    } else {
      for (const lang::Token& each : lang::tokenize(text_, sign + 2, end, source_.errors)) {
        if (each.kind != lang::TokenKind::end) tokens.push_back(each);
      }
    }
    symbol(")");
    tokens.push_back({lang::TokenKind::end, "", end, 0, 0});
    std::size_t read = 0;
    const lang::Expression value =
        c_.grammar.program.parse(tokens, read, c_.names, source_.errors, c_.limits.expression_depth);
    if (source_.errors.size() == before && tokens[read].kind != lang::TokenKind::end) {
      add_error(tokens[read].offset,
                "found `" + std::string(tokens[read].text) + "` after the end of the expression");
    }
    return value;
  }

  /// Adds the step that sets `name`. Where `binds` allows it, an unknown name becomes a local.
  void set(const std::string& name, const lang::Expression& value, bool binds, std::size_t at) {
    const std::uint32_t* known = local(name);
    const lang::Names::Binding* bound = c_.names.find(name);
    const bool alone = allowed_ == Allowed::statements_alone;
    std::uint32_t slot = known ? *known : 0;
    if (!known && alone && bound && !bound->is_constant) {
      slot = bound->slot;  // changes the copy of a parameter
    } else if (!known && !binds) {
      add_error(at, "`" + name + "` has no value yet");
    } else if (binds && (!known || !alone)) {
      if (name.size() > longest_name || bound_ == most_locals) {
        add_error(at, name.size() > longest_name ? "found a local of more than 64 characters"
                                                 : "found more than 1,000 locals in one production");
        stopped_ = true;
        return;
      }
      ++bound_;
      slot = slots_++;
      bind_local(name, slot);
    }
    steps_.push_back({Step::Action::set, {}, value, slot, 0});
  }

  std::uint32_t here() const { return static_cast<std::uint32_t>(steps_.size()); }
  std::uint32_t add(Step::Action action, const lang::Expression& value = {}, std::uint32_t target = 0) {
    steps_.push_back({action, {}, value, 0, target});
    return here() - 1;
  }

  std::size_t for_loop(std::size_t open, std::size_t to) {
    const std::size_t close = marks_.closing(open, to);
    const std::size_t first = statements_.find_semicolon(open + 1, close);
    const std::size_t second = first < close ? statements_.find_semicolon(first + 1, close) : close;
    if (close == to || second == close || statements_.find_semicolon(second + 1, close) < close) {
      add_error(open, "expected `(start; condition; change)`");
      stopped_ = true;
      return to;
    }
    const std::size_t names = c_.names.size();
    const std::size_t outer = locals_.size();
    const std::size_t start = skip_spaces(text_, open + 1, first);
    if (start < first) change(start, first, Ends::here, Binds::yes);
    add(Step::Action::enter_loop);
    const std::uint32_t again = here();
    const lang::Expression condition = compile_expression(c_, source_, {first + 1, second});
    const std::uint32_t leave = add(Step::Action::jump_unless, condition);
    const std::size_t end = body(close + 1, to);
    const std::size_t next = skip_spaces(text_, second + 1, close);
    if (next < close) change(next, close, Ends::here, Binds::no);
    end_loop(again, leave);
    c_.names.forget_after(names);
    forget_locals_after(outer);
    return end;
  }

  std::size_t while_loop(std::size_t open, std::size_t to) {
    const std::size_t close = marks_.closing(open, to);
    add(Step::Action::enter_loop);
    const std::uint32_t again = here();
    const std::uint32_t leave = add(Step::Action::jump_unless, condition(open, close, to));
    const std::size_t end = body(std::min(close + 1, to), to);
    end_loop(again, leave);
    return end;
  }

  void end_loop(std::uint32_t again, std::uint32_t leave) {
    add(Step::Action::next_turn);
    add(Step::Action::jump, {}, again);
    steps_[leave].target = add(Step::Action::leave_loop);
  }

  std::size_t choice(std::size_t open, std::size_t to) {
    const std::size_t close = marks_.closing(open, to);
    const std::uint32_t otherwise = add(Step::Action::jump_unless, condition(open, close, to));
    std::size_t end = body(std::min(close + 1, to), to);
    const std::size_t next = skip_spaces(text_, end, to);
    const bool has_else = text_.substr(next, std::min<std::size_t>(4, to - next)) == "else";
    if (has_else) {
      const std::uint32_t over = add(Step::Action::jump);
      steps_[otherwise].target = here();
      end = body(next + 4, to);
      steps_[over].target = here();
    } else {
      steps_[otherwise].target = here();
    }
    return end;
  }

  lang::Expression condition(std::size_t open, std::size_t close, std::size_t to) {
    if (close == to) add_error(open, "found `(` without its `)`");
    return compile_expression(c_, source_, {open + 1, close});
  }

  /// Compiles a block, one statement or one module.
  std::size_t body(std::size_t at, std::size_t to) {
    at = skip_spaces(text_, at, to);
    if (++depth_ > deepest) {
      add_error(at, "statements nest deeper than 64");
      stopped_ = true;
    }
    if (at >= to) add_error(at, "expected a module or `{` after the condition");
    std::size_t end = to;
    if (at < to && !stopped_) end = text_[at] == '{' ? block(at, to) : single(at, to);
    --depth_;
    return end;
  }

  std::size_t block(std::size_t open, std::size_t to) {
    const std::size_t close = marks_.closing(open, to);
    if (close == to) add_error(open, "found `{` without its `}`; braces inside a block must pair");
    items({open + 1, close});
    return std::min(close + 1, to);
  }

  std::size_t single(std::size_t at, std::size_t to) {
    const std::size_t end = statement(at, to);
    if (end != at) return end;
    std::size_t module_end = module_at(at, to);
    if (text_[at] == '[') {  // a branch counts as one module
      module_end = std::min(marks_.closing(at, to) + 1, to);
    }
    items({at, module_end});
    return module_end;
  }

  /// Returns the end of the module at `at`, including its parameters.
  std::size_t module_at(std::size_t at, std::size_t to) const {
    const std::size_t length = std::max<std::size_t>(c_.symbols.length_at(text_, at, to), 1);
    const std::size_t end = at + length;
    if (end >= to || text_[end] != '(') return end;
    return std::min(marks_.closing(end, to) + 1, to);
  }

  /// Compiles the modules up to the next statement as one step, and returns their end.
  std::size_t modules(std::size_t at, std::size_t to, std::vector<std::size_t>& open) {
    const std::size_t from = at;
    while (at < to && (at == from || !begins_statement(at, to))) {
      if (text_[at] == '[') open.push_back(at);
      if (text_[at] == ']' && open.empty() && sound())
        add_error(at, "found `]` without a `[` before it in the same block");
      if (text_[at] == ']' && !open.empty()) open.pop_back();
      at = skip_spaces(text_, module_at(at, to), to);
    }
    if (allowed_ == Allowed::statements_alone) {
      add_error(from, "found modules; expected statements such as `x = 2;`");
      stopped_ = true;
      return to;
    }
    steps_.push_back({Step::Action::write, compile_word(c_, source_, {from, at}), {}, 0, 0});
    return at;
  }

  bool begins_statement(std::size_t at, std::size_t to) const {
    if (statements_.loop_at(at, to) < to || open_after(text_, "while", at, to) < to) return true;
    if (statements_.condition_at(at, to) < to || statements_.is_let(at, to)) return true;
    const std::size_t end = end_of_name(text_, at, to);
    return end > at && statements_.changes(skip_spaces(text_, end, to), to) &&
           local(text_.substr(at, end - at));
  }

  Compilation& c_;
  Source& source_;
  std::string_view text_;
  const Marks& marks_;
  Statements statements_;
  std::vector<Step>& steps_;
  std::uint32_t& slots_;
  Allowed allowed_;
  std::vector<std::string> locals_;  ///< names in the order of declaration
  /// slots by name, innermost last
  std::map<std::string, std::vector<std::uint32_t>, std::less<>> slots_of_;
  std::size_t bound_ = 0;
  int depth_ = 0;
  bool stopped_ = false;
};

}  // namespace

Range compile_code(Compilation& c, Source& source, Slice slice, std::uint32_t& slots) {
  const auto first = static_cast<std::uint32_t>(c.grammar.steps.size());
  CodeReader(c, source, slots, CodeReader::Allowed::modules).items(slice);
  return {first, static_cast<std::uint32_t>(c.grammar.steps.size()) - first};
}

/// The locals stay valid in the rest of the production.
Range compile_assignments(Compilation& c, Source& source, Slice slice, std::uint32_t& slots) {
  const auto first = static_cast<std::uint32_t>(c.grammar.steps.size());
  if (slice.empty()) return {first, 0};
  CodeReader reader(c, source, slots, CodeReader::Allowed::statements_alone);
  std::size_t at = skip_spaces(source.text, slice.from, slice.to);
  while (at < slice.to && source.errors.size() < lang::max_errors) {
    const std::size_t end = reader.statement(at, slice.to);
    if (end == at) {
      source.errors.push_back({at, "expected a statement such as `x = 2;`"});
      break;
    }
    at = skip_spaces(source.text, end, slice.to);
  }
  return {first, static_cast<std::uint32_t>(c.grammar.steps.size()) - first};
}

}  // namespace seedmesh::lsystem

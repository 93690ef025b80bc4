#include "core/generators/lsystem/grammar.h"

#include <algorithm>

#include "core/generators/lsystem/compilation.h"
#include "core/generators/lsystem/constants.h"
#include "core/generators/lsystem/unused.h"
#include "core/schema/json.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t most_issues = 10'000;      // compilation stops at this number
constexpr std::size_t most_of_tables = 200'000;  // productions, of about 400 bytes each
constexpr std::size_t most_elements = 10'000;    // of all arrays; productions keep a copy

std::vector<WrittenConstant> written_constants(const LsystemParams& params) {
  std::vector<WrittenConstant> written;
  for (const auto& [name, value] : params.constants) written.push_back({name, value});
  if (params.timed && !params.constants.contains("age")) {
    written.push_back({"age", params.age.value_or(static_cast<double>(params.iterations))});
  }
  return written;
}

void check_age(const LsystemParams& params, std::vector<Issue>& issues) {
  if (params.timed && params.constants.contains("age")) {
    issues.emplace_back(conflict_with({"timed"}), "/constants/age",
                        "with `timed`, the name `age` is reserved for the age of the plant");
  }
  if (!params.age || params.timed || *params.age <= static_cast<double>(params.iterations)) return;
  issues.emplace_back(IssueKind::out_of_range, "/age",
                      "found an age of " + number_text(*params.age) + "; the plant is derived for " +
                          std::to_string(params.iterations) + " iterations");
}

/// Between two steps, modules of the next word replace those of the present one. That needs fixed successors.
void check_between_steps(const LsystemParams& params, const Grammar& grammar, std::vector<Issue>& issues) {
  if (!params.age || params.timed ||
      *params.age == static_cast<double>(static_cast<std::int64_t>(*params.age)))
    return;
  const auto has_new_context = [](const Production& each) { return each.has_new_context(); };
  const std::vector<Production>& rules = grammar.productions.productions;
  const char* found = grammar.statements                                         ? "statements"
                      : grammar.strict                                           ? "strict predecessors"
                      : !grammar.variables.empty()                               ? "variables"
                      : !grammar.decomposition.productions.empty()               ? "decomposition rules"
                      : std::any_of(rules.begin(), rules.end(), has_new_context) ? "contexts of the new word"
                                                                                 : nullptr;
  if (!found) return;
  issues.emplace_back(conflict_with({"timed"}), "/age",
                      "found a fractional age and a grammar with " + std::string(found) +
                          "; such a grammar needs a whole number of iterations or `timed`");
}

/// The name of a surface is a reference to it in every expression, unless a constant, a variable or an array has the
/// name: its number in the order of the names.
void bind_objects(Compilation& c) {
  double number = 0;
  for (const auto& [name, surface] : c.params.surfaces) {
    const bool is_taken = c.params.constants.contains(name) || c.params.variables.contains(name) ||
                          c.params.arrays.contains(name);
    if (!is_taken) c.names.bind_constant(name, number);
    ++number;
  }
}

/// Gives variables and arrays the first slots of all productions.
void bind_variables(Compilation& c, const lang::Names& values) {
  for (const auto& [name, value] : c.params.variables) {
    c.names.bind_slot(name, static_cast<std::uint32_t>(c.grammar.variables.size()));
    c.grammar.variables.push_back(values.find(name)->value);
  }
  std::size_t elements = 0;
  for (const auto& [name, list] : c.params.arrays) {
    elements += list.size();
    if (elements > most_elements) {
      c.issues.emplace_back(IssueKind::out_of_range, "/arrays",
                            "found more than " + std::to_string(most_elements) + " elements of all arrays");
      return;
    }
    if (c.params.constants.contains(name))
      c.issues.emplace_back(conflict_with({"constants"}), "/arrays/" + name, "found a constant of this name");
    c.names.bind_array(name, static_cast<std::uint32_t>(c.grammar.variables.size()),
                       static_cast<std::uint32_t>(list.size()));
    c.grammar.variables.insert(c.grammar.variables.end(), list.begin(), list.end());
  }
  c.grammar.most_slots =
      std::max(c.grammar.most_slots, static_cast<std::uint32_t>(c.grammar.variables.size()));
}

/// Binds the names of surfaces, constants, variables and arrays.
void bind_values(Compilation& c, std::uint64_t seed) {
  for (const auto& [name, surface] : c.params.surfaces) c.symbols.declare("~" + name);
  std::vector<WrittenConstant> written = written_constants(c.params);
  for (const auto& [name, value] : c.params.variables) {
    written.push_back({name, value});
    if (c.params.constants.contains(name) || c.params.arrays.contains(name)) {
      c.issues.emplace_back(conflict_with({"constants", "arrays"}), "/variables/" + name,
                            "found a constant or an array of this name");
    }
  }
  std::vector<Issue> found;
  const lang::Names values = resolve_constants(written, Rng::of_seed(seed).at("constants"), found);
  for (Issue& issue : found) {
    const std::string name = issue.pointer.substr(issue.pointer.rfind('/') + 1);
    if (c.params.variables.contains(name) && !c.params.constants.contains(name))
      issue.pointer = "/variables/" + name;
    c.issues.push_back(std::move(issue));
  }
  bind_objects(c);
  for (const WrittenConstant& each : written_constants(c.params))
    c.names.bind_constant(each.name, values.find(each.name)->value);
  bind_variables(c, values);
  c.constant_count = c.names.size();
}

/// Compiles what runs before and after every step.
void read_statements_between(Compilation& c) {
  const auto read = [&](const std::string& text, const char* pointer) {
    Source source(text, pointer);
    c.names.forget_after(c.constant_count);
    auto slots = static_cast<std::uint32_t>(c.grammar.variables.size());
    const Range steps = compile_assignments(c, source, {0, text.size()}, slots);
    c.grammar.most_slots = std::max(c.grammar.most_slots, slots);
    take_errors(c, source);
    return steps;
  };
  c.grammar.start_each = read(c.params.start_each, "/start_each");
  c.grammar.end_each = read(c.params.end_each, "/end_each");
  c.names.forget_after(c.constant_count);
}

std::uint32_t surface_of(const Compilation& c, std::string_view symbol) {
  if (symbol.size() < 2 || symbol[0] != '~') return Kind::none;
  const auto found = c.params.surfaces.find(std::string(symbol.substr(1)));
  if (found == c.params.surfaces.end()) return Kind::none;
  return static_cast<std::uint32_t>(std::distance(c.params.surfaces.begin(), found));
}

void read_axiom(Compilation& c) {
  Source source(c.params.axiom, "/axiom");
  c.occurrences.clear();
  c.grammar.axiom = compile_word(c, source, {0, source.text.size()});
  check_brackets(c, source, {0, source.text.size()});
  take_errors(c, source);
}

void read_rules(Compilation& c, const std::string& folder, const std::vector<std::string>& texts,
                Rules& rules) {
  for (std::size_t i = 0; i < texts.size() && c.issues.size() < most_issues; ++i) {
    if (c.job && (i & 255U) == 0) c.job->check();
    Source source(texts[i], folder + std::to_string(i));
    const std::size_t label = label_length(source.text, c.symbols);
    const WrittenProduction written = read_production(source.text, source.errors, label);
    if (source.errors.empty()) rules.productions.push_back(compile_production(c, source, written));
    take_errors(c, source);
  }
}

/// The productions of a table precede those that apply in every step.
void read_tables(Compilation& c) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < c.params.tables.size(); ++i) {
    const auto& table = c.params.tables[i];
    c.grammar.tables.emplace_back();
    read_rules(c, "/tables/" + std::to_string(i) + "/productions/", table.productions,
               c.grammar.tables.back());
    const std::vector<Production>& common = c.grammar.productions.productions;
    std::vector<Production>& own = c.grammar.tables.back().productions;
    count += own.size() + common.size();
    if (count > most_of_tables) {
      c.issues.emplace_back(IssueKind::out_of_range, "/tables",
                            "found more than " + std::to_string(most_of_tables) +
                                " productions in all tables, each with the productions of every step");
      return;
    }
    own.insert(own.end(), common.begin(), common.end());
    c.grammar.table_of_turn.insert(c.grammar.table_of_turn.end(), static_cast<std::size_t>(table.steps),
                                   static_cast<std::uint32_t>(i));
  }
}

void check_alone(Compilation& c, const Rules& rules, const char* what) {
  for (const Production& each : rules.productions) {
    if (!each.has_context()) continue;
    c.issues.emplace_back(IssueKind::invalid_value, each.pointer,
                          std::string(what) + " cannot have a context, because it applies to one module");
  }
}

/// A word is written in one direction: from the left for new left contexts, from the right for new right
/// contexts.
void check_directions(Compilation& c) {
  const Production* left = nullptr;
  const Production* right = nullptr;
  for_all_rules(c, [&](const Rules& rules) {
    for (const Production& each : rules.productions) {
      if (!each.new_left.empty()) left = &each;
      if (!each.new_right.empty()) right = &each;
      c.grammar.strict = c.grammar.strict || !each.rest.empty();
      if (&rules == &c.grammar.interpretation) continue;
      c.grammar.statements = c.grammar.statements || each.code.count > 0 || each.before.count > 0;
    }
  });
  c.grammar.backward = right != nullptr;
  if (right && c.grammar.strict) {
    c.issues.emplace_back(conflict_with({}), right->pointer,
                          "found a new right context and strict predecessors of several modules; a word is "
                          "written in one direction");
  }
  if (left && right) {
    c.issues.emplace_back(conflict_with({}), right->pointer,
                          "found a new right context, but `" + left->pointer.substr(1) +
                              "` has a new left one; a word is written in one direction");
  }
}

bool draws_in(const Compilation& c, Range steps) {
  for (std::uint32_t i = steps.first; i < steps.first + steps.count; ++i) {
    if (c.grammar.program.draws(c.grammar.steps[i].value)) return true;
  }
  return false;
}

bool draws(const Compilation& c, Range successor) {
  const auto draws_one = [&](const lang::Expression& each) { return c.grammar.program.draws(each); };
  for (const Template& each : c.grammar.successor(successor)) {
    const Kind& kind = c.grammar.kinds[each.kind];
    for (std::uint32_t i = 0; i < kind.written(); ++i) {
      const lang::Expression& argument = c.grammar.arguments[each.first_argument + i];
      if (draws_one(argument)) return true;
      if (kind.frames.empty() || kind.frames[i] == 0) continue;
      for (const FrameExpression::Part& part : c.grammar.frames[frame_index(argument)].parts) {
        if (std::any_of(std::begin(part.by), std::end(part.by), draws_one)) return true;
      }
    }
  }
  return false;
}

bool draws(const Compilation& c, const Production& production) {
  return draws(c, production.successor) || draws_in(c, production.code) || draws_in(c, production.before);
}

/// Sorts by predecessor, then with context before without unless the order of the list counts, then by the order of
/// the text.
void order(Compilation& c, Rules& rules) {
  const bool by_context = c.params.rule_order == LsystemParams::RuleOrder::contexts_first;
  std::stable_sort(rules.productions.begin(), rules.productions.end(),
                   [by_context](const Production& a, const Production& b) {
                     if (a.predecessor != b.predecessor) return a.predecessor < b.predecessor;
                     return by_context && a.has_context() && !b.has_context();
                   });
  rules.of_kind.assign(c.grammar.kinds.size(), {});
  rules.redraws.assign(c.grammar.kinds.size(), 0);
  for (std::uint32_t i = 0; i < rules.productions.size(); ++i) {
    const Production& each = rules.productions[i];
    Range& range = rules.of_kind[each.predecessor];
    if (range.count++ == 0) range.first = i;
    rules.context = rules.context || each.has_context();
    if (each.conditional && c.grammar.program.draws(each.condition)) rules.redraws[each.predecessor] = 1;
    rules.random = rules.random || each.weighted || rules.redraws[each.predecessor] || draws(c, each);
  }
}

/// Compiles in the order in which the parts depend on each other.
Grammar compile_all(Compilation& c, std::uint64_t seed) {
  bind_values(c, seed);
  declare_modules(c);
  define_functions(c);
  mark_ignored(c);
  read_alphabet(c);
  Source none;
  c.grammar.open = kind_of(c, "[", 0, none, 0);
  c.grammar.close = kind_of(c, "]", 0, none, 0);
  c.grammar.cut = kind_of(c, "%", 0, none, 0);
  c.grammar.ring = c.params.ring;
  c.grammar.contexts_first = c.params.rule_order == LsystemParams::RuleOrder::contexts_first;
  c.grammar.weights_sum_to_1 = c.params.weights == LsystemParams::Weights::strict;
  c.grammar.decomposition_depth = static_cast<std::uint32_t>(c.params.decomposition_depth);
  read_axiom(c);
  read_rules(c, "/productions/", c.params.productions, c.grammar.productions);
  read_rules(c, "/interpretation/", c.params.interpretation, c.grammar.interpretation);
  read_rules(c, "/decomposition/", c.params.decomposition, c.grammar.decomposition);
  read_tables(c);
  read_statements_between(c);
  check_alone(c, c.grammar.interpretation, "an interpretation rule");
  check_alone(c, c.grammar.decomposition, "a decomposition rule");
  check_directions(c);
  for_all_rules(c, [&](Rules& rules) { order(c, rules); });
  for (const Rules& table : c.grammar.tables) {
    c.grammar.productions.random |= table.random;
    c.grammar.productions.context |= table.context;
  }
  c.grammar.productions.random |= c.grammar.decomposition.random || draws(c, c.grammar.axiom);
  check_rules(c);
  return std::move(c.grammar);
}

}  // namespace

/// Reports a kind that contradicts its declared signature, at `offset`.
KindId kind_of(Compilation& c, std::string_view symbol, std::uint32_t written, Source& source,
               std::size_t offset) {
  const auto known = c.ids.find({std::string(symbol), written});
  if (known != c.ids.end()) return known->second;
  if (c.grammar.kinds.size() == most_kinds) {
    source.errors.push_back({offset, "found more than " + std::to_string(most_kinds) +
                                         " symbols; each number of parameters counts as a symbol"});
    return c.grammar.open;
  }
  Kind made;
  made.symbol = symbol;
  made.arity = written;
  const auto signature = c.signatures.find(symbol);
  if (signature != c.signatures.end() && signature->second.size() != written) {
    source.errors.push_back({offset, "found " + std::to_string(written) + " parameters of `" + made.symbol +
                                         "`; expected " + std::to_string(signature->second.size()) +
                                         ", as declared"});
  } else if (signature != c.signatures.end()) {
    const std::vector<std::uint8_t>& frames = signature->second;
    const auto count = static_cast<std::uint32_t>(std::count(frames.begin(), frames.end(), 1));
    if (count > 0) made.frames = frames;
    made.arity += count * (frame_numbers - 1);
    if (made.arity > most_parameters) {
      source.errors.push_back({offset, "found too many parameters; expected at most 64 numbers"});
    }
  }
  made.command = command_of(symbol.substr(0, symbol[0] == '~' ? 1 : symbol.size()), made.arity);
  made.surface = surface_of(c, symbol);
  made.ignored = c.considered.empty() ? c.ignored.count(symbol) != 0 : c.considered.count(symbol) == 0;
  if (symbol == "[" || symbol == "]") {
    made.ignored = false;  // brackets always count, as in the book
    if (written > 0) source.errors.push_back({offset, "found parameters of a bracket; it takes none"});
  }
  c.grammar.widest = std::max(c.grammar.widest, made.arity);
  const auto id = static_cast<KindId>(c.grammar.kinds.size());
  c.grammar.kinds.push_back(std::move(made));
  c.ids.emplace(std::pair{std::string(symbol), written}, id);
  return id;
}

/// A ~ without a surface name is an error where there are surfaces. Otherwise it can be an ordinary symbol.
void check_surface(Compilation& c, const WrittenModule& module, Source& source) {
  if (module.symbol != "~") return;
  if (c.params.surfaces.empty()) {
    warn(c, source, module.offset,
         "found `~` without `surfaces`; it adds no organ, and the text after it is read as modules");
    return;
  }
  if (!lang::can_add_error(source.errors)) return;
  std::string known;
  for (const auto& [name, surface] : c.params.surfaces) known += (known.empty() ? "~" : ", ~") + name;
  source.errors.push_back(
      {module.offset, "found `~` without the name of a surface; expected one of " + known});
}

void take_errors(Compilation& c, Source& source) {
  if (source.errors.empty()) return;
  lang::add_issues(source.pointer, source.text, source.errors, c.issues);
}

Grammar compile(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                std::vector<Issue>& issues, const Job* job) {
  if (params.iterations > static_cast<std::int64_t>(limits.iterations)) {
    issues.push_back(iterations_issue(static_cast<std::uint64_t>(params.iterations), limits));
  }
  check_age(params, issues);
  Compilation compilation(params, limits, issues, job);
  Grammar grammar = compile_all(compilation, seed);
  check_between_steps(params, grammar, issues);
  const std::vector<Warning> unused = unused_settings(params, grammar);
  grammar.warnings.insert(grammar.warnings.end(), unused.begin(), unused.end());
  return grammar;
}

}  // namespace seedmesh::lsystem

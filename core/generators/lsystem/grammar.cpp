#include "core/generators/lsystem/grammar.h"

#include <algorithm>

#include "core/generators/lsystem/compiler.h"
#include "core/generators/lsystem/constants.h"
#include "core/generators/unused.h"
#include "core/schema/json.h"
#include "generated/params/lsystem_unused.h"

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
    issues.emplace_back(IssueKind::conflict, "/constants/age",
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
  issues.emplace_back(IssueKind::conflict, "/age",
                      "found a fractional age and a grammar with " + std::string(found) +
                          "; such a grammar needs a whole number of iterations or `timed`");
}

}  // namespace

Compiler::Compiler(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                   std::vector<Issue>& issues, const Job* job)
    : params_(params), limits_(limits), issues_(issues), job_(job) {
  for (const auto& [name, surface] : params_.surfaces) symbols_.declare("~" + name);
  std::vector<WrittenConstant> written = written_constants(params);
  for (const auto& [name, value] : params.variables) {
    written.push_back({name, value});
    if (params.constants.contains(name) || params.arrays.contains(name)) {
      issues_.emplace_back(IssueKind::conflict, "/variables/" + name,
                           "found a constant or an array of this name");
    }
  }
  std::vector<Issue> found;
  const lang::Names values = resolve_constants(written, Rng::of_seed(seed).at("constants"), found);
  for (Issue& issue : found) {
    const std::string name = issue.pointer.substr(issue.pointer.rfind('/') + 1);
    if (params.variables.contains(name) && !params.constants.contains(name))
      issue.pointer = "/variables/" + name;
    issues_.push_back(std::move(issue));
  }
  bind_objects();
  for (const WrittenConstant& each : written_constants(params))
    names_.bind_constant(each.name, values.find(each.name)->value);
  bind_variables(values);
  constant_count_ = names_.size();
}

/// The name of a surface is a reference to it in every expression, unless a constant, a variable or an array has the
/// name: its number in the order of the names.
void Compiler::bind_objects() {
  double number = 0;
  for (const auto& [name, surface] : params_.surfaces) {
    const bool is_taken =
        params_.constants.contains(name) || params_.variables.contains(name) || params_.arrays.contains(name);
    if (!is_taken) names_.bind_constant(name, number);
    ++number;
  }
}

/// Gives variables and arrays the first slots of all productions.
void Compiler::bind_variables(const lang::Names& values) {
  for (const auto& [name, value] : params_.variables) {
    names_.bind_slot(name, static_cast<std::uint32_t>(grammar_.variables.size()));
    grammar_.variables.push_back(values.find(name)->value);
  }
  std::size_t elements = 0;
  for (const auto& [name, list] : params_.arrays) {
    elements += list.size();
    if (elements > most_elements) {
      issues_.emplace_back(IssueKind::out_of_range, "/arrays",
                           "found more than " + std::to_string(most_elements) + " elements of all arrays");
      return;
    }
    if (params_.constants.contains(name))
      issues_.emplace_back(IssueKind::conflict, "/arrays/" + name, "found a constant of this name");
    names_.bind_array(name, static_cast<std::uint32_t>(grammar_.variables.size()),
                      static_cast<std::uint32_t>(list.size()));
    grammar_.variables.insert(grammar_.variables.end(), list.begin(), list.end());
  }
  grammar_.most_slots = std::max(grammar_.most_slots, static_cast<std::uint32_t>(grammar_.variables.size()));
}

/// Compiles what runs before and after every step.
void Compiler::read_statements_between() {
  const auto read = [&](const std::string& text, const char* pointer) {
    Source source(text, pointer);
    names_.forget_after(constant_count_);
    auto slots = static_cast<std::uint32_t>(grammar_.variables.size());
    const Range steps = assignments(source, {0, text.size()}, slots);
    grammar_.most_slots = std::max(grammar_.most_slots, slots);
    take_errors(source);
    return steps;
  };
  grammar_.start_each = read(params_.start_each, "/start_each");
  grammar_.end_each = read(params_.end_each, "/end_each");
  names_.forget_after(constant_count_);
}

Grammar Compiler::compile() {
  declare_modules();
  define_functions();
  mark_ignored();
  read_alphabet();
  Source none;
  grammar_.open = kind("[", 0, none, 0);
  grammar_.close = kind("]", 0, none, 0);
  grammar_.cut = kind("%", 0, none, 0);
  grammar_.ring = params_.ring;
  grammar_.contexts_first = params_.rule_order == LsystemParams::RuleOrder::contexts_first;
  grammar_.weights_sum_to_1 = params_.weights == LsystemParams::Weights::strict;
  grammar_.decomposition_depth = static_cast<std::uint32_t>(params_.decomposition_depth);
  read_axiom();
  read_rules("/productions/", params_.productions, grammar_.productions);
  read_rules("/interpretation/", params_.interpretation, grammar_.interpretation);
  read_rules("/decomposition/", params_.decomposition, grammar_.decomposition);
  read_tables();
  read_statements_between();
  check_alone(grammar_.interpretation, "an interpretation rule");
  check_alone(grammar_.decomposition, "a decomposition rule");
  check_directions();
  for_all_rules([&](Rules& rules) { order(rules); });
  for (const Rules& table : grammar_.tables) {
    grammar_.productions.random |= table.random;
    grammar_.productions.context |= table.context;
  }
  grammar_.productions.random |= grammar_.decomposition.random || draws(grammar_.axiom);
  check_rules();
  return std::move(grammar_);
}

/// Reports a kind that contradicts its declared signature, at `offset`.
KindId Compiler::kind(std::string_view symbol, std::uint32_t written, Source& source, std::size_t offset) {
  const auto known = ids_.find({std::string(symbol), written});
  if (known != ids_.end()) return known->second;
  if (grammar_.kinds.size() == most_kinds) {
    source.errors.push_back({offset, "found more than " + std::to_string(most_kinds) +
                                         " symbols; each number of parameters counts as a symbol"});
    return grammar_.open;
  }
  Kind made;
  made.symbol = symbol;
  made.arity = written;
  const auto signature = signatures_.find(symbol);
  if (signature != signatures_.end() && signature->second.size() != written) {
    source.errors.push_back({offset, "found " + std::to_string(written) + " parameters of `" + made.symbol +
                                         "`; expected " + std::to_string(signature->second.size()) +
                                         ", as declared"});
  } else if (signature != signatures_.end()) {
    const std::vector<std::uint8_t>& frames = signature->second;
    const auto count = static_cast<std::uint32_t>(std::count(frames.begin(), frames.end(), 1));
    if (count > 0) made.frames = frames;
    made.arity += count * (frame_numbers - 1);
    if (made.arity > most_parameters) {
      source.errors.push_back({offset, "found too many parameters; expected at most 64 numbers"});
    }
  }
  made.command = command_of(symbol.substr(0, symbol[0] == '~' ? 1 : symbol.size()), made.arity);
  made.surface = surface_of(symbol);
  made.ignored = considered_.empty() ? ignored_.count(symbol) != 0 : considered_.count(symbol) == 0;
  if (symbol == "[" || symbol == "]") {
    made.ignored = false;  // brackets always count, as in the book
    if (written > 0) source.errors.push_back({offset, "found parameters of a bracket; it takes none"});
  }
  grammar_.widest = std::max(grammar_.widest, made.arity);
  const auto id = static_cast<KindId>(grammar_.kinds.size());
  grammar_.kinds.push_back(std::move(made));
  ids_.emplace(std::pair{std::string(symbol), written}, id);
  return id;
}

std::uint32_t Compiler::surface_of(std::string_view symbol) const {
  if (symbol.size() < 2 || symbol[0] != '~') return Kind::none;
  const auto found = params_.surfaces.find(std::string(symbol.substr(1)));
  if (found == params_.surfaces.end()) return Kind::none;
  return static_cast<std::uint32_t>(std::distance(params_.surfaces.begin(), found));
}

/// A ~ without a surface name is an error where there are surfaces. Otherwise it can be an ordinary symbol.
void Compiler::check_surface(const WrittenModule& module, Source& source) {
  if (module.symbol != "~") return;
  if (params_.surfaces.empty()) {
    warn(source, module.offset,
         "found `~` without `surfaces`; it adds no organ, and the text after it is read as modules");
    return;
  }
  if (!lang::has_room(source.errors)) return;
  std::string known;
  for (const auto& [name, surface] : params_.surfaces) known += (known.empty() ? "~" : ", ~") + name;
  source.errors.push_back(
      {module.offset, "found `~` without the name of a surface; expected one of " + known});
}

void Compiler::take_errors(Source& source) {
  if (source.errors.empty()) return;
  lang::add_issues(source.pointer, source.text, source.errors, issues_);
}

void Compiler::read_axiom() {
  Source source(params_.axiom, "/axiom");
  occurrences_.clear();
  grammar_.axiom = word(source, {0, source.text.size()});
  check_brackets(source, {0, source.text.size()});
  take_errors(source);
}

void Compiler::read_rules(const std::string& folder, const std::vector<std::string>& texts, Rules& rules) {
  for (std::size_t i = 0; i < texts.size() && issues_.size() < most_issues; ++i) {
    if (job_ && (i & 255U) == 0) job_->check();
    Source source(texts[i], folder + std::to_string(i));
    const std::size_t label = label_length(source.text, symbols_);
    const WrittenProduction written = read_production(source.text, source.errors, label);
    if (source.errors.empty()) rules.productions.push_back(production(source, written));
    take_errors(source);
  }
}

/// The productions of a table precede those that apply in every step.
void Compiler::read_tables() {
  std::size_t count = 0;
  for (std::size_t i = 0; i < params_.tables.size(); ++i) {
    const auto& table = params_.tables[i];
    grammar_.tables.emplace_back();
    read_rules("/tables/" + std::to_string(i) + "/productions/", table.productions, grammar_.tables.back());
    const std::vector<Production>& common = grammar_.productions.productions;
    std::vector<Production>& own = grammar_.tables.back().productions;
    count += own.size() + common.size();
    if (count > most_of_tables) {
      issues_.emplace_back(IssueKind::out_of_range, "/tables",
                           "found more than " + std::to_string(most_of_tables) +
                               " productions in all tables, each with the productions of every step");
      return;
    }
    own.insert(own.end(), common.begin(), common.end());
    grammar_.table_of_turn.insert(grammar_.table_of_turn.end(), static_cast<std::size_t>(table.steps),
                                  static_cast<std::uint32_t>(i));
  }
}

void Compiler::check_alone(const Rules& rules, const char* what) {
  for (const Production& each : rules.productions) {
    if (!each.has_context()) continue;
    issues_.emplace_back(IssueKind::invalid_value, each.pointer,
                         std::string(what) + " cannot have a context, because it applies to one module");
  }
}

/// A word is written in one direction: from the left for new left contexts, from the right for new right
/// contexts.
void Compiler::check_directions() {
  const Production* left = nullptr;
  const Production* right = nullptr;
  for_all_rules([&](const Rules& rules) {
    for (const Production& each : rules.productions) {
      if (!each.new_left.empty()) left = &each;
      if (!each.new_right.empty()) right = &each;
      grammar_.strict = grammar_.strict || !each.rest.empty();
      if (&rules == &grammar_.interpretation) continue;
      grammar_.statements = grammar_.statements || each.code.count > 0 || each.before.count > 0;
    }
  });
  grammar_.backward = right != nullptr;
  if (right && grammar_.strict) {
    issues_.emplace_back(IssueKind::conflict, right->pointer,
                         "found a new right context and strict predecessors of several modules; a word is "
                         "written in one direction");
  }
  if (left && right) {
    issues_.emplace_back(IssueKind::conflict, right->pointer,
                         "found a new right context, but " + left->pointer +
                             " has a new left one; a word is written in one direction");
  }
}

/// Sorts by predecessor, then with context before without unless the order of the list counts, then by the order of
/// the text.
void Compiler::order(Rules& rules) {
  const bool by_context = params_.rule_order == LsystemParams::RuleOrder::contexts_first;
  std::stable_sort(rules.productions.begin(), rules.productions.end(),
                   [by_context](const Production& a, const Production& b) {
                     if (a.predecessor != b.predecessor) return a.predecessor < b.predecessor;
                     return by_context && a.has_context() && !b.has_context();
                   });
  rules.of_kind.assign(grammar_.kinds.size(), {});
  rules.redraws.assign(grammar_.kinds.size(), 0);
  for (std::uint32_t i = 0; i < rules.productions.size(); ++i) {
    const Production& each = rules.productions[i];
    Range& range = rules.of_kind[each.predecessor];
    if (range.count++ == 0) range.first = i;
    rules.context = rules.context || each.has_context();
    if (each.conditional && grammar_.program.draws(each.condition)) rules.redraws[each.predecessor] = 1;
    rules.random = rules.random || each.weighted || rules.redraws[each.predecessor] || draws(each);
  }
}

bool Compiler::draws(const Production& production) const {
  return draws(production.successor) || draws_in(production.code) || draws_in(production.before);
}

bool Compiler::draws_in(Range steps) const {
  for (std::uint32_t i = steps.first; i < steps.first + steps.count; ++i) {
    if (grammar_.program.draws(grammar_.steps[i].value)) return true;
  }
  return false;
}

bool Compiler::draws(Range successor) const {
  const auto draws_one = [&](const lang::Expression& each) { return grammar_.program.draws(each); };
  for (const Template& each : grammar_.successor(successor)) {
    const Kind& kind = grammar_.kinds[each.kind];
    for (std::uint32_t i = 0; i < kind.written(); ++i) {
      const lang::Expression& argument = grammar_.arguments[each.first_argument + i];
      if (draws_one(argument)) return true;
      if (kind.frames.empty() || kind.frames[i] == 0) continue;
      for (const FrameExpression::Part& part : grammar_.frames[frame_index(argument)].parts) {
        if (std::any_of(std::begin(part.by), std::end(part.by), draws_one)) return true;
      }
    }
  }
  return false;
}

Grammar compile(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                std::vector<Issue>& issues, const Job* job) {
  if (params.iterations > static_cast<std::int64_t>(limits.iterations)) {
    issues.push_back(iterations_issue(static_cast<std::uint64_t>(params.iterations), limits));
  }
  check_age(params, issues);
  Grammar grammar = Compiler(params, seed, limits, issues, job).compile();
  check_between_steps(params, grammar, issues);
  const std::vector<Warning> unused = warnings_of(unused_parameters(params));
  grammar.warnings.insert(grammar.warnings.end(), unused.begin(), unused.end());
  return grammar;
}

}  // namespace seedmesh::lsystem

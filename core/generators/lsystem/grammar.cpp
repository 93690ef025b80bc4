#include "core/generators/lsystem/grammar.h"

#include <algorithm>

#include "core/generators/lsystem/compiler.h"
#include "core/generators/lsystem/constants.h"
#include "core/generators/lsystem/idle.h"
#include "core/schema/json.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t most_issues = 10'000;      // a request with more is not read to its end
constexpr std::size_t most_of_tables = 200'000;  // productions; each takes about 400 bytes

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
    issues.push_back({"/constants/age", "`age` is the age of the plant where `timed` is set"});
  }
  if (!params.age || params.timed || *params.age <= static_cast<double>(params.iterations)) return;
  issues.push_back({"/age", "found an age of " + number_text(*params.age) + "; the plant is derived for " +
                                std::to_string(params.iterations) + " iterations"});
}

/// Between two steps modules of the next word grow in place of those of this one; that needs a successor that
/// stands in the text.
void check_between_steps(const LsystemParams& params, const Grammar& grammar, std::vector<Issue>& issues) {
  if (!params.age || params.timed ||
      *params.age == static_cast<double>(static_cast<std::int64_t>(*params.age)))
    return;
  const auto looks_at_new = [](const Production& each) { return each.looks_at_new(); };
  const std::vector<Production>& rules = grammar.productions.productions;
  const char* found = grammar.statements                                      ? "statements"
                      : !grammar.decomposition.productions.empty()            ? "decomposition rules"
                      : std::any_of(rules.begin(), rules.end(), looks_at_new) ? "contexts of the new word"
                                                                              : nullptr;
  if (!found) return;
  issues.push_back({"/age", "found a part of a step and a grammar with " + std::string(found) +
                                "; such a grammar grows by whole steps, or by timed modules"});
}

}  // namespace

Compiler::Compiler(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                   std::vector<Issue>& issues, const Job* job)
    : params_(params), limits_(limits), issues_(issues), job_(job) {
  for (const auto& [name, surface] : params_.surfaces) symbols_.declare("~" + name);
  names_ = resolve_constants(written_constants(params), Rng::of_seed(seed).at("constants"), issues_);
  constant_count_ = names_.size();
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
  grammar_.decomposition_depth = static_cast<std::uint32_t>(params_.decomposition_depth);
  read_axiom();
  read_rules("/productions/", params_.productions, grammar_.productions);
  read_rules("/interpretation/", params_.interpretation, grammar_.interpretation);
  read_rules("/decomposition/", params_.decomposition, grammar_.decomposition);
  read_tables();
  check_alone(grammar_.interpretation, "an interpretation rule");
  check_alone(grammar_.decomposition, "a decomposition rule");
  check_directions();
  for_all_rules([&](Rules& rules) { order(rules); });
  for (const Rules& table : grammar_.tables) {
    grammar_.productions.chance |= table.chance;
    grammar_.productions.context |= table.context;
  }
  grammar_.productions.chance |= grammar_.decomposition.chance || draws(grammar_.axiom);
  judge();
  return std::move(grammar_);
}

/// Kinds with a signature that is not kept are told at `offset`.
KindId Compiler::kind(std::string_view symbol, std::uint32_t written, Source& source, std::size_t offset) {
  const auto known = ids_.find({std::string(symbol), written});
  if (known != ids_.end()) return known->second;
  if (grammar_.kinds.size() == most_kinds) {
    source.faults.push_back({offset, "found more than " + std::to_string(most_kinds) +
                                         " symbols, with those of other numbers of parameters"});
    return grammar_.open;
  }
  Kind made;
  made.symbol = symbol;
  made.arity = written;
  const auto signature = signatures_.find(symbol);
  if (signature != signatures_.end() && signature->second.size() != written) {
    source.faults.push_back({offset, "found " + std::to_string(written) + " parameters of `" + made.symbol +
                                         "`; expected " + std::to_string(signature->second.size()) +
                                         ", as declared"});
  } else if (signature != signatures_.end()) {
    const std::vector<std::uint8_t>& frames = signature->second;
    const auto count = static_cast<std::uint32_t>(std::count(frames.begin(), frames.end(), 1));
    if (count > 0) made.frames = frames;
    made.arity += count * (frame_numbers - 1);
    if (made.arity > most_parameters) {
      source.faults.push_back({offset, "found too many parameters; expected at most 64 numbers"});
    }
  }
  made.command = command_of(symbol.substr(0, symbol[0] == '~' ? 1 : symbol.size()), made.arity);
  made.surface = surface_of(symbol);
  made.ignored = considered_.empty() ? ignored_.count(symbol) != 0 : considered_.count(symbol) == 0;
  if (symbol == "[" || symbol == "]") {
    made.ignored = false;  // brackets always count, as in the book
    if (written > 0) source.faults.push_back({offset, "found parameters of a bracket; it takes none"});
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

/// A ~ of no surface is a slip wherever there are surfaces; where there are none it may be a letter as
/// others.
void Compiler::check_surface(const WrittenModule& module, Source& source) {
  if (module.symbol != "~") return;
  if (params_.surfaces.empty()) {
    warn(
        source, module.offset,
        "found `~` and no `surfaces`: it places no organ, and what follows it is read as modules of its own");
    return;
  }
  if (!lang::has_room(source.faults)) return;
  std::string known;
  for (const auto& [name, surface] : params_.surfaces) known += (known.empty() ? "~" : ", ~") + name;
  source.faults.push_back({module.offset, "found `~` without the name of a surface; there are " + known});
}

void Compiler::take_faults(Source& source) {
  if (source.faults.empty()) return;
  lang::add_issues(source.pointer, source.text, source.faults, issues_);
}

void Compiler::read_axiom() {
  Source source(params_.axiom, "/axiom");
  occurrences_.clear();
  grammar_.axiom = word(source, {0, source.text.size()});
  check_brackets(source, {0, source.text.size()});
  take_faults(source);
}

void Compiler::read_rules(const std::string& folder, const std::vector<std::string>& texts, Rules& rules) {
  for (std::size_t i = 0; i < texts.size() && issues_.size() < most_issues; ++i) {
    if (job_ && (i & 255U) == 0) job_->check();
    Source source(texts[i], folder + std::to_string(i));
    const std::size_t label = label_length(source.text, symbols_);
    const WrittenProduction written = read_production(source.text, source.faults, label);
    if (source.faults.empty()) rules.productions.push_back(production(source, written));
    take_faults(source);
  }
}

/// A table's productions come before those that hold in every step.
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
      issues_.push_back({"/tables", "found more than " + std::to_string(most_of_tables) +
                                        " productions in all tables, each with those that hold in every "
                                        "step"});
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
    issues_.push_back(
        {each.pointer, std::string(what) + " takes no context: it is used on one module alone"});
  }
}

/// A word is written in one direction: from the left where new left contexts are looked at, from the right
/// where new right ones are.
void Compiler::check_directions() {
  const Production* left = nullptr;
  const Production* right = nullptr;
  for_all_rules([&](const Rules& rules) {
    for (const Production& each : rules.productions) {
      if (!each.new_left.empty()) left = &each;
      if (!each.new_right.empty()) right = &each;
      if (&rules == &grammar_.interpretation) continue;
      grammar_.statements = grammar_.statements || each.code.count > 0 || each.before.count > 0;
    }
  });
  grammar_.backward = right != nullptr;
  if (left && right) {
    issues_.push_back({right->pointer, "found a new right context where " + left->pointer +
                                           " has a new left one; a word is written in one direction"});
  }
}

/// Side by side by predecessor, with context before without, then as written.
void Compiler::order(Rules& rules) {
  std::stable_sort(rules.productions.begin(), rules.productions.end(),
                   [](const Production& a, const Production& b) {
                     if (a.predecessor != b.predecessor) return a.predecessor < b.predecessor;
                     return a.has_context() && !b.has_context();
                   });
  rules.of_kind.assign(grammar_.kinds.size(), {});
  rules.redraws.assign(grammar_.kinds.size(), 0);
  for (std::uint32_t i = 0; i < rules.productions.size(); ++i) {
    const Production& each = rules.productions[i];
    Range& range = rules.of_kind[each.predecessor];
    if (range.count++ == 0) range.first = i;
    rules.context = rules.context || each.has_context();
    if (each.conditional && grammar_.program.draws(each.condition)) rules.redraws[each.predecessor] = 1;
    rules.chance = rules.chance || each.weighted || rules.redraws[each.predecessor] || draws(each);
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
      for (const FrameExpression::Part& part : grammar_.frames[frame_place(argument)].parts) {
        if (std::any_of(std::begin(part.by), std::end(part.by), draws_one)) return true;
      }
    }
  }
  return false;
}

Grammar compile(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                std::vector<Issue>& issues, const Job* job) {
  if (params.iterations > static_cast<std::int64_t>(limits.iterations)) {
    issues.push_back({"/iterations", "found " + std::to_string(params.iterations) + "; the limit is " +
                                         std::to_string(limits.iterations)});
  }
  check_age(params, issues);
  Grammar grammar = Compiler(params, seed, limits, issues, job).compile();
  check_between_steps(params, grammar, issues);
  const std::vector<Warning> idle = idle_parameters(params);
  grammar.warnings.insert(grammar.warnings.end(), idle.begin(), idle.end());
  return grammar;
}

}  // namespace seedmesh::lsystem

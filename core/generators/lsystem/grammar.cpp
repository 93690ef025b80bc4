#include "core/generators/lsystem/grammar.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/generators/lsystem/constants.h"
#include "core/generators/lsystem/notation.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {
namespace {

using lang::Fault;

constexpr std::uint32_t most_parameters = 64;
constexpr std::size_t most_kinds = 60'000;

std::uint64_t hash_of(std::string_view symbol) { return Rng(0).at(symbol).key(); }

/// One text of the request with the faults found in it.
struct Source {
  std::string_view text;
  std::string pointer;
  std::vector<Fault> faults;
};

class Compiler {
 public:
  Compiler(const LsystemParams& params, std::uint64_t seed, const Limits& limits, std::vector<Issue>& issues)
      : params_(params), limits_(limits), issues_(issues) {
    for (const auto& [name, surface] : params_.surfaces) symbols_.declare("~" + name);
    names_ = resolve_constants(written_constants(), Rng::of_seed(seed).at("constants"), issues_);
    constant_count_ = names_.size();
  }

  Grammar compile() {
    grammar_.open = kind("[", 0);
    grammar_.close = kind("]", 0);
    grammar_.cut = kind("%", 0);
    mark_ignored();
    read_axiom();
    read_rules("/productions/", params_.productions, grammar_.productions);
    read_rules("/interpretation/", params_.interpretation, grammar_.interpretation);
    check_interpretation();
    order(grammar_.productions);
    order(grammar_.interpretation);
    return std::move(grammar_);
  }

 private:
  std::vector<WrittenConstant> written_constants() const {
    std::vector<WrittenConstant> written;
    for (const auto& [name, value] : params_.constants) written.push_back({name, value});
    if (params_.timed && !params_.constants.contains("age")) {
      written.push_back({"age", params_.age.value_or(static_cast<double>(params_.iterations))});
    }
    return written;
  }

  KindId kind(std::string_view symbol, std::uint32_t arity) {
    const auto [at, fresh] =
        ids_.try_emplace({std::string(symbol), arity}, static_cast<KindId>(grammar_.kinds.size()));
    if (fresh) {
      grammar_.kinds.push_back(
          {std::string(symbol), arity, command_of(symbol.substr(0, symbol[0] == '~' ? 1 : symbol.size()), arity),
           ignored_.count(symbol) != 0, surface_of(symbol)});
      grammar_.widest = std::max(grammar_.widest, arity);
    }
    return at->second;
  }

  std::uint32_t surface_of(std::string_view symbol) const {
    if (symbol.size() < 2 || symbol[0] != '~') return Kind::none;
    const auto found = params_.surfaces.find(std::string(symbol.substr(1)));
    if (found == params_.surfaces.end()) return Kind::none;
    return static_cast<std::uint32_t>(std::distance(params_.surfaces.begin(), found));
  }

  /// A ~ of no surface is a slip wherever there are surfaces.
  void check_surface(const WrittenModule& module, Source& source) const {
    if (module.symbol != "~" || params_.surfaces.empty()) return;
    std::string known;
    for (const auto& [name, surface] : params_.surfaces) known += (known.empty() ? "~" : ", ~") + name;
    source.faults.push_back({module.offset, "found `~` without the name of a surface; there are " + known});
  }

  void mark_ignored() {
    Source source{params_.ignore, "/ignore", {}};
    for (const WrittenModule& module :
         read_modules(source.text, {0, source.text.size()}, symbols_, source.faults)) {
      ignored_.insert(std::string(module.symbol));
    }
    ignored_.erase("[");  // brackets always count, as in the book
    ignored_.erase("]");
    take_faults(source);
    for (Kind& each : grammar_.kinds) each.ignored = ignored_.count(each.symbol) != 0;
    read_alphabet();
  }

  void read_alphabet() {
    if (!params_.alphabet) return;
    Source variables{params_.alphabet->variables, "/alphabet/variables", {}};
    Source constants{params_.alphabet->constants, "/alphabet/constants", {}};
    for (Source* source : {&variables, &constants}) {
      for (const WrittenModule& module :
           read_modules(source->text, {0, source->text.size()}, symbols_, source->faults)) {
        (source == &variables ? variables_ : alphabet_constants_).insert(std::string(module.symbol));
      }
      take_faults(*source);
    }
  }

  void check_symbol(const WrittenModule& module, Source& source) const {
    if (!params_.alphabet || variables_.count(module.symbol) || alphabet_constants_.count(module.symbol))
      return;
    source.faults.push_back(
        {module.offset, "found `" + std::string(module.symbol) + "`, which is not in the alphabet"});
  }

  void take_faults(Source& source) {
    std::stable_sort(source.faults.begin(), source.faults.end(),
                     [](const Fault& a, const Fault& b) { return a.offset < b.offset; });
    for (const Fault& fault : source.faults) {
      issues_.push_back(issue_at(source.pointer, source.text, fault.offset, fault.message));
    }
  }

  lang::Expression expression(Source& source, Slice slice) {
    const std::size_t before = source.faults.size();
    const std::vector<lang::Token> tokens = lang::tokenize(source.text, slice.from, slice.to, source.faults);
    if (source.faults.size() != before) return {};
    std::size_t at = 0;
    const lang::Expression parsed =
        grammar_.program.parse(tokens, at, names_, source.faults, limits_.expression_depth);
    if (source.faults.size() == before && tokens[at].kind != lang::TokenKind::end) {
      source.faults.push_back({tokens[at].offset, "found `" + std::string(tokens[at].text) +
                                                      "` after the end of the expression"});
    }
    return parsed;
  }

  /// The modules of an axiom or a successor, as templates.
  Range word(Source& source, Slice slice) {
    Range range{static_cast<std::uint32_t>(grammar_.templates.size()), 0};
    if (erases(source.text, slice)) return range;
    std::map<std::string, std::uint64_t, std::less<>> occurrences;
    for (const WrittenModule& module : read_modules(source.text, slice, symbols_, source.faults)) {
      check_symbol(module, source);
      check_surface(module, source);
      if (grammar_.templates.size() == most_modules) {
        source.faults.push_back({module.offset, "found more than 1,000,000 modules in one grammar"});
        break;
      }
      if (module.arguments.size() > most_parameters || grammar_.kinds.size() > most_kinds) {
        source.faults.push_back({module.offset, "found too many parameters; expected at most 64"});
        continue;
      }
      Template made;
      made.first_argument = static_cast<std::uint32_t>(grammar_.arguments.size());
      for (const Slice& argument : module.arguments) {
        const lang::Expression value = expression(source, argument);
        grammar_.arguments.push_back(value);
      }
      made.kind = kind(module.symbol, static_cast<std::uint32_t>(module.arguments.size()));
      if (made.kind == grammar_.cut) grammar_.cuts = true;
      std::uint64_t& count = occurrences.try_emplace(std::string(module.symbol), 0).first->second;
      made.place = key_at(hash_of(module.symbol), count++);
      grammar_.templates.push_back(made);
    }
    check_brackets(source, slice);
    range.count = static_cast<std::uint32_t>(grammar_.templates.size()) - range.first;
    return range;
  }

  /// [ and ] must pair inside every word; { and } need not (leaves of the book open them in one branch and
  /// close in another).
  void check_brackets(Source& source, Slice slice) {
    std::vector<std::size_t> open;
    int depth = 0;
    for (std::size_t i = slice.from; i < slice.to; ++i) {
      const char c = source.text[i];
      if (c == '(') ++depth;
      if (c == ')') --depth;
      if (depth > 0) continue;
      if (c == '@') {
        ++i;
      } else if (c == '[') {
        open.push_back(i);
      } else if (c == ']') {
        if (open.empty()) {
          source.faults.push_back({i, "found `]` without a `[` before it"});
        } else {
          open.pop_back();
        }
      }
    }
    if (!open.empty()) source.faults.push_back({open.back(), "found `[` without its `]`"});
    if (open.size() > limits_.bracket_depth) {
      source.faults.push_back(
          {open.back(), "brackets nest deeper than " + std::to_string(limits_.bracket_depth)});
    }
  }

  void read_axiom() {
    Source source{params_.axiom, "/axiom", {}};
    grammar_.axiom = word(source, {0, source.text.size()});
    take_faults(source);
  }

  void read_rules(const std::string& folder, const std::vector<std::string>& texts, Rules& rules) {
    for (std::size_t i = 0; i < texts.size(); ++i) {
      Source source{texts[i], folder + std::to_string(i), {}};
      const WrittenProduction written = read_production(source.text, source.faults);
      if (source.faults.empty()) rules.productions.push_back(production(source, written));
      take_faults(source);
    }
  }

  Production production(Source& source, const WrittenProduction& written) {
    names_.forget_after(constant_count_);
    Production made;
    made.pointer = source.pointer;
    std::uint32_t slots = 0;
    const std::vector<WrittenModule> heads =
        read_modules(source.text, written.predecessor, symbols_, source.faults);
    if (heads.size() == 1) {
      check_symbol(heads[0], source);
      if (alphabet_constants_.count(heads[0].symbol)) {
        source.faults.push_back({heads[0].offset, "found `" + std::string(heads[0].symbol) +
                                                      "`, which the alphabet lists as a constant"});
      }
      made.predecessor = formal(source, heads[0], slots);
      if (made.predecessor == grammar_.open || made.predecessor == grammar_.close) {
        source.faults.push_back(
            {heads[0].offset, "found a bracket as predecessor; brackets cannot be rewritten"});
      }
    } else if (source.faults.empty()) {
      source.faults.push_back(
          {heads.empty() ? written.predecessor.from : heads[1].offset,
           "found " + std::to_string(heads.size()) + " modules; expected one predecessor"});
    }
    made.left = context(source, written.left, slots);
    std::reverse(made.left.begin(), made.left.end());
    for (KindId id : made.left) {
      if (id == grammar_.open || id == grammar_.close) {
        source.faults.push_back(
            {written.left.from, "found a bracket in a left context, which is a path without branches"});
        break;
      }
    }
    made.right = context(source, written.right, slots);
    check_brackets(source, written.right);
    if (written.has_condition && !is_star(source.text, written.condition)) {
      made.conditional = true;
      made.condition = expression(source, written.condition);
    }
    made.successor = word(source, written.successor);
    if (written.has_weight) read_weight(source, written, made);
    grammar_.most_slots = std::max(grammar_.most_slots, slots);
    return made;
  }

  static bool is_star(std::string_view text, Slice slice) {
    return erases(text, slice) &&
           text.substr(slice.from, slice.to - slice.from).find('*') != std::string_view::npos;
  }

  void read_weight(Source& source, const WrittenProduction& written, Production& made) {
    made.weighted = true;
    made.weight = expression(source, written.weight);
    if (made.weight.is_constant && !(made.weight.value >= 0 && std::isfinite(made.weight.value))) {
      source.faults.push_back({written.weight.from, "found a probability that is negative or not finite"});
    }
  }

  std::vector<KindId> context(Source& source, Slice slice, std::uint32_t& slots) {
    std::vector<KindId> kinds;
    for (const WrittenModule& module : read_modules(source.text, slice, symbols_, source.faults)) {
      check_symbol(module, source);
      kinds.push_back(formal(source, module, slots));
    }
    return kinds;
  }

  /// A module with formal parameters: binds each name to the next slot.
  KindId formal(Source& source, const WrittenModule& module, std::uint32_t& slots) {
    for (const Slice& argument : module.arguments) {
      const std::vector<lang::Token> tokens =
          lang::tokenize(source.text, argument.from, argument.to, source.faults);
      if (tokens.size() != 2 || tokens[0].kind != lang::TokenKind::name) {
        source.faults.push_back({argument.from, "found an expression; expected the name of a parameter"});
        ++slots;
        continue;
      }
      const lang::Names::Binding* before = names_.find(tokens[0].text);
      if (before && !before->is_constant) {
        source.faults.push_back(
            {tokens[0].offset, "the parameter `" + std::string(tokens[0].text) + "` is named twice"});
      }
      names_.bind_slot(std::string(tokens[0].text), slots++);
    }
    if (module.arguments.size() > most_parameters) {
      source.faults.push_back({module.offset, "found too many parameters; expected at most 64"});
      return grammar_.open;
    }
    return kind(module.symbol, static_cast<std::uint32_t>(module.arguments.size()));
  }

  void check_interpretation() {
    for (const Production& each : grammar_.interpretation.productions) {
      if (each.has_context()) {
        issues_.push_back(
            {each.pointer, "an interpretation rule takes no context: it is used on one module alone"});
      }
    }
  }

  /// Side by side by predecessor, with context before without, then as written.
  void order(Rules& rules) {
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
      rules.chance =
          rules.chance || each.weighted || rules.redraws[each.predecessor] || draws(each.successor);
    }
    if (&rules == &grammar_.productions) rules.chance = rules.chance || draws(grammar_.axiom);
    warn_of_weights(rules);
  }

  bool draws(Range successor) const {
    for (const Template& each : grammar_.successor(successor)) {
      for (std::uint32_t i = 0; i < grammar_.kinds[each.kind].arity; ++i) {
        if (grammar_.program.draws(grammar_.arguments[each.first_argument + i])) return true;
      }
    }
    return false;
  }

  /// Weights are normalised; a sum other than 1 is told, since it is mostly a slip.
  void warn_of_weights(const Rules& rules) {
    for (const Range& range : rules.of_kind) {
      double sum = 0;
      bool plain = range.count > 0;
      for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
        const Production& each = rules.productions[i];
        plain = plain && each.weighted && each.weight.is_constant && !each.conditional && !each.has_context();
        sum += each.weight.value;
      }
      if (!plain || std::abs(sum - 1) <= 1e-6) continue;
      const Production& first = rules.productions[range.first];
      grammar_.warnings.push_back({first.pointer, "the probabilities of the productions of `" +
                                                      grammar_.kinds[first.predecessor].symbol +
                                                      "` do not sum to 1; they are used as weights"});
    }
  }

  const LsystemParams& params_;
  const Limits& limits_;
  std::vector<Issue>& issues_;
  lang::Names names_;  ///< the constants, and behind them the parameters of the production that is read
  std::size_t constant_count_ = 0;
  std::set<std::string, std::less<>> ignored_, variables_, alphabet_constants_;
  Symbols symbols_;
  std::map<std::pair<std::string, std::uint32_t>, KindId> ids_;
  Grammar grammar_;
};

void check_age(const LsystemParams& params, std::vector<Issue>& issues) {
  if (params.timed && params.constants.contains("age")) {
    issues.push_back({"/constants/age", "`age` is the age of the plant where `timed` is set"});
  }
  if (!params.age || params.timed || *params.age <= static_cast<double>(params.iterations)) return;
  issues.push_back({"/age", "found an age of " + std::to_string(*params.age) + "; the plant is derived for " +
                                std::to_string(params.iterations) + " iterations"});
}

}  // namespace

Grammar compile(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                std::vector<Issue>& issues) {
  if (params.iterations > static_cast<std::int64_t>(limits.iterations)) {
    issues.push_back({"/iterations", "found " + std::to_string(params.iterations) + "; the limit is " +
                                         std::to_string(limits.iterations)});
  }
  check_age(params, issues);
  return Compiler(params, seed, limits, issues).compile();
}

}  // namespace seedmesh::lsystem

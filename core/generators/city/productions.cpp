#include "core/generators/city/productions.h"

#include <algorithm>

#include "core/generators/lsystem/notation.h"
#include "core/lang/text_positions.h"

namespace seedmesh::city {
namespace {

using lsystem::Slice;

// Slots of the expressions of a production.
constexpr std::uint32_t own_slot = 0, left_slot = 3, right_slot = 6, delay_slot = 9, rule_slot = 12,
                        road_slot = 15, angle_slot = 18, length_slot = 19, slot_count = 20;
constexpr std::uint32_t most_parameters = 3;
/// Sites that wait at one time, of about 150 bytes each, and steps: those without a road, and more for each road that
/// was built.
constexpr std::size_t first_sites = 10'000, sites_a_road = 10;
constexpr std::uint64_t first_steps = 50'000, steps_a_road = 1'000;

/// Counts the roads that are built.
class CountedRules final : public RoadRules {
 public:
  explicit CountedRules(RoadRules& rules) : rules_(rules) {}
  GlobalGoals global_goals(double rule, double road, Rng key) override {
    return rules_.global_goals(rule, road, key);
  }
  RoadState local_constraints(double road) override {
    const RoadState state = rules_.local_constraints(road);
    built_ += state == RoadState::succeed ? 1 : 0;
    return state;
  }
  std::array<double, 2> measure(double road) const override { return rules_.measure(road); }
  std::uint64_t built() const { return built_; }

 private:
  RoadRules& rules_;
  std::uint64_t built_ = 0;
};

void bind_common(lang::Names& names) {
  names.bind_constant("UNASSIGNED", static_cast<double>(RoadState::unassigned));
  names.bind_constant("SUCCEED", static_cast<double>(RoadState::succeed));
  names.bind_constant("FAILED", static_cast<double>(RoadState::failed));
  for (std::uint32_t k = 0; k < 3; ++k) {
    names.bind_slot("pDel" + std::to_string(k), delay_slot + k);
    names.bind_slot("pRule" + std::to_string(k), rule_slot + k);
    names.bind_slot("pRoad" + std::to_string(k), road_slot + k);
  }
  names.bind_slot("angle", angle_slot);
  names.bind_slot("length", length_slot);
}

/// The number of parameters of a module, or 255 for a symbol that is none.
std::uint32_t arity_of(char symbol) {
  switch (symbol) {
    case 'R':
    case 'I':
      return 2;
    case 'B':
      return 3;
    case '+':
    case 'F':
      return 1;
    case '[':
    case ']':
      return 0;
    default:
      return 255;
  }
}

}  // namespace

/// Reads one production.
class StreetGrammar::Reader {
 public:
  Reader(const std::string& text, lang::Program& program, std::vector<lang::TextError>& errors)
      : text_(text), program_(program), errors_(errors) {
    bind_common(names_);
  }

  Production read() {
    Production production;
    const std::size_t label = lsystem::label_length(text_, symbols_);
    const lsystem::WrittenProduction written = lsystem::read_production(text_, errors_, label);
    if (!errors_.empty()) return production;
    production.predecessor = module(written.predecessor, own_slot, production.own);
    if (written.has_left) production.left = module(written.left, left_slot, production.left_count);
    if (written.has_right) production.right = module(written.right, right_slot, production.right_count);
    if (!written.new_left.empty() || !written.new_right.empty())
      add(written.predecessor.from,
          "found a context of the new word (<< or >>); street productions have none");
    if (!written.weight.empty()) add(written.weight.from, "street productions have no weights");
    statements(written.before, production);
    statements(written.after, production);
    if (written.has_condition && !written.condition.empty()) {
      production.has_condition = true;
      production.condition = expression(written.condition);
    }
    if (lsystem::erases(text_, written.successor)) return production;
    for (const lsystem::WrittenModule& each :
         lsystem::read_modules(text_, written.successor, symbols_, errors_))
      production.successor.push_back(made(each));
    check_brackets(production, written.successor.from);
    return production;
  }

 private:
  void add(std::size_t offset, std::string message, IssueKind kind = IssueKind::invalid_value) {
    errors_.push_back({offset, std::move(message), kind});
  }

  /// Reads a module of the left side, and binds the names of its parameters.
  char module(const Slice& slice, std::uint32_t first, std::uint32_t& count) {
    const auto modules = lsystem::read_modules(text_, slice, symbols_, errors_);
    if (modules.size() != 1) {
      add(slice.from, "found " + std::to_string(modules.size()) + " modules, expected one");
      return 0;
    }
    const char symbol = checked(modules[0]);
    if (symbol != 'R' && symbol != 'B' && symbol != 'I')
      add(modules[0].offset, "found `" + std::string(modules[0].symbol) + "`, expected R, B or I");
    for (const Slice& each : modules[0].arguments) {
      const auto tokens = lang::tokenize(text_, each.from, each.to, errors_);
      if (tokens.size() != 2 || tokens[0].kind != lang::TokenKind::name) {
        add(each.from, "expected the name of a parameter");
      } else if (count < most_parameters) {
        parameters_.emplace_back(tokens[0].text);
        names_.bind_slot(std::string(tokens[0].text), first + count++);
      }
    }
    return symbol;
  }

  /// The symbol of a module that has the right number of parameters.
  char checked(const lsystem::WrittenModule& each) {
    const char symbol = each.symbol.size() == 1 ? each.symbol[0] : '\0';
    const std::uint32_t arity = arity_of(symbol);
    if (arity == 255) {
      add(each.offset, "found `" + std::string(each.symbol) + "`, expected R, B, I, F, +, [ or ]",
          IssueKind::unknown_name);
    } else if (each.arguments.size() != arity) {
      add(each.offset, "found " + std::to_string(each.arguments.size()) + " parameters of " +
                           std::string(each.symbol) + ", expected " + std::to_string(arity));
    }
    return symbol;
  }

  MadeModule made(const lsystem::WrittenModule& each) {
    MadeModule module;
    module.symbol = checked(each);
    for (const Slice& argument : each.arguments) module.arguments.push_back(expression(argument));
    return module;
  }

  lang::Expression expression(const Slice& slice) {
    const auto tokens = lang::tokenize(text_, slice.from, slice.to, errors_);
    std::size_t at = 0;
    lang::Expression result = program_.parse(tokens, at, names_, errors_);
    if (tokens[at].kind != lang::TokenKind::end) {
      add(tokens[at].offset, "found " + lang::in_quotes(tokens[at]) + ", expected an operator or the end",
          IssueKind::syntax);
    }
    if (program_.draws(result))
      add(slice.from, "found a random function; street productions use no random numbers");
    return result;
  }

  /// `globalGoals(rule, road)` or `localConstraints(road)` between braces.
  void statements(const Slice& slice, Production& production) {
    if (slice.empty()) return;
    auto tokens = lang::tokenize(text_, slice.from, slice.to, errors_);
    if (tokens.size() < 2) return;
    std::size_t at = 2;
    const std::string_view name = tokens[0].text;
    if (!lang::is_symbol(tokens[1], "(")) {
      add(tokens[0].offset, "found " + lang::in_quotes(tokens[0]) +
                                ", expected globalGoals(rule, road) or localConstraints(road)");
      return;
    }
    if (name == "globalGoals") {
      production.asks_goals = true;
      production.goal_rule = program_.parse(tokens, at, names_, errors_);
      if (lang::is_symbol(tokens[at], ",")) ++at;
      production.goal_road = program_.parse(tokens, at, names_, errors_);
    } else if (name == "localConstraints") {
      production.asks_constraints = true;
      production.constraint_road = program_.parse(tokens, at, names_, errors_);
      if (production.predecessor != 'I')
        add(tokens[0].offset, "localConstraints sets the state of an I, found another predecessor");
    } else {
      add(tokens[0].offset,
          "found " + lang::in_quotes(tokens[0]) +
              ", expected globalGoals(rule, road) or localConstraints(road)",
          IssueKind::unknown_name);
      return;
    }
    if (!lang::is_symbol(tokens[at], ")"))
      add(tokens[at].offset, "found " + lang::in_quotes(tokens[at]) + ", expected `)`", IssueKind::syntax);
  }

  void check_brackets(const Production& production, std::size_t offset) {
    int depth = 0;
    for (const MadeModule& each : production.successor) {
      depth += each.symbol == '[' ? 1 : each.symbol == ']' ? -1 : 0;
      if (depth < 0 || depth > 1) break;
    }
    if (depth != 0) {
      add(offset, "found brackets that are nested or not balanced; expected pairs side by side",
          IssueKind::syntax);
    }
  }

  const std::string& text_;
  lang::Program& program_;
  std::vector<lang::TextError>& errors_;
  lsystem::Symbols symbols_;
  lang::Names names_;
  std::vector<std::string> parameters_;
};

StreetGrammar::StreetGrammar(const std::vector<std::string>& productions, const std::string& pointer,
                             std::vector<Issue>& issues) {
  for (std::size_t i = 0; i < productions.size(); ++i) {
    std::vector<lang::TextError> errors;
    productions_.push_back(Reader(productions[i], program_, errors).read());
    lang::add_issues(pointer + "/" + std::to_string(i), productions[i], errors, issues);
  }
}

const StreetGrammar::Production* StreetGrammar::matching(const Site& site, std::size_t at,
                                                         std::vector<double>& slots) const {
  const auto bind = [&slots](const Module& module, std::uint32_t first) {
    std::copy(module.value.begin(), module.value.end(), slots.begin() + first);
  };
  for (const Production& each : productions_) {
    if (each.predecessor != site.word[at].symbol) continue;
    if (each.left != 0) {
      if (at == 0 || site.word[at - 1].symbol != each.left) continue;
      bind(site.word[at - 1], left_slot);
    }
    if (each.right != 0) {
      if (at + 1 >= site.word.size() || site.word[at + 1].symbol != each.right) continue;
      bind(site.word[at + 1], right_slot);
    }
    bind(site.word[at], own_slot);
    Rng unused(0);
    if (!each.has_condition || program_.evaluate(each.condition, slots.data(), unused) != 0) return &each;
  }
  return nullptr;
}

void StreetGrammar::apply(const Production& production, const Site& site, std::vector<double>& slots,
                          RoadRules& rules, std::vector<Module>& made) const {
  Rng unused(0);
  const auto value = [&](const lang::Expression& expression) {
    return program_.evaluate(expression, slots.data(), unused);
  };
  if (production.asks_goals) {
    const double road = value(production.goal_road);
    const std::array<double, 2> measures = rules.measure(road);
    slots[angle_slot] = measures[0];
    slots[length_slot] = measures[1];
    const GlobalGoals goals = rules.global_goals(value(production.goal_rule), road, Rng(site.key));
    std::copy(goals.delay.begin(), goals.delay.end(), slots.begin() + delay_slot);
    std::copy(goals.rule.begin(), goals.rule.end(), slots.begin() + rule_slot);
    std::copy(goals.road.begin(), goals.road.end(), slots.begin() + road_slot);
  }
  if (production.asks_constraints)
    slots[own_slot + 1] = static_cast<double>(rules.local_constraints(value(production.constraint_road)));
  for (const MadeModule& each : production.successor) {
    Module module{each.symbol, {}};
    for (std::size_t k = 0; k < each.arguments.size(); ++k) module.value[k] = value(each.arguments[k]);
    made.push_back(module);
  }
}

void StreetGrammar::rewrite(const Site& site, RoadRules& rules, Sites& sites) const {
  std::vector<Module> made;
  std::vector<double> slots(slot_count, 0.0);
  for (std::size_t at = 0; at < site.word.size(); ++at) {
    if (const Production* production = matching(site, at, slots)) {
      apply(*production, site, slots, rules, made);
    } else {
      made.push_back(site.word[at]);
    }
  }
  // Branches and the rest of the word are continued separately. Their keys are made of their positions in the word.
  Site rest{site.step + 1, site.key, {}};
  for (std::size_t at = 0; at < made.size(); ++at) {
    const char symbol = made[at].symbol;
    if (symbol == 'B') {
      sites.push({site.step + 1, site.word.size() == 1 ? site.key : key_at(site.key, at), {made[at]}});
    } else if (symbol == '[') {
      Site branch{site.step + 1, key_at(site.key, at), {}};
      for (++at; at < made.size() && made[at].symbol != ']'; ++at) branch.word.push_back(made[at]);
      sites.push(std::move(branch));
    } else if (symbol == 'R' || symbol == 'I') {
      rest.word.push_back(made[at]);
    }
  }
  if (rest.word.empty()) return;
  const bool is_next_road = made.size() != site.word.size();
  if (is_next_road) rest.key = key_at(site.key, 0xF0);
  sites.push(std::move(rest));
}

std::optional<std::uint64_t> StreetGrammar::grow(const std::vector<Start>& starts, RoadRules& rules,
                                                 std::uint64_t most_steps, const Job& job) const {
  Sites sites;
  for (const Start& each : starts)
    sites.push({0, each.key, {{'R', {each.delay, each.rule, 0}}, {'I', {each.road, 0, 0}}}});
  CountedRules counted(rules);
  for (std::uint64_t done = 0; !sites.empty(); ++done) {
    if (done >= std::min(most_steps, first_steps + steps_a_road * counted.built())) return done;
    if (sites.size() > first_sites + sites_a_road * counted.built()) return done;
    if (done % 64 == 0) job.check();
    // A word of this length comes from productions that multiply without branches.
    constexpr std::size_t most_modules = 256;
    if (sites.top().word.size() > most_modules) return done;
    const Site site = sites.top();
    sites.pop();
    rewrite(site, counted, sites);
  }
  return std::nullopt;
}

}  // namespace seedmesh::city

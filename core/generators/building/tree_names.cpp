/// Names in expressions that are trees: values, functions, queries and component splits.
#include "core/generators/building/compile_values.h"
#include "core/generators/building/components.h"
#include "core/generators/building/parse_parts.h"
#include "core/generators/building/tree_parser.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building {

std::string TreeParser::dotted_name() {
  std::string dotted(here().text);
  ++at_;
  while (is(".") && p_.tokens.at(at_ + 1).kind == TokenKind::name && at_ + 1 < to_) {
    dotted += "." + std::string(p_.tokens.at(at_ + 1).text);
    at_ += 2;
  }
  return dotted;
}

std::vector<std::uint32_t> TreeParser::arguments(bool takes_words) {
  std::vector<std::uint32_t> out;
  if (!take("(")) return out;
  while (at_ < to_ && !is(")")) {
    const std::size_t begin = at_;
    std::uint32_t word = none;
    if (takes_words && here().kind == TokenKind::name && !is_known_name()) {
      const std::string dotted = dotted_name();
      const bool is_value = p_.names.find(dotted) != nullptr || find_value_function(dotted) != none;
      if (!is_value && (is(",") || is(")"))) {
        word = constant(begin, {0, p_.grammar.texts.id_of(dotted)});
      } else {
        at_ = begin;
      }
    }
    out.push_back(word != none ? word : value());
    if (!take(",")) break;
  }
  expect(")");
  return out;
}

bool TreeParser::is_known_name() const {
  const std::string_view text = here().text;
  return text == "true" || text == "false" || p_.functions.contains(text) || p_.names.find(text) != nullptr ||
         std::ranges::find(locals, text, [](const auto& each) { return std::string_view(each.first); }) !=
             locals.end();
}

std::uint32_t TreeParser::name() {
  const std::size_t begin = at_;
  const auto local = std::ranges::find(locals.rbegin(), locals.rend(), here().text,
                                       [](const auto& each) { return std::string_view(each.first); });
  if (local != locals.rend()) {
    ++at_;
    ValueNode out = node(Kind::local, begin);
    out.id = local->second;
    return add(out);
  }
  if (is_name("true") || is_name("false")) {
    ++at_;
    return constant(begin, {p_.tokens.is_name(begin, "true") ? 1.0 : 0.0, 0});
  }
  if (is_name("comp") && p_.tokens.is(at_ + 1, "(")) return components();
  const std::string dotted = dotted_name();
  if (const auto function = p_.functions.find(dotted); function != p_.functions.end())
    return user_function(begin, dotted);
  std::string lower = dotted;
  if (lower[0] >= 'A' && lower[0] <= 'Z' && lower.find('.') != std::string::npos)
    lower[0] = static_cast<char>(lower[0] - 'A' + 'a');
  for (const std::string& each : {dotted, lower}) {
    const lang::Names::Binding* const bound = p_.names.find(each);
    if (bound == nullptr || is("(")) continue;
    if (bound->is_constant) return constant(begin, {bound->value, 0});
    ValueNode out = node(Kind::slot, begin);
    out.id = bound->slot;
    return add(out);
  }
  if (std::uint32_t found = none; query(begin, lower, found)) return found;
  if (const std::uint32_t special = find_value_function(dotted); special != none)
    return special_function(begin, special);
  if (is("(") || dotted == "rand") {
    if (const std::uint32_t built_in = built_in_function(begin, dotted); built_in != none) return built_in;
  }
  if (std::uint32_t classes = 0; !is("(")) {
    std::uint8_t frame = 0;
    if (in_selector_ && read_selector(dotted, classes, frame)) {
      ValueNode out = node(Kind::selector, begin);
      out.id = classes;
      out.frame = frame;
      return add(out);
    }
  }
  if (p_.tokens.is_missing(dotted)) {
    arguments(false);
    return constant(begin, {0, 0});
  }
  add_error(p_, p_.tokens.at(begin),
            (is("(") ? "unknown function " : "unknown name ") + lang::in_quotes(dotted),
            IssueKind::unknown_name);
  at_ = to_;
  return 0;
}

std::uint32_t TreeParser::user_function(std::size_t begin, const std::string& name) {
  const RuleFunction& function = p_.functions.find(name)->second;
  const std::vector<std::uint32_t> given = arguments(false);
  if (given.size() != function.parameters.size()) {
    add_error(p_, p_.tokens.at(begin),
              lang::in_quotes(name) + " takes " + std::to_string(function.parameters.size()) +
                  " arguments, found " + std::to_string(given.size()));
  }
  ValueNode out = node(Kind::function, begin);
  const auto [found, is_new] =
      p_.function_trees.try_emplace(name, static_cast<std::uint32_t>(p_.grammar.functions.size()));
  out.id = found->second;
  if (is_new) {
    p_.grammar.functions.push_back({none, static_cast<std::uint32_t>(function.parameters.size())});
    std::vector<std::pair<std::string, std::uint32_t>> known;
    for (const std::string_view parameter : function.parameters)
      known.emplace_back(std::string(parameter), static_cast<std::uint32_t>(known.size()));
    const std::uint32_t root = function_body(function, 0, std::move(known));
    p_.grammar.functions[out.id].root = root;
  }
  return add(out, given);
}

/// The body of a function behind its first `done` values of with(...). Each further value is a parameter of a function
/// without a name, so that it is found once.
std::uint32_t TreeParser::function_body(const RuleFunction& function, std::size_t done,
                                        std::vector<std::pair<std::string, std::uint32_t>> known) {
  const bool is_last = done == function.locals.size();
  const std::size_t from = is_last ? function.from : function.locals[done].from;
  TreeParser body(p_, from, is_last ? function.to : function.locals[done].to);
  body.depth_ = depth_ + 1;
  body.locals = known;
  const std::uint32_t value = body.value();
  body.check_end();
  if (is_last) return value;
  std::vector<std::uint32_t> operands;
  for (const auto& [name, number] : known) {
    ValueNode argument = node(Kind::local, from);
    argument.id = number;
    operands.push_back(add(argument));
  }
  operands.push_back(value);
  known.emplace_back(std::string(function.locals[done].name), static_cast<std::uint32_t>(known.size()));
  ValueNode call = node(Kind::function, from);
  call.id = static_cast<std::uint32_t>(p_.grammar.functions.size());
  p_.grammar.functions.push_back({none, static_cast<std::uint32_t>(known.size())});
  const std::uint32_t root = function_body(function, done + 1, std::move(known));
  p_.grammar.functions[call.id].root = root;
  return add(call, operands);
}

std::uint32_t TreeParser::special_function(std::size_t begin, std::uint32_t number) {
  const ValueFunctionRow& row = value_function(number);
  const std::vector<std::uint32_t> given = arguments(true);
  const int count = static_cast<int>(given.size());
  if (count < row.least || count > row.most) {
    add_error(p_, p_.tokens.at(begin),
              lang::in_quotes(row.name) + " takes (" + std::string(row.parameters) + "), found " +
                  std::to_string(count) + " arguments");
  }
  if (row.name == "contextCount" || row.name == "minimumDistance" || row.name == "contextCompare") {
    const bool is_count = row.name != "minimumDistance";
    const Query::Kind kind = is_count ? Query::Kind::count : Query::Kind::distance;
    if (std::ranges::find(p_.grammar.queries, kind, &Query::kind) == p_.grammar.queries.end())
      p_.grammar.queries.push_back({kind, "", 0});
  }
  if (row.name == "comp.sel") p_.grammar.uses_selectors = true;
  p_.grammar.uses_tags |= row.name.ends_with("sTagged") || row.name.ends_with("ags");
  ValueNode out = node(Kind::special, begin);
  out.id = number;
  return add(out, given);
}

std::uint32_t TreeParser::built_in_function(std::size_t begin, const std::string& name) {
  const std::span<const lang::Function> rows = lang::functions();
  if (std::ranges::find(rows, name, &lang::Function::name) == rows.end()) return none;
  const std::vector<std::uint32_t> given = arguments(false);
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    if (rows[i].name != name || rows[i].arity != static_cast<int>(given.size())) continue;
    ValueNode out = node(Kind::call, begin);
    out.id = i;
    return add(out, given);
  }
  add_error(
      p_, p_.tokens.at(begin),
      lang::in_quotes(name) + " takes another number of arguments than " + std::to_string(given.size()));
  return 0;
}

bool TreeParser::query(std::size_t begin, const std::string& name, std::uint32_t& out) {
  constexpr std::pair<std::string_view, Query::Kind> kinds[] = {
      {"scope.occ", Query::Kind::occlusion},   {"shape.occ", Query::Kind::occlusion},
      {"scope.visible", Query::Kind::visible}, {"shape.visible", Query::Kind::visible},
      {"inside", Query::Kind::inside},         {"overlaps", Query::Kind::overlaps},
      {"touches", Query::Kind::touches}};
  const auto* const found =
      std::ranges::find(kinds, std::string_view(name), &std::pair<std::string_view, Query::Kind>::first);
  if (found == std::end(kinds) || !is("(")) return false;
  const std::size_t close = std::min(p_.tokens.partner(at_), to_);
  std::string target = "all";
  for (; at_ < close; ++at_) {
    if (here().kind == TokenKind::string) target = lang::string_value(here());
  }
  expect(")");
  ValueNode made = node(Kind::query, begin);
  made.id = query_index(p_, found->second, target);
  out = add(made);
  return true;
}

/// comp(fe){ front = 3 | all : 1 }
std::uint32_t TreeParser::components() {
  const std::size_t begin = at_;
  at_ += 2;
  ComponentValue made;
  made.kind = read_component(p_, here());
  ++at_;
  if (take(",")) ++at_;
  expect(")");
  if (!is("{")) {
    unexpected("`{` after comp(...)");
    return 0;
  }
  const std::size_t close = std::min(p_.tokens.partner(at_), to_);
  const std::size_t before = std::exchange(p_.at, at_ + 1);
  do {
    Part part = parse_selector(p_);
    // The bar ends a value, and is no operator here.
    std::size_t to = p_.at;
    while (to < close && !p_.tokens.is(to, "|")) {
      const bool opens = p_.tokens.is(to, "(") || p_.tokens.is(to, "[") || p_.tokens.is(to, "{");
      to = opens ? std::min(p_.tokens.partner(to) + 1, close) : to + 1;
    }
    part.size.value = compile_value(p_, p_.at, to);
    p_.at = to;
    made.parts.push_back(part);
  } while (p_.at < close && building::take(p_, "|"));
  at_ = p_.at;
  p_.at = before;
  expect("}");
  ValueNode out = node(Kind::components, begin);
  out.id = static_cast<std::uint32_t>(p_.grammar.component_values.size());
  p_.grammar.component_values.push_back(std::move(made));
  return add(out);
}

}  // namespace seedmesh::building

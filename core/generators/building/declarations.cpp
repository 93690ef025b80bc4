#include "core/generators/building/declarations.h"

#include <algorithm>
#include <optional>
#include <span>

#include "core/generators/building/compile_values.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr std::size_t most_attributes = 1'000;

/// Collects the values of with ( name := value  name := value ), whose first token is `i`.
void collect_locals(Parser& p, std::size_t i, RuleFunction& function) {
  const std::size_t close = p.tokens.partner(i - 1);
  while (i < close && begins_local(p, i)) {
    if (function.parameters.size() + function.locals.size() == most_parameters) {
      add_error(p, p.tokens.at(i), "found more than 32 parameters and values in one function");
      return;
    }
    LocalValue& local = function.locals.emplace_back();
    local.name = p.tokens.at(i).text;
    local.from = i + 3;
    local.to = local.from;
    while (local.to < close && !begins_local(p, local.to) && !p.tokens.is(local.to, ",") &&
           !p.tokens.is(local.to, ";")) {
      const bool opens =
          p.tokens.is(local.to, "(") || p.tokens.is(local.to, "[") || p.tokens.is(local.to, "{");
      local.to = opens ? p.tokens.partner(local.to) + 1 : local.to + 1;
    }
    i = p.tokens.is(local.to, ",") || p.tokens.is(local.to, ";") ? local.to + 1 : local.to;
  }
  if (i < close) {
    add_error(p, p.tokens.at(i),
              "found " + in_quotes(p.tokens.at(i)) + ", expected `name := value` or the end of with");
  }
}

/// The arguments or parameters in the brackets that open at token `open`.
std::size_t count_arguments(const Parser& p, std::size_t open) {
  const std::size_t close = p.tokens.partner(open);
  std::size_t count = close > open + 1 ? 1 : 0;
  for (std::size_t i = open + 1; i < close; ++i) {
    if (p.tokens.is(i, ",")) ++count;
    if (p.tokens.is(i, "(") || p.tokens.is(i, "[") || p.tokens.is(i, "{")) i = p.tokens.partner(i);
  }
  return count;
}

/// Functions of one name and several numbers of parameters get names of their own, such as `f/2`, here and where they
/// are called.
void separate_overloads(Parser& p) {
  std::map<std::string_view, std::vector<std::size_t>> counts;
  for (std::size_t i = 0; !p.tokens.is_end(i); ++i) {
    const bool has_brackets = p.tokens.is(i + 1, "(");
    if (p.tokens.at(i).kind == TokenKind::name && (has_brackets || p.tokens.is(i + 1, "=")) &&
        begins_statement(p, i) && !begins_rule(p, i) && p.tokens.is(behind_head(p, i), "=")) {
      std::vector<std::size_t>& all = counts[p.tokens.at(i).text];
      const std::size_t count = has_brackets ? count_arguments(p, i + 1) : 0;
      // One without brackets keeps its name, because only calls with brackets are renamed.
      if (std::ranges::find(all, count) == all.end())
        all.insert(has_brackets ? all.end() : all.begin(), count);
    }
    if (p.tokens.is(i, "{") || p.tokens.is(i, "[") || p.tokens.is(i, "(")) i = p.tokens.partner(i);
  }
  std::erase_if(counts, [](const auto& each) { return each.second.size() < 2; });
  if (counts.empty()) return;
  for (std::size_t i = 0; !p.tokens.is_end(i); ++i) {
    if (p.tokens.at(i).kind != TokenKind::name || !p.tokens.is(i + 1, "(")) continue;
    const auto found = counts.find(p.tokens.at(i).text);
    if (found == counts.end() || begins_rule(p, i)) continue;
    const std::size_t count = count_arguments(p, i + 1);
    const auto place = std::ranges::find(found->second, count);
    if (place == found->second.end() || place == found->second.begin()) continue;
    const std::string own = std::string(found->first) + "/" + std::to_string(count);
    p.tokens.rename(i, *p.made_texts.emplace(own).first);
  }
}

/// Collects `name = value`, `name(a, b) = value` or `attr name = value`. Returns the token behind it.
std::size_t collect_definition(Parser& p, std::size_t i, bool is_constant, bool is_attribute) {
  const Token& name = p.tokens.at(i);
  std::size_t body = i + 1;
  RuleFunction function;
  if (p.tokens.is(body, "(")) {
    const std::size_t close = p.tokens.partner(body);
    for (std::size_t k = body + 1; k < close; ++k) {
      if (p.tokens.at(k).kind != TokenKind::name) continue;
      if (function.parameters.size() == most_parameters) {
        add_error(p, p.tokens.at(k), "found more than 32 parameters in one function");
        break;
      }
      function.parameters.push_back(p.tokens.at(k).text);
    }
    body = close + 1;
    is_constant = is_attribute = false;
  }
  if (p.tokens.is_name(body, "with") && p.tokens.is(body + 1, "(")) {
    collect_locals(p, body + 2, function);
    body = p.tokens.partner(body + 1) + 1;
    is_constant = is_attribute = false;
  }
  if (!p.tokens.is(body, "=")) {
    add_error(p, p.tokens.at(body),
              "found " + in_quotes(p.tokens.at(body)) + ", expected `=` and a value for " + in_quotes(name));
    return body;
  }
  function.from = body + 1;
  function.to = end_of_value(p, body + 1);
  if (function.to == function.from) {
    add_error(p, p.tokens.at(body + 1), "found " + in_quotes(p.tokens.at(body + 1)) + ", expected a value");
    return body + 1;
  }
  const std::string key(name.text);
  if (p.declared.contains(key) || p.functions.contains(key)) {
    add_error(p, name, in_quotes(name) + " is declared twice", IssueKind::duplicate_key);
  } else if (is_attribute || is_constant) {
    p.declared.emplace(key, p.declarations.size());
    p.declarations.push_back({key, function.from, function.to, Progress::untouched, {}});
    Attribute attribute;
    attribute.name = key;
    attribute.is_constant = is_constant;
    attribute.offset = static_cast<std::uint32_t>(name.offset);
    p.grammar.attributes.push_back(std::move(attribute));
  } else {
    p.functions.emplace(key, function);
  }
  return function.to;
}

/// One argument of an annotation: name = value, or a value.
struct NoteArgument {
  std::string name;
  std::size_t token = 0;
  lang::TaggedValue value;
};

std::vector<NoteArgument> arguments_of(Parser& p, std::size_t note) {
  std::vector<NoteArgument> out;
  if (!p.tokens.is(note + 1, "(")) return out;
  const std::size_t close = p.tokens.partner(note + 1);
  for (std::size_t i = note + 2; i < close; ++i) {
    if (p.tokens.is(i, ",")) continue;
    NoteArgument& argument = out.emplace_back();
    if (p.tokens.is(i + 1, "=")) {
      argument.name = p.tokens.at(i).text;
      i += 2;
    }
    argument.token = i;
    double sign = 1;
    for (; i < close && !p.tokens.is(i, ","); ++i) {
      const Token& token = p.tokens.at(i);
      if (token.kind == TokenKind::number) argument.value = {sign * token.number, 0};
      if (token.kind == TokenKind::string)
        argument.value = {0, p.grammar.texts.id_of(lang::string_value(token))};
      if (token.kind == TokenKind::name) argument.value = {token.text == "true" ? 1.0 : 0.0, 0};
      sign = p.tokens.is(i, "-") ? -1 : 1;
    }
  }
  return out;
}

void read_range(Attribute& attribute, const std::vector<NoteArgument>& given) {
  std::vector<double> ends;
  std::optional<double> low, high;
  for (const NoteArgument& each : given) {
    if (each.name == "min") low = each.value.number;
    if (each.name == "max") high = each.value.number;
    if (each.name == "stepsize") attribute.step = each.value.number;
    if (each.name == "restricted") attribute.is_restricted = each.value.number != 0;
    if (each.name.empty()) ends.push_back(each.value.number);
  }
  if (ends.size() >= 2) {
    low = ends[0];
    high = ends[1];
  }
  if (ends.size() >= 3) attribute.step = ends[2];
  attribute.has_range = low && high;
  attribute.low = low.value_or(0);
  attribute.high = high.value_or(0);
}

/// @Range(1, 10) or @Range(min=1, max=10, stepsize=1, restricted=false), @Enum("a", "b", restricted=true), and what forms
/// show: @Group, @Order, @Hidden, @Description, @Color, @Angle and other units.
void read_annotations(Parser& p, Attribute& attribute, const std::vector<std::size_t>& notes) {
  constexpr std::string_view widgets[] = {"Color",     "Angle",  "Distance", "Percent", "File",
                                          "Directory", "Length", "Area",     "Volume"};
  constexpr std::string_view others[] = {"StartRule", "Handle",  "Out",   "InPath",    "OutPath",
                                         "Hidden",    "Private", "Error", "KeepScopes"};
  for (const std::size_t note : notes) {
    const Token& name = p.tokens.at(note);
    const std::vector<NoteArgument> given = arguments_of(p, note);
    // Before 2019, @Range("a", "b") and @Range(true, false) were lists of values.
    const bool is_list =
        name.text == "Range" && std::ranges::any_of(given, [&](const NoteArgument& each) {
          return each.name.empty() && (each.value.text != 0 || p.tokens.is_name(each.token, "true") ||
                                       p.tokens.is_name(each.token, "false"));
        });
    if (name.text == "Enum" || is_list) {
      for (const NoteArgument& each : given) {
        if (each.name == "restricted") {
          attribute.is_restricted = each.value.number != 0;
        } else if (each.name.empty()) {
          attribute.choices.push_back(each.value);
        }
      }
    } else if (name.text == "Range") {
      read_range(attribute, given);
    } else if (name.text == "Group" || name.text == "Description") {
      std::string text;
      for (const NoteArgument& each : given) {
        if (const std::string* found = p.grammar.texts.find(each.value.text))
          text += (text.empty() ? "" : " / ") + *found;
      }
      (name.text == "Group" ? attribute.group : attribute.description) = text;
    } else if (name.text == "Order") {
      attribute.order = given.empty() ? 0 : given[0].value.number;
    } else if (std::ranges::find(widgets, name.text) != std::end(widgets)) {
      attribute.widget = name.text;
    } else if (std::ranges::find(others, name.text) == std::end(others)) {
      add_warning(p, static_cast<std::uint32_t>(name.offset),
                  "the annotation " + in_quotes(name) + " is unknown and has no effect");
    }
    attribute.is_hidden |= name.text == "Hidden" || name.text == "Private";
  }
}

void compile_attribute(Parser& p, std::size_t index);

/// Compiles the attributes that tokens name, also those in the bodies of functions that they call. `attribute` is the
/// one that needs them; names in `hidden` are parameters.
void compile_needed(Parser& p, std::size_t attribute, std::size_t from, std::size_t to,
                    std::span<const std::string_view> hidden) {
  for (std::size_t i = from; i < to; ++i) {
    const Token& token = p.tokens.at(i);
    const bool is_member = i > from && p.tokens.is(i - 1, ".");
    if (token.kind != TokenKind::name || is_member || std::ranges::find(hidden, token.text) != hidden.end())
      continue;
    if (const auto found = p.declared.find(token.text); found != p.declared.end())
      compile_attribute(p, found->second);
    const auto called = p.functions.find(token.text);
    if (called == p.functions.end() || called->second.order == Progress::done) continue;
    RuleFunction& function = called->second;
    if (function.order == Progress::in_progress) {
      // A function may call itself, but no attribute may stand between.
      if (function.owner != attribute) {
        add_error(p, p.tokens.at(p.declarations[attribute].from),
                  "the value of `" + p.declarations[attribute].name + "` depends on itself",
                  IssueKind::evaluation);
      }
      continue;
    }
    function.order = Progress::in_progress;
    function.owner = attribute;
    std::vector<std::string_view> names = function.parameters;
    for (const LocalValue& each : function.locals) {
      compile_needed(p, attribute, each.from, each.to, names);
      names.push_back(each.name);
    }
    compile_needed(p, attribute, function.from, function.to, names);
    function.order = Progress::done;
  }
}

void compile_attribute(Parser& p, std::size_t index) {
  Declaration& declaration = p.declarations[index];
  if (declaration.state == Progress::done) return;
  if (p.depth > 200) {
    add_error(p, p.tokens.at(declaration.from),
              "found a chain of more than 200 attributes, each of which depends on the next");
    return;
  }
  if (declaration.state == Progress::in_progress) {
    add_error(p, p.tokens.at(declaration.from), "the value of `" + declaration.name + "` depends on itself",
              IssueKind::evaluation);
    return;
  }
  declaration.state = Progress::in_progress;
  ++p.depth;
  compile_needed(p, index, declaration.from, declaration.to, {});
  --p.depth;
  declaration.state = Progress::done;
  Attribute& attribute = p.grammar.attributes[index];
  attribute.value = compile_value(p, declaration.from, declaration.to);
  read_annotations(p, attribute, declaration.annotations);
  p.attribute_order.push_back(declaration.name);
}

}  // namespace

void collect_declarations(Parser& p) {
  separate_overloads(p);
  std::vector<std::size_t> notes;
  for (std::size_t i = 0; !p.tokens.is_end(i);) {
    const Token& token = p.tokens.at(i);
    if (p.tokens.is(i, "@") && p.tokens.at(i + 1).kind == TokenKind::name) {
      notes.push_back(i + 1);
      i += 2;
      if (p.tokens.is(i, "(")) i = p.tokens.partner(i) + 1;
      continue;
    }
    const bool declares = token.kind == TokenKind::name && (token.text == "attr" || token.text == "const") &&
                          p.tokens.at(i + 1).kind == TokenKind::name;
    if (declares) {
      const std::size_t before = p.declarations.size();
      i = collect_definition(p, i + 1, token.text == "const", token.text == "attr");
      if (p.declarations.size() > before) p.declarations.back().annotations = notes;
    } else if (token.kind == TokenKind::name && begins_statement(p, i) && !begins_rule(p, i) &&
               (p.tokens.is(i + 1, "=") || p.tokens.is(i + 1, "(") || p.tokens.is(behind_head(p, i), "="))) {
      i = collect_definition(p, i, false, false);
    } else {
      if (begins_rule(p, i)) {
        const std::uint32_t symbol = symbol_index(p, token.text, static_cast<std::uint32_t>(token.offset));
        p.symbols_with_rules.emplace(token.text);
        if (!p.tokens.start().empty() && token.text == p.tokens.start()) p.start = symbol;
        for (const std::size_t note : notes) {
          if (p.tokens.at(note).text == "StartRule" && p.tokens.is_main(note)) p.start = symbol;
        }
      }
      if (p.tokens.is(i, "{") || p.tokens.is(i, "(") || p.tokens.is(i, "[")) {
        // Nothing is declared inside brackets.
        i = std::max(p.tokens.partner(i), i);
      }
      ++i;
    }
    notes.clear();
  }
}

void compile_attributes(Parser& p) {
  if (p.declarations.size() > most_attributes)
    add_error(p, p.tokens.at(p.declarations[most_attributes].from), "found more than 1,000 attributes");
  p.grammar.first_attribute_slot = first_free_slot + most_queries;
  const std::vector<Attribute> declared = std::move(p.grammar.attributes);
  p.grammar.attributes.clear();
  for (std::size_t i = 0; i < declared.size(); ++i) {
    p.names.bind_slot(declared[i].name, p.grammar.first_attribute_slot + static_cast<std::uint32_t>(i));
  }
  // Values are evaluated in the order of p.grammar.attributes; slots stay in the order of declaration.
  std::vector<Attribute> kept = declared;
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i].slot = p.grammar.first_attribute_slot + static_cast<std::uint32_t>(i);
  p.grammar.attributes = std::move(kept);
  for (std::size_t i = 0; i < p.declarations.size(); ++i) compile_attribute(p, i);
  std::vector<Attribute> sorted;
  for (const std::string& name : p.attribute_order) {
    sorted.push_back(std::move(p.grammar.attributes[p.declared.find(name)->second]));
  }
  p.grammar.attributes = std::move(sorted);
  p.grammar.first_parameter_slot =
      p.grammar.first_attribute_slot + static_cast<std::uint32_t>(p.grammar.attributes.size());
}

}  // namespace seedmesh::building

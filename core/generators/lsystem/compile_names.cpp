/// Compiles what a grammar declares before its rules: modules, functions, the alphabet, and symbols that
/// contexts skip.
#include "core/generators/lsystem/compilation.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t longest_module_name = 64;

/// Keywords of statements cannot name a module.
bool is_keyword(std::string_view name) {
  return name == "for" || name == "while" || name == "if" || name == "else" || name == "let";
}

std::set<std::string, std::less<>> symbols_of(Compilation& c, const std::string& text, const char* pointer) {
  std::set<std::string, std::less<>> symbols;
  Source source(text, pointer);
  for (const WrittenModule& module :
       read_modules(source.text, {0, source.text.size()}, c.symbols, source.errors)) {
    symbols.insert(std::string(module.symbol));
  }
  take_errors(c, source);
  return symbols;
}

}  // namespace

/// Reads `name` or `name(parameter, ...)`, where a parameter is a name, "frame", or both.
void declare_modules(Compilation& c) {
  for (const CommandRow& row : commands()) {
    if (row.parameters == "(frame)") c.signatures.emplace(row.symbol, std::vector<std::uint8_t>{1});
    if (row.parameters == "(frame,object)") c.signatures.emplace(row.symbol, std::vector<std::uint8_t>{1, 0});
  }
  for (std::size_t i = 0; i < c.params.modules.size(); ++i) {
    Source source(c.params.modules[i], "/modules/" + std::to_string(i));
    const std::vector<lang::Token> tokens = lang::tokenize(source.text, 0, source.text.size(), source.errors);
    const auto add_error = [&](std::size_t at, const char* expected) {
      source.errors.push_back({tokens[at].offset, "expected " + std::string(expected) + ", found " +
                                                      lang::in_quotes(tokens[at])});
    };
    std::size_t at = 0;
    if (tokens[0].kind != lang::TokenKind::name) {
      add_error(0, "the name of a module");
    } else if (tokens[0].text.size() > longest_module_name) {
      source.errors.push_back({tokens[0].offset, "found a name of more than 64 characters"});
    } else if (is_keyword(tokens[0].text)) {
      source.errors.push_back({tokens[0].offset, lang::in_quotes(tokens[0]) + " begins a statement"});
    } else {
      std::vector<std::uint8_t> signature;
      const bool parameters = lang::is_symbol(tokens[++at], "(");
      bool sound = true;
      while (parameters && sound && !lang::is_symbol(tokens[at], ")")) {
        ++at;  // "(" or ","
        const bool frame = tokens[at].text == "frame";
        const std::size_t before = at;
        while (tokens[at].kind == lang::TokenKind::name && at < before + (frame ? 2 : 1)) ++at;
        signature.push_back(frame ? 1 : 0);
        sound = at > before && (lang::is_symbol(tokens[at], ",") || lang::is_symbol(tokens[at], ")"));
      }
      if (!sound) {
        add_error(at, "a parameter, `,` or `)`");
      } else if (tokens[at + (parameters ? 1 : 0)].kind != lang::TokenKind::end) {
        add_error(at + (parameters ? 1 : 0), "the end of the declaration");
      } else {
        c.symbols.declare(tokens[0].text);
        if (parameters) c.signatures.insert_or_assign(std::string(tokens[0].text), std::move(signature));
      }
    }
    take_errors(c, source);
  }
}

void define_functions(Compilation& c) {
  std::vector<Source> sources;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < c.params.functions.size(); ++i) {
    sources.emplace_back(c.params.functions[i], "/functions/" + std::to_string(i));
    lang::Names::Defined function;
    names.push_back(lang::read_definition(sources[i].text, function, sources[i].errors));
    function.is_valid = sources[i].errors.empty();
    if (!names[i].empty() && c.names.find_function(names[i]) != nullptr) {
      sources[i].errors.push_back(
          {0, "the function " + lang::in_quotes(names[i]) + " is defined twice", IssueKind::duplicate_key});
    } else {
      c.names.define(names[i], std::move(function));
    }
  }
  lang::Program tried;  // shared, so that all inlined functions count towards one limit
  // all functions are declared now, so that each body can be checked
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const lang::Names::Defined* function = c.names.find_function(names[i]);
    if (sources[i].errors.empty() && function != nullptr) {
      std::uint32_t slot = 0;
      for (const std::string& parameter : function->parameters) c.names.bind_slot(parameter, slot++);
      std::size_t at = 0;
      tried.parse(function->body, at, c.names, sources[i].errors, c.limits.expression_depth);
      if (sources[i].errors.empty() && function->body[at].kind != lang::TokenKind::end) {
        sources[i].errors.push_back(
            {function->body[at].offset, "found text after the end of the expression"});
      }
      c.names.forget_after(c.constant_count);
      if (!sources[i].errors.empty()) c.names.mark_invalid(names[i]);
    }
    take_errors(c, sources[i]);
  }
}

void mark_ignored(Compilation& c) {
  c.ignored = symbols_of(c, c.params.ignore, "/ignore");
  c.considered = symbols_of(c, c.params.consider, "/consider");
  if (!c.ignored.empty() && !c.considered.empty()) {
    c.issues.emplace_back(conflict_with({"ignore"}), "/consider",
                          "found both `consider` and `ignore`; expected one of them");
  }
}

void read_alphabet(Compilation& c) {
  if (!c.params.alphabet) return;
  c.variables = symbols_of(c, c.params.alphabet->variables, "/alphabet/variables");
  c.alphabet_constants = symbols_of(c, c.params.alphabet->constants, "/alphabet/constants");
}

void check_symbol(const Compilation& c, const WrittenModule& module, Source& source) {
  if (!lang::can_add_error(source.errors)) return;
  if (!c.params.alphabet || c.variables.count(module.symbol) || c.alphabet_constants.count(module.symbol))
    return;
  source.errors.push_back(
      {module.offset, "found `" + std::string(module.symbol) + "`, which is not in the alphabet"});
}

}  // namespace seedmesh::lsystem

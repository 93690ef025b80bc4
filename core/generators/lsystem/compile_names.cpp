/// Compiles what a grammar declares before its rules: modules, functions, the alphabet, and symbols that
/// contexts skip.
#include "core/generators/lsystem/compiler.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t longest_module_name = 64;

/// Keywords of statements cannot name a module.
bool is_keyword(std::string_view name) {
  return name == "for" || name == "while" || name == "if" || name == "else" || name == "let";
}

}  // namespace

/// Reads `name` or `name(parameter, ...)`, where a parameter is a name, "frame", or both.
void Compiler::declare_modules() {
  for (const CommandRow& row : commands()) {
    if (row.parameters == "(frame)") signatures_.emplace(row.symbol, std::vector<std::uint8_t>{1});
    if (row.parameters == "(frame,object)") signatures_.emplace(row.symbol, std::vector<std::uint8_t>{1, 0});
  }
  for (std::size_t i = 0; i < params_.modules.size(); ++i) {
    Source source(params_.modules[i], "/modules/" + std::to_string(i));
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
        symbols_.declare(tokens[0].text);
        if (parameters) signatures_.insert_or_assign(std::string(tokens[0].text), std::move(signature));
      }
    }
    take_errors(source);
  }
}

void Compiler::define_functions() {
  std::vector<Source> sources;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < params_.functions.size(); ++i) {
    sources.emplace_back(params_.functions[i], "/functions/" + std::to_string(i));
    lang::Names::Defined function;
    names.push_back(lang::read_definition(sources[i].text, function, sources[i].errors));
    function.is_valid = sources[i].errors.empty();
    if (!names[i].empty() && names_.find_function(names[i]) != nullptr) {
      sources[i].errors.push_back(
          {0, "the function " + lang::in_quotes(names[i]) + " is defined twice", IssueKind::duplicate_key});
    } else {
      names_.define(names[i], std::move(function));
    }
  }
  lang::Program tried;  // shared, so that all inlined functions count towards one limit
  // all functions are declared now, so that each body can be checked
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const lang::Names::Defined* function = names_.find_function(names[i]);
    if (sources[i].errors.empty() && function != nullptr) {
      std::uint32_t slot = 0;
      for (const std::string& parameter : function->parameters) names_.bind_slot(parameter, slot++);
      std::size_t at = 0;
      tried.parse(function->body, at, names_, sources[i].errors, limits_.expression_depth);
      if (sources[i].errors.empty() && function->body[at].kind != lang::TokenKind::end) {
        sources[i].errors.push_back(
            {function->body[at].offset, "found more after the end of the expression"});
      }
      names_.forget_after(constant_count_);
      if (!sources[i].errors.empty()) names_.mark_invalid(names[i]);
    }
    take_errors(sources[i]);
  }
}

std::set<std::string, std::less<>> Compiler::symbols_of(const std::string& text, const char* pointer) {
  std::set<std::string, std::less<>> symbols;
  Source source(text, pointer);
  for (const WrittenModule& module :
       read_modules(source.text, {0, source.text.size()}, symbols_, source.errors)) {
    symbols.insert(std::string(module.symbol));
  }
  take_errors(source);
  return symbols;
}

void Compiler::mark_ignored() {
  ignored_ = symbols_of(params_.ignore, "/ignore");
  considered_ = symbols_of(params_.consider, "/consider");
  if (!ignored_.empty() && !considered_.empty()) {
    issues_.push_back(
        {IssueKind::conflict, "/consider", "found both `consider` and `ignore`; expected one of them"});
  }
}

void Compiler::read_alphabet() {
  if (!params_.alphabet) return;
  variables_ = symbols_of(params_.alphabet->variables, "/alphabet/variables");
  alphabet_constants_ = symbols_of(params_.alphabet->constants, "/alphabet/constants");
}

void Compiler::check_symbol(const WrittenModule& module, Source& source) const {
  if (!lang::has_room(source.errors)) return;
  if (!params_.alphabet || variables_.count(module.symbol) || alphabet_constants_.count(module.symbol))
    return;
  source.errors.push_back(
      {module.offset, "found `" + std::string(module.symbol) + "`, which is not in the alphabet"});
}

}  // namespace seedmesh::lsystem

#include "core/generators/building/rule_statements.h"

#include <algorithm>
#include <map>

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

/// Whether a token still belongs to an expression, as `style` in `look = style`.
bool is_operand(const RuleTokens& file, std::size_t i) {
  constexpr std::string_view signs[] = {"=", ":", "==", "!=", "<", ">",  "<=", ">=", "+",
                                        "-", "*", "/",  "%",  ",", "&&", "||", "!"};
  if (i == 0) return false;
  const Token& before = file.at(i - 1);
  return (before.kind == TokenKind::symbol && std::ranges::find(signs, before.text) != std::end(signs)) ||
         is_name(before, "case");
}

/// The declaration that begins at token i, if one does.
Statement statement_at(const RuleTokens& file, std::size_t i) {
  Statement out;
  out.first = i;
  while (file.is(i, "@") && file.at(i + 1).kind == TokenKind::name) {
    out.has_start_note |= is_name(file.at(i + 1), "StartRule");
    i += 2;
    if (file.is(i, "(")) i = file.partner[i] + 1;
  }
  const bool names_next = file.at(i + 1).kind == TokenKind::name && !is_operand(file, i);
  const bool path_next = file.at(i + 1).kind == TokenKind::string && !is_operand(file, i);
  if ((names_next || path_next) && is_name(file.at(i), "import")) out.kind = Statement::Kind::import;
  if (names_next && is_name(file.at(i), "style")) out.kind = Statement::Kind::style;
  if (out.kind != Statement::Kind::other) {
    out.name = i + 1;
    return out;
  }
  if (names_next && (is_name(file.at(i), "attr") || is_name(file.at(i), "const"))) {
    out.kind = Statement::Kind::definition;
    out.name = i + 1;
    const bool is_attribute = file.at(i).text == "attr";
    i += 2;
    if (is_attribute && file.is(i, "=")) out.value = i + 1;
    return out;
  }
  out.is_start = names_next && is_name(file.at(i), "start");
  out.is_extension = names_next && is_name(file.at(i), "extension");
  if (out.is_start || out.is_extension) ++i;
  if (file.at(i).kind != TokenKind::name) return out;
  std::size_t behind = i + 1;
  while (touches(file, behind) && file.is(behind, ".") && touches(file, behind + 1) &&
         file.at(behind + 1).kind == TokenKind::name)
    behind += 2;
  const std::size_t name_end = behind;
  if (file.is(behind, "(")) behind = file.partner[behind] + 1;
  if (is_name(file.at(behind), "with") && file.is(behind + 1, "(")) behind = file.partner[behind + 1] + 1;
  out.name = i;
  out.name_end = name_end;
  if (file.is(behind, "=") && !out.is_foreign()) out.kind = Statement::Kind::definition;
  if (file.is(behind, "-->") || file.is(behind, "~>")) out.kind = Statement::Kind::rule;
  return out;
}

}  // namespace

bool is_name(const Token& token, std::string_view text) {
  return token.kind == TokenKind::name && token.text == text;
}

void match_brackets(RuleTokens& file) {
  file.partner.assign(file.tokens.size(), file.tokens.size() - 1);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < file.tokens.size(); ++i) {
    if (file.is(i, "(") || file.is(i, "[") || file.is(i, "{")) open.push_back(i);
    if ((file.is(i, ")") || file.is(i, "]") || file.is(i, "}")) && !open.empty()) {
      file.partner[open.back()] = i;
      open.pop_back();
    }
  }
}

RuleTokens read_tokens(std::string_view plain, const RuleText::Part& part,
                       std::vector<lang::TextError>& errors) {
  RuleTokens file;
  file.tokens = lang::tokenize(plain, part.first, part.first + part.count, errors);
  match_brackets(file);
  return file;
}

bool touches(const RuleTokens& file, std::size_t i) {
  return i > 0 && file.at(i).offset == file.at(i - 1).offset + file.at(i - 1).length;
}

std::vector<Statement> statements_of(const RuleTokens& file) {
  std::vector<Statement> out;
  for (std::size_t i = 0; i + 1 < file.tokens.size();) {
    Statement found = statement_at(file, i);
    const bool is_marked = file.is(i, "@") || is_name(file.at(i), "version");
    const bool begins_file = std::ranges::find(file.included, i) != file.included.end();
    if (found.kind != Statement::Kind::other || is_marked || begins_file || out.empty()) {
      if (!out.empty()) out.back().last = i;
      out.push_back(found);
    }
    const std::size_t name = found.kind == Statement::Kind::other ? i : found.name;
    i = std::max(i, name) + 1;
    if (found.kind == Statement::Kind::rule) i = std::max(i, found.name_end);
    if (file.is(i - 1, "(") || file.is(i - 1, "[") || file.is(i - 1, "{")) i = file.partner[i - 1] + 1;
    if (found.kind != Statement::Kind::other && file.is(i, "(")) i = file.partner[i] + 1;
  }
  if (!out.empty()) out.back().last = file.tokens.size() - 1;
  return out;
}

std::string included_path(const RuleTokens& file, const Statement& each) {
  if (each.kind != Statement::Kind::import) return {};
  if (file.at(each.name).kind == TokenKind::string) return lang::string_value(file.at(each.name));
  const bool is_path = file.is(each.name + 1, ".") && touches(file, each.name + 1) &&
                       touches(file, each.name + 2) && is_name(file.at(each.name + 2), "cga");
  return is_path ? std::string(file.at(each.name).text) + ".cga" : std::string();
}

void drop_replaced(const RuleTokens& file, std::vector<Statement>& statements) {
  if (file.included.empty()) return;
  std::map<std::string_view, std::ptrdiff_t> files;  // by name: the first file that declares it
  std::erase_if(statements, [&](const Statement& each) {
    if (each.kind != Statement::Kind::definition && each.kind != Statement::Kind::rule) return false;
    const auto own = std::ranges::upper_bound(file.included, each.first) - file.included.begin();
    return files.emplace(file.at(each.name).text, own).first->second < own;
  });
}

}  // namespace seedmesh::building

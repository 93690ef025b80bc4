#include "core/generators/building/load_files.h"

#include <algorithm>
#include <map>

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;
using Range = std::pair<std::size_t, std::size_t>;

constexpr int deepest_import = 16;
constexpr std::size_t most_instances = 200;  ///< of imported files

bool is_name(const Token& token, std::string_view text) {
  return token.kind == TokenKind::name && token.text == text;
}

/// A declaration of a file: an attribute, a constant, a function or a rule, with its annotations.
struct Statement {
  enum class Kind : std::uint8_t { definition, rule, import, style, other };
  Kind kind = Kind::other;
  std::size_t first = 0, last = 0;  ///< tokens
  std::size_t name = 0;             ///< token of its name
  std::size_t name_end = 0;         ///< behind its name, which has points if it replaces a rule of an import
  std::size_t value = 0;            ///< of an attribute: token of its value; 0 for other declarations
  bool is_start = false, is_extension = false;

  bool is_foreign() const { return name_end > name + 1; }  ///< a rule of an imported file
};

/// The tokens of one file, and how its brackets fit together.
struct File {
  std::vector<Token> tokens;
  std::vector<std::size_t> partner;

  const Token& at(std::size_t i) const { return tokens[std::min(i, tokens.size() - 1)]; }
  bool is(std::size_t i, std::string_view symbol) const { return lang::is_symbol(at(i), symbol); }
};

File read_file(std::string_view plain, const RuleText::Part& part, std::vector<lang::TextError>& faults) {
  File file;
  file.tokens = lang::tokenize(plain, part.first, part.first + part.count, faults);
  file.partner.assign(file.tokens.size(), file.tokens.size() - 1);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < file.tokens.size(); ++i) {
    if (file.is(i, "(") || file.is(i, "[") || file.is(i, "{")) open.push_back(i);
    if ((file.is(i, ")") || file.is(i, "]") || file.is(i, "}")) && !open.empty()) {
      file.partner[open.back()] = i;
      open.pop_back();
    }
  }
  return file;
}

/// Whether a token follows the one before it without a blank.
bool touches(const File& file, std::size_t i) {
  return i > 0 && file.at(i).offset == file.at(i - 1).offset + file.at(i - 1).length;
}

/// Whether a token still belongs to an expression, as `style` in `look = style`.
bool is_operand(const File& file, std::size_t i) {
  constexpr std::string_view signs[] = {"=", ":", "==", "!=", "<", ">",  "<=", ">=", "+",
                                        "-", "*", "/",  "%",  ",", "&&", "||", "!"};
  if (i == 0) return false;
  const Token& before = file.at(i - 1);
  return (before.kind == TokenKind::symbol && std::ranges::find(signs, before.text) != std::end(signs)) ||
         is_name(before, "case");
}

/// The declaration that begins at token i, if one does.
Statement statement_at(const File& file, std::size_t i) {
  Statement out;
  out.first = i;
  while (file.is(i, "@") && file.at(i + 1).kind == TokenKind::name) {
    i += 2;
    if (file.is(i, "(")) i = file.partner[i] + 1;
  }
  const bool names_next = file.at(i + 1).kind == TokenKind::name && !is_operand(file, i);
  if (names_next && is_name(file.at(i), "import")) out.kind = Statement::Kind::import;
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

std::vector<Statement> statements_of(const File& file) {
  std::vector<Statement> out;
  for (std::size_t i = 0; i + 1 < file.tokens.size();) {
    Statement found = statement_at(file, i);
    const bool is_marked = file.is(i, "@") || is_name(file.at(i), "version");
    if (found.kind != Statement::Kind::other || is_marked || out.empty()) {
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

/// What an import says about attributes and rules of the imported file.
struct Overrides {
  std::map<std::string, std::vector<Token>, std::less<>>
      values;                                ///< of attributes, as the importing file reads them
  std::set<std::string, std::less<>> rules;  ///< redefined
};

class Loader {
 public:
  Loader(const RuleText& files, std::string_view plain, std::string_view style,
         std::vector<lang::TextError>& faults)
      : files_(files), plain_(plain), style_(style), faults_(faults) {}

  void load(const RuleText::Part& part, const std::string& prefix, const Overrides& overrides, int depth) {
    File file = read_file(plain_, part, faults_);
    const std::vector<Statement> all = statements_of(file);
    const std::vector<Statement> statements =
        in_style(file, all, prefix.empty() ? style_ : std::string_view());
    Names names;
    names.prefix = prefix;
    for (const Statement& each : all) {
      if (each.kind == Statement::Kind::import) {
        names.aliases.emplace(file.at(each.name).text);
      } else if ((each.kind == Statement::Kind::definition || each.kind == Statement::Kind::rule) &&
                 !each.is_foreign()) {
        names.own.emplace(file.at(each.name).text);
      }
      if (each.is_start) names.start = file.at(each.name).text;
    }
    if (prefix.empty()) out.start = names.start;
    starts_[prefix] = names.start;
    for (const Statement& each : statements) {
      if (each.kind == Statement::Kind::style || each.kind == Statement::Kind::import) continue;
      copy(file, each, names, overrides);
    }
    const Token end = file.tokens.back();
    for (const Statement& each : statements) {
      if (each.kind == Statement::Kind::import) load_import(file, each, names, statements, overrides, depth);
    }
    if (prefix.empty()) out.tokens.push_back(end);
  }

  LoadedTokens out;

 private:
  struct Names {
    std::string prefix, start;
    std::set<std::string, std::less<>> own, aliases;
  };

  Token renamed(Token token, const std::string& text) {
    token.text = *out.texts.emplace(text).first;
    return token;
  }

  /// The name of a rule of an imported file, with the names of the imports.
  static std::string dotted(const File& file, const Statement& each) {
    std::string text;
    for (std::size_t i = each.name; i < each.name_end; ++i) text += file.at(i).text;
    return text;
  }

  /// The declarations of a style: those before the first style, and those of the style itself, which replace them.
  static std::vector<Statement> in_style(const File& file, const std::vector<Statement>& all,
                                         std::string_view style) {
    std::vector<Statement> base, own;
    std::set<std::string_view> replaced;
    std::string_view current = "Default";
    for (const Statement& each : all) {
      if (each.kind == Statement::Kind::style) {
        current = file.at(each.name).text;
      } else if (current == "Default") {
        base.push_back(each);
      } else if (current == style) {
        own.push_back(each);
        if (each.kind != Statement::Kind::other) replaced.insert(file.at(each.name).text);
      }
    }
    std::erase_if(base, [&](const Statement& each) {
      return (each.kind == Statement::Kind::definition || each.kind == Statement::Kind::rule) &&
             !each.is_foreign() && replaced.contains(file.at(each.name).text);
    });
    base.insert(base.end(), own.begin(), own.end());
    return base;
  }

  /// Appends tokens, with names of the file and of what it imports in their full form.
  void append(const File& file, Range range, const Names& names, std::vector<Token>& to) {
    for (std::size_t i = range.first; i < range.second; ++i) {
      const Token& token = file.tokens[i];
      if (to.size() > lang::max_tokens) return;
      const bool is_member = i > 0 && file.is(i - 1, ".") && touches(file, i - 1) && touches(file, i);
      if (token.kind != TokenKind::name || is_member) {
        to.push_back(token);
        continue;
      }
      if (names.aliases.contains(token.text) && file.is(i + 1, ".") &&
          file.at(i + 2).kind == TokenKind::name) {
        std::string text = names.prefix;
        std::size_t k = i;
        text += token.text;
        while (file.is(k + 1, ".") && file.at(k + 2).kind == TokenKind::name && touches(file, k + 1) &&
               touches(file, k + 2)) {
          text += "." + std::string(file.at(k + 2).text);
          k += 2;
        }
        Token merged = renamed(token, text);
        merged.length = file.at(k).offset + file.at(k).length - token.offset;
        to.push_back(merged);
        i = k;
      } else if (token.text == "start" && !names.start.empty() && !names.own.contains(token.text)) {
        to.push_back(renamed(token, names.prefix + names.start));
      } else if (!names.prefix.empty() && names.own.contains(token.text)) {
        to.push_back(renamed(token, names.prefix + std::string(token.text)));
      } else {
        to.push_back(token);
      }
    }
  }

  void copy(const File& file, const Statement& each, const Names& names, const Overrides& overrides) {
    const bool is_named = each.kind != Statement::Kind::other;
    const std::string_view name = is_named ? file.at(each.name).text : std::string_view();
    if (each.kind == Statement::Kind::rule &&
        overrides.rules.contains(each.is_foreign() ? dotted(file, each) : std::string(name)))
      return;
    const auto value = each.value != 0 ? overrides.values.find(name) : overrides.values.end();
    if (each.is_start || each.is_extension) {
      std::size_t keyword = each.first;
      while (!is_name(file.at(keyword), "start") && !is_name(file.at(keyword), "extension")) ++keyword;
      append(file, {each.first, keyword}, names, out.tokens);
      append(file, {each.name, each.last}, names, out.tokens);
    } else if (value != overrides.values.end()) {
      append(file, {each.first, each.value}, names, out.tokens);
      out.tokens.insert(out.tokens.end(), value->second.begin(), value->second.end());
    } else {
      append(file, {each.first, each.last}, names, out.tokens);
    }
  }

  /// import id ( styles ) : "file.cga" ( attributes, values and rules )
  void load_import(const File& file, const Statement& each, const Names& names,
                   const std::vector<Statement>& statements, const Overrides& outer, int depth) {
    out.has_imports = true;
    const Token& alias = file.at(each.name);
    std::size_t i = each.name + 1;
    if (file.is(i, "(")) i = file.partner[i] + 1;
    if (!file.is(i, ":") || file.at(i + 1).kind != TokenKind::string) {
      error(file.at(i), "found " + in_quotes(file.at(i)) + ", expected import name : \"file.cga\"");
      return;
    }
    const Token& path = file.at(i + 1);
    const std::string prefix = names.prefix + std::string(alias.text) + ".";
    const RuleText::Part* part = files_.find(lang::string_value(path));
    if (part == nullptr) {
      out.missing.push_back(prefix);
      out.warnings.push_back(
          {path.offset, "the request has no rule file " + lang::in_quotes(path.text) + "; rules of `" +
                            std::string(alias.text) +
                            "` are leaves, and its values are 0: give the file in \"rules\""});
      return;
    }
    if (depth >= deepest_import || ++instances_ > most_instances) {
      error(path, "rule files import each other more than 16 deep or 200 times, perhaps in a circle");
      return;
    }
    Overrides overrides;
    const bool has_list = file.is(i + 2, "(") && i + 2 < each.last;
    const bool keeps_all = has_list && file.partner[i + 2] == i + 3;
    std::set<std::string_view> kept;
    if (has_list) read_list(file, {i + 3, file.partner[i + 2]}, names, prefix, overrides, kept);
    if (!keeps_all) {
      for (const Statement& own : statements) {
        const std::string_view name = file.at(own.name).text;
        if (own.value == 0 || kept.contains(name) || overrides.values.contains(name)) continue;
        overrides.values[std::string(name)] = {renamed(file.at(own.name), names.prefix + std::string(name))};
      }
    }
    // `alias.Rule -->` replaces the rule, and so does such a rule of the files around this one.
    const std::string own_prefix = std::string(alias.text) + ".";
    for (const Statement& own : statements) {
      if (own.kind != Statement::Kind::rule || !own.is_foreign()) continue;
      const std::string name = dotted(file, own);
      if (name.starts_with(own_prefix)) overrides.rules.emplace(name.substr(own_prefix.size()));
    }
    for (const std::string& name : outer.rules) {
      if (name.starts_with(own_prefix)) overrides.rules.emplace(name.substr(own_prefix.size()));
    }
    load(*part, prefix, overrides, depth + 1);
    resolve_start(prefix);
  }

  /// attr = value, attr (kept as it is), Rule(a) --> operations
  void read_list(const File& file, Range range, const Names& names, const std::string& prefix,
                 Overrides& overrides, std::set<std::string_view>& kept) {
    for (std::size_t i = range.first; i < range.second;) {
      std::size_t end = i;
      while (end < range.second && !file.is(end, ",")) {
        const bool opens = file.is(end, "(") || file.is(end, "[") || file.is(end, "{");
        end = opens ? std::min(file.partner[end] + 1, range.second) : end + 1;
      }
      const Token& name = file.at(i);
      std::size_t behind = i + 1;
      if (file.is(behind, "(")) behind = file.partner[behind] + 1;
      if (name.kind != TokenKind::name) {
        error(name, "found " + in_quotes(name) + ", expected an attribute or an extension rule");
      } else if (file.is(i + 1, "=")) {
        append(file, {i + 2, end}, names, overrides.values[std::string(name.text)]);
      } else if (file.is(behind, "-->")) {
        overrides.rules.emplace(name.text);
        out.tokens.push_back(renamed(name, prefix + std::string(name.text)));
        append(file, {i + 1, end}, names, out.tokens);
      } else {
        kept.insert(name.text);
      }
      i = end + 1;
    }
  }

  /// `r.start` means the rule that the file marks with `start`.
  void resolve_start(const std::string& prefix) {
    const std::string& start = starts_[prefix];
    if (start.empty()) return;
    for (Token& token : out.tokens) {
      if (token.text == prefix + "start") token = renamed(token, prefix + start);
    }
  }

  void error(const Token& token, std::string message) {
    if (faults_.size() < lang::max_errors) faults_.push_back({token.offset, std::move(message)});
  }

  const RuleText& files_;
  std::string_view plain_, style_;
  std::vector<lang::TextError>& faults_;
  std::map<std::string, std::string> starts_;
  std::size_t instances_ = 0;
};

}  // namespace

LoadedTokens load_files(const RuleText& files, std::string_view plain, std::string_view style,
                        std::vector<lang::TextError>& faults) {
  const RuleText::Part& main = files.parts.front();
  LoadedTokens plain_tokens;
  plain_tokens.tokens = lang::tokenize(plain, main.first, main.first + main.count, faults);
  // Most rules have none of these words: their tokens stay as they are.
  const bool is_plain = std::ranges::none_of(plain_tokens.tokens, [](const Token& token) {
    return is_name(token, "import") || is_name(token, "style") || is_name(token, "start") ||
           is_name(token, "extension");
  });
  if (is_plain) return plain_tokens;
  std::vector<lang::TextError> again;  // the same errors of the main file, and those of the others
  Loader loader(files, plain, style, again);
  loader.load(main, "", {}, 0);
  for (lang::TextError& fault : again) {
    const auto is_same = [&](const lang::TextError& known) {
      return known.offset == fault.offset && known.message == fault.message;
    };
    if (faults.size() < lang::max_errors && std::ranges::none_of(faults, is_same))
      faults.push_back(std::move(fault));
  }
  return std::move(loader.out);
}

}  // namespace seedmesh::building

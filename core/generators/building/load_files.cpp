#include "core/generators/building/load_files.h"

#include <algorithm>
#include <map>

#include "core/generators/building/rule_statements.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;
using Range = std::pair<std::size_t, std::size_t>;

constexpr int deepest_import = 16;
constexpr std::size_t most_instances = 200;  ///< number of imported files

/// The settings of an import for attributes and rules of the imported file.
struct Overrides {
  std::map<std::string, std::vector<Token>, std::less<>>
      values;                                ///< of attributes, as the importing file reads them
  std::set<std::string, std::less<>> rules;  ///< redefined
};

class Loader {
 public:
  Loader(const RuleText& files, std::string_view plain, std::string_view style,
         std::vector<lang::TextError>& errors)
      : files_(files), plain_(plain), style_(style), errors_(errors) {}

  void load(const RuleText::Part& part, const std::string& prefix, const Overrides& overrides, int depth) {
    RuleTokens file = read_tokens(plain_, part, errors_);
    include_files(file, depth);
    std::vector<Statement> all = statements_of(file);
    drop_replaced(file, all);
    const std::vector<Statement> statements =
        in_style(file, all, prefix.empty() ? style_ : std::string_view());
    Names names;
    names.prefix = prefix;
    const bool has_own_start = std::ranges::any_of(all, [&](const Statement& each) {
      return file.is_own(each) && (each.is_start || each.has_start_note);
    });
    for (const Statement& each : all) {
      if (each.kind == Statement::Kind::import) {
        if (!included_path(file, each).empty()) continue;
        names.aliases.emplace(file.at(each.name).text);
      } else if ((each.kind == Statement::Kind::definition || each.kind == Statement::Kind::rule) &&
                 !each.is_foreign()) {
        names.own.emplace(file.at(each.name).text);
      }
      const bool is_included_start = !file.is_own(each) && (each.is_start || each.has_start_note);
      if ((each.is_start && file.is_own(each)) || (is_included_start && !has_own_start))
        names.start = file.at(each.name).text;
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

  /// Appends the tokens of files that are imported without a name.
  void include_files(RuleTokens& file, int depth) {
    for (const Statement& each : statements_of(file)) {
      const std::string path = included_path(file, each);
      if (path.empty()) continue;
      const Token& token = file.at(each.name);
      const RuleText::Part* const part = files_.find(path);
      if (part == nullptr) {
        warn(token, "the request has no rule file " + lang::in_quotes(path) + ": give it in \"rules\"");
        continue;
      }
      if (depth >= deepest_import || ++instances_ > most_instances) {
        error(token, "rule files import each other more than 16 deep or 200 times, perhaps in a cycle");
        return;
      }
      warn(token, "`import` has no name, so that the names of " + lang::in_quotes(path) + " get no prefix");
      RuleTokens other = read_tokens(plain_, *part, errors_);
      include_files(other, depth + 1);
      const std::size_t begin = file.tokens.size() - 1;
      file.included.push_back(begin);
      for (const std::size_t inner : other.included) file.included.push_back(begin + inner);
      file.tokens.insert(file.tokens.end() - 1, other.tokens.begin(), other.tokens.end() - 1);
      if (file.tokens.size() > lang::max_tokens) return error(token, "the rule files have too many words");
    }
    match_brackets(file);
  }

  Token renamed(Token token, const std::string& text) {
    token.text = *out.texts.emplace(text).first;
    return token;
  }

  /// The name of a rule of an imported file, with the names of the imports.
  static std::string dotted(const RuleTokens& file, const Statement& each) {
    std::string text;
    for (std::size_t i = each.name; i < each.name_end; ++i) text += file.at(i).text;
    return text;
  }

  /// The declarations of a style: those before the first style, and those of the style itself, which replace them.
  static std::vector<Statement> in_style(const RuleTokens& file, const std::vector<Statement>& all,
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
  void append(const RuleTokens& file, Range range, const Names& names, std::vector<Token>& to) {
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

  void copy(const RuleTokens& file, const Statement& each, const Names& names, const Overrides& overrides) {
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
  void load_import(const RuleTokens& file, const Statement& each, const Names& names,
                   const std::vector<Statement>& statements, const Overrides& outer, int depth) {
    out.has_imports = true;
    if (!included_path(file, each).empty()) return;
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
      error(path, "rule files import each other more than 16 deep or 200 times, perhaps in a cycle");
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
  void read_list(const RuleTokens& file, Range range, const Names& names, const std::string& prefix,
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

  void warn(const Token& token, std::string message) {
    if (out.warnings.size() < lang::max_errors) out.warnings.push_back({token.offset, std::move(message)});
  }

  void error(const Token& token, std::string message) {
    if (errors_.size() < lang::max_errors) errors_.push_back({token.offset, std::move(message)});
  }

  const RuleText& files_;
  std::string_view plain_, style_;
  std::vector<lang::TextError>& errors_;
  std::map<std::string, std::string> starts_;
  std::size_t instances_ = 0;
};

}  // namespace

LoadedTokens load_files(const RuleText& files, std::string_view plain, std::string_view style,
                        std::vector<lang::TextError>& errors) {
  const RuleText::Part& main = files.parts.front();
  LoadedTokens plain_tokens;
  plain_tokens.tokens = lang::tokenize(plain, main.first, main.first + main.count, errors);
  // Most rules have none of these words: their tokens stay as they are.
  const bool is_plain = std::ranges::none_of(plain_tokens.tokens, [](const Token& token) {
    return is_name(token, "import") || is_name(token, "style") || is_name(token, "start") ||
           is_name(token, "extension");
  });
  if (is_plain) return plain_tokens;
  std::vector<lang::TextError> again;  // the same errors of the main file, and those of the others
  Loader loader(files, plain, style, again);
  loader.load(main, "", {}, 0);
  for (lang::TextError& error : again) {
    const auto is_same = [&](const lang::TextError& known) {
      return known.offset == error.offset && known.message == error.message;
    };
    if (errors.size() < lang::max_errors && std::ranges::none_of(errors, is_same))
      errors.push_back(std::move(error));
  }
  return std::move(loader.out);
}

}  // namespace seedmesh::building

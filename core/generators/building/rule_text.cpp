#include "core/generators/building/rule_text.h"

#include <algorithm>
#include <set>

#include "core/base/json_pointer.h"
#include "core/lang/lexer.h"

namespace seedmesh::building {
namespace {

using lang::TokenKind;

/// Typographical signs of three bytes, and the same in the language with as many bytes.
constexpr std::pair<std::string_view, std::string_view> typographical_signs[] = {
    {"\u2265", ">= "}, {"\u2264", "<= "}, {"\u2260", "!= "}};

/// The name of a file without directories and without the ending.
std::string_view stem_of(std::string_view path) {
  if (const std::size_t slash = path.find_last_of("/\\"); slash != std::string_view::npos)
    path.remove_prefix(slash + 1);
  if (path.ends_with(".cga") || path.ends_with(".CGA")) path.remove_suffix(4);
  return path;
}

/// The declarations by which a file refers to the others.
struct FileNotes {
  std::vector<std::string> imports;  ///< paths
  std::set<std::string, std::less<>> rules;
  bool has_start = false;
};

FileNotes notes_of(std::string_view text) {
  FileNotes notes;
  std::vector<lang::TextError> ignored;  // the parser reports them
  const std::string plain = without_comments(text);
  const std::vector<lang::Token> tokens = lang::tokenize(plain, 0, plain.size(), ignored);
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const lang::Token& token = tokens[i];
    if (token.kind == TokenKind::name && token.text == "import") {
      // import file.cga, without a name and quotes
      if (i + 3 < tokens.size() && is_symbol(tokens[i + 2], ".") && tokens[i + 3].text == "cga") {
        notes.imports.emplace_back(tokens[i + 1].text);
        continue;
      }
      for (std::size_t k = i + 1; k < std::min(i + 40, tokens.size()); ++k) {
        if (tokens[k].kind == TokenKind::string) {
          notes.imports.push_back(lang::string_value(tokens[k]));
          break;
        }
      }
    }
    const bool is_named = token.kind == TokenKind::name;
    notes.has_start |= is_named && (token.text == "StartRule" ||
                                    (token.text == "start" && tokens[i + 1].kind == TokenKind::name));
    if (!is_named) continue;
    std::size_t k = i + 1;
    if (is_symbol(tokens[k], "(")) {
      while (k + 1 < tokens.size() && !is_symbol(tokens[k], ")")) ++k;
      ++k;
    }
    if (k < tokens.size() && (is_symbol(tokens[k], "-->") || is_symbol(tokens[k], "~>")))
      notes.rules.emplace(token.text);
  }
  return notes;
}

}  // namespace

std::string without_comments(std::string_view text, std::optional<std::size_t>* unclosed) {
  std::string out(text);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] == '"') {
      for (++i; i < out.size() && out[i] != '"' && out[i] != '\n'; ++i) i += out[i] == '\\' ? 1 : 0;
    } else if (out[i] == '#' || (out[i] == '/' && i + 1 < out.size() && out[i + 1] == '/')) {
      for (; i < out.size() && out[i] != '\n'; ++i) out[i] = ' ';
    } else if (out[i] == '/' && i + 1 < out.size() && out[i + 1] == '*') {
      const std::size_t found = out.find("*/", i + 2);
      if (found == std::string::npos && unclosed) *unclosed = i;
      const std::size_t end = std::min(found, out.size() - 1);
      for (const std::size_t last = std::min(end + 2, out.size()); i < last; ++i) {
        if (out[i] != '\n') out[i] = ' ';
      }
      --i;
    } else if (text.substr(i).starts_with("\xEF\xBB\xBF")) {
      out.replace(i, 3, 3, ' ');  // the byte order mark of a file
    } else if (out[i] == '\xE2') {
      for (const auto& [sign, meant] : typographical_signs) {
        if (text.substr(i).starts_with(sign)) out.replace(i, sign.size(), meant);
      }
    }
  }
  return out;
}

const RuleText::Part& RuleText::part_at(std::size_t offset) const {
  const Part* found = &parts.front();
  for (const Part& part : parts) {
    if (offset >= part.first) found = &part;
  }
  return *found;
}

const RuleText::Part* RuleText::find(std::string_view path) const {
  for (const Part& part : parts) {
    if (part.name == path) return &part;
  }
  for (const Part& part : parts) {
    if (!part.name.empty() && stem_of(part.name) == stem_of(path)) return &part;
  }
  return nullptr;
}

RuleText rule_text(std::string_view text) {
  RuleText out;
  out.text = text;
  out.parts.push_back({"", 0, text.size()});
  return out;
}

RuleText rule_text(const std::map<std::string, std::string>& files, std::string_view start,
                   std::vector<Issue>& issues) {
  std::vector<std::string_view> mains;
  std::map<std::string_view, FileNotes> notes;
  for (const auto& [name, text] : files) notes.emplace(name, notes_of(text));
  for (const auto& entry : notes) {
    const std::string_view name = entry.first;
    const bool is_imported = std::ranges::any_of(notes, [&](const auto& other) {
      return other.first != name && std::ranges::any_of(other.second.imports, [&](const std::string& path) {
               return stem_of(path) == stem_of(name);
             });
    });
    if (!is_imported) mains.push_back(name);
  }
  const auto keep_if = [&](auto&& matches) {
    if (mains.size() < 2) return;
    std::vector<std::string_view> kept;
    for (const std::string_view name : mains) {
      if (matches(notes.at(name))) kept.push_back(name);
    }
    if (!kept.empty()) mains = kept;
  };
  if (!start.empty()) keep_if([&](const FileNotes& own) { return own.rules.contains(start); });
  keep_if([](const FileNotes& own) { return own.has_start; });
  if (mains.size() != 1) {
    std::string names;
    for (const std::string_view name : mains) names.append(names.empty() ? "" : ", ").append(name);
    issues.emplace_back(
        conflict_with({"start"}), "/rules",
        mains.empty() ? "found files that all import each other, expected one that no other file imports"
                      : "found several files that no other file imports (" + names +
                            "), expected one; mark its start rule with @StartRule, or name it in \"start\"");
  }
  const std::string_view main = mains.empty() ? std::string_view(files.begin()->first) : mains.front();
  RuleText out;
  const auto add = [&](const std::string& name, const std::string& text) {
    out.parts.push_back({name, out.text.size(), text.size()});
    out.text += text;
    out.text += '\n';
  };
  add(std::string(main), files.at(std::string(main)));
  for (const auto& [name, text] : files) {
    if (name != main) add(name, text);
  }
  return out;
}

Issue issue_at(IssueKind kind, const RuleText& text, std::size_t offset, std::string message) {
  const RuleText::Part& part = text.part_at(offset);
  return seedmesh::issue_at(kind, part.name.empty() ? "/rules" : "/rules" + pointer_token(part.name),
                            text.text_of(part), std::min(offset - part.first, part.count),
                            std::move(message));
}

}  // namespace seedmesh::building

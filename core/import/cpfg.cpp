/// Reads L-system files of cpfg, after its grammar and manual (Virtual Laboratory, "CPFG Version 4.0 User's Manual"):
///
///   #define r 0.7
///   Lsystem: 1
///   derivation length: 5
///   ignore: +-
///   Axiom: A(1)
///   A(x) : x > 0.1 --> F(x)[+A(x*r)]A(x*r)       a line that begins with a blank continues the last one
///   decomposition | homomorphism [: no warnings] [maximum depth: 3] and their rules
///   endlsystem
#include <algorithm>
#include <cmath>

#include "core/generators/lsystem/constants.h"
#include "core/import/cpfg_include.h"
#include "core/import/cpfg_preprocessor.h"
#include "core/import/cpfg_reader.h"
#include "core/import/formats.h"

namespace seedmesh {
namespace {

// Rules are applied to their own results at most this number of times: while drawing, and while deriving.
constexpr double deepest_homomorphism = 1'000, deepest_decomposition = 1'000'000;

/// The depth of braces behind a text, from that before it.
std::ptrdiff_t depth_of_braces(std::ptrdiff_t depth, std::string_view text) {
  for (const char c : text) depth += c == '{' ? 1 : c == '}' && depth > 0 ? -1 : 0;
  return depth;
}

constexpr const char* blocks[] = {"start each", "starteach", "end each", "endeach", "start", "end", "define"};

}  // namespace

Imported CpfgReader::read() {
  preprocess_cpfg(source_, text_, macros_);
  macros_.sort();
  const std::vector<Line> lines = lines_of(text_);
  for (std::size_t i = 0; i < lines.size() && !ended_; ++i) {
    Line whole = trimmed(text_, lines[i]);
    if (whole.from == whole.to || is_cpfg_directive(text_, whole)) continue;
    if (has_block(whole)) {
      const std::size_t open = text_.find('{', whole.from);
      const std::size_t close = lsystem::closing(text_, std::min(open, text_.size() - 1), text_.size());
      while (i + 1 < lines.size() && (lines[i].to <= open || lines[i].to <= close)) ++i;
      whole.to = trimmed(text_, {whole.from, lines[i].to}).to;
    }
    // Braces of words and of lists of symbols need no partner.
    Line behind;
    const bool has_word = begins(whole, "axiom", behind) || begins(whole, "ignore", behind) ||
                          begins(whole, "consider", behind);
    std::ptrdiff_t depth = depth_of_braces(0, text(whole));
    for (bool arrow = has_cpfg_arrow(text(whole)); i + 1 < lines.size(); ++i) {
      // Statements before the arrow can have empty lines.
      if (!arrow && !has_word && depth > 0) {
        const std::string_view next = text(lines[i + 1]);
        depth = depth_of_braces(depth, next);
        arrow = has_cpfg_arrow(next);
        whole.to = std::max(whole.to, trimmed(text_, lines[i + 1]).to);
        continue;
      }
      if (!goes_on(lines[i + 1]) || (arrow && has_cpfg_arrow(text(lines[i + 1])))) break;
      arrow = arrow || has_cpfg_arrow(text(lines[i + 1]));
      depth = depth_of_braces(depth, text(lines[i + 1]));
      whole.to = trimmed(text_, lines[i + 1]).to;
    }
    if (!keyword(whole)) production(whole);
  }
  return made();
}

/// The line with its macros expanded and its parts joined.
TracedText CpfgReader::expanded(Line line) {
  TracedText out = macros_.expanded(TracedText(text_, line.from, line.to));
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] == '\n' || out[i] == '\r') out.replace(i, ' ');
  }
  return with_one_index(out);
}

TracedText CpfgReader::expression(Line line) {
  const TracedText whole = expanded(line);
  return words_.expression(whole, {0, whole.size()});
}

/// Whether the line begins with `key` in either case and a colon; `rest` is the text behind them.
bool CpfgReader::begins(Line line, std::string_view key, Line& rest) const {
  if (lower(text({line.from, std::min(line.from + key.size(), line.to)})) != key) return false;
  const Line behind = trimmed(text_, {line.from + key.size(), line.to});
  const bool colon = behind.from < behind.to && text_[behind.from] == ':';
  if (!colon && behind.from != behind.to) return false;
  rest = trimmed(text_, {behind.from + (colon ? 1 : 0), line.to});
  return true;
}

/// Whether the line begins a block in braces, whose lines need not begin with a blank.
bool CpfgReader::has_block(Line line) const {
  Line rest;
  for (const char* key : blocks) {
    if (begins(line, key, rest)) return rest.from == rest.to || text_[rest.from] == '{';
  }
  return false;
}

bool CpfgReader::keyword(Line line) {
  Line rest;
  for (const char* key : {"no warnings", "warnings", "verbose"}) {
    if (begins(line, key, rest)) return true;
  }
  const auto read = [&](void (CpfgReader::*use)(Line, double)) {
    const std::optional<double> value = number(expression(rest), rest.from);
    if (value) (this->*use)(rest, *value);
  };
  if (begins(line, "endlsystem", rest)) {
    ended_ = true;
  } else if (begins(line, "lsystem", rest) || begins(line, "ring lsystem", rest)) {
    if (lower(text_[line.from]) == 'r') {
      parameters_["ring"] = true;
    } else if (std::exchange(begun_, true)) {
      source_.report(line.from, "found a second L-system; a file can have only one");
      ended_ = true;
    }
  } else if (begins(line, "seed", rest)) {
    read(&CpfgReader::seed);
  } else if (begins(line, "derivation length", rest) || begins(line, "derivationlength", rest)) {
    if (length_.from < length_.to) source_.report(line.from, "found a second derivation length");
    length_ = rest;
  } else if (begins(line, "maximum depth", rest)) {
    read(&CpfgReader::depth);
  } else if (begins(line, "ignore", rest)) {
    symbols_["ignore"] = rest;
  } else if (begins(line, "consider", rest)) {
    symbols_["consider"] = rest;
  } else if (begins(line, "axiom", rest)) {
    axiom(rest);
  } else {
    return section(line, "homomorphism", Part::homomorphism) ||
           section(line, "decomposition", Part::decomposition) || block(line);
  }
  return true;
}

/// `Start: { ... }` and the other blocks of statements. What runs at the end has no effect on the word.
bool CpfgReader::block(Line line) {
  Line rest;
  const auto* const found = std::find_if(std::begin(blocks), std::end(blocks),
                                         [&](const char* key) { return begins(line, key, rest); });
  if (found == std::end(blocks)) return false;
  const TracedText whole = expanded(rest);
  if (whole.size() < 2 || whole[0] != '{' || whole[whole.size() - 1] != '}') {
    source_.report(rest.from, "expected `{ name = expression; ... }`");
    return true;
  }
  const TracedText inner = whole.part(1, whole.size() - 1);
  const std::string_view key = *found;
  if (key == "define") {
    define(inner);
  } else if (key == "end") {
    words_.warn_once(line.from, "End", "runs when all is drawn, and is left out");
  } else {
    (key == "start" ? start_ : key[0] == 's' ? start_each_ : end_each_) = inner;
  }
  return true;
}

/// homomorphism, homomorphism: or homomorphism: no warnings
bool CpfgReader::section(Line line, std::string_view key, Part part) {
  if (lower(text({line.from, std::min(line.from + key.size(), line.to)})) != key) return false;
  Line rest = trimmed(text_, {line.from + key.size(), line.to});
  if (rest.from < rest.to && text_[rest.from] == ':') rest = trimmed(text_, {rest.from + 1, rest.to});
  const std::string_view behind = text(rest);
  if (behind.find("-->") != std::string_view::npos) return false;
  if (!behind.empty() && behind != "warnings" && behind != "no warnings") {
    source_.report(rest.from, "found " + lang::in_quotes(behind) + "; expected `warnings` or `no warnings`");
  }
  part_ = part;
  return true;
}

/// The value of an expression over constants; nullopt after an error, which is reported. `at`: where the text begins.
std::optional<double> CpfgReader::number(const TracedText& body, std::size_t at) {
  if (body.size() == 0) {
    source_.report(at, "found no number");
    return std::nullopt;
  }
  std::vector<lang::TextError> errors;
  const std::vector<lang::Token> tokens = lang::tokenize(body.text(), 0, body.size(), errors);
  lang::Program program;
  std::size_t read = 0;
  const lang::Expression value = program.parse(tokens, read, constants(), errors);
  if (errors.empty() && tokens[read].kind != lang::TokenKind::end)
    errors.push_back({tokens[read].offset, "found text after the number"});
  for (const lang::TextError& error : errors)
    source_.report(body.origin(error.offset), error.message, error.kind);
  if (!errors.empty()) return std::nullopt;
  if (value.is_constant) return value.value;
  source_.report(at, "found a random value");
  return std::nullopt;
}

const lang::Names& CpfgReader::constants() {
  if (names_) return *names_;
  std::vector<lsystem::WrittenConstant> written;
  for (const auto& [name, value] : constants_) written.push_back({name, value});
  for (const CpfgMacros::Expression& each : macros_.constants()) written.push_back({each.name, each.text});
  std::vector<Issue> ignored;  // reported when the request is read
  names_ = lsystem::resolve_constants(written, Rng(0), ignored);
  return *names_;
}

void CpfgReader::seed(Line line, double value) {
  if (part_ != Part::derivation) {
    source_.warn(line.from, "this seed of a homomorphism is left out: all rules use one seed");
  } else if (value < 0 || value != std::floor(value) || value > 9e15) {
    source_.report(line.from, "expected a seed that is a whole number");
  } else if (out_.request.contains("seed")) {
    source_.report(line.from, "found a second seed");
  } else {
    out_.request["seed"] = static_cast<std::uint64_t>(value);
  }
}

void CpfgReader::depth(Line line, double value) {
  const bool homomorphism = part_ == Part::homomorphism;
  const double most = homomorphism ? deepest_homomorphism : deepest_decomposition;
  if (part_ == Part::derivation) {
    source_.report(line.from, "found a depth outside decomposition and homomorphism");
  } else if (!(value >= 1) || value != std::floor(value)) {
    source_.report(line.from, "expected a depth that is a whole number above 0");
  } else {
    if (value > most) {
      source_.warn(line.from, "the depth becomes " + number_text(most) + ", the greatest depth here");
    }
    parameters_[homomorphism ? "interpretation_depth" : "decomposition_depth"] =
        static_cast<int>(std::min(value, most));
  }
}

void CpfgReader::axiom(Line line) {
  if (std::exchange(has_axiom_, true)) source_.report(line.from, "found a second axiom");
  const std::size_t errors = source_.error_count();
  const TracedText whole = expanded(line);
  const TracedText word = words_.modules(whole, {0, whole.size()}, CpfgWords::Role::word);
  if (whole.size() == 0 && source_.error_count() == errors) source_.report(line.from, "found an empty axiom");
  put("axiom", word.text(), word.runs());
}

/// Whether a line continues the one before it: it begins with a blank.
bool CpfgReader::goes_on(Line next) const {
  const Line inner = trimmed(text_, next);
  return inner.from < inner.to && is_blank(text_[next.from]) && !is_cpfg_directive(text_, inner);
}

void CpfgReader::production(Line line) {
  const TracedText rule = expanded(line);
  if (rule.size() == 0) return;
  if (rules_[0].empty() && rules_[1].empty() && rules_[2].empty()) {
    for (const TracedText* const block : {&start_, &start_each_, &end_each_})
      statements_.share(cpfg_names_in(block->text()));
  }
  const auto contexts = part_ == Part::homomorphism ? CpfgContexts::ignored : CpfgContexts::used;
  std::optional<CpfgRule> read = read_cpfg_rule(rule, contexts, source_, words_, statements_);
  if (!read) return;
  if (read->is_strict && part_ != Part::derivation) {
    source_.warn(read->at,
                 "a rule of a decomposition or homomorphism rewrites one module here; this one with several "
                 "is left out");
    return;
  }
  rules_[static_cast<std::size_t>(part_)].push_back(std::move(*read));
}

Result<Imported> import_cpfg(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of cpfg contains one L-system"))
    return *std::move(error);
  if (const std::optional<OtherLanguage> other = other_language_of(text)) {
    ForeignText source(text);
    source.report(
        other->at,
        "this file is written in " + other->name +
            ", which is not supported; expected an L-system of cpfg, whose rules have the arrow `-->`",
        IssueKind::not_available);
    return source.finish({});
  }
  const JoinedText joined = with_cpfg_includes(text, options.files);
  ImportOptions rest = options;
  for (const std::string& name : joined.included) rest.files.erase(name);
  ForeignText source(joined.text, text, joined.parts);
  Imported imported = CpfgReader(source, cpfg_without_comments(source), rest).read();
  return source.finish(std::move(imported));
}

}  // namespace seedmesh

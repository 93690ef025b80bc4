/// L-system files of cpfg, as its lexer and manual have them (Virtual Laboratory, "CPFG Version 4.0 User's
/// Manual"):
///
///   #define r 0.7
///   Lsystem: 1
///   derivation length: 5
///   ignore: +-
///   Axiom: A(1)
///   A(x) : x > 0.1 --> F(x)[+A(x*r)]A(x*r)       a production may go on in lines that begin with a blank
///   decomposition | homomorphism [maximum depth: 3] and their rules
///   endlsystem
///
/// Macros that are expressions become constants and functions; others are replaced in the text.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/generators/lsystem/commands.h"
#include "core/generators/lsystem/constants.h"
#include "core/generators/lsystem/notation.h"
#include "core/import/cpfg_macros.h"
#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/lang/expression.h"

namespace seedmesh {
namespace {

using lsystem::Slice;

/// The text without comments and with lines joined where a backslash ends one; every byte keeps its place.
std::string without_comments(ForeignText& source) {
  const std::string_view text = source.text();
  std::string out(text);
  for (std::size_t i = 0; i + 1 < out.size(); ++i) {
    if (out[i] == '/' && out[i + 1] == '*') {
      const std::size_t end = std::min(text.find("*/", i + 2), text.size());
      if (end == text.size()) source.fault(i, "found a comment without its end; expected `*/`");
      for (const std::size_t stop = std::min(end + 2, text.size()); i < stop; ++i) {
        if (out[i] != '\n') out[i] = ' ';
      }
      --i;
    } else if (out[i] == '/' && out[i + 1] == '/') {
      for (; i < out.size() && out[i] != '\n'; ++i) out[i] = ' ';
    } else if (out[i] == '\\' && (out[i + 1] == '\n' || (out[i + 1] == '\r' && i + 2 < out.size()))) {
      const std::size_t newline = out[i + 1] == '\n' ? i + 1 : i + 2;
      if (out[newline] == '\n')
        std::fill(out.begin() + static_cast<std::ptrdiff_t>(i),
                  out.begin() + static_cast<std::ptrdiff_t>(newline) + 1, ' ');
    }
  }
  return out;
}

class CpfgReader {
 public:
  CpfgReader(ForeignText& source, std::string clean)
      : source_(source), text_(std::move(clean)), macros_(source) {}

  Imported read() {
    const std::vector<Line> lines = lines_of(text_);
    for (const Line& line : lines) {
      if (line.from < line.to && text_[line.from] == '#') macros_.define(text_, line);
    }
    macros_.sort();
    for (std::size_t i = 0; i < lines.size() && !ended_; ++i) {
      const Line line = trimmed(text_, lines[i]);
      if (line.from == line.to || text_[line.from] == '#') continue;
      if (keyword(line)) continue;
      Line whole = line;  // of a production
      while (i + 1 < lines.size() && goes_on(whole, lines[i + 1])) whole.to = trimmed(text_, lines[++i]).to;
      production(whole);
    }
    return made();
  }

 private:
  enum class Part { derivation, decomposition, homomorphism };
  std::string_view text(Line line) const {
    return std::string_view(text_).substr(line.from, line.to - line.from);
  }

  // --- lines

  /// What stands behind `key` and its colon where the line begins with them; keys may be in either case.
  bool begins(Line line, std::string_view key, Line& rest) const {
    if (lower(text({line.from, std::min(line.from + key.size(), line.to)})) != key) return false;
    const Line behind = trimmed(text_, {line.from + key.size(), line.to});
    const bool colon = behind.from < behind.to && text_[behind.from] == ':';
    const bool bare = behind.from == behind.to;
    if (!colon && !bare) return false;
    rest = trimmed(text_, {behind.from + (colon ? 1 : 0), line.to});
    return true;
  }

  bool keyword(Line line) {
    Line rest;
    for (const char* key : {"no warnings", "warnings", "verbose"}) {
      if (begins(line, key, rest)) return true;
    }
    if (begins(line, "endlsystem", rest)) {
      ended_ = true;
    } else if (begins(line, "lsystem", rest) || begins(line, "ring lsystem", rest)) {
      if (std::exchange(begun_, true)) {
        source_.fault(line.from, "found a second L-system; one without sub-L-systems is understood");
      }
      if (lower(text_[line.from]) == 'r') parameters_["ring"] = true;
    } else if (begins(line, "seed", rest)) {
      number(rest, [&](double value) { seed(rest, value); });
    } else if (begins(line, "derivation length", rest)) {
      length_ = rest;
    } else if (begins(line, "maximum depth", rest)) {
      number(rest, [&](double value) { depth(rest, value); });
    } else if (begins(line, "ignore", rest)) {
      symbols("ignore", rest);
    } else if (begins(line, "consider", rest)) {
      symbols("consider", rest);
    } else if (begins(line, "axiom", rest)) {
      axiom(rest);
    } else if (begins(line, "homomorphism", rest)) {
      section(Part::homomorphism, rest);
    } else if (begins(line, "decomposition", rest)) {
      section(Part::decomposition, rest);
    } else if (begins(line, "start", rest)) {
      start(rest);
    } else {
      return block_without_counterpart(line);
    }
    return true;
  }

  bool block_without_counterpart(Line line) {
    Line rest;
    for (const char* key : {"start each", "starteach", "end each", "endeach", "end", "define"}) {
      if (!begins(line, key, rest)) continue;
      source_.fault(line.from, "found statements that run between steps or files; they have no counterpart");
      return true;
    }
    return false;
  }

  void section(Part part, Line rest) {
    part_ = part;
    if (rest.from < rest.to)
      source_.warn(rest.from, "rules draw from streams of their own; their seed is left out");
  }

  template <class Use>
  void number(Line line, Use&& use) {
    lang::Names names = constants();
    const std::string body(text(line));
    std::vector<lang::Fault> faults;
    const std::vector<lang::Token> tokens = lang::tokenize(body, 0, body.size(), faults);
    lang::Program program;
    std::size_t at = 0;
    const lang::Expression value = program.parse(tokens, at, names, faults);
    if (faults.empty() && tokens[at].kind != lang::TokenKind::end)
      faults.push_back({tokens[at].offset, "found more after the number"});
    for (const lang::Fault& fault : faults) source_.fault(line.from + fault.offset, fault.message);
    if (faults.empty() && value.is_constant) use(value.value);
    if (faults.empty() && !value.is_constant)
      source_.fault(line.from, "found a value that is drawn at random");
  }

  lang::Names constants() const {
    std::vector<lsystem::WrittenConstant> written;
    for (const auto& [name, value] : constants_) written.push_back({name, value});
    for (const CpfgMacros::Expression& each : macros_.constants()) written.push_back({each.name, each.text});
    std::vector<Issue> ignored;  // told where the request is read
    return lsystem::resolve_constants(written, Rng(0), ignored);
  }

  void seed(Line line, double value) {
    if (value < 0 || value != std::floor(value) || value > 9e15) {
      source_.fault(line.from, "expected a seed that is a whole number");
    } else {
      out_.request["seed"] = static_cast<std::uint64_t>(value);
    }
  }

  void depth(Line line, double value) {
    const bool homomorphism = part_ == Part::homomorphism;
    const double most = homomorphism ? 10 : 32;
    if (part_ == Part::derivation) {
      source_.fault(line.from, "found a depth outside decomposition and homomorphism");
    } else if (!(value >= 1) || value != std::floor(value)) {
      source_.fault(line.from, "expected a depth that is a whole number above 0");
    } else {
      if (value > most) {
        source_.warn(line.from, "the depth is " + number_text(most) + " here, the most there is");
      }
      parameters_[homomorphism ? "interpretation_depth" : "decomposition_depth"] =
          static_cast<int>(std::min(value, most));
    }
  }

  void symbols(const char* name, Line line) {
    std::string list;
    for (const char c : text(line)) {
      if (!is_blank(c)) list += c;
    }
    parameters_[name] = list;
    out_.origins.push_back({std::string("/parameters/") + name, line.from, false});
  }

  void axiom(Line line) {
    bool changed = false;
    const std::string word = macros_.expanded(text(line), line.from, changed);
    if (parameters_.contains("axiom")) source_.fault(line.from, "found a second axiom");
    parameters_["axiom"] = word;
    judge_modules(line, word, {0, word.size()}, changed);
    out_.origins.push_back({"/parameters/axiom", line.from, !changed});
  }

  /// Start: { name = expression; ... } makes constants.
  void start(Line line) {
    if (line.to - line.from < 2 || text_[line.from] != '{' || text_[line.to - 1] != '}') {
      source_.fault(line.from, "expected `{ name = expression; ... }` in one line");
      return;
    }
    std::size_t from = line.from + 1;
    for (std::size_t at = from; at < line.to; ++at) {
      if (text_[at] != ';') continue;
      const Line one = trimmed(text_, {from, at});
      from = at + 1;
      std::size_t end = one.from;
      while (end < one.to && is_name_part(text_[end])) ++end;
      const Line equals = trimmed(text_, {end, one.to});
      if (end == one.from || equals.from == equals.to || text_[equals.from] != '=') {
        source_.fault(one.from, "expected an assignment such as `x = 2;`");
      } else if (!constants_.emplace(text({one.from, end}), text(trimmed(text_, {equals.from + 1, one.to})))
                      .second) {
        source_.fault(one.from, "found a second value of this name; a constant has one");
      }
    }
    if (trimmed(text_, {from, line.to - 1}).from + 1 < line.to)
      source_.fault(from, "found a statement without `;`");
  }

  bool has_arrow(Line line) const { return text(line).find("-->") != std::string_view::npos; }

  bool goes_on(Line whole, Line next) const {
    const Line inner = trimmed(text_, next);
    if (inner.from == inner.to || !is_blank(text_[next.from])) return false;
    return !has_arrow(whole) || !has_arrow(inner);
  }

  void production(Line line) {
    bool changed = false;
    std::string rule = macros_.expanded(text(line), line.from, changed);
    if (!source_.sound() && rule.empty()) return;
    const std::size_t arrow = rule.find("-->");
    if (arrow == std::string::npos) {
      source_.fault(line.from, "found no keyword and no production; expected `predecessor --> successor`");
      return;
    }
    // [H=] names the beginning of a branch, which is what [H] means here.
    for (std::size_t i = rule.find('>'); i < arrow; ++i) {
      if (rule[i] == ':') break;
      if (rule[i] == '=' && rule[i + 1] == ']') rule[i] = ' ';
    }
    std::replace(rule.begin(), rule.end(), '\n', ' ');
    std::replace(rule.begin(), rule.end(), '\r', ' ');
    std::vector<lang::Fault> faults;
    const lsystem::WrittenProduction written = lsystem::read_production(rule, faults);
    if (faults.empty()) judge_modules(line, rule, written.successor, changed);
    const char* names[] = {"productions", "decomposition", "interpretation"};
    const char* const name = names[static_cast<int>(part_)];
    Json& list = parameters_[name];
    if (list.is_null()) list = Json::array();
    out_.origins.push_back(
        {std::string("/parameters/") + name + "/" + std::to_string(list.size()), line.from, !changed});
    list.push_back(rule);
  }

  /// Symbols that mean something to cpfg and nothing, or something else, here.
  void judge_modules(Line line, const std::string& word, Slice slice, bool changed) {
    std::vector<lang::Fault> faults;
    const lsystem::Symbols symbols;
    for (const lsystem::WrittenModule& module : lsystem::read_modules(word, slice, symbols, faults)) {
      const std::size_t at = line.from + (changed ? 0 : module.offset);
      const std::string_view symbol = module.symbol;
      const auto arity = static_cast<std::uint32_t>(module.arguments.size());
      if (symbol == "$" || (symbol == "?" && arity > 0)) {
        source_.fault(at, "found a sub-L-system, which has no counterpart");
      } else if (symbol[0] == '@' && lsystem::command_of(symbol, arity) == lsystem::Command::none) {
        warn_once(at, symbol, " means something to cpfg and draws nothing here");
      } else if (symbol == "~") {
        warn_once(at, symbol, ": cpfg's surfaces stand in other files; nothing is drawn here");
      }
    }
  }

  void warn_once(std::size_t at, std::string_view symbol, const char* text) {
    if (warned_.insert(std::string(symbol)).second) source_.warn(at, lang::in_quotes(symbol) + text);
  }

  Imported made() {
    for (const CpfgMacros::Expression& each : macros_.constants()) {
      constants_.emplace(each.name, each.text);
      out_.origins.push_back({"/parameters/constants/" + each.name, each.at, false});
    }
    if (!parameters_.contains("axiom")) source_.fault(0, "found no axiom");
    if (length_.from == length_.to) {
      source_.fault(0, "found no derivation length");
    } else {
      number(length_, [&](double value) {
        if (!(value >= 0) || value != std::floor(value) || value > 1000) {
          source_.fault(length_.from, "expected a derivation length that is a whole number up to 1000");
        } else {
          parameters_["iterations"] = static_cast<int>(value);
        }
      });
    }
    for (const auto& [name, value] : constants_) parameters_["constants"][name] = value;
    for (const CpfgMacros::Expression& each : macros_.functions()) {
      Json& list = parameters_["functions"];
      if (list.is_null()) list = Json::array();
      out_.origins.push_back({"/parameters/functions/" + std::to_string(list.size()), each.at, false});
      list.push_back(each.text);
    }
    source_.warn(0, "angle, width and colours stand in cpfg's view file; they are the defaults here",
                 "/parameters");
    out_.request["generator"] = "lsystem";
    out_.request["parameters"] = std::move(parameters_);
    return std::move(out_);
  }

  ForeignText& source_;
  std::string text_;
  CpfgMacros macros_;
  std::map<std::string, std::string> constants_;
  std::set<std::string> warned_;
  Json parameters_ = Json::object();
  Imported out_;
  Line length_;
  Part part_ = Part::derivation;
  bool begun_ = false, ended_ = false;
};

}  // namespace

Result<Imported> import_cpfg(std::string_view text, const ImportOptions& options) {
  if (!options.entry.empty()) {
    return Error{Code::invalid, {{"/entry", "a file of cpfg holds one system; expected no entry"}}};
  }
  ForeignText source(text);
  Imported imported = CpfgReader(source, without_comments(source)).read();
  return source.finish(std::move(imported));
}

}  // namespace seedmesh

/// L-system files of cpfg, as its grammar and manual have them (Virtual Laboratory, "CPFG Version 4.0 User's
/// Manual"):
///
///   #define r 0.7
///   Lsystem: 1
///   derivation length: 5
///   ignore: +-
///   Axiom: A(1)
///   A(x) : x > 0.1 --> F(x)[+A(x*r)]A(x*r)       what goes on in the next line begins there with a blank
///   decomposition | homomorphism [: no warnings] [maximum depth: 3] and their rules
///   endlsystem
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/generators/lsystem/constants.h"
#include "core/import/cpfg_macros.h"
#include "core/import/cpfg_rules.h"
#include "core/import/cpfg_text.h"
#include "core/import/cpfg_words.h"
#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/lang/expression.h"

namespace seedmesh {
namespace {

class CpfgReader {
 public:
  CpfgReader(ForeignText& source, std::string clean)
      : source_(source), text_(std::move(clean)), macros_(source), words_(source) {}

  Imported read() {
    const std::vector<Line> lines = lines_of(text_);
    for (const Line& line : lines) {
      if (is_cpfg_directive(text_, trimmed(text_, line))) macros_.define(text_, line);
    }
    macros_.sort();
    for (std::size_t i = 0; i < lines.size() && !ended_; ++i) {
      Line whole = trimmed(text_, lines[i]);
      if (whole.from == whole.to || is_cpfg_directive(text_, whole)) continue;
      if (has_block(whole)) {
        const std::size_t open = text_.find('{', whole.from);
        const std::size_t close = lsystem::closing(text_, std::min(open, text_.size() - 1), text_.size());
        while (i + 1 < lines.size() && (lines[i].to <= open || lines[i].to <= close)) ++i;
        whole.to = trimmed(text_, {whole.from, lines[i].to}).to;
      }
      for (bool arrow = has_cpfg_arrow(text(whole)); i + 1 < lines.size(); ++i) {
        if (!goes_on(lines[i + 1]) || (arrow && has_cpfg_arrow(text(lines[i + 1])))) break;
        arrow = arrow || has_cpfg_arrow(text(lines[i + 1]));
        whole.to = trimmed(text_, lines[i + 1]).to;
      }
      if (!keyword(whole)) production(whole);
    }
    return made();
  }

 private:
  enum class Part { derivation, decomposition, homomorphism };
  std::string_view text(Line line) const {
    return std::string_view(text_).substr(line.from, line.to - line.from);
  }

  /// text_[line] with its macros pasted and its lines joined.
  TracedText expanded(Line line) {
    TracedText out = macros_.expanded(TracedText(text_, line.from, line.to));
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (out[i] == '\n' || out[i] == '\r') out.replace(i, ' ');
    }
    return out;
  }

  TracedText expression(Line line) {
    const TracedText whole = expanded(line);
    return words_.expression(whole, {0, whole.size()});
  }

  /// What stands behind `key` and its colon where the line begins with them; keys may be in either case.
  bool begins(Line line, std::string_view key, Line& rest) const {
    if (lower(text({line.from, std::min(line.from + key.size(), line.to)})) != key) return false;
    const Line behind = trimmed(text_, {line.from + key.size(), line.to});
    const bool colon = behind.from < behind.to && text_[behind.from] == ':';
    if (!colon && behind.from != behind.to) return false;
    rest = trimmed(text_, {behind.from + (colon ? 1 : 0), line.to});
    return true;
  }

  /// Keywords whose statements stand in braces, which may go on in lines that begin with no blank.
  bool has_block(Line line) const {
    Line rest;
    for (const char* key : {"start", "start each", "starteach", "end each", "endeach", "end", "define"}) {
      if (begins(line, key, rest)) return rest.from == rest.to || text_[rest.from] == '{';
    }
    return false;
  }

  bool keyword(Line line) {
    Line rest;
    for (const char* key : {"no warnings", "warnings", "verbose"}) {
      if (begins(line, key, rest)) return true;
    }
    if (begins(line, "endlsystem", rest)) {
      ended_ = true;
    } else if (begins(line, "lsystem", rest) || begins(line, "ring lsystem", rest)) {
      if (lower(text_[line.from]) == 'r') {
        parameters_["ring"] = true;
      } else if (std::exchange(begun_, true)) {
        source_.fault(line.from, "found a second L-system; one without sub-L-systems is understood");
        ended_ = true;
      }
    } else if (begins(line, "seed", rest)) {
      number(rest, [&](double value) { seed(rest, value); });
    } else if (begins(line, "derivation length", rest) || begins(line, "derivationlength", rest)) {
      if (length_.from < length_.to) source_.fault(line.from, "found a second derivation length");
      length_ = rest;
    } else if (begins(line, "maximum depth", rest)) {
      number(rest, [&](double value) { depth(rest, value); });
    } else if (begins(line, "ignore", rest)) {
      symbols_["ignore"] = rest;
    } else if (begins(line, "consider", rest)) {
      symbols_["consider"] = rest;
    } else if (begins(line, "axiom", rest)) {
      axiom(rest);
    } else if (section(line, "homomorphism", Part::homomorphism) ||
               section(line, "decomposition", Part::decomposition)) {
      return true;
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
      source_.fault(line.from, std::string_view(key) == "define"
                                   ? "found arrays, which have no counterpart"
                                   : "found statements that run between steps; they have no counterpart");
      return true;
    }
    return false;
  }

  /// homomorphism, homomorphism: or homomorphism: no warnings
  bool section(Line line, std::string_view key, Part part) {
    if (lower(text({line.from, std::min(line.from + key.size(), line.to)})) != key) return false;
    Line rest = trimmed(text_, {line.from + key.size(), line.to});
    if (rest.from < rest.to && text_[rest.from] == ':') rest = trimmed(text_, {rest.from + 1, rest.to});
    const std::string_view behind = text(rest);
    if (behind.find("-->") != std::string_view::npos) return false;
    if (!behind.empty() && behind != "warnings" && behind != "no warnings") {
      source_.fault(rest.from, "found " + lang::in_quotes(behind) + "; expected `warnings` or `no warnings`");
    }
    part_ = part;
    return true;
  }

  template <class Use>
  void number(Line line, Use&& use) {
    const TracedText body = expression(line);
    if (body.size() == 0) return source_.fault(line.from, "found no number");
    const lang::Names& names = constants();
    std::vector<lang::Fault> faults;
    const std::vector<lang::Token> tokens = lang::tokenize(body.text(), 0, body.size(), faults);
    lang::Program program;
    std::size_t at = 0;
    const lang::Expression value = program.parse(tokens, at, names, faults);
    if (faults.empty() && tokens[at].kind != lang::TokenKind::end)
      faults.push_back({tokens[at].offset, "found more after the number"});
    for (const lang::Fault& fault : faults) source_.fault(body.origin(fault.offset), fault.message);
    if (faults.empty() && value.is_constant) use(value.value);
    if (faults.empty() && !value.is_constant)
      source_.fault(line.from, "found a value that is drawn at random");
  }

  const lang::Names& constants() {
    if (names_) return *names_;
    std::vector<lsystem::WrittenConstant> written;
    for (const auto& [name, value] : constants_) written.push_back({name, value});
    for (const CpfgMacros::Expression& each : macros_.constants()) written.push_back({each.name, each.text});
    std::vector<Issue> ignored;  // told where the request is read
    names_ = lsystem::resolve_constants(written, Rng(0), ignored);
    return *names_;
  }

  void seed(Line line, double value) {
    if (part_ != Part::derivation) {
      source_.warn(line.from, "this seed of a homomorphism is left out: all rules draw from the one seed");
    } else if (value < 0 || value != std::floor(value) || value > 9e15) {
      source_.fault(line.from, "expected a seed that is a whole number");
    } else if (out_.request.contains("seed")) {
      source_.fault(line.from, "found a second seed");
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

  void axiom(Line line) {
    if (std::exchange(has_axiom_, true)) source_.fault(line.from, "found a second axiom");
    const std::size_t faults = source_.fault_count();
    const TracedText whole = expanded(line);
    const TracedText word = words_.modules(whole, {0, whole.size()}, CpfgWords::Place::word);
    if (whole.size() == 0 && source_.fault_count() == faults)
      source_.fault(line.from, "found an empty axiom");
    put("axiom", word.text(), word.runs());
  }

  void put(const std::string& name, Json value, std::vector<TextRun> runs) {
    out_.origins.push_back({"/parameters/" + name, std::move(runs)});
    parameters_[name] = std::move(value);
  }

  /// Start: { name = expression; ... } makes constants.
  void start(Line line) {
    names_.reset();
    if (line.to - line.from < 2 || text_[line.from] != '{' || text_[line.to - 1] != '}') {
      source_.fault(line.from, "expected `{ name = expression; ... }`");
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
        source_.fault(one.from, "expected an assignment such as `x = 2;`; others have no counterpart");
        continue;
      }
      const std::string name(text({one.from, end}));
      const TracedText value = expression(trimmed(text_, {equals.from + 1, one.to}));
      if (!constants_.emplace(name, value.text()).second)
        source_.fault(one.from, "found a second value of this name; a constant has one");
      out_.origins.push_back({"/parameters/constants/" + name, value.runs()});
    }
    const Line rest = trimmed(text_, {from, line.to - 1});
    if (rest.from < rest.to) source_.fault(rest.from, "found a statement without `;`");
  }

  /// What begins with a blank, up to the next arrow.
  bool goes_on(Line next) const {
    const Line inner = trimmed(text_, next);
    return inner.from < inner.to && is_blank(text_[next.from]) && !is_cpfg_directive(text_, inner);
  }

  void production(Line line) {
    const TracedText rule = expanded(line);
    if (rule.size() == 0) return;
    const auto contexts = part_ == Part::homomorphism ? CpfgContexts::passed_over : CpfgContexts::counted;
    std::optional<CpfgRule> read = read_cpfg_rule(rule, contexts, source_, words_);
    if (!read) return;
    check_assignments(*read);
    rules_[static_cast<std::size_t>(part_)].push_back(std::move(*read));
  }

  /// What Start sets is a constant here.
  void check_assignments(const CpfgRule& rule) {
    const std::string& condition = rule.condition.text();
    for (std::size_t at = 0; at < condition.size();) {
      std::size_t end = at;
      while (end < condition.size() && is_name_part(condition[end])) ++end;
      const std::size_t next = lsystem::skip_spaces(condition, end, condition.size());
      const bool assigns =
          end > at && next + 1 < condition.size() && condition[next] == '=' && condition[next + 1] != '=';
      if (assigns && constants_.count(condition.substr(at, end - at)) != 0)
        source_.fault(rule.condition.origin(at),
                      "found a new value of what `Start` sets, which is a constant here");
      at = std::max(end, at + 1);
    }
  }

  void put_rules() {
    static const char* const names[] = {"productions", "decomposition", "interpretation"};
    add_cpfg_rules_for_surfaces(rules_, words_);
    for (std::size_t part = 0; part < std::size(names); ++part) {
      for (const CpfgRule& rule : rules_[part]) {
        const auto other = words_.inside().find(rule.predecessor[0]);
        if (rule.is_for_one_letter() && other != words_.inside().end())
          words_.warn_once(rule.at, other->second,
                           "is one symbol here: the rule for " +
                               lang::in_quotes(std::string_view(rule.predecessor.text()).substr(0, 1)) +
                               " rewrites a part of it in cpfg alone");
        Json& list = parameters_[names[part]];
        if (list.is_null()) list = Json::array();
        const TracedText written = rule.written();
        out_.origins.push_back(
            {std::string("/parameters/") + names[part] + "/" + std::to_string(list.size()), written.runs()});
        list.push_back(written.text());
      }
    }
  }

  void put_surfaces() {
    for (const auto& [symbol, at] : words_.surfaces()) {
      const std::string name = CpfgWords::surface_name(symbol);
      parameters_["surfaces"][name] = {{"shape", "simple"}};
      source_.warn(at,
                   lang::in_quotes("~" + name) +
                       " is a surface of another file of cpfg's; a leaf of 1 m stands for it",
                   "/parameters/surfaces/" + name);
    }
  }

  void put_symbols() {
    for (const auto& [name, line] : symbols_) {
      const TracedText whole = expanded(line);
      if (name == "ignore" && whole.text().find_first_of("[]") != std::string::npos)
        source_.warn(line.from, "brackets count in contexts, also where they are ignored in cpfg");
      put(name, words_.listed(whole.text()), {{0, line.from, false}});
    }
  }

  Imported made() {
    put_rules();
    put_surfaces();
    put_symbols();
    for (const CpfgMacros::Expression& each : macros_.constants()) {
      TracedText text;
      text.write(each.text, each.at);
      constants_.emplace(each.name, words_.expression(text, {0, text.size()}).text());
      out_.origins.push_back({"/parameters/constants/" + each.name, {{0, each.at, false}}});
    }
    if (!has_axiom_) source_.fault(0, "found no axiom");
    if (length_.from == length_.to) {
      source_.fault(0, "found no derivation length");
    } else {
      number(length_, [&](double value) {
        if (!(value >= 0) || value != std::floor(value) || value > 1000) {
          source_.fault(length_.from, "expected a derivation length that is a whole number up to 1000");
        } else {
          put("iterations", static_cast<int>(value), {{0, length_.from, false}});
        }
      });
    }
    for (const auto& [name, value] : constants_) parameters_["constants"][name] = value;
    for (const CpfgMacros::Expression& each : macros_.functions()) {
      Json& list = parameters_["functions"];
      if (list.is_null()) list = Json::array();
      out_.origins.push_back({"/parameters/functions/" + std::to_string(list.size()), {{0, each.at, false}}});
      TracedText text;
      text.write(each.text, each.at);
      list.push_back(words_.expression(text, {0, text.size()}).text());
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
  CpfgWords words_;
  std::map<std::string, std::string> constants_;
  std::optional<lang::Names> names_;  ///< of the constants, when they were asked for
  std::map<std::string, Line> symbols_;
  std::vector<CpfgRule> rules_[3];
  Json parameters_ = Json::object();
  Imported out_;
  Line length_;
  Part part_ = Part::derivation;
  bool begun_ = false, ended_ = false, has_axiom_ = false;
};

}  // namespace

Result<Imported> import_cpfg(std::string_view text, const ImportOptions& options) {
  if (!options.entry.empty()) {
    return Error{Code::invalid, {{"/entry", "a file of cpfg holds one system; expected no entry"}}};
  }
  ForeignText source(text);
  Imported imported = CpfgReader(source, cpfg_without_comments(source)).read();
  return source.finish(std::move(imported));
}

}  // namespace seedmesh

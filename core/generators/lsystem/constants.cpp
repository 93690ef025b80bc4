#include "core/generators/lsystem/constants.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/lang/text_positions.h"

namespace seedmesh::lsystem {
namespace {

enum class State { unknown, in_progress, known };

struct Entry {
  const WrittenConstant* written;
  State state = State::unknown;
  double value = 0;
};

class Resolver {
 public:
  Resolver(const std::vector<WrittenConstant>& constants, const Rng& rng, std::vector<Issue>& issues)
      : rng_(rng), issues_(issues) {
    for (const WrittenConstant& constant : constants) {
      by_name_.emplace(constant.name, entries_.size());
      entries_.push_back({&constant});
    }
  }

  lang::Names resolve() {
    for (Entry& entry : entries_) settle(entry);
    lang::Names names;
    for (const Entry& entry : entries_) names.bind_constant(entry.written->name, entry.value);
    return names;
  }

 private:
  Entry* find(std::string_view name) {
    const auto at = by_name_.find(name);
    return at == by_name_.end() ? nullptr : &entries_[at->second];
  }

  /// Evaluates `entry` after the constants that it needs. The recursion depth is the length of a chain of
  /// constants.
  void settle(Entry& entry) {
    if (entry.state != State::unknown) return;
    entry.state = State::in_progress;
    path_.push_back(&entry);
    if (const double* number = std::get_if<double>(&entry.written->value)) {
      entry.value = *number;
    } else {
      entry.value = evaluate(entry, std::get<std::string>(entry.written->value));
    }
    if (!std::isfinite(entry.value)) {
      issues_.emplace_back(IssueKind::evaluation, pointer(entry), "the value is not a finite number");
      entry.value = 0;
    }
    path_.pop_back();
    entry.state = State::known;
  }

  double evaluate(const Entry& entry, const std::string& text) {
    std::vector<lang::TextError> errors;
    const std::vector<lang::Token> tokens = lang::tokenize(text, 0, text.size(), errors);
    lang::Names known;
    for (const lang::Token& token : tokens) {
      if (token.kind != lang::TokenKind::name) continue;
      Entry* other = find(token.text);
      if (!other) continue;
      if (other->state == State::in_progress || path_.size() >= longest_chain) {
        issues_.push_back(issue_at(IssueKind::evaluation, pointer(entry), text, token.offset, cycle(*other)));
        return 0;
      }
      settle(*other);
      if (known.find(token.text)) continue;
      known.bind_constant(other->written->name, other->value);
    }
    lang::Program program;
    std::size_t at = 0;
    const lang::Expression expression = program.parse(tokens, at, known, errors);
    if (errors.empty() && tokens[at].kind != lang::TokenKind::end) {
      errors.push_back({tokens[at].offset, "found text after the end of the expression"});
    }
    if (!errors.empty()) {
      lang::add_issues(pointer(entry), text, errors, issues_);
      return 0;
    }
    Rng draws = rng_.at(entry.written->name);
    return program.evaluate(expression, nullptr, draws);
  }

  std::string cycle(const Entry& again) const {
    if (again.state != State::in_progress) return "the chain of constants is longer than 200";
    std::string text = "the constants form a cycle:  ";
    auto from = std::find(path_.begin(), path_.end(), &again);
    for (; from != path_.end(); ++from) text += (*from)->written->name + " -> ";
    return text + again.written->name;
  }

  static std::string pointer(const Entry& entry) { return "/constants/" + entry.written->name; }

  static constexpr std::size_t longest_chain = 200;
  Rng rng_;
  std::vector<Issue>& issues_;
  std::vector<Entry> entries_;
  std::map<std::string_view, std::size_t> by_name_;
  std::vector<Entry*> path_;
};

}  // namespace

lang::Names resolve_constants(const std::vector<WrittenConstant>& constants, const Rng& rng,
                              std::vector<Issue>& issues) {
  return Resolver(constants, rng, issues).resolve();
}

}  // namespace seedmesh::lsystem

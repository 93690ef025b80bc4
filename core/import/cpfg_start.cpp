/// Variables and arrays of cpfg. What `Start` sets and nothing changes becomes a constant; otherwise the statements of
/// `Start` run here, and their results are the variables of the request.
#include <algorithm>

#include "core/base/job.h"
#include "core/generators/lsystem/word.h"
#include "core/import/cpfg_reader.h"
#include "core/import/cpfg_view.h"
#include "generated/params/lsystem.h"

namespace seedmesh {
namespace {

using lsystem::Slice;

constexpr std::size_t most_elements = 10'000;
constexpr std::uint64_t most_turns = 1'000'000;  // of the loops of Start

std::size_t skip(const TracedText& text, std::size_t at, std::size_t to) {
  return lsystem::skip_spaces(text.text(), at, to);
}

std::size_t name_end(const TracedText& text, std::size_t at, std::size_t to) {
  while (at < to && is_name_part(text[at])) ++at;
  return at;
}

/// The next `mark` outside of brackets and braces; `to` if there is none.
std::size_t find_outside(const TracedText& text, std::size_t at, std::size_t to, char mark) {
  int depth = 0;
  for (; at < to; ++at) {
    if (depth == 0 && text[at] == mark) return at;
    if (std::string_view("([{").find(text[at]) != std::string_view::npos) ++depth;
    if (std::string_view(")]}").find(text[at]) != std::string_view::npos) --depth;
  }
  return to;
}

}  // namespace

/// `array name[size] = {value, ...}, other[size]; ...`
void CpfgReader::define(const TracedText& block) {
  for (std::size_t at = skip(block, 0, block.size()); at < block.size();) {
    const std::size_t end = find_outside(block, at, block.size(), ';');
    const std::size_t word = name_end(block, at, end);
    if (block.text().compare(at, word - at, "array") != 0) {
      source_.report(block.origin(at), "expected `array name[size] = {numbers};`");
      return;
    }
    for (std::size_t from = word; from < end;) {
      const std::size_t comma = find_outside(block, from, end, ',');
      define_array(block, {skip(block, from, comma), comma});
      from = comma + 1;
    }
    at = skip(block, end + 1, block.size());
  }
}

void CpfgReader::define_array(const TracedText& block, Slice slice) {
  const std::size_t end = name_end(block, slice.from, slice.to);
  const std::size_t open = skip(block, end, slice.to);
  if (end == slice.from || open == slice.to || block[open] != '[') {
    source_.report(block.origin(slice.from), "expected the name of an array and its size in brackets");
    return;
  }
  std::vector<std::size_t> sizes;
  std::size_t elements = 1, next = open;
  while (next < slice.to && block[next] == '[') {
    const std::size_t close = lsystem::closing(block.text(), next, slice.to);
    const std::optional<double> size =
        number(words_.expression(block, {next + 1, close}), block.origin(next));
    if (!size) return;
    if (!(*size >= 1 && *size * static_cast<double>(elements) <= static_cast<double>(most_elements))) {
      source_.report(block.origin(next), "expected a size from 1 to 10000");
      return;
    }
    sizes.push_back(static_cast<std::size_t>(*size));
    elements *= sizes.back();
    next = close < slice.to ? skip(block, close + 1, slice.to) : slice.to;
  }
  std::vector<double> values(elements, 0.0);
  const std::size_t brace =
      next < slice.to && block[next] == '=' ? skip(block, next + 1, slice.to) : slice.to;
  if (brace < slice.to && block[brace] == '{') {
    const std::size_t last = lsystem::closing(block.text(), brace, slice.to);
    std::size_t count = 0;
    for (std::size_t from = brace + 1; from < last && count < values.size(); ++count) {
      const std::size_t comma = find_outside(block, from, last, ',');
      values[count] = number(words_.expression(block, {from, comma}), block.origin(from)).value_or(0);
      from = comma + 1;
    }
  }
  const std::string name = block.text().substr(slice.from, end - slice.from);
  if (!arrays_.emplace(name, std::move(values)).second)
    source_.report(block.origin(slice.from), "found a second array of this name");
  if (sizes.size() > 1) dimensions_.emplace(name, std::move(sizes));
}

/// a[i][j] of an array with several dimensions as a[floor(i) * columns + j], in the order in which C stores it.
TracedText CpfgReader::with_one_index(const TracedText& text) const {
  if (dimensions_.empty()) return text;
  TracedText out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::max(name_end(text, at, text.size()), at + 1);
    const auto found = dimensions_.find(text.text().substr(at, end - at));
    std::size_t open = skip(text, end, text.size());
    out.copy(text, at, end);
    at = end;
    if (found == dimensions_.end() || open == text.size() || text[open] != '[') continue;
    TracedText index;
    for (std::size_t i = 0; open < text.size() && text[open] == '['; ++i) {
      const std::size_t close = lsystem::closing(text.text(), open, text.size());
      const TracedText inner = with_one_index(text.part(open + 1, close));
      const std::size_t from = text.origin(open);
      TracedText sum;
      if (i > 0) {
        const std::size_t columns = i < found->second.size() ? found->second[i] : 1;
        sum.write("(", from);
        sum.copy(index, 0, index.size());
        sum.write(")*" + std::to_string(columns) + "+", from);
      }
      sum.write("floor(", from);
      sum.copy(inner, 0, inner.size());
      sum.write(")", from);
      index = std::move(sum);
      at = std::min(close + 1, text.size());
      open = skip(text, at, text.size());
    }
    out.write("[", text.origin(at - 1));
    out.copy(index, 0, index.size());
    out.write("]", text.origin(at - 1));
  }
  return out;
}

/// Start: { name = expression; ... } with simple assignments makes constants, unless something changes their names.
/// False: the statements have to run.
bool CpfgReader::put_constants() {
  std::map<std::string, TracedText> found;
  for (std::size_t at = skip(start_, 0, start_.size()); at < start_.size();) {
    const std::size_t end = find_outside(start_, at, start_.size(), ';');
    const std::size_t stop = name_end(start_, at, end), equals = skip(start_, stop, end);
    const bool is_simple = stop > at && equals + 1 < end && end < start_.size() && start_[equals] == '=' &&
                           start_[equals + 1] != '=';
    if (!is_simple) return false;
    const Line value = trimmed(start_.text(), {equals + 1, end});
    TracedText text = words_.expression(start_, {value.from, value.to});
    // Constants have no functions of files.
    if (text.text().find("fopen") != std::string::npos || text.text().find("func") != std::string::npos)
      return false;
    if (!found.emplace(start_.text().substr(at, stop - at), std::move(text)).second) return false;
    at = skip(start_, end + 1, start_.size());
  }
  for (const auto& [name, value] : found) {
    if (statements_.assigned().contains(name)) return false;
  }
  for (const auto& [name, value] : found) put_constant(name, value);
  return true;
}

/// Runs the statements of Start on variables of 0.
void CpfgReader::run_start(const TracedText& start) {
  LsystemParams params;
  params.axiom = "A";
  for (const auto& [name, value] : constants_) params.constants[name] = value;
  for (const CpfgMacros::Expression& each : macros_.constants()) params.constants[each.name] = each.text;
  for (const CpfgMacros::Expression& each : macros_.functions()) params.functions.push_back(each.text);
  for (const std::string& name : between_.assigned()) {
    if (!arrays_.contains(name) && !params.constants.contains(name)) params.variables[name] = 0.0;
  }
  params.arrays = arrays_;
  ForeignText unheard(source_.text());  // put_cpfg_files reports again when the request is complete
  Json of_files = Json::object();
  put_cpfg_files(options_.files, of_files, unheard);
  for (const Json& each : of_files.value("functions", Json::array()))
    params.functions.push_back(each.get<std::string>());
  const Json samples = of_files.value("arrays", Json::object());
  for (const auto& [name, values] : samples.items()) params.arrays[name] = values.get<std::vector<double>>();
  params.start_each = start.text();
  const std::uint64_t seed = out_.request.value("seed", std::uint64_t{0});
  Limits limits;
  limits.modules = most_turns;
  std::vector<Issue> issues;
  const lsystem::Grammar grammar = lsystem::compile(params, seed, limits, issues);
  for (const Issue& issue : issues) {
    const std::size_t column =
        issue.pointer == "/start_each" ? static_cast<std::size_t>(std::max(issue.column, 1)) : 1;
    if (start.size() > 0)
      source_.report(start.origin(std::min(column, start.size()) - 1), issue.message, issue.kind);
  }
  if (!issues.empty()) return;
  Job::Options options;
  options.limits = limits;
  Job job(seed, options);
  lsystem::Derivation derivation(grammar, false, job);
  try {
    derivation.step();
  } catch (const Stop& stop) {
    source_.report(start.origin(0), "the statements of `Start` do not end: " + stop.issue().message);
    return;
  }
  std::size_t at = 0;
  Json& variables = parameters_["variables"] = Json::object();
  for (auto& [name, value] : params.variables) variables[name] = derivation.word.variables[at++];
  for (const auto& [name, all] : params.arrays) {
    const auto own = arrays_.find(name);
    if (own == arrays_.end()) {
      at += all.size();
      continue;
    }
    for (double& value : own->second) value = derivation.word.variables[at++];
    parameters_["arrays"][name] = own->second;
  }
}

/// Everything that statements between steps set, or that rules change, is a variable.
void CpfgReader::put_variables() {
  const TracedText start = between_.converted(start_, {0, start_.size()});
  const TracedText start_each = between_.converted(start_each_, {0, start_each_.size()});
  const TracedText end_each = between_.converted(end_each_, {0, end_each_.size()});
  const bool is_still = arrays_.empty() && start_each.size() + end_each.size() == 0;
  const bool has_variables = !arrays_.empty() || !between_.assigned().empty();
  if (has_variables && !(is_still && put_constants())) run_start(start);
  if (start_each.size() > 0) put("start_each", start_each.text(), start_each.runs());
  if (end_each.size() > 0) put("end_each", end_each.text(), end_each.runs());
  const TracedText& seed = between_.seed();
  if (seed.size() == 0 || out_.request.contains("seed")) return;
  const std::optional<double> value = number(seed, seed.origin(0));
  if (value && *value >= 0 && *value <= 9e15) out_.request["seed"] = static_cast<std::uint64_t>(*value);
}

}  // namespace seedmesh

#include <algorithm>
#include <array>

#include "core/lang/expression.h"

namespace seedmesh::lang {

void Names::bind(Binding binding) {
  indices_[binding.name].push_back(static_cast<std::uint32_t>(bindings_.size()));
  bindings_.push_back(std::move(binding));
}

void Names::bind_slot(std::string name, std::uint32_t slot) { bind({std::move(name), false, slot, 0}); }

void Names::bind_constant(std::string name, double value) { bind({std::move(name), true, 0, value}); }

void Names::bind_array(std::string name, std::uint32_t slot, std::uint32_t count) {
  bind({std::move(name), false, slot, 0, count});
}

void Names::forget_after(std::size_t count) {
  while (bindings_.size() > count) {
    const auto found = indices_.find(bindings_.back().name);
    found->second.pop_back();
    if (found->second.empty()) indices_.erase(found);
    bindings_.pop_back();
  }
}

const Names::Binding* Names::find(std::string_view name) const {
  const auto found = indices_.find(name);
  return found == indices_.end() ? nullptr : &bindings_[found->second.back()];
}

const Names::Binding* Names::find_constant(std::string_view name) const {
  const auto found = indices_.find(name);
  if (found == indices_.end()) return nullptr;
  for (auto each = found->second.rbegin(); each != found->second.rend(); ++each) {
    if (bindings_[*each].is_constant) return &bindings_[*each];
  }
  return nullptr;
}

void Names::define(std::string name, Defined function) {
  functions_.insert_or_assign(std::move(name), std::move(function));
}

void Names::mark_invalid(std::string_view name) {
  const auto found = functions_.find(name);
  if (found != functions_.end()) found->second.is_valid = false;
}

const Names::Defined* Names::find_function(std::string_view name) const {
  const auto found = functions_.find(name);
  return found == functions_.end() ? nullptr : &found->second;
}

std::string_view Names::nearest(std::string_view name) const {
  if (!may_hint()) return {};
  constexpr std::size_t looked_at = 256;  // bounds the cost for a hostile list
  const std::size_t first = bindings_.size() > looked_at ? bindings_.size() - looked_at : 0;
  std::string_view best;
  std::uint32_t least = hint_distance(name) + 1;
  for (std::size_t i = first; i < bindings_.size(); ++i) {
    const std::uint32_t distance = name_distance(name, bindings_[i].name);
    if (distance >= least) continue;
    least = distance;
    best = bindings_[i].name;
  }
  return best;
}

std::string read_definition(std::string_view text, Names::Defined& function, std::vector<TextError>& errors) {
  const std::vector<Token> tokens = tokenize(text, 0, text.size(), errors);
  std::size_t at = 0;
  const auto expect = [&](bool found, const char* what) {
    if (!found) {
      errors.push_back(
          {tokens[at].offset, "expected " + std::string(what) + ", found " + in_quotes(tokens[at])});
    }
    return found;
  };
  if (!expect(tokens[at].kind == TokenKind::name, "the name of the function")) return {};
  const std::string name(tokens[at].text);
  const auto same = [&](const Function& row) { return row.name == name; };
  if (std::any_of(functions().begin(), functions().end(), same)) {
    errors.push_back({tokens[at].offset, in_quotes(name) + " is the name of a built-in function",
                      IssueKind::duplicate_key});
  }
  ++at;
  if (!expect(is_symbol(tokens[at], "("), "`(`")) return name;
  ++at;
  while (!is_symbol(tokens[at], ")")) {
    if (!function.parameters.empty()) {
      if (!expect(is_symbol(tokens[at], ","), "`,` or `)`")) return name;
      ++at;
    }
    if (!expect(tokens[at].kind == TokenKind::name, "the name of a parameter")) return name;
    const std::string parameter(tokens[at].text);
    if (std::find(function.parameters.begin(), function.parameters.end(), parameter) !=
        function.parameters.end()) {
      errors.push_back({tokens[at].offset, "the parameter " + in_quotes(parameter) + " is named twice",
                        IssueKind::duplicate_key});
    }
    if (function.parameters.size() == Names::most_parameters) {
      errors.push_back({tokens[at].offset, "found more than 8 parameters", IssueKind::out_of_range});
      return name;
    }
    function.parameters.push_back(parameter);
    ++at;
  }
  ++at;
  if (!expect(is_symbol(tokens[at], "="), "`=` and the value of the function")) return name;
  function.body.assign(tokens.begin() + static_cast<std::ptrdiff_t>(at) + 1, tokens.end());
  return name;
}

std::uint32_t hint_distance(std::string_view name) {
  return std::max<std::uint32_t>(2,
                                 static_cast<std::uint32_t>(std::min<std::size_t>(name.size(), 64)) * 2 / 3);
}

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::uint32_t exchange_cost(char a, char b) { return a == b ? 0U : lower(a) == lower(b) ? 1U : 2U; }

}  // namespace

// The table of Wagner and Fischer, "The String-to-String Correction Problem", 1974, with Damerau's swap of
// neighbours; only three rows are kept.
std::uint32_t name_distance(std::string_view a, std::string_view b) {
  constexpr std::size_t longest = 64;
  constexpr std::uint32_t edit = 2;
  if (a == b) return 0;
  const auto same_letter = [](char x, char y) { return lower(x) == lower(y); };
  if (std::equal(a.begin(), a.end(), b.begin(), b.end(), same_letter)) return 1;
  if (a.size() > longest || b.size() > longest) return 2 * edit * longest;

  std::array<std::array<std::uint32_t, longest + 1>, 3> rows{};
  for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = static_cast<std::uint32_t>(j) * edit;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    auto& row = rows[i % 3];
    const auto& above = rows[(i + 2) % 3];
    row[0] = static_cast<std::uint32_t>(i) * edit;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({above[j] + edit, row[j - 1] + edit, above[j - 1] + exchange_cost(a[i - 1], b[j - 1])});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], rows[(i + 1) % 3][j - 2] + edit);
    }
  }
  return rows[a.size() % 3][b.size()];
}

}  // namespace seedmesh::lang

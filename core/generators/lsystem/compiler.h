#pragma once
/// Compiles the texts of a request to a Grammar. Internal header of this directory:
/// grammar.cpp          order of compilation, symbols
/// compile_names.cpp    modules, functions, alphabet, ignored symbols
/// compile_rules.cpp    productions and words
/// statements.cpp       recognition of statements
/// compile_code.cpp     statements
/// compile_frames.cpp   frames
/// check_grammar.cpp    checks of the whole grammar
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/generators/lsystem/grammar.h"
#include "core/generators/lsystem/notation.h"
#include "core/lang/text_positions.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

constexpr std::uint32_t most_parameters = 64;
constexpr std::size_t most_kinds = 60'000;
constexpr std::uint32_t frame_numbers = 12;  ///< axes x, y, z and origin, three numbers each

/// One text of the request with the errors found in it. Does not own the text.
struct Source {
  Source() = default;
  Source(std::string_view of, std::string at) : text(of), pointer(std::move(at)), positions(of) {}
  std::string_view text;
  std::string pointer;
  std::vector<lang::TextError> errors;
  lang::TextPositions positions{{}};

  const Marks& marks_of_text() {
    if (!marks_) marks_.emplace(text);
    return *marks_;
  }

 private:
  std::optional<Marks> marks_;  ///< computed on first use
};

class Compiler {
 public:
  Compiler(const LsystemParams& params, std::uint64_t seed, const Limits& limits, std::vector<Issue>& issues,
           const Job* job);
  Grammar compile();

 private:
  // grammar.cpp
  KindId kind(std::string_view symbol, std::uint32_t written, Source& source, std::size_t offset);
  void declare_modules();
  void define_functions();
  void mark_ignored();
  std::set<std::string, std::less<>> symbols_of(const std::string& text, const char* pointer);
  void read_alphabet();
  void check_symbol(const WrittenModule& module, Source& source) const;
  std::uint32_t surface_of(std::string_view symbol) const;
  void check_surface(const WrittenModule& module, Source& source);
  void take_errors(Source& source);
  void read_axiom();
  void read_rules(const std::string& folder, const std::vector<std::string>& texts, Rules& rules);
  void read_tables();
  void bind_objects();
  void bind_variables(const lang::Names& values);
  void read_statements_between();
  void check_alone(const Rules& rules, const char* what);
  void check_directions();
  void order(Rules& rules);
  bool draws(const Production& production) const;
  bool draws(Range successor) const;
  bool draws_in(Range steps) const;
  template <class Use>
  void for_all_rules(Use&& use) {
    use(grammar_.productions);
    use(grammar_.interpretation);
    use(grammar_.decomposition);
    for (Rules& table : grammar_.tables) use(table);
  }

  // compile_rules.cpp
  lang::Expression expression(Source& source, Slice slice);
  Range word(Source& source, Slice slice);
  void add_template(Source& source, const WrittenModule& module);
  void check_brackets(Source& source, Slice slice);
  Production production(Source& source, const WrittenProduction& written);
  void read_predecessor(Source& source, Slice slice, Production& made, std::uint32_t& slots);
  void read_contexts(Source& source, const WrittenProduction& written, Production& made,
                     std::uint32_t& slots);
  void read_weight(Source& source, const WrittenProduction& written, Production& made);
  std::vector<KindId> context(Source& source, Slice slice, std::uint32_t& slots);
  KindId formal(Source& source, const WrittenModule& module, std::uint32_t& slots);
  void bind(Source& source, const lang::Token& name, bool is_frame, std::uint32_t& slots);

  // check_grammar.cpp
  /// A module on which the turtle has no effect. It is reported only where no rule rewrites its kind.
  struct Doubt {
    KindId kind;
    enum class Is { warning, error } is;
    Warning warning;
  };
  void warn(Source& source, std::size_t offset, std::string message);
  void warn(Warning warning);
  void doubt_module(Source& source, const WrittenModule& module, const Template& made);
  void check_word(Source& source, Slice slice) const;
  void check_rules();
  void warn_of_weights(const Rules& rules);
  void warn_of_dead(const Rules& rules);
  std::vector<bool> reachable_kinds();
  void warn_of_arity();

  // statements.cpp
  bool has_statements(Source& source, Slice slice) const;

  // compile_code.cpp
  class CodeReader;
  friend class CodeReader;
  /// Compiles text[slice] to steps.
  Range code(Source& source, Slice slice, std::uint32_t& slots);
  Range assignments(Source& source, Slice slice, std::uint32_t& slots);

  // compile_frames.cpp
  lang::Expression frame(Source& source, Slice slice);

  const LsystemParams& params_;
  const Limits& limits_;
  std::vector<Issue>& issues_;
  const Job* job_;     ///< may be null
  lang::Names names_;  ///< the constants, the variables, then the parameters of the production being compiled
  std::size_t constant_count_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> frame_slots_;             ///< parameters that are frames
  std::map<std::string, std::vector<std::uint8_t>, std::less<>> signatures_;  ///< 1: a frame
  std::set<std::string, std::less<>> ignored_, considered_, variables_, alphabet_constants_;
  Symbols symbols_;
  std::map<std::pair<std::string, std::uint32_t>, KindId> ids_;
  /// count of each symbol in the current successor
  std::map<std::string, std::uint64_t, std::less<>> occurrences_;
  std::vector<Doubt> doubts_;
  std::vector<std::uint8_t> doubted_;  ///< by kind: 1 where it has been checked
  std::set<std::string> warned_;       ///< pointers of productions that have a warning
  std::size_t unreported_ = 0;         ///< number of warnings beyond the limit
  Grammar grammar_;
};

}  // namespace seedmesh::lsystem

#pragma once
/// The parts of the compiler from the texts of a request to a Grammar. Internal header of this directory.
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

/// A possible error: a module on which the turtle has no effect. It is reported only if no rule rewrites its
/// kind.
struct PossibleError {
  KindId kind;
  enum class Severity { warning, error } severity;
  Warning warning;
};

/// The state of one compilation. All functions below read and extend it.
struct Compilation {
  Compilation(const LsystemParams& given, const Limits& most, std::vector<Issue>& found, const Job* shared)
      : params(given), limits(most), issues(found), job(shared) {}

  const LsystemParams& params;
  const Limits& limits;
  std::vector<Issue>& issues;
  const Job* job;     ///< may be null
  lang::Names names;  ///< constants, then variables, then parameters of the current production
  std::size_t constant_count = 0;
  std::map<std::string, std::uint32_t, std::less<>> frame_slots;             ///< parameters that are frames
  std::map<std::string, std::vector<std::uint8_t>, std::less<>> signatures;  ///< 1: a frame
  std::set<std::string, std::less<>> ignored, considered, variables, alphabet_constants;
  Symbols symbols;
  std::map<std::pair<std::string, std::uint32_t>, KindId> ids;
  std::map<std::string, std::uint64_t, std::less<>> occurrences;  ///< in the current successor, by symbol
  std::vector<PossibleError> possible_errors;
  std::vector<std::uint8_t> is_checked;  ///< 1 for kinds that have been checked
  std::set<std::string> warned;          ///< pointers of productions that have a warning
  std::size_t unreported = 0;            ///< number of warnings beyond the limit
  Grammar grammar;
};

// Functions that report errors add them to the errors of `source`; take_errors() moves them to the issues.

/// grammar.cpp: Returns the kind of a symbol with this number of written parameters, and makes it on first use.
/// Reports a kind that contradicts its declared signature, at `offset`.
KindId kind_of(Compilation& c, std::string_view symbol, std::uint32_t written, Source& source,
               std::size_t offset);
void check_surface(Compilation& c, const WrittenModule& module, Source& source);
void take_errors(Compilation& c, Source& source);

/// Calls `use` for the rules of all kinds and tables.
template <class Use>
void for_all_rules(Compilation& c, Use&& use) {
  use(c.grammar.productions);
  use(c.grammar.interpretation);
  use(c.grammar.decomposition);
  for (Rules& table : c.grammar.tables) use(table);
}

/// compile_names.cpp: These functions read the declarations of the request. check_symbol() compares a module
/// with the alphabet.
void declare_modules(Compilation& c);
void define_functions(Compilation& c);
void mark_ignored(Compilation& c);
void read_alphabet(Compilation& c);
void check_symbol(const Compilation& c, const WrittenModule& module, Source& source);

/// compile_rules.cpp: Compile slices of a text. check_brackets() reports brackets without a partner.
lang::Expression compile_expression(Compilation& c, Source& source, Slice slice);
Range compile_word(Compilation& c, Source& source, Slice slice);
Production compile_production(Compilation& c, Source& source, const WrittenProduction& written);
void check_brackets(Compilation& c, Source& source, Slice slice);

/// compile_code.cpp: Compile a successor with statements, or statements alone, to steps. New locals get slots from
/// `slots` on.
Range compile_code(Compilation& c, Source& source, Slice slice, std::uint32_t& slots);
Range compile_assignments(Compilation& c, Source& source, Slice slice, std::uint32_t& slots);

/// compile_frames.cpp: Returns a constant whose value is the index into Grammar::frames.
lang::Expression compile_frame(Compilation& c, Source& source, Slice slice);

/// check_grammar.cpp: warn() adds a warning at a position of a text. check_module() adds a PossibleError.
/// check_word() reports text in a word that cannot be meant as modules. check_rules() checks the whole
/// grammar.
void warn(Compilation& c, Source& source, std::size_t offset, std::string message);
void check_module(Compilation& c, Source& source, const WrittenModule& module, const Template& made);
void check_word(const Compilation& c, Source& source, Slice slice);
void check_rules(Compilation& c);

}  // namespace seedmesh::lsystem

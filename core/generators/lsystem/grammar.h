#pragma once
/// A compiled L-system: parsed texts, names bound to slots, productions sorted by the order of matching.
///
/// A kind is a symbol with its number of parameters. All kinds that a grammar can write occur in its text, so
/// a word is an array of kind numbers with an array of parameters.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/lsystem/commands.h"
#include "core/lang/expression.h"
#include "core/model/model.h"

namespace seedmesh {
struct LsystemParams;
}

namespace seedmesh::lsystem {

using KindId = std::uint16_t;

/// A symbol with a fixed number of parameters.
struct Kind {
  std::string symbol;
  std::uint32_t arity = 0;           ///< number of values; a frame has twelve
  Command command = Command::none;   ///< command that the turtle executes
  bool ignored = false;              ///< skipped when contexts are matched
  std::vector<std::uint8_t> frames;  ///< 1 for written parameters that are frames, else 0; empty: no frames
  std::uint32_t written() const {    ///< number of parameters in the text
    return frames.empty() ? arity : static_cast<std::uint32_t>(frames.size());
  }
  std::uint32_t surface = none;  ///< for Command::organ: index of the surface, sorted by name
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
};

struct Range {
  std::uint32_t first = 0, count = 0;
};

/// A module of an axiom or a successor. Its arguments are expressions over the slots of the production.
struct Template {
  KindId kind = 0;
  std::uint32_t first_argument = 0;  ///< index into Grammar::arguments; Kind::written() elements
  std::uint64_t occurrence = 0;      ///< hash of the symbol and its occurrence number in the successor
};

/// One step of a successor with statements (code.h runs it).
struct Step {
  enum class Action : std::uint8_t {
    write,        ///< writes the templates
    set,          ///< sets the slot to the value
    set_element,  ///< sets the element `index` of the array of `target` slots from `slot` on
    jump,         ///< continues at step `target`
    jump_unless,  ///< continues at `target` where the value is 0
    enter_loop,   ///< starts the random streams of the iterations
    next_turn,
    leave_loop,
  };
  Action action = Action::write;
  Range templates;
  lang::Expression value;
  std::uint32_t slot = 0;
  std::uint32_t target = 0;  ///< index into Grammar::steps
  lang::Expression index{};
};

/// One production. The slots of its expressions are, in this order: the variables of the grammar; the
/// parameters of the predecessor, the left, the right, the new left and the new right context; the locals.
/// Within a context, parameters are ordered from left to right.
struct Production {
  KindId predecessor = 0;
  std::vector<KindId> rest;                 ///< for a strict predecessor: its modules after the first one
  std::vector<KindId> left;                 ///< nearest first
  std::vector<KindId> right;                ///< nearest first; [ and ] count as kinds
  std::vector<KindId> new_left, new_right;  ///< contexts in the word of the next step
  bool conditional = false;
  bool weighted = false;
  lang::Expression condition;
  lang::Expression weight;
  Range successor;  ///< range in Grammar::templates; with statements: all templates that they can write
  Range code;       ///< range in Grammar::steps; empty: the successor has no statements
  Range before;     ///< steps that run before the condition
  std::uint32_t bound = 0;  ///< number of slots of parameters; locals follow
  std::string pointer;
  bool has_context() const { return !rest.empty() || !left.empty() || !right.empty() || has_new_context(); }
  bool has_new_context() const { return !new_left.empty() || !new_right.empty(); }
};

/// Productions in the order of matching, which is that of the text. If Grammar::contexts_first is set,
/// productions with a context come first.
struct Rules {
  std::vector<Production> productions;  ///< grouped by predecessor
  std::vector<Range> of_kind;           ///< ranges of productions, indexed by kind
  bool context = false;                 ///< true where a production has a context
  bool random = false;                  ///< true where there are weights or random functions
  std::vector<std::uint8_t>
      /// by kind: 1 where a condition uses random numbers, so that a failed match can succeed later
      redraws;
  bool rewrites(KindId kind) const { return of_kind[kind].count != 0; }
  /// The productions of a kind, in the order of matching.
  std::span<const Production> candidates(KindId kind) const {
    return std::span(productions).subspan(of_kind[kind].first, of_kind[kind].count);
  }
};

/// A frame expression: a given frame, moved in its own axes move by move.
struct FrameExpression {
  enum class Move : std::uint8_t { translate, rotate_x, rotate_y, rotate_z, scale };
  struct Part {
    Move move;
    lang::Expression by[3];
  };
  std::uint32_t slot = identity;  ///< first of twelve slots
  std::vector<Part> parts;        ///< parts in the order of execution
  static constexpr std::uint32_t identity = ~std::uint32_t{0};
};

/// Returns the index into Grammar::frames that an argument refers to.
inline std::uint32_t frame_index(const lang::Expression& argument) {
  return static_cast<std::uint32_t>(argument.value);
}

struct Grammar {
  std::vector<Kind> kinds;
  std::vector<Template> templates;
  std::vector<lang::Expression> arguments;
  lang::Program program;
  std::vector<FrameExpression> frames;  ///< frame arguments are constants with their index here
  std::vector<Step> steps;
  Range axiom;
  Rules productions;
  Rules interpretation;
  Rules decomposition;
  std::vector<Rules> tables;                 ///< each also has the `productions`, which apply in every step
  std::vector<std::uint32_t> table_of_turn;  ///< table by step, repeated; empty: there are no tables
  std::uint32_t decomposition_depth = 0;
  std::vector<double> variables;        ///< initial values of variables and array elements: the first slots
  Range start_each, end_each;           ///< steps that run before and after every derivation step
  bool ring = false;                    ///< true where the last module is the left neighbour of the first
  bool backward = false;                ///< words are written from right to left, for new right contexts
  bool statements = false;              ///< true where a production has statements
  bool strict = false;                  ///< true where a production has a predecessor of several modules
  bool contexts_first = true;           ///< productions with a context come before those without
  bool weights_sum_to_1 = false;        ///< another sum of the weights that match a module is an error
  KindId open = 0, close = 0, cut = 0;  ///< kinds of [ ] %
  bool cuts = false;                    ///< true where % occurs
  std::uint32_t widest = 0;             ///< largest Kind::arity
  std::uint32_t most_slots = 1;         ///< largest number of slots of a production, with locals
  std::vector<Warning> warnings;

  /// Returns the productions of step `step`, counted from 0.
  const Rules& rules_at(std::uint32_t step) const {
    return table_of_turn.empty() ? productions : tables[table_of_turn[step % table_of_turn.size()]];
  }
  /// Returns true where the derivation of a module depends on the module alone and each production writes a
  /// fixed list of modules. Then context_free_derivation.h derives without storing a word.
  bool is_context_free() const {
    return !productions.context && decomposition.productions.empty() && tables.empty() && !statements &&
           variables.empty();
  }

  std::span<const Template> successor(Range range) const {
    return {templates.data() + range.first, range.count};
  }
};

/// Parses and checks all texts of the parameters. All errors go to `issues`, with pointers relative to the
/// parameters ("/productions/2"), line and column; the grammar is valid only without them. Random functions in
/// constants draw from `seed`. `job` may be null; otherwise its deadline and cancellation are checked. Cost:
/// linear in the text. The numbers of errors and warnings are bounded.
Grammar compile(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                std::vector<Issue>& issues, const Job* job = nullptr);

}  // namespace seedmesh::lsystem

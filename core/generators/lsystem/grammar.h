#pragma once
/// An L-system ready to run: texts parsed, names bound to slots, productions sorted into the order of
/// matching.
///
/// A module is a symbol and its number of parameters; the two together are its kind. All kinds that a grammar
/// can ever write stand in its text, so a word is a row of small numbers and (where kinds have them) a row of
/// parameters.
#include <cstdint>
#include <string>
#include <string_view>
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
  std::uint32_t arity = 0;           ///< numbers that it carries; a frame is twelve of them
  Command command = Command::none;   ///< what the turtle does on it
  bool ignored = false;              ///< passed over when contexts are matched
  std::vector<std::uint8_t> frames;  ///< by written parameter: 1 where it is a frame; empty where none is
  std::uint32_t written() const {    ///< number of parameters as written
    return frames.empty() ? arity : static_cast<std::uint32_t>(frames.size());
  }
  std::uint32_t surface = none;  ///< of Command::organ: which of the surfaces, in the order of their names
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
};

struct Range {
  std::uint32_t first = 0, count = 0;
};

/// A module as written in an axiom or a successor: its arguments are expressions over the slots of the
/// production.
struct Template {
  KindId kind = 0;
  std::uint32_t first_argument = 0;  ///< into Grammar::arguments; as many as the kind's written()
  std::uint64_t place = 0;  ///< hash of symbol and of which occurrence of it in the successor this is
};

/// One step of a successor that has statements (code.h runs them).
struct Step {
  enum class Does : std::uint8_t {
    write,        ///< the templates
    set,          ///< the slot to the value
    jump,         ///< to the step `target`
    jump_unless,  ///< to `target` where the value does not hold
    enter_loop,   ///< the random streams of its turns begin
    next_turn,
    leave_loop,
  };
  Does does = Does::write;
  Range templates;
  lang::Expression value;
  std::uint32_t slot = 0;
  std::uint32_t target = 0;  ///< into Grammar::steps
};

/// One production. Slots of its expressions: parameters of the predecessor, then of the left context from
/// left to right, of the right context, of the new left and the new right context; then its locals.
struct Production {
  KindId predecessor = 0;
  std::vector<KindId> left;                 ///< nearest first
  std::vector<KindId> right;                ///< nearest first; [ and ] are kinds like others
  std::vector<KindId> new_left, new_right;  ///< the same, of the word that is being written
  bool conditional = false;
  bool weighted = false;
  lang::Expression condition;
  lang::Expression weight;
  Range successor;          ///< into Grammar::templates; with statements: all that it may write
  Range code;               ///< into Grammar::steps; empty: the successor is written as it stands
  Range before;             ///< steps that come before the condition
  std::uint32_t bound = 0;  ///< slots of parameters; locals come behind them
  std::string pointer;
  bool has_context() const { return !left.empty() || !right.empty() || looks_at_new(); }
  bool looks_at_new() const { return !new_left.empty() || !new_right.empty(); }
};

/// Productions in the order in which they are tried: those with context first, then as written.
struct Rules {
  std::vector<Production> productions;  ///< of one predecessor side by side
  std::vector<Range> of_kind;           ///< by kind
  bool context = false;                 ///< some production has a context
  bool chance = false;                  ///< weights, or random functions anywhere
  std::vector<std::uint8_t>
      redraws;  ///< by kind: a condition draws, so that a failed match may hold in a later step
  bool rewrites(KindId kind) const { return of_kind[kind].count != 0; }
};

/// A frame as written: a frame that is there, moved in its own axes step by step.
struct FrameExpression {
  enum class Move : std::uint8_t { translate, rotate_x, rotate_y, rotate_z, scale };
  struct Part {
    Move move;
    lang::Expression by[3];
  };
  std::uint32_t slot = identity;  ///< first of twelve slots
  std::vector<Part> parts;        ///< in the order in which they are done
  static constexpr std::uint32_t identity = ~std::uint32_t{0};
};

/// The place in Grammar::frames that an argument holds which is a frame.
inline std::uint32_t frame_place(const lang::Expression& argument) {
  return static_cast<std::uint32_t>(argument.value);
}

struct Grammar {
  std::vector<Kind> kinds;
  std::vector<Template> templates;
  std::vector<lang::Expression> arguments;
  lang::Program program;
  std::vector<FrameExpression> frames;  ///< arguments that are frames hold their place here as a constant
  std::vector<Step> steps;
  Range axiom;
  Rules productions;
  Rules interpretation;
  Rules decomposition;
  std::vector<Rules> tables;                 ///< with those of `productions`, which hold in every step
  std::vector<std::uint32_t> table_of_turn;  ///< table by step, over and over; empty: there are none
  std::uint32_t decomposition_depth = 0;
  bool ring = false;        ///< the last module is the left neighbour of the first
  bool backward = false;    ///< words are written from right to left, since a new right context is looked at
  bool statements = false;  ///< some production of the derivation has code or something before its condition
  KindId open = 0, close = 0, cut = 0;  ///< kinds of [ ] %
  bool cuts = false;                    ///< % occurs
  std::uint32_t widest = 0;             ///< greatest arity
  std::uint32_t most_slots = 1;         ///< greatest number of slots of a production, locals included
  std::vector<Warning> warnings;

  /// The productions of step `step`, counted from 0.
  const Rules& rules_at(std::uint32_t step) const {
    return table_of_turn.empty() ? productions : tables[table_of_turn[step % table_of_turn.size()]];
  }
  /// What becomes of a module depends on nothing but itself and the step's one set of productions, each of
  /// which writes a fixed row of modules: then no word needs to be held.
  bool is_free() const {
    return !productions.context && decomposition.productions.empty() && tables.empty() && !statements;
  }

  std::span<const Template> successor(Range range) const {
    return {templates.data() + range.first, range.count};
  }
};

/// Parses and checks everything textual of the parameters. Every fault goes to `issues`, with pointers
/// relative to the parameters ("/productions/2") and line and column; the grammar may be run only when none
/// came. `seed` feeds random functions in constants. Where there is a job, its deadline and stop are asked
/// on the way. Cost: linear in the text; of faults and warnings no more are made than somebody may read.
Grammar compile(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                std::vector<Issue>& issues, const Job* job = nullptr);

}  // namespace seedmesh::lsystem

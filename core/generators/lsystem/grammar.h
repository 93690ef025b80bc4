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
  std::uint32_t arity = 0;
  Command command = Command::none;  ///< what the turtle does on it
  bool ignored = false;             ///< passed over when contexts are matched
  std::uint32_t surface = none;     ///< of Command::organ: which of the surfaces, in the order of their names
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
};

/// A module as written in an axiom or a successor: its arguments are expressions over the slots of the
/// production.
struct Template {
  KindId kind = 0;
  std::uint32_t first_argument = 0;  ///< into Grammar::arguments; as many as the kind's arity
  std::uint64_t place = 0;  ///< hash of symbol and of which occurrence of it in the successor this is
};

struct Range {
  std::uint32_t first = 0, count = 0;
};

/// One production. Slots of its expressions: parameters of the predecessor, then of the left context from
/// left to right, then of the right context.
struct Production {
  KindId predecessor = 0;
  std::vector<KindId> left;   ///< nearest first
  std::vector<KindId> right;  ///< nearest first; [ and ] are kinds like others
  bool conditional = false;
  bool weighted = false;
  lang::Expression condition;
  lang::Expression weight;
  Range successor;  ///< into Grammar::templates
  std::string pointer;
  bool has_context() const { return !left.empty() || !right.empty(); }
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

struct Grammar {
  std::vector<Kind> kinds;
  std::vector<Template> templates;
  std::vector<lang::Expression> arguments;
  lang::Program program;
  Range axiom;
  Rules productions;
  Rules interpretation;
  KindId open = 0, close = 0, cut = 0;  ///< kinds of [ ] %
  bool cuts = false;                    ///< % occurs
  std::uint32_t widest = 0;             ///< greatest arity
  std::uint32_t most_slots = 0;         ///< greatest number of slots of a production
  std::vector<Warning> warnings;

  std::span<const Template> successor(Range range) const {
    return {templates.data() + range.first, range.count};
  }
};

/// Parses and checks everything textual of the parameters. Every fault goes to `issues`, with pointers
/// relative to the parameters ("/productions/2") and line and column; the grammar may be run only when none
/// came. `seed` feeds random functions in constants. Cost: linear in the text.
Grammar compile(const LsystemParams& params, std::uint64_t seed, const Limits& limits,
                std::vector<Issue>& issues);

}  // namespace seedmesh::lsystem

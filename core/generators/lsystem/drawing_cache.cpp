#include "core/generators/lsystem/drawing_cache.h"

#include <algorithm>

#include "core/generators/lsystem/growth.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::uint64_t worth_it = std::uint64_t{1} << 20U;  // smallest number of modules
// A recording has to fit into the processor cache, and drawing all of them has to be cheap.
constexpr std::uint64_t least_of_recording = 64, most_of_recording = 8192;
constexpr std::size_t most_recordings = 64;
constexpr std::size_t most_pieces = std::size_t{1} << 16U;  // number of kinds times number of steps

/// Returns true where the symbol has the same effect after a rigid motion of the turtle, and affects only the
/// turtle.
bool moves_along(const Grammar& grammar, Command command) {
  if (command == Command::cut) return !grammar.cuts;
  if (command <= Command::turn_around) return true;
  if (command >= Command::width_down && command <= Command::color_down) return true;
  if (command >= Command::set_scale && command <= Command::mirror) return true;
  return command == Command::push || command == Command::pop;
}

/// Brackets pair in every successor. Braces need not pair, and statements can write anything.
bool is_written_plainly(const Rules& rules) {
  return std::all_of(rules.productions.begin(), rules.productions.end(),
                     [](const Production& each) { return each.code.count == 0; });
}

std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return std::min(saturated, a + b); }

}  // namespace

bool DrawingCache::fits(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps) {
  if (!grammar.is_context_free() || Drawing::needs_keys(grammar, params)) return false;
  if ((std::size_t{steps} + 1) * grammar.kinds.size() > most_pieces) return false;
  const std::vector<std::uint64_t> counts = exact_counts(grammar, steps);
  std::uint64_t modules = 0;
  for (const std::uint64_t each : counts) modules = sum(modules, each);
  return modules >= worth_it && moves_rigidly(grammar, params, steps);
}

bool DrawingCache::moves_rigidly(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps) {
  if (!grammar.is_context_free() || Drawing::needs_keys(grammar, params)) return false;
  if ((std::size_t{steps} + 1) * grammar.kinds.size() > most_pieces) return false;
  const auto has_parameters = [&](const Production& each) {
    return grammar.kinds[each.predecessor].arity > 0;
  };
  const std::vector<Production>& productions = grammar.productions.productions;
  return std::none_of(productions.begin(), productions.end(), has_parameters) &&
         is_written_plainly(grammar.interpretation) &&
         std::all_of(grammar.kinds.begin(), grammar.kinds.end(),
                     [&](const Kind& kind) { return moves_along(grammar, kind.command); });
}

DrawingCache::DrawingCache(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps,
                           Drawing& drawing, const GenerateContext& context)
    : grammar_(grammar),
      params_(params),
      steps_(steps),
      drawing_(drawing),
      context_(context),
      job_(context.job),
      meter_(context.job, Resource::modules),
      pieces_((std::size_t{steps} + 1) * grammar.kinds.size()) {
  count();
}

/// Counts the modules of each symbol after each number of steps.
void DrawingCache::count() {
  const Rules& rules = grammar_.productions;
  for (std::uint32_t steps = 1; steps <= steps_; ++steps) {
    for (std::size_t i = 0; i < grammar_.kinds.size(); ++i) {
      const auto kind = static_cast<KindId>(i);
      if (!rules.rewrites(kind)) continue;
      std::uint64_t modules = 0;
      for (const Template& each : grammar_.successor(rules.productions[rules.of_kind[kind].first].successor))
        modules = sum(modules, piece(each.kind, steps - 1).modules);
      piece(kind, steps).modules = modules;
    }
  }
}

bool DrawingCache::replaces(KindId kind, std::uint32_t step) {
  Piece& here = piece(kind, steps_ - step);
  if (here.modules < least_of_recording || here.modules > most_of_recording) return false;
  meter_.spend(here.modules);
  for (const std::unique_ptr<Turtle::Recording>& recording : here.recordings) {
    if (!drawing_.matches(*recording)) continue;
    drawing_.append_copy(*recording);
    return true;
  }
  if (recordings_ == most_recordings) {
    ContextFreeDerivation<Drawing>(grammar_, steps_, false, job_, drawing_).run(kind, step);
  } else {
    drawing_.append_copy(draw(kind, step, here));
  }
  return true;
}

const Turtle::Recording& DrawingCache::draw(KindId kind, std::uint32_t step, Piece& piece) {
  ++recordings_;
  Turtle::Recording& recording = *piece.recordings.emplace_back(std::make_unique<Turtle::Recording>(job_));
  Drawing own(grammar_, params_, &recording.skeleton, context_);
  own.begin_recording(drawing_, recording);
  ContextFreeDerivation<Drawing>(grammar_, steps_, false, job_, own).run(kind, step);
  own.end_recording(recording);
  return recording;
}

}  // namespace seedmesh::lsystem

#include "core/generators/lsystem/shared_parts.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/generators/lsystem/build_model.h"
#include "core/generators/lsystem/context_free_derivation.h"
#include "core/generators/lsystem/drawing_cache.h"
#include "core/generators/lsystem/growth.h"
#include "core/generators/lsystem/shape.h"

namespace seedmesh::lsystem {
namespace {

// Constants, so that a model does not depend on the limits of the server.
constexpr std::uint64_t many_modules = 64'000'000, many_triangles = 40'000'000;
constexpr std::uint64_t most_places = 4'096;                                   ///< nodes of a core file
constexpr std::uint64_t least_part = 64, most_part = std::uint64_t{1} << 17U;  ///< modules
constexpr std::size_t most_parts = 64;

std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return std::min(saturated, a + b); }

/// Modules that each symbol derives to, and the number of parts in them, by number of steps.
class Sizes {
 public:
  Sizes(const Grammar& grammar, std::uint32_t steps) : grammar_(grammar), kinds_(grammar.kinds.size()) {
    modules_.assign((std::size_t{steps} + 1) * kinds_, 1);
    each_row(steps, [&](std::uint32_t left, KindId kind, Range successor) {
      std::uint64_t modules = 0;
      for (const Template& each : grammar_.successor(successor))
        modules = sum(modules, this->modules(each.kind, left - 1));
      modules_[left * kinds_ + kind] = modules;
    });
  }

  std::uint64_t modules(KindId kind, std::uint32_t left) const { return modules_[left * kinds_ + kind]; }

  /// The number of places of parts with at most `most` modules in the whole word.
  std::uint64_t places(std::uint32_t steps, std::uint64_t most) const {
    std::vector<std::uint64_t> places((std::size_t{steps} + 1) * kinds_, 0);
    const auto is_part = [&](KindId kind, std::uint32_t left) {
      return left > 0 && modules(kind, left) >= least_part && modules(kind, left) <= most;
    };
    each_row(steps, [&](std::uint32_t left, KindId kind, Range successor) {
      std::uint64_t own = 0;
      for (const Template& each : grammar_.successor(successor)) {
        own = sum(own, is_part(each.kind, left - 1) && grammar_.productions.rewrites(each.kind)
                           ? 1
                           : places[(left - 1) * kinds_ + each.kind]);
      }
      places[left * kinds_ + kind] = own;
    });
    std::uint64_t all = 0;
    for (const Template& each : grammar_.successor(grammar_.axiom)) {
      const bool is_one = is_part(each.kind, steps) && grammar_.productions.rewrites(each.kind);
      all = sum(all, is_one ? 1 : places[steps * kinds_ + each.kind]);
    }
    return all;
  }

 private:
  template <class Visit>
  void each_row(std::uint32_t steps, const Visit& visit) const {
    const Rules& rules = grammar_.productions;
    for (std::uint32_t left = 1; left <= steps; ++left) {
      for (std::size_t i = 0; i < kinds_; ++i) {
        const auto kind = static_cast<KindId>(i);
        if (rules.rewrites(kind)) visit(left, kind, rules.productions[rules.of_kind[kind].first].successor);
      }
    }
  }

  const Grammar& grammar_;
  std::size_t kinds_;
  std::vector<std::uint64_t> modules_;
};

/// The largest size of a part, as small as the number of places allows; 0: there is none.
std::uint64_t part_size(const Sizes& sizes, std::uint32_t steps) {
  for (std::uint64_t most = 4 * least_part; most <= most_part; most *= 2) {
    const std::uint64_t places = sizes.places(steps, most);
    if (places > 0 && places <= most_places) return most;
  }
  return 0;
}

/// Segments that each symbol draws by its interpretation.
std::vector<std::uint64_t> segments_by_kind(const Grammar& grammar, int depth) {
  const Rules& rules = grammar.interpretation;
  std::vector<std::uint64_t> own(grammar.kinds.size());
  for (std::size_t kind = 0; kind < own.size(); ++kind) {
    const Command command = grammar.kinds[kind].command;
    own[kind] = command == Command::draw || command == Command::draw_plain ? 1 : 0;
  }
  std::vector<std::uint64_t> segments = own, next = own;
  for (int step = 0; step < depth; ++step) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto kind = static_cast<KindId>(i);
      if (!rules.rewrites(kind)) continue;
      next[i] = 0;
      for (const Template& each : grammar.successor(rules.productions[rules.of_kind[kind].first].successor))
        next[i] = sum(next[i], segments[each.kind]);
    }
    segments = next;
  }
  return segments;
}

/// Is the whole drawing too large for one mesh?
bool is_large(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps) {
  constexpr int deepest = 16;
  const std::vector<std::uint64_t> counts = exact_counts(grammar, steps);
  const std::vector<std::uint64_t> drawn =
      segments_by_kind(grammar, std::min(params.interpretation_depth, deepest));
  double modules = 0, segments = 0;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    modules += static_cast<double>(counts[kind]);
    segments += static_cast<double>(counts[kind]) * static_cast<double>(drawn[kind]);
  }
  const bool has_tubes = params.style == LsystemParams::Style::tubes;
  const double elements = has_tubes ? 2.0 * params.sides * params.stacks : 1;
  return modules > static_cast<double>(many_modules) ||
         segments * elements > static_cast<double>(many_triangles);
}

Transform transform_of(const Turtle& turtle) {
  const Frame& frame = turtle.frame();
  Transform place;
  place.translation = glm::vec3(turtle.position()) + 0.0F;
  const glm::dquat turn = glm::quat_cast(glm::dmat3(-frame.left, frame.heading, frame.up));
  place.rotation = glm::quat(turn / std::sqrt(glm::dot(turn, turn)));
  return place;
}

/// A sink of ContextFreeDerivation that draws each part once and notes its places.
class SharedDrawing {
 public:
  struct Part {
    explicit Part(const Job& job) : recording(job) {}
    KindId kind = 0;
    std::uint32_t left = 0;
    Turtle::Recording recording;
    std::vector<Transform> transforms;
  };

  SharedDrawing(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps, Drawing& drawing,
                const GenerateContext& context, bool is_measured)
      : grammar_(grammar),
        params_(params),
        steps_(steps),
        drawing_(drawing),
        context_(context),
        is_measured_(is_measured),
        meter_(context.job, Resource::modules),
        sizes_(grammar, steps),
        most_(part_size(sizes_, steps)) {}

  void module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t step) {
    drawing_.module(kind, parameters, key, step);
  }

  bool replaces(KindId kind, std::uint32_t step) {
    const std::uint32_t left = steps_ - step;
    const std::uint64_t modules = sizes_.modules(kind, left);
    if (modules < least_part || modules > most_) return false;
    Part* part = nullptr;
    for (const auto& each : parts) {
      if (each->kind == kind && each->left == left && drawing_.matches(each->recording)) part = each.get();
    }
    if (part == nullptr && parts.size() == most_parts) return false;
    if (part == nullptr) {
      meter_.spend(modules);
      part = &draw(kind, step);
    }
    part->transforms.push_back(transform_of(drawing_.turtle()));
    drawing_.skip_copy(part->recording, is_measured_);
    return true;
  }

  std::vector<std::unique_ptr<Part>> parts;

 private:
  Part& draw(KindId kind, std::uint32_t step) {
    Part& part = *parts.emplace_back(std::make_unique<Part>(context_.job));
    part.kind = kind;
    part.left = steps_ - step;
    Drawing own(grammar_, params_, &part.recording.skeleton, context_);
    own.begin_recording(drawing_, part.recording);
    ContextFreeDerivation<Drawing>(grammar_, steps_, false, context_.job, own).run(kind, step);
    own.end_recording(part.recording);
    return part;
  }

  const Grammar& grammar_;
  const LsystemParams& params_;
  std::uint32_t steps_;
  Drawing& drawing_;
  const GenerateContext context_;
  bool is_measured_;
  Meter meter_;
  Sizes sizes_;
  std::uint64_t most_;
};

}  // namespace

bool has_shared_parts(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps,
                      const GenerateContext& context) {
  using Share = LsystemParams::Share;
  const bool has_own_widths = params.width_rule == LsystemParams::WidthRule::symbols ||
                              params.width_rule == LsystemParams::WidthRule::decrement;
  const Demand& demand = context.demand;
  const bool is_whole = demand.growth || demand.wind || demand.collision != CollisionNames::none ||
                        demand.copies == CopyForm::merge;
  if (params.share == Share::never || !has_own_widths || is_whole || params.weld || params.weather ||
      params.environment || params.age || !params.tropism.empty() || !params.contours.empty())
    return false;
  if (!DrawingCache::moves_rigidly(grammar, params, steps)) return false;
  if (params.share == Share::auto_ && !is_large(grammar, params, steps)) return false;
  return part_size(Sizes(grammar, steps), steps) > 0;
}

void warn_of_whole(const LsystemParams& params, std::vector<Warning>& warnings) {
  if (params.share == LsystemParams::Share::always) {
    warnings.push_back(
        {"/share", "has no effect: the system or the output does not allow shared parts", 0, 0});
  }
}

Model shared_model(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps,
                   const GenerateContext& context) {
  Job& job = context.job;
  Skeleton skeleton(job);
  Drawing drawing(grammar, params, &skeleton, context);
  SharedDrawing shared(grammar, params, steps, drawing, context, false);
  ContextFreeDerivation<SharedDrawing>(grammar, steps, false, job, shared).run();
  shape(skeleton, params, job);
  std::vector<SharedPart> parts;
  for (const auto& part : shared.parts) {
    shape(part->recording.skeleton, params, job);
    parts.push_back({&part->recording.skeleton, std::move(part->transforms)});
  }
  job.progress("mesh", 0);
  return build_model(std::move(skeleton), params, context, parts);
}

void measure_shared(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps,
                    Drawing& drawing, const GenerateContext& context) {
  SharedDrawing shared(grammar, params, steps, drawing, context, true);
  ContextFreeDerivation<SharedDrawing>(grammar, steps, false, context.job, shared).run();
}

}  // namespace seedmesh::lsystem

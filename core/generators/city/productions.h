#pragma once
/// The extended L-system of Parish and Mueller ("Procedural modeling of cities", 2001): productions over the
/// modules R (the tip of a road), B (a delayed branch) and I (the query that checks a road). Contexts only
/// link an R and the I that follows it. A word can therefore be split into short independent words (sites),
/// one for each tip.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/lang/expression.h"

namespace seedmesh::city {

enum class RoadState : std::uint8_t { unassigned = 0, succeed = 1, failed = 2 };

/// The parameters that the global goals give to the three successors of a road: straight on, left, right.
struct GlobalGoals {
  std::array<double, 3> delay = {-1, -1, -1};  ///< steps; negative: no successor
  std::array<double, 3> rule = {0, 0, 0};
  std::array<double, 3> road = {0, 0, 0};  ///< road numbers; the grammar does not interpret them
};

/// The functions that productions call for roads. The implementation numbers the roads. A production can compute
/// any number; a number without a road yields FAILED.
class RoadRules {
 public:
  virtual ~RoadRules() = default;
  /// Proposes the successors of a road that was built. `key` is that of the site.
  virtual GlobalGoals global_goals(double rule, double road, Rng key) = 0;
  /// Builds a road, adjusted to its surroundings, or refuses it.
  virtual RoadState local_constraints(double road) = 0;
  /// Returns the direction and the length of a road that was built, for the parameters of + and F.
  virtual std::array<double, 2> measure(double road) const = 0;
};

/// Compiled productions. Immutable; threads may share it.
class StreetGrammar {
 public:
  /// Reads the productions; errors have the pointer `pointer`/<index>, with line and column.
  StreetGrammar(const std::vector<std::string>& productions, const std::string& pointer,
                std::vector<Issue>& issues);

  /// A site where growth starts: R(delay, rule) I(road, UNASSIGNED).
  struct Start {
    double delay = 0, rule = 0, road = 0;
    std::uint64_t key = 0;
  };
  /// Rewrites all sites in the order of (step, key). Ends when none is left, after `most_steps` rewritings, or when
  /// there are far more rewritings or waiting sites than roads. Returns nullopt if all sites came to an end,
  /// otherwise the number of rewritings so far.
  std::optional<std::uint64_t> grow(const std::vector<Start>& starts, RoadRules& rules,
                                    std::uint64_t most_steps, const Job& job) const;

 private:
  struct Module {
    char symbol = 0;
    std::array<double, 3> value = {0, 0, 0};
  };
  struct Site {
    std::uint64_t step = 0, key = 0;
    std::vector<Module> word;
    bool operator>(const Site& other) const {
      return step != other.step ? step > other.step : key > other.key;
    }
  };
  struct MadeModule {
    char symbol = 0;
    std::vector<lang::Expression> arguments;
  };
  struct Production {
    char predecessor = 0, left = 0, right = 0;               ///< 0: no context
    std::uint32_t own = 0, left_count = 0, right_count = 0;  ///< parameter counts
    bool has_condition = false, asks_goals = false, asks_constraints = false;
    lang::Expression condition;
    lang::Expression goal_rule, goal_road, constraint_road;
    std::vector<MadeModule> successor;
  };
  class Reader;
  using Sites = std::priority_queue<Site, std::vector<Site>, std::greater<>>;
  const Production* matching(const Site& site, std::size_t at, std::vector<double>& slots) const;
  void rewrite(const Site& site, RoadRules& rules, Sites& sites) const;
  void apply(const Production& production, const Site& site, std::vector<double>& slots, RoadRules& rules,
             std::vector<Module>& made) const;

  lang::Program program_;
  std::vector<Production> productions_;
};

}  // namespace seedmesh::city

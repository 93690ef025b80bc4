#pragma once
/// Computes heights from an expression in the request (Kogovšek 2014, sections 5.3.4 and 6). The language is that of
/// docs/expressions.md plus noise functions of a position.
#include <string>
#include <string_view>
#include <vector>

#include "core/generators/terrain/noise.h"
#include "core/lang/rows.h"

namespace seedmesh::terrain {

/// One expression with its noise calls, compiled. The noise functions are noise(x, y) or noise(x, y, z), and fbm,
/// ridged and billow, whose last argument is a constant number of octaves. Calls with the same arguments have the
/// same value everywhere in one layer.
class HeightExpression {
 public:
  /// Parses `text`, which may use `names`. All their slots must be less than `slots`. Adds the errors of the text.
  HeightExpression(std::string_view text, lang::Names names, std::uint32_t slots,
                   std::vector<lang::TextError>& errors);
  HeightExpression(const HeightExpression&) = delete;
  HeightExpression& operator=(const HeightExpression&) = delete;

  bool draws() const;                      ///< uses random numbers
  bool uses(std::string_view name) const;  ///< the name occurs in the text

 private:
  friend class HeightRows;
  /// A noise function at a position of two or three coordinates. Its value is in a slot behind those of the names.
  struct NoiseCall {
    NoiseKind kind = NoiseKind::rolling;
    int octaves = 1;
    std::vector<lang::Expression> position;
  };
  struct Source;

  void take_noise_calls(Source& source);
  bool take_call(Source& source, std::size_t at);
  bool check_call(Source& source, std::size_t at, std::vector<lang::Expression> arguments);

  lang::Program program_;
  lang::Expression height_;
  std::vector<NoiseCall> calls_;  ///< calls in the order of their slots; each uses only calls before it
  std::vector<std::string> used_;
  std::uint32_t slots_;
};

/// Evaluates one expression over rows of cells, on one thread. The expression has to outlive it.
class HeightRows {
 public:
  HeightRows(const HeightExpression& expression, Rng noise);

  /// Does the same as lang::RowEvaluator::run(). `slots` has a row for each slot of the names in use.
  void run(std::span<const double* const> slots, std::size_t count, std::span<Rng> rngs, double* out);

 private:
  struct Noise {
    NoisePlan plan;
    std::vector<lang::RowEvaluator> position;
    std::vector<double> value;
  };
  void fill(Noise& noise, std::size_t count, std::span<Rng> rngs);

  const HeightExpression& expression_;
  Rng noise_;
  std::vector<Noise> calls_;
  lang::RowEvaluator height_;
  std::vector<const double*> rows_;
  std::vector<double> coordinates_;
};

/// Returns the error about a name that other expressions of terrains have. `behind` begins with an unknown name; the
/// result is empty for names that no expression has.
std::string error_about_name(std::string_view behind, bool is_plane);

}  // namespace seedmesh::terrain

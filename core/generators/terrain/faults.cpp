#include "core/generators/terrain/faults.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 32;
// Heights are whole multiples of this, in metres: about a micrometre.
constexpr double grain = 0x1p-20;
// Entries of the table of the cosine step. Linear interpolation between them has an error below 1e-6.
constexpr std::size_t table_size = 1024;

/// One line. Samples with x * nx + z * nz > offset (in samples) are raised.
struct Fault {
  double nx = 1, nz = 0, offset = 0;
  std::int64_t below = 0, above = 0;  ///< grains added on each side
};

std::vector<Fault> drawn_faults(const FaultPlan& plan, const Window& world, Rng rng) {
  std::vector<Fault> faults(static_cast<std::size_t>(plan.planned + plan.extra));
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Rng line = rng.at("line").at(i);
    Fault& fault = faults[i];
    const math::SinCos direction = math::sincos(line.uniform(0, 2 * math::pi));
    const double x = line.uniform(0, world.width - 1), z = line.uniform(0, world.depth - 1);
    fault.nx = direction.cos;
    fault.nz = direction.sin;
    fault.offset = direction.cos * (static_cast<double>(world.x) + x) +
                   direction.sin * (static_cast<double>(world.z) + z);
    const std::int64_t height =
        math::to_int64(std::floor(fault_height(plan, static_cast<int>(i), rng) / grain));
    fault.above = height;
    fault.below = plan.kind == FaultKind::normal ? -height : 0;
  }
  return faults;
}

std::array<float, table_size + 1> cosine_table() {
  std::array<float, table_size + 1> table{};
  for (std::size_t i = 0; i <= table_size; ++i)
    table[i] = static_cast<float>(0.5 - 0.5 * math::cos(math::pi * static_cast<double>(i) / table_size));
  return table;
}

/// Adds faults to one row of samples that starts at column `left` of row `z` of the world.
class Row {
 public:
  Row(const FaultPlan& plan, double slope_samples, const std::array<float, table_size + 1>& table,
      std::size_t width)
      : plan_(plan), slope_(slope_samples), table_(table), jumps_(width + 1) {}

  void sum(const std::vector<Fault>& faults, std::int64_t left, std::int64_t z, float* out) {
    std::fill(jumps_.begin(), jumps_.end(), 0);
    for (const Fault& fault : faults) add(fault, left, z);
    std::int64_t height = 0;
    for (std::size_t x = 0; x + 1 < jumps_.size(); ++x) {
      height += jumps_[x];
      out[x] = static_cast<float>(static_cast<double>(height) * grain);
    }
  }

 private:
  /// Returns the first sample of the row at which x * nx exceeds `limit`, for nx > 0. The position is computed
  /// in the world and clamped to the row.
  std::size_t crossing(double nx, double limit, std::int64_t left) const {
    const double first = std::floor(limit / nx) + 1 - static_cast<double>(left);
    return static_cast<std::size_t>(std::clamp(first, 0.0, static_cast<double>(jumps_.size() - 1)));
  }
  void jump(std::size_t at, std::int64_t by) { jumps_[at] += by; }

  void add(const Fault& fault, std::int64_t left, std::int64_t z) {
    const double rest = fault.offset - fault.nz * static_cast<double>(z);
    const double half = plan_.step == FaultStep::hard ? 0 : slope_ / 2;
    if (std::abs(fault.nx) < 1e-9) {  // the line is parallel to the row
      jump(0, height_at(fault, -rest, half));
      return;
    }
    // From the end with the smallest distance, a row is below the fault, then in its slope, then above it.
    const bool rising = fault.nx > 0;
    const double nx = std::abs(fault.nx);
    // For a decreasing distance, use mirrored columns: x' = -x.
    std::size_t enters = 0, leaves = 0;
    if (rising) {
      enters = crossing(nx, rest - half, left);
      leaves = crossing(nx, rest + half, left);
    } else {
      leaves = mirrored(nx, rest - half, left);
      enters = mirrored(nx, rest + half, left);
    }
    jump(0, rising ? fault.below : fault.above);
    const std::int64_t before = rising ? fault.below : fault.above,
                       after = rising ? fault.above : fault.below;
    std::int64_t last = before;
    for (std::size_t x = enters; x < leaves; ++x) {
      const double distance = static_cast<double>(left + static_cast<std::int64_t>(x)) * fault.nx - rest;
      const std::int64_t height = height_at(fault, distance, half);
      jump(x, height - last);
      last = height;
    }
    jump(leaves, after - last);
  }

  /// Returns the first sample at which -x * nx is at most `limit`.
  std::size_t mirrored(double nx, double limit, std::int64_t left) const {
    const double first = std::ceil(-limit / nx) - static_cast<double>(left);
    return static_cast<std::size_t>(std::clamp(first, 0.0, static_cast<double>(jumps_.size() - 1)));
  }

  std::int64_t height_at(const Fault& fault, double distance, double half) const {
    if (distance > half) return fault.above;
    if (half <= 0 || distance <= -half) return fault.below;
    double t = (distance + half) / (2 * half);
    if (plan_.step == FaultStep::cosine) {
      const double position = t * table_size;
      const auto index = std::min(static_cast<std::size_t>(std::max(position, 0.0)), table_size - 1);
      t = table_[index] +
          (position - static_cast<double>(index)) * (static_cast<double>(table_[index + 1]) - table_[index]);
    }
    return fault.below + math::to_int64(std::floor(static_cast<double>(fault.above - fault.below) * t));
  }

  const FaultPlan& plan_;
  double slope_;
  const std::array<float, table_size + 1>& table_;
  std::vector<std::int64_t> jumps_;
};

}  // namespace

double fault_bound(double greatest, double least, int i, int n) {
  return greatest - (greatest - least) * i / n;
}

double fault_height(const FaultPlan& plan, int i, Rng rng) {
  Rng draw = rng.at("height").at(static_cast<std::uint64_t>(i));
  const double bound =
      i < plan.planned ? fault_bound(plan.greatest, plan.least, i, plan.planned) : plan.greatest;
  return plan.kind == FaultKind::one_sided ? draw.uniform(0, bound) : normal(draw, 0, bound);
}

Field faulted(const FaultPlan& plan, const Window& world, const Window& window, double cell, Rng rng,
              const Job& job) {
  const std::vector<Fault> faults = drawn_faults(plan, world, rng);
  const std::array<float, table_size + 1> table = cosine_table();
  Field field(job, window.width, window.depth, 0);
  parallel_for(job, static_cast<std::size_t>(window.depth), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 Row row(plan, plan.width / cell, table, static_cast<std::size_t>(window.width));
                 for (std::size_t z = begin; z < end; ++z) {
                   job.check();
                   row.sum(faults, window.x, window.z + static_cast<std::int64_t>(z),
                           field.row(static_cast<std::int32_t>(z)));
                 }
               });
  return field;
}

}  // namespace seedmesh::terrain

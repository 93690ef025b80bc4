#include "core/generators/fractal/escape.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/generators/fractal/element.h"
#include "core/model/empty_mesh.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {
namespace {

constexpr double far =
    1e6;  ///< squared distance at which a point has left; large, so that fractions are smooth

constexpr int lanes = 16;         ///< points that are iterated together
constexpr int steps_a_look = 16;  ///< steps between two tests whether all points have left

/// z and c of some points, and how many steps they have made. A point that has left stays where it is.
struct Orbits {
  double zr[lanes], zi[lanes], cr[lanes], ci[lanes], steps[lanes];
};

/// Iterates until every point has left or made `limit` steps.
SEEDMESH_WIDE void iterate(Orbits& orbits, int limit) {
  for (int step = 0; step < limit; step += steps_a_look) {
    const int last = std::min(steps_a_look, limit - step);
    for (int i = 0; i < last; ++i) {
      for (int k = 0; k < lanes; ++k) {
        const double rr = orbits.zr[k] * orbits.zr[k], ii = orbits.zi[k] * orbits.zi[k];
        const double next_i = 2 * orbits.zr[k] * orbits.zi[k] + orbits.ci[k], next_r = rr - ii + orbits.cr[k];
        const bool has_left = rr + ii > far;
        orbits.zi[k] = has_left ? orbits.zi[k] : next_i;
        orbits.zr[k] = has_left ? orbits.zr[k] : next_r;
        orbits.steps[k] += has_left ? 0.0 : 1.0;
      }
    }
    int gone = 0;
    for (int k = 0; k < lanes; ++k)
      gone += orbits.zr[k] * orbits.zr[k] + orbits.zi[k] * orbits.zi[k] > far ? 1 : 0;
    if (gone == lanes) return;
  }
}

/// The logarithms that all points need.
struct Scale {
  explicit Scale(int step_limit)
      : limit(step_limit),
        log_far(math::log(far)),
        log_two(math::log(2.0)),
        log_limit(math::log(std::max(limit, 2.0))) {}
  double limit, log_far, log_two, log_limit;
};

/// Steps until z leaves, with a fraction, on a logarithmic scale from 0 to 0.999; 1 where it does not leave.
double value_of(const Orbits& orbits, int lane, const Scale& scale) {
  const double norm = orbits.zr[lane] * orbits.zr[lane] + orbits.zi[lane] * orbits.zi[lane];
  if (orbits.steps[lane] >= scale.limit) return 1;
  const double steps = orbits.steps[lane] + 1 - math::log(math::log(norm) / scale.log_far) / scale.log_two;
  return std::min(math::log(std::clamp(steps, 1.0, scale.limit)) / scale.log_limit, 0.999);
}

/// Builds the plate: the relief, four walls and the underside, each with its own vertices.
class Plate {
 public:
  Plate(const FractalParams& params, const EscapeField& field, Job& job)
      : params_(params), field_(field), n_(field.side), step_(params.size / (n_ - 1)) {
    const std::size_t n = n_, rim = 4 * (n - 1);
    job.spend(Resource::triangles, 2 * (n - 1) * (n - 1) + 3 * rim);
    const std::size_t vertices = n * n + 8 * n + rim + 1;
    mesh_ = empty_mesh(job);
    mesh_.color = Array<glm::u8vec4>(job);
    mesh_.position.reserve(vertices);
    mesh_.normal.reserve(vertices);
    mesh_.color.reserve(vertices);
    mesh_.index.wide.reserve(3 * (2 * (n - 1) * (n - 1) + 3 * rim));
    add_top(job);
    add_walls();
    add_underside();
  }

  Mesh take() { return std::move(mesh_); }

 private:
  float height(std::uint32_t i, std::uint32_t j) const {
    return static_cast<float>(params_.size * params_.escape.relief) * field_.value[j * n_ + i];
  }
  glm::vec3 at(std::uint32_t i, std::uint32_t j, float y) const {
    return {static_cast<float>(step_ * i - params_.size / 2), y,
            static_cast<float>(step_ * j - params_.size / 2)};
  }
  float underside() const { return static_cast<float>(-params_.size * params_.escape.plate); }

  glm::u8vec4 color(float value) const {
    const Color paint = escape_color(params_, value);
    return linear_color(paint.red, paint.green, paint.blue);
  }

  void add(const glm::vec3& p, const glm::vec3& normal, const glm::u8vec4& paint) {
    mesh_.position.push_back(p);
    mesh_.normal.push_back(normal);
    mesh_.color.push_back(paint);
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t each : {a, b, c}) mesh_.index.wide.push_back(each);
  }

  /// The mean normal of the faces around a sample, weighted by area; +Y if that would face away from one of
  /// them.
  glm::vec3 normal(std::uint32_t i, std::uint32_t j) const {
    glm::dvec3 faces[6];
    int count = 0;
    const auto add_face = [&](int i0, int j0, int i1, int j1, int i2, int j2) {
      const glm::dvec3 a(sample(i0, j0)), b(sample(i1, j1)), c(sample(i2, j2));
      faces[count++] = glm::cross(b - a, c - a);
    };
    const int x = static_cast<int>(i), z = static_cast<int>(j), last = static_cast<int>(n_) - 1;
    if (x < last && z < last) add_face(x, z, x, z + 1, x + 1, z);
    if (x > 0 && z < last) {
      add_face(x - 1, z, x - 1, z + 1, x, z);
      add_face(x, z, x - 1, z + 1, x, z + 1);
    }
    if (x < last && z > 0) {
      add_face(x, z - 1, x, z, x + 1, z - 1);
      add_face(x + 1, z - 1, x, z, x + 1, z);
    }
    if (x > 0 && z > 0) add_face(x, z - 1, x - 1, z, x, z);
    glm::dvec3 sum(0);
    for (int f = 0; f < count; ++f) sum += faces[f];
    for (int f = 0; f < count; ++f) {
      if (glm::dot(sum, faces[f]) <= 0.01 * glm::length(sum) * glm::length(faces[f])) return {0, 1, 0};
    }
    return glm::vec3(math::unit(sum, {0, 1, 0}));
  }

  glm::vec3 sample(int i, int j) const {
    const auto x = static_cast<std::uint32_t>(i), z = static_cast<std::uint32_t>(j);
    return at(x, z, height(x, z));
  }

  void add_top(const Job& job) {
    for (std::uint32_t j = 0; j < n_; ++j) {
      job.check();
      for (std::uint32_t i = 0; i < n_; ++i) {
        add(at(i, j, height(i, j)), normal(i, j), color(field_.value[j * n_ + i]));
      }
    }
    for (std::uint32_t j = 0; j + 1 < n_; ++j) {
      for (std::uint32_t i = 0; i + 1 < n_; ++i) {
        const std::uint32_t a = j * n_ + i, b = a + 1, c = a + n_, d = c + 1;
        add_triangle(a, c, b);
        add_triangle(b, c, d);
      }
    }
  }

  /// The sample (i, j) at `step` of the 4 * (n - 1) steps around the boundary, counter-clockwise from above.
  glm::uvec2 rim(std::uint32_t step) const {
    const std::uint32_t last = n_ - 1, along = step % last;
    switch (step / last % 4) {
      case 0:
        return {along, last};
      case 1:
        return {last, last - along};
      case 2:
        return {last - along, 0};
      default:
        return {0, along};
    }
  }

  void add_walls() {
    constexpr glm::vec3 outward[] = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}};
    const glm::u8vec4 paint = color(0);
    for (std::uint32_t side = 0; side < 4; ++side) {
      const auto first = static_cast<std::uint32_t>(mesh_.position.size());
      for (std::uint32_t step = 0; step < n_; ++step) {
        const glm::uvec2 c = rim(side * (n_ - 1) + step);
        const glm::uvec2 end = step + 1 == n_ ? rim((side + 1) * (n_ - 1)) : c;
        add(at(end.x, end.y, underside()), outward[side], paint);
        add(at(end.x, end.y, height(end.x, end.y)), outward[side], paint);
      }
      for (std::uint32_t step = 0; step + 1 < n_; ++step) {
        const std::uint32_t a = first + 2 * step;
        add_triangle(a, a + 2, a + 3);
        add_triangle(a, a + 3, a + 1);
      }
    }
  }

  void add_underside() {
    const auto centre = static_cast<std::uint32_t>(mesh_.position.size());
    const std::uint32_t steps = 4 * (n_ - 1);
    add({0, underside(), 0}, {0, -1, 0}, color(0));
    for (std::uint32_t step = 0; step < steps; ++step) {
      const glm::uvec2 c = rim(step);
      add(at(c.x, c.y, underside()), {0, -1, 0}, color(0));
    }
    for (std::uint32_t step = 0; step < steps; ++step)
      add_triangle(centre, centre + 1 + (step + 1) % steps, centre + 1 + step);
  }

  const FractalParams& params_;
  const EscapeField& field_;
  std::uint32_t n_;
  double step_;
  Mesh mesh_;
};

}  // namespace

Color escape_color(const FractalParams& params, float value) {
  if (value >= 1) return {24, 24, 28};
  const std::vector<Color>& palette = params.palette;
  const double place = std::sqrt(static_cast<double>(value)) * static_cast<double>(palette.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const Color& a = palette[low];
  const Color& b = palette[std::min(low + 1, palette.size() - 1)];
  const double part = place - static_cast<double>(low);
  const auto mixed = [part](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(from * (1 - part) + to * part + 0.5);
  };
  return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

EscapeField escape_field(const FractalParams& params, Job& job) {
  const auto& window = params.escape;
  const auto side = static_cast<std::uint32_t>(window.resolution);
  EscapeField field{side, Array<float>(job, std::size_t{side} * side)};
  const double step = window.span / (side - 1), top = window.center[1] + window.span / 2,
               left = window.center[0] - window.span / 2;
  const bool julia = window.set == FractalSet::julia;
  const Scale scale(window.limit);
  parallel_for(job, side, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t j = begin; j < end; ++j) {
      const double im = top - step * static_cast<double>(j);
      for (std::uint32_t i = 0; i < side; i += lanes) {
        job.check();
        Orbits orbits{};
        for (std::uint32_t k = 0; k < lanes; ++k) {
          const double re = left + step * std::min(i + k, side - 1);
          orbits.zr[k] = julia ? re : 0;
          orbits.zi[k] = julia ? im : 0;
          orbits.cr[k] = julia ? window.constant[0] : re;
          orbits.ci[k] = julia ? window.constant[1] : im;
        }
        iterate(orbits, window.limit);
        for (std::uint32_t k = 0; k < lanes && i + k < side; ++k)
          field.value[j * side + i + k] = static_cast<float>(value_of(orbits, static_cast<int>(k), scale));
      }
    }
  });
  return field;
}

Mesh escape_plate(const FractalParams& params, const EscapeField& field, Job& job) {
  return Plate(params, field, job).take();
}

}  // namespace seedmesh::fractal

#include "core/render/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/render/holes.h"

namespace seedmesh::render {
namespace {

constexpr std::uint32_t most_bands = 8;
constexpr std::size_t check_every = 8'192;  ///< triangles

/// Which triangles of a drawing are left out.
enum class Sides { both, front, front_of_mirrored };

/// A run of triangles.
struct Run {
  float depth;  ///< of its nearest vertex
  std::uint32_t begin, end;
};

/// The triangles of a drawing in short runs, the nearest first, so that most of what is hidden is drawn last. Neighbours
/// stay together.
std::vector<Run> runs_of(const Shown& shown, const Drawing& drawing, std::uint32_t count) {
  constexpr std::uint32_t length = 64, worth_sorting = 512;
  if (count < worth_sorting || shown.vertices.empty()) return {{0, 0, count}};
  std::vector<Run> runs;
  const Projected* const vertices = shown.vertices.data() + drawing.first;
  for (std::uint32_t begin = 0; begin < count; begin += length) {
    Run run{-std::numeric_limits<float>::max(), begin, std::min(begin + length, count)};
    for (std::size_t i = std::size_t{3} * run.begin; i < std::size_t{3} * run.end; ++i)
      run.depth = std::max(run.depth, vertices[drawing.mesh->index.at(i)].depth);
    runs.push_back(run);
  }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
    return a.depth != b.depth ? a.depth > b.depth : a.begin < b.begin;
  });
  return runs;
}

/// Takes the corners of a triangle. False: it covers no sample of the rows, or is left out.
bool take(Triangle& t, const Shown& shown, const Drawing& drawing, const Lens& lens, Sides sides,
          const Rows& rows) {
  Cover& c = t.cover;
  for (std::size_t i = 0; i < 3; ++i) {
    t.vertex[i] = drawing.mesh->index.at(std::size_t{3} * t.number + i);
    const Projected p = shown.vertex(drawing, lens, t.vertex[i]);
    c.x[i] = p.x;
    c.y[i] = p.y;
    t.depth[i] = p.depth;
  }
  if (!set_box(c, static_cast<std::int32_t>(shown.eye.size()), rows)) return false;
  c.area = (std::int64_t{c.x[1]} - c.x[0]) * (std::int64_t{c.y[2]} - c.y[0]) -
           (std::int64_t{c.y[1]} - c.y[0]) * (std::int64_t{c.x[2]} - c.x[0]);
  if (c.area == 0 || (sides != Sides::both && (c.area > 0) != (sides == Sides::front_of_mirrored)))
    return false;
  if (c.area < 0) {
    std::swap(t.vertex[1], t.vertex[2]);
    std::swap(c.x[1], c.x[2]);
    std::swap(c.y[1], c.y[2]);
    std::swap(t.depth[1], t.depth[2]);
    c.area = -c.area;
  }
  set_edges(c);
  return true;
}

/// Calls visit(triangle) for each triangle that covers a sample of the rows and is not left out.
template <class Visit>
void each_triangle(const Shown& shown, const Drawing& drawing, Sides sides, const Rows& rows, const Job& job,
                   const Visit& visit) {
  const Lens lens = shown.vertices.empty() ? shown.lens_of(drawing) : Lens{};
  const auto count = static_cast<std::uint32_t>(drawing.mesh->index.size() / 3);
  const bool is_ordered = shown.scene.surfaces[drawing.surface].blends;
  Triangle t;
  for (const Run& run : is_ordered ? std::vector<Run>{{0, 0, count}} : runs_of(shown, drawing, count)) {
    job.check();
    for (t.number = run.begin; t.number < run.end; ++t.number) {
      if ((t.number + 1) % check_every == 0) job.check();
      if (take(t, shown, drawing, lens, sides, rows)) visit(t);
    }
  }
}

FourFloats load(const float* from) {
  FourFloats out;
  std::memcpy(&out, from, sizeof(out));
  return out;
}
template <class Four>
void store(const Four& four, void* to) {
  std::memcpy(to, &four, sizeof(four));
}
void choose(FourFlags flags, std::uint32_t value, std::uint32_t* in) {
  FourFlags held;
  std::memcpy(&held, in, sizeof(held));
  store(chosen(flags, four_flags(static_cast<std::int32_t>(value)), held), in);
}

/// Calls visit(index of the first, passed, depth) for each four samples where the triangle is nearer than what is held.
template <class Visit>
void each_nearer(const Triangle& t, const Surface& surface, const Array<glm::vec2>* uv, const Shown& shown,
                 const Rows& rows, const float* held, const Visit& visit) {
  const std::uint32_t size = shown.eye.size();
  const std::size_t stride = stride_of(size);
  const auto [least, greatest] = std::minmax({t.depth[0], t.depth[1], t.depth[2]});
  const FourFloats low = all_lanes(least), high = all_lanes(greatest);
  const Plane plane = t.cover.plane(static_cast<double>(t.depth[0]), static_cast<double>(t.depth[1]),
                                    static_cast<double>(t.depth[2]));
  const auto scan = [&](const auto& filled) {
    each_four(t.cover, static_cast<std::int32_t>(size), rows,
              [&](std::int32_t x, std::int32_t y, FourFlags inside, FourFloats across, float down) {
                const std::size_t at = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
                FourFloats depth = plane.of(across, down);
                depth = chosen(depth > low, depth, low);
                depth = chosen(depth < high, depth, high);
                FourFlags passed = inside & (depth > load(held + at));
                if (!any_of(passed)) return;
                passed = filled(passed, depth, across, down);
                visit(at, passed, depth);
              });
  };
  if (!uv) return scan([](FourFlags passed, FourFloats, FourFloats, float) { return passed; });
  const Holes holes(surface, *uv, t, shown.eye.is_perspective());
  scan([&holes](FourFlags passed, FourFloats depth, FourFloats across, float down) {
    return passed & holes.filled(depth, across, down);
  });
}

/// Draws into the rows of one band.
class Band {
 public:
  Band(const Shown& shown, const Rows& rows, const Job& job) : shown_(shown), rows_(rows), job_(job) {}

  void draw_samples(Samples& samples) {
    for (const bool blending : {false, true}) {
      if (blending && !shown_.scene.has_blending) return;
      each_drawing(blending, [&](std::uint32_t number, const Drawing& drawing, const Surface& surface) {
        if (drawing.mesh->topology != Topology::triangles) return draw_thin(number, drawing, samples);
        if (blending) return draw_sheet(number, drawing, surface, samples);
        draw_mesh(number, drawing, surface, samples);
      });
    }
  }

  void draw_depths(Array<float>& map) {
    each_drawing(false, [&](std::uint32_t, const Drawing& drawing, const Surface& surface) {
      if (drawing.mesh->topology != Topology::triangles) return;
      const Array<glm::vec2>* uv = holes_of(*drawing.mesh, surface);
      each_triangle(shown_, drawing, sides_of(drawing, surface), rows_, job_, [&](const Triangle& t) {
        each_nearer(t, surface, uv, shown_, rows_, map.data(),
                    [&](std::size_t at, FourFlags passed, FourFloats depth) {
                      store(chosen(passed, depth, load(&map[at])), &map[at]);
                    });
      });
    });
  }

 private:
  template <class Draw>
  void each_drawing(bool blending, const Draw& draw) {
    const Array<Drawing>& drawings = shown_.scene.drawings;
    for (std::uint32_t i = 0; i < drawings.size(); ++i) {
      const Surface& surface = shown_.scene.surfaces[drawings[i].surface];
      if (surface.blends == blending && touches(drawings[i])) draw(i, drawings[i], surface);
    }
  }

  /// Whether a drawing may touch the rows.
  bool touches(const Drawing& drawing) const {
    if (rows_.begin == 0 && rows_.end >= static_cast<std::int32_t>(shown_.eye.size())) return true;
    const Item& item = shown_.scene.items.list[drawing.item];
    const Box& box = shown_.scene.items.boxes[item.group];
    const Lens lens = shown_.eye.lens_at(item.at);
    std::int32_t top = std::numeric_limits<std::int32_t>::max(),
                 bottom = std::numeric_limits<std::int32_t>::min();
    for (int corner = 0; corner < 8; ++corner) {
      const std::int32_t y = lens(corner_of(box, corner)).y;
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
    constexpr std::int32_t edge = 2 * fixed_one;
    return bottom + edge >= rows_.begin * fixed_one && top - edge <= rows_.end * fixed_one;
  }

  static const Array<glm::vec2>* holes_of(const Mesh& mesh, const Surface& surface) {
    return surface.texels && surface.texels->has_holes() ? uv_of(mesh, surface) : nullptr;
  }

  Sides sides_of(const Drawing& drawing, const Surface& surface) const {
    if (surface.both_sides || surface.blends) return Sides::both;
    // The rows of a map run upwards, those of pictures downwards.
    const bool is_map = !shown_.eye.is_perspective();
    return is_mirrored(shown_.scene.items.list[drawing.item].at) != is_map ? Sides::front_of_mirrored
                                                                           : Sides::front;
  }

  void draw_mesh(std::uint32_t number, const Drawing& drawing, const Surface& surface, Samples& samples) {
    const Array<glm::vec2>* uv = holes_of(*drawing.mesh, surface);
    each_triangle(shown_, drawing, sides_of(drawing, surface), rows_, job_, [&](const Triangle& t) {
      each_nearer(t, surface, uv, shown_, rows_, samples.near.data(),
                  [&](std::size_t at, FourFlags passed, FourFloats depth) {
                    store(chosen(passed, depth, load(&samples.near[at])), &samples.near[at]);
                    choose(passed, number, &samples.drawing[at]);
                    choose(passed, t.number, &samples.number[at]);
                  });
    });
  }

  /// Sheets that blend leave the depth of what is behind them.
  void draw_sheet(std::uint32_t number, const Drawing& drawing, const Surface& surface, Samples& samples) {
    const Array<glm::vec2>* uv = holes_of(*drawing.mesh, surface);
    FragmentReader front(shown_), behind(shown_);
    each_triangle(shown_, drawing, Sides::both, rows_, job_, [&](const Triangle& t) {
      each_nearer(t, surface, uv, shown_, rows_, samples.near.data(),
                  [&](std::size_t at, FourFlags passed, FourFloats) {
                    for (std::size_t lane = 0; lane < 4; ++lane) {
                      const std::size_t column = at % samples.stride + lane, row = at / samples.stride;
                      if (passed[static_cast<int>(lane)] == 0 || column >= samples.size) continue;
                      const float x = (static_cast<float>(column) + 0.5F) * fixed_one,
                                  y = (static_cast<float>(row) + 0.5F) * fixed_one;
                      const Fragment next = front.at(number, t.number, x, y);
                      blend(next, at + lane, samples, [&](std::uint32_t drawn, std::uint32_t triangle) {
                        return behind.at(drawn, triangle, x, y);
                      });
                    }
                  });
    });
  }

  template <class Read>
  static void blend(const Fragment& next, std::size_t at, Samples& samples, const Read& read) {
    Fragment& held = samples.fragment[at];
    const std::uint32_t drawn = samples.drawing[at];
    samples.drawing[at] = Samples::blended;
    if (drawn == Samples::nothing) {
      held = next;
      samples.near[at] = next.near;
      return;
    }
    if (drawn != Samples::blended) {
      held = read(drawn, samples.number[at]);
      held.near = samples.near[at];
    }
    held.color = held.color * (1 - next.alpha) + next.color * next.alpha;
    if (next.alpha < 0.5F) return;
    held.normal = next.normal;
    held.surface = next.surface;
  }

  /// Lines and points, three samples thick.
  void draw_thin(std::uint32_t number, const Drawing& drawing, Samples& samples) {
    const Lens lens = shown_.lens_of(drawing);
    const Mesh& mesh = *drawing.mesh;
    const auto size = static_cast<std::int32_t>(samples.size);
    const auto dot = [&](std::int64_t px, std::int64_t py, float depth, std::uint32_t vertex) {
      for (std::int64_t y = py / fixed_one - 1; y <= py / fixed_one + 1; ++y) {
        for (std::int64_t x = px / fixed_one - 1; x <= px / fixed_one + 1; ++x) {
          if (x < 0 || x >= size || y < rows_.begin || y >= rows_.end) continue;
          const std::size_t at = samples.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
          if (depth <= samples.near[at]) continue;
          samples.near[at] = depth;
          samples.drawing[at] = number;
          samples.number[at] = vertex;
        }
      }
    };
    if (mesh.topology == Topology::points) {
      for (std::uint32_t i = 0; i < mesh.position.size(); ++i) {
        if (i % check_every == 0) job_.check();
        const Projected p = shown_.vertex(drawing, lens, i);
        dot(p.x, p.y, p.depth, i);
      }
      return;
    }
    for (std::size_t i = 0; i + 1 < mesh.index.size(); i += 2) {
      if (i % check_every == 0) job_.check();
      const Projected a = shown_.vertex(drawing, lens, mesh.index.at(i)),
                      b = shown_.vertex(drawing, lens, mesh.index.at(i + 1));
      const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
      const std::int64_t steps =
          std::max({std::abs(dx), std::abs(dy), std::int64_t{fixed_one}}) / std::int64_t{fixed_one};
      // A line that leaves the picture by far is cut off.
      for (std::int64_t step = 0; step <= std::min<std::int64_t>(steps, std::int64_t{8} * size); ++step) {
        const float share = static_cast<float>(step) / static_cast<float>(steps);
        dot(a.x + dx * step / steps, a.y + dy * step / steps, a.depth + (b.depth - a.depth) * share,
            mesh.index.at(i));
      }
    }
  }

  const Shown& shown_;
  Rows rows_;
  const Job& job_;
};

SEEDMESH_WIDE void draw_samples_of(Band& band, Samples& samples) { band.draw_samples(samples); }
SEEDMESH_WIDE void draw_depths_of(Band& band, Array<float>& map) { band.draw_depths(map); }

/// Calls draw(band) for all bands in parallel.
template <class Draw>
void each_band(const Shown& shown, const Job& job, const Draw& draw) {
  const std::uint32_t bands = has_threads(job) ? most_bands : 1, size = shown.eye.size();
  const std::uint32_t height = (size + bands - 1) / bands;
  parallel_for(job, bands, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto first = static_cast<std::uint32_t>(i) * height;
      Band band(shown,
                {static_cast<std::int32_t>(first), static_cast<std::int32_t>(std::min(first + height, size))},
                job);
      draw(band);
    }
  });
}

}  // namespace

Samples draw_samples(const Shown& shown, const Job& job) {
  const std::uint32_t size = shown.eye.size();
  const std::size_t count = stride_of(size) * size;
  Samples samples{size,
                  stride_of(size),
                  Array<float>(job, count, 0.0F),
                  Array<std::uint32_t>(job, count, Samples::nothing),
                  Array<std::uint32_t>(job, count),
                  Array<Fragment>(job)};
  if (shown.scene.has_blending) samples.fragment.resize(count);
  // `number` has no value where nothing is drawn.
  std::memset(samples.number.data(), 0, samples.number.bytes());
  each_band(shown, job, [&](Band& band) { draw_samples_of(band, samples); });
  return samples;
}

Array<float> draw_depths(const Shown& shown, float farthest, const Job& job) {
  Array<float> map(job, stride_of(shown.eye.size()) * shown.eye.size(), farthest);
  each_band(shown, job, [&](Band& band) { draw_depths_of(band, map); });
  return map;
}

}  // namespace seedmesh::render

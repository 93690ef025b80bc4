#include "core/render/samples.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/render/holes.h"

namespace seedmesh::render {
namespace {

constexpr std::uint32_t rows_of_band = 64;  ///< of which the samples fit into the cache of a core
constexpr std::size_t check_every = 8'192;  ///< triangles

Floats load(const float* from) {
  Floats out;
  std::memcpy(&out, from, sizeof(out));
  return out;
}
template <class Lanes>
void store(const Lanes& values, void* to) {
  std::memcpy(to, &values, sizeof(values));
}
void choose(Flags flags, std::uint32_t value, std::uint32_t* in) {
  Flags held;
  std::memcpy(&held, in, sizeof(held));
  store(chosen(flags, all_lanes(static_cast<std::int32_t>(value)), held), in);
}

/// Draws into the rows of one band.
class Band {
 public:
  Band(const ProjectedScene& shown, const Rows& rows, const Job& job)
      : shown_(shown), rows_(rows), job_(job) {}

  void clear(Samples& samples) const {
    fill(samples.near, 0.0F);
    fill(samples.drawing, Samples::nothing);
    fill(samples.number, 0U);
  }
  template <class T>
  void fill(Array<T>& map, T value) const {
    const std::size_t stride = stride_of(shown_.eye.size());
    const std::size_t begin = static_cast<std::size_t>(rows_.begin) * stride,
                      end = static_cast<std::size_t>(rows_.end) * stride;
    std::fill(map.data() + begin, map.data() + end, value);
  }

  void draw_meshes(std::span<const Binned> triangles, Samples& samples) {
    each_triangle(triangles, [&](const Triangle& t) {
      each_nearer(t, samples.near.data(), [&](std::size_t at, Flags passed, Floats depth) {
        store(chosen(passed, depth, load(&samples.near[at])), &samples.near[at]);
        choose(passed, number_, &samples.drawing[at]);
        choose(passed, t.number, &samples.number[at]);
      });
    });
  }

  void draw_depths(std::span<const Binned> triangles, Array<float>& map) {
    each_triangle(triangles, [&](const Triangle& t) {
      each_nearer(t, map.data(), [&](std::size_t at, Flags passed, Floats depth) {
        store(chosen(passed, depth, load(&map[at])), &map[at]);
      });
    });
  }

  /// Sheets that blend leave the depth of what is behind them.
  void draw_sheets(std::span<const Binned> triangles, Samples& samples) {
    FragmentReader front(shown_), behind(shown_);
    each_triangle(triangles, [&](const Triangle& t) {
      each_nearer(t, samples.near.data(), [&](std::size_t at, Flags passed, Floats) {
        for (std::size_t lane = 0; lane < std::size_t{lanes}; ++lane) {
          const std::size_t column = at % samples.stride + lane, row = at / samples.stride;
          if (passed[static_cast<int>(lane)] == 0 || column >= samples.size) continue;
          const float x = (static_cast<float>(column) + 0.5F) * fixed_one,
                      y = (static_cast<float>(row) + 0.5F) * fixed_one;
          const Fragment next = front.at(number_, t.number, x, y);
          blend(next, at + lane, samples, [&](std::uint32_t drawn, std::uint32_t triangle) {
            return behind.at(drawn, triangle, x, y);
          });
        }
      });
    });
  }

  /// Lines and points, three samples thick.
  void draw_thin(Samples& samples) {
    const Array<Drawing>& drawings = shown_.scene.drawings;
    for (std::uint32_t i = 0; i < drawings.size(); ++i) {
      if (drawings[i].mesh->topology != Topology::triangles) draw_thin(i, drawings[i], samples);
    }
  }

 private:
  void take_drawing(std::uint32_t number) {
    number_ = number;
    drawing_ = &shown_.scene.drawings[number];
    surface_ = &shown_.scene.surfaces[drawing_->surface];
    holes_ = surface_->texels && surface_->texels->has_holes() ? uv_of(*drawing_->mesh, *surface_) : nullptr;
    sides_ = sides_of(shown_, *drawing_);
    if (shown_.vertices.empty()) lens_ = shown_.lens_of(*drawing_);
  }

  /// Calls visit(triangle) for each triangle of a list that covers a sample of the rows.
  template <class Visit>
  void each_triangle(std::span<const Binned> triangles, const Visit& visit) {
    Triangle t;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (i % check_every == 0) job_.check();
      if (triangles[i].drawing != number_) take_drawing(triangles[i].drawing);
      t.number = triangles[i].number;
      if (!read_triangle(t, shown_, *drawing_, lens_, sides_, rows_)) continue;
      set_edges(t.cover);
      visit(t);
    }
  }

  /// Calls visit(index of the first, passed, depth) for each eight samples where the triangle is nearer than the stored ones.
  template <class Visit>
  void each_nearer(const Triangle& t, const float* held, const Visit& visit) const {
    const std::uint32_t size = shown_.eye.size();
    const std::size_t stride = stride_of(size);
    const auto [least, greatest] = std::minmax({t.depth[0], t.depth[1], t.depth[2]});
    const Floats low = all_lanes(least), high = all_lanes(greatest);
    const Plane plane = t.cover.plane(static_cast<double>(t.depth[0]), static_cast<double>(t.depth[1]),
                                      static_cast<double>(t.depth[2]));
    const auto scan = [&](const auto& filled) {
      each_eight(t.cover, static_cast<std::int32_t>(size), rows_,
                 [&](std::int32_t x, std::int32_t y, Flags inside, Floats across, float down) {
                   const std::size_t at = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
                   Floats depth = plane.of(across, down);
                   depth = chosen(depth > low, depth, low);
                   depth = chosen(depth < high, depth, high);
                   Flags passed = inside & (depth > load(held + at));
                   if (!any_of(passed)) return;
                   passed = filled(passed, depth, across, down);
                   visit(at, passed, depth);
                 });
    };
    if (!holes_) return scan([](Flags passed, Floats, Floats, float) { return passed; });
    const Holes holes(*surface_, *holes_, t, shown_.eye.is_perspective());
    scan([&holes](Flags passed, Floats depth, Floats across, float down) {
      return passed & holes.filled(depth, across, down);
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

  const ProjectedScene& shown_;
  Rows rows_;
  const Job& job_;
  // The drawing of the current triangle:
  std::uint32_t number_ = ~0U;
  const Drawing* drawing_ = nullptr;
  const Surface* surface_ = nullptr;
  const Array<glm::vec2>* holes_ = nullptr;  ///< texture coordinates of a texture with holes
  Sides sides_ = Sides::both;
  Lens lens_;
};

SEEDMESH_WIDE void draw_meshes_of(Band& band, std::span<const Binned> triangles, Samples& samples) {
  band.draw_meshes(triangles, samples);
}
SEEDMESH_WIDE void draw_depths_of(Band& band, std::span<const Binned> triangles, Array<float>& map) {
  band.draw_depths(triangles, map);
}

/// For all bands in parallel: calls begin(band), and then draw(band, triangles) for each of its lists.
template <class Begin, class Draw>
void each_band(const ProjectedScene& shown, bool blending, const Job& job, const Begin& begin_band,
               const Draw& draw) {
  const Bins bins(shown, blending, rows_of_band, job);
  parallel_for(job, bins.bands(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      Band band(shown, bins.rows(i), job);
      begin_band(band);
      for (std::size_t list = 0; list < bins.lists(); ++list) draw(band, bins.list(list, i));
    }
  });
}

bool has_thin(const Scene& scene) {
  return std::ranges::any_of(scene.drawings.span(),
                             [](const Drawing& each) { return each.mesh->topology != Topology::triangles; });
}

}  // namespace

Samples draw_samples(const ProjectedScene& shown, const Job& job) {
  const std::uint32_t size = shown.eye.size();
  const std::size_t count = stride_of(size) * size;
  Samples samples{size,
                  stride_of(size),
                  Array<float>(job, count),
                  Array<std::uint32_t>(job, count),
                  Array<std::uint32_t>(job, count),
                  Array<Fragment>(job)};
  if (shown.scene.has_blending) samples.fragment.resize(count);
  using Triangles = std::span<const Binned>;
  each_band(
      shown, false, job, [&](Band& band) { band.clear(samples); },
      [&](Band& band, Triangles triangles) { draw_meshes_of(band, triangles, samples); });
  if (has_thin(shown.scene)) Band(shown, {0, static_cast<std::int32_t>(size)}, job).draw_thin(samples);
  if (shown.scene.has_blending) {
    each_band(
        shown, true, job, [](Band&) {},
        [&](Band& band, Triangles triangles) { band.draw_sheets(triangles, samples); });
  }
  return samples;
}

Array<float> draw_depths(const ProjectedScene& shown, float farthest, const Job& job) {
  Array<float> map(job, stride_of(shown.eye.size()) * shown.eye.size());
  each_band(
      shown, false, job, [&](Band& band) { band.fill(map, farthest); },
      [&](Band& band, std::span<const Binned> triangles) { draw_depths_of(band, triangles, map); });
  return map;
}

}  // namespace seedmesh::render

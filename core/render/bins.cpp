#include "core/render/bins.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/base/parallel.h"

namespace seedmesh::render {
namespace {

constexpr std::size_t check_every = 8'192;         ///< triangles
constexpr std::size_t triangles_of_list = 32'768;  ///< at least, so that a list is enough work for one chunk

/// A run of triangles.
struct Run {
  float depth;  ///< of its nearest vertex
  std::uint32_t begin, end;
};

std::uint32_t triangles_of(const Drawing& drawing) {
  const bool is_surface = drawing.mesh->topology == Topology::triangles;
  return is_surface ? static_cast<std::uint32_t>(drawing.mesh->index.size() / 3) : 0;
}

/// The triangles of a drawing in short runs, the nearest first, so that most of what is hidden is drawn last. Neighbours
/// stay together.
std::vector<Run> runs_of(const ProjectedScene& shown, const Drawing& drawing, std::uint32_t count) {
  constexpr std::uint32_t length = 64, worth_sorting = 512;
  const bool is_ordered = shown.scene.surfaces[drawing.surface].blends;
  if (is_ordered || count < worth_sorting || shown.vertices.empty()) return {{0, 0, count}};
  std::vector<Run> runs;
  runs.reserve(count / length + 1);
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

/// The first drawing of each list, and the end of the last list.
std::vector<std::uint32_t> list_begins(const Array<Drawing>& drawings) {
  std::vector<std::uint32_t> begins = {0};
  std::size_t triangles = 0;
  for (std::uint32_t i = 0; i < drawings.size(); ++i) {
    if (triangles >= triangles_of_list) {
      begins.push_back(i);
      triangles = 0;
    }
    triangles += triangles_of(drawings[i]);
  }
  begins.push_back(static_cast<std::uint32_t>(drawings.size()));
  return begins;
}

}  // namespace

Sides sides_of(const ProjectedScene& shown, const Drawing& drawing) {
  const Surface& surface = shown.scene.surfaces[drawing.surface];
  if (surface.both_sides || surface.blends) return Sides::both;
  // The rows of a map run upwards, those of pictures downwards.
  const bool is_map = !shown.eye.is_perspective();
  return is_mirrored(shown.scene.items.list[drawing.item].at) != is_map ? Sides::front_of_mirrored
                                                                        : Sides::front;
}

Bins::Bins(const ProjectedScene& shown, bool blending, std::uint32_t height, const Job& job)
    : height_(height), size_(shown.eye.size()), bands_((shown.eye.size() + height - 1) / height) {
  const Array<Drawing>& drawings = shown.scene.drawings;
  const std::vector<std::uint32_t> begins = list_begins(drawings);
  lists_.resize(begins.size() - 1);
  const Rows all{0, static_cast<std::int32_t>(size_)};
  const auto add = [&](List& list, std::uint32_t number) {
    const Drawing& drawing = drawings[number];
    const std::uint32_t count = triangles_of(drawing);
    if (count == 0 || shown.scene.surfaces[drawing.surface].blends != blending) return;
    const Lens lens = shown.vertices.empty() ? shown.lens_of(drawing) : Lens{};
    const Sides sides = sides_of(shown, drawing);
    Triangle t;
    for (const Run& run : runs_of(shown, drawing, count)) {
      job.check();
      for (t.number = run.begin; t.number < run.end; ++t.number) {
        if ((t.number + 1) % check_every == 0) job.check();
        if (!read_triangle(t, shown, drawing, lens, sides, all)) continue;
        const auto first = static_cast<std::uint32_t>(std::max(t.cover.top, 0)) / height_;
        const auto last = static_cast<std::uint32_t>(std::min(t.cover.bottom, all.end - 1)) / height_;
        for (std::uint32_t band = first; band <= last; ++band) list[band].push_back({number, t.number});
      }
    }
  };
  parallel_for(job, lists_.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t band = 0; band < bands_; ++band) lists_[i].emplace_back(job);
      for (std::uint32_t number = begins[i]; number < begins[i + 1]; ++number) add(lists_[i], number);
    }
  });
}

Rows Bins::rows(std::size_t band) const {
  const auto first = static_cast<std::uint32_t>(band) * height_;
  return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(std::min(first + height_, size_))};
}

}  // namespace seedmesh::render

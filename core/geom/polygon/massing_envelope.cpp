// Roofs that are the lowest of several planes; see massing_envelope.h.
#include "core/geom/polygon/massing_envelope.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"

namespace seedmesh {
namespace {

using glm::dvec2;

constexpr int pieces_of_an_arc = 12;
// The share of its height at which the sloped ends of a half-hipped roof begin.
constexpr double half_hip = 0.5;

/// A point of a profile: the share of the width across, and of the height.
struct ProfilePoint {
  double across, height;
};

/// The rectangle around the plan: `down` is the direction across the ridge.
struct Frame {
  dvec2 down{0, 1}, along{1, 0};
  double from = 0, width = 0;    ///< across
  double start = 0, length = 0;  ///< along
};

/// Outwards over the longest edge of the outer ring.
dvec2 over_longest_edge(const Plan& plan) {
  const PlanRing& ring = plan.rings[0];
  double longest = 0;
  dvec2 best{1, 0};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    const double length = glm::length(edge);
    if (length <= longest * (1 + 1e-9)) continue;
    longest = length;
    best = dvec2(edge.y, -edge.x) / length;
  }
  return best;
}

Frame frame_of(const Plan& plan, const MassOptions& options) {
  Frame frame;
  if (options.direction) {
    frame.down = *options.direction;
  } else if (options.roof == MassRoof::skillion) {
    frame.down = over_longest_edge(plan);
  } else {
    const PlanBox box = smallest_box(plan);
    frame.down = options.across ? box.along : dvec2(-box.along.y, box.along.x);
  }
  frame.along = {-frame.down.y, frame.down.x};
  double low = 0, high = 0, left = 0, right = 0;
  bool is_first = true;
  for (const dvec2& p : plan.rings[0]) {
    const double t = glm::dot(p, frame.down), u = glm::dot(p, frame.along);
    low = is_first ? t : std::min(low, t);
    high = is_first ? t : std::max(high, t);
    left = is_first ? u : std::min(left, u);
    right = is_first ? u : std::max(right, u);
    is_first = false;
  }
  frame.from = low;
  frame.width = high - low;
  frame.start = left;
  frame.length = right - left;
  return frame;
}

/// The plane that rises by `slope` along `direction` and has a height at a distance along it.
Envelope::Plane plane_along(const dvec2& direction, double slope, double distance, double height) {
  return {direction * slope, height - slope * distance};
}

void cut_between(Envelope& envelope, std::size_t a, std::size_t b) {
  const dvec2 rise = envelope.planes[a].rise - envelope.planes[b].rise;
  const double length = glm::length(rise);
  if (length > 0) {
    envelope.cuts.push_back(
        {rise / length, (envelope.planes[b].height - envelope.planes[a].height) / length});
  }
}

void add_profile(Envelope& envelope, const Frame& frame, double height,
                 const std::vector<ProfilePoint>& profile) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const ProfilePoint &a = profile[i], &b = profile[i + 1];
    const double slope = height * (b.height - a.height) / (frame.width * (b.across - a.across));
    envelope.planes.push_back(
        plane_along(frame.down, slope, frame.from + a.across * frame.width, a.height * height));
    if (i > 0) envelope.cuts.push_back({frame.down, frame.from + a.across * frame.width});
  }
}

/// Slopes from both ends of the ridge, of the steepness of a gabled roof.
void add_ends(Envelope& envelope, const Frame& frame, double height, double height_at_end) {
  const double slope = height / (frame.width / 2);
  envelope.planes.push_back(plane_along(frame.along, slope, frame.start, height_at_end));
  envelope.planes.push_back(plane_along(frame.along, -slope, frame.start + frame.length, height_at_end));
  for (const std::size_t end : {2U, 3U}) {
    for (const std::size_t side : {0U, 1U}) cut_between(envelope, end, side);
  }
  cut_between(envelope, 2, 3);
}

std::vector<ProfilePoint> profile_of(MassRoof roof) {
  switch (roof) {
    case MassRoof::skillion:
      return {{0, 1}, {1, 0}};
    case MassRoof::gambrel:
      return {{0, 0}, {0.2, 0.6}, {0.5, 1}, {0.8, 0.6}, {1, 0}};
    case MassRoof::saltbox:
      return {{0, 0}, {saltbox_ridge, 1}, {1, 0}};
    case MassRoof::round: {
      std::vector<ProfilePoint> profile;
      for (int i = 0; i <= pieces_of_an_arc; ++i) {
        const math::SinCos at = math::sincos(math::pi * i / pieces_of_an_arc);
        profile.push_back({(1 - at.cos) / 2, at.sin});
      }
      profile.front() = {0, 0};
      profile.back() = {1, 0};
      return profile;
    }
    default:
      return {{0, 0}, {0.5, 1}, {1, 0}};
  }
}

}  // namespace

std::size_t Envelope::lowest(const dvec2& p) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < planes.size(); ++i) {
    if (planes[i].at(p) < planes[best].at(p)) best = i;
  }
  return best;
}

Envelope level_envelope() { return {{Envelope::Plane{}}, {}}; }

Envelope envelope_of(const Plan& plan, const MassOptions& options) {
  const Frame frame = frame_of(plan, options);
  Envelope envelope;
  add_profile(envelope, frame, options.roof_height, profile_of(options.roof));
  if (options.roof == MassRoof::half_hipped)
    add_ends(envelope, frame, options.roof_height, half_hip * options.roof_height);
  return envelope;
}

Envelope hipped_envelope(const Plan& plan, const MassOptions& options) {
  const Frame frame = frame_of(plan, options);
  Envelope envelope;
  add_profile(envelope, frame, options.roof_height, profile_of(MassRoof::gabled));
  add_ends(envelope, frame, options.roof_height, 0);
  return envelope;
}

double width_across(const Plan& plan, const MassOptions& options) { return frame_of(plan, options).width; }

}  // namespace seedmesh

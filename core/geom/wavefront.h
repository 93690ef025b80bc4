#pragma once
/// The outline that moves inwards while a straight skeleton is made; only straight_skeleton.cpp uses it.
#include <queue>

#include "core/geom/straight_skeleton.h"

namespace seedmesh {

/// Edges, and corners between two of them, that change only at events: an edge shrinks to nothing, or a
/// corner runs into an edge. Everything that happens at one time is resolved at once, place by place:
/// trajectories end there, edges of no length go, edges that lie on each other the other way round go as a
/// ridge, and what is left round a place is joined again so that the inside stays to the left. As each place
/// has as many edges that end as edges that begin, the outline is closed at all times, whatever rounding
/// does.
class Wavefront {
 public:
  /// A line that moves along its normal.
  struct Source {
    glm::dvec2 direction{0}, normal{0};  ///< the normal is to the left
    double offset = 0, speed = 1;        ///< normal . p = offset + speed * time
    std::uint32_t edge = 0;              ///< of the plan
    bool is_step = false;
  };
  /// A piece of a face's border, the face to its left.
  struct Border {
    std::uint32_t source, from, to;
  };

  Wavefront(const Plan& plan, const SkeletonOptions& options, const Job& job);

  /// False where it gives up, as with an outline that never closes.
  bool run();

  std::vector<Source> sources;  ///< one for each edge of the plan, then steps
  std::vector<glm::dvec3> nodes;
  std::vector<Border> borders;
  std::vector<SkeletonFront> fronts;
  double scale = 1;

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  struct Corner {
    glm::dvec2 place{0}, velocity{0};
    double time = 0;
    std::uint32_t node = 0, in = 0, out = 0;  ///< where it began; the edges before and after it
    bool is_alive = true, can_hit = false;
  };
  /// From corner to corner; while events are resolved from node to node where an end is open.
  struct Edge {
    std::uint32_t source = 0;
    std::uint32_t start = none, end = none;
    std::uint32_t start_node = none, end_node = none;
    std::uint32_t version = 0;
    bool is_alive = true, is_open = false;
  };
  struct Event {
    double time = 0;
    std::uint32_t edge = 0, version = 0;
    std::uint32_t corner = none;  ///< none: the edge shrinks to nothing
    bool operator<(const Event& other) const;
  };
  /// A corner that has come to a place, or a place on an edge.
  struct Touch {
    glm::dvec2 place{0};
    std::uint32_t corner = none, edge = none;
    std::uint32_t first = 0;  ///< of the touches that are one place: the first of them, later the node
  };

  const Source& source(std::uint32_t edge) const { return sources[edges_[edge].source]; }
  glm::dvec2 place_of(std::uint32_t corner) const;
  glm::dvec2 place_at(std::uint32_t corner, double time) const;
  glm::dvec2 far_place(std::uint32_t edge, bool at_start) const;
  std::uint32_t add_node(const glm::dvec2& place);

  void add_ring(const PlanRing& ring, std::uint32_t first);
  bool is_current(const Event& event) const;
  void expect_collapse(std::uint32_t edge);
  void expect_hit(std::uint32_t corner, std::uint32_t edge);
  void expect();
  void count_looks(std::size_t count);

  void resolve(const std::vector<Event>& batch);
  std::vector<Touch> touches_of(const std::vector<Event>& batch) const;
  void name_nodes(std::vector<Touch>& touches);
  void end_corner(std::uint32_t corner, std::uint32_t node);
  void open_end(std::uint32_t edge, bool at_start, std::uint32_t node);
  void split(std::uint32_t edge, const std::vector<std::uint32_t>& at);
  bool settle();
  void drop_nothing();
  void cancel_opposites();
  void find_joints();
  void pair_round(std::uint32_t node, std::span<const std::pair<std::uint32_t, std::uint32_t>> rays);
  bool is_closing(std::uint32_t in, std::uint32_t out) const;
  void zip(std::uint32_t in, std::uint32_t out, std::uint32_t node);
  void join(std::uint32_t in, std::uint32_t out, std::uint32_t node);
  void add_corner(std::uint32_t in, std::uint32_t out, std::uint32_t node);
  void close_fronts();

  double end_time_, now_ = 0;
  double near_ = 0;     ///< places nearer than this are one
  double soon_ = 0;     ///< times nearer than this are one
  double fastest_ = 0;  ///< speed of an edge
  const Job& job_;
  std::uint64_t looks_ = 0;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  std::priority_queue<Event> events_;
  std::vector<std::uint32_t> open_;     ///< edges with an open end
  std::vector<std::uint32_t> hitters_;  ///< corners that may run into edges
  std::vector<std::uint32_t> fresh_;    ///< corners made since `expect`
  struct Joint {
    std::uint32_t in, out, node;
  };
  std::vector<Joint> joints_;  ///< found by settle
};

}  // namespace seedmesh

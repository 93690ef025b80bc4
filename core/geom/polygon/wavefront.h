#pragma once
/// The moving outline of a straight skeleton; for straight_skeleton.cpp only.
#include <map>
#include <queue>
#include <set>

#include "core/geom/polygon/cell_grid.h"
#include "core/geom/polygon/straight_skeleton.h"

namespace seedmesh {

/// Edges and the corners between them change only at events: an edge shrinks to length 0, or a corner hits an
/// edge. All events of one time are resolved together, position by position. Trajectories of corners end
/// there; edges without a length are removed; opposite edges on each other become a ridge; the remaining ends
/// are joined so that the inside stays to the left. At each position as many edges end as begin, so that the
/// outline stays closed despite rounding errors.
///
/// A corner is compared with the edges of its neighbourhood alone. A grid stores the regions that edges and corners
/// pass over until a horizon, which is chosen so that these regions stay small; then the grid is made anew with the
/// corners that are left. Regions end where an edge is known to shrink to nothing. An event therefore costs log n for
/// the queue, plus the number of neighbours. The grid costs a few steps for each corner and horizon.
class Wavefront {
 public:
  /// A line that moves along its normal.
  struct Source {
    glm::dvec2 direction{0}, normal{0};  ///< the normal is to the left
    double offset = 0, speed = 1;        ///< normal . p = offset + speed * time
    std::uint32_t edge = 0;              ///< edge of the plan
    bool is_step = false;                ///< a vertical side added where an edge stops, not of the plan
  };
  /// A piece of the border of a face, which lies to its left.
  struct Border {
    std::uint32_t source, from, to;
  };

  Wavefront(const Plan& plan, const SkeletonOptions& options, const Job& job);

  /// Runs to the end time. Returns false if the outline does not close in the expected number of steps.
  bool run();

  std::vector<Source> sources;  ///< one for each edge of the plan, then steps
  std::vector<glm::dvec3> nodes;
  std::vector<Border> borders;
  std::vector<SkeletonFront> fronts;
  double scale = 1;

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  struct Corner {
    glm::dvec2 position{0}, velocity{0};
    double time = 0;
    double speed = 0;               ///< the length of `velocity`
    std::uint32_t node = 0;         ///< node where it began
    std::uint32_t in = 0, out = 0;  ///< the edges before and after it
    bool is_alive = true, can_hit = false;
  };
  /// An edge between two corners. While events are resolved, an open end is a node.
  struct Edge {
    std::uint32_t source = 0;
    std::uint32_t start = none, end = none;
    std::uint32_t start_node = none, end_node = none;
    std::uint32_t version = 0;
    bool is_alive = true, is_open = false;
    bool is_touched = false;                               ///< since the last round of `settle`
    std::uint32_t listed_start = none, listed_end = none;  ///< the nodes in ends_ that list its open ends
    double since = 0;                                      ///< the time of its last change
    double until = 0;                                      ///< the time when it shrinks to length 0
  };
  struct Event {
    double time = 0;
    std::uint32_t edge = 0, version = 0;
    std::uint32_t corner = none;  ///< none: the edge shrinks to length 0
    bool operator<(const Event& other) const;
  };
  /// A corner at the position of an event, or a position on an edge.
  struct Touch {
    glm::dvec2 position{0};
    std::uint32_t corner = none, edge = none;
    std::uint32_t first = 0;  ///< the first touch at the same position; later the node
  };
  /// Two edges that are joined at a node.
  struct Joint {
    std::uint32_t in, out, node;
  };

  const Source& source(std::uint32_t edge) const { return sources[edges_[edge].source]; }
  glm::dvec2 position_of(std::uint32_t corner) const;
  glm::dvec2 position_at(std::uint32_t corner, double time) const;
  glm::dvec2 far_position(std::uint32_t edge, bool at_start) const;
  std::uint32_t add_node(const glm::dvec2& position);

  void add_ring(const PlanRing& ring, std::uint32_t first);
  bool is_current(const Event& event) const;
  bool is_in_reach(const Event& event) const;
  void expect_collapse(std::uint32_t edge);
  void expect_hit(std::uint32_t corner, std::uint32_t edge);
  /// Predicts the events of changed edges and new corners, and puts them into the queue.
  void expect();
  void expect_nearby();
  void expect_all();
  bool is_at_horizon() const;
  /// Predicts the hits of a corner on edges nearby, and of corners nearby on an edge.
  void find_hits_of_corner(std::uint32_t corner, double from);
  void find_hits_on_edge(std::uint32_t edge);
  void move_horizon();
  double median_life(double from) const;
  void drop_ended();
  void place_grid(double time);
  bool fill_grid(double from, double ahead);
  double pairs_in_grid();
  template <class Visit>
  void each_cell_of_edge(std::uint32_t edge, double from, double until, const Visit& visit) const;
  template <class Visit>
  void each_cell_of_corner(std::uint32_t corner, double from, double until, const Visit& visit) const;
  void count_comparisons(std::size_t count);  ///< checks the deadline now and then

  void resolve(const std::vector<Event>& batch);
  std::vector<Touch> touches_of(const std::vector<Event>& batch) const;
  void name_nodes(std::vector<Touch>& touches);
  void end_corner(std::uint32_t corner, std::uint32_t node);
  void open_end(std::uint32_t edge, bool at_start, std::uint32_t node);
  void split(std::uint32_t edge, const std::vector<std::uint32_t>& at);
  /// Joins all open ends, until none is left. Returns false if that takes too many rounds.
  bool settle();
  void touch(std::uint32_t edge);
  void take_touched();
  void unlist(std::uint32_t edge);
  void cancel_opposites(const std::pair<std::uint32_t, std::uint32_t>& span);
  void find_joints();
  void match_rays_around(std::uint32_t node, const std::set<std::uint32_t>& rays,
                         std::vector<Joint>& joints) const;
  bool is_closing(std::uint32_t in, std::uint32_t out) const;
  /// Opens the nearer of the far ends of two edges that lie on each other, and cuts the other edge there.
  void zip(std::uint32_t in, std::uint32_t out, std::uint32_t node);
  void join(std::uint32_t in, std::uint32_t out, std::uint32_t node);
  void add_corner(std::uint32_t in, std::uint32_t out, std::uint32_t node);
  void close_fronts();

  double end_time_, now_ = 0;
  double near_ = 0;     ///< positions nearer than this are equal
  double soon_ = 0;     ///< times nearer than this are equal
  double fastest_ = 0;  ///< the greatest speed of an edge
  const Job& job_;
  std::uint64_t comparisons_ = 0;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  std::priority_queue<Event> events_;
  std::vector<std::uint32_t> open_;             ///< edges with an open end
  std::vector<std::uint32_t> hitting_corners_;  ///< corners that can hit edges (reflex); some have ended
  std::vector<std::uint32_t> fresh_;            ///< corners made since `expect`
  std::vector<std::uint32_t> front_;            ///< edges; some are not alive

  // The search for hits.
  /// What a quick comparison needs of an edge.
  struct Line {
    glm::dvec2 normal{0};
    double offset = 0, speed = 0, until = 0;
  };
  std::vector<Line> lines_;
  bool uses_grid_ = false;
  double horizon_ = -1;          ///< hits up to this time are in the queue
  double horizon_before_ = -1;   ///< horizon of the previous grid; hits up to it are already in the queue
  double ahead_ = 0;             ///< time from the making of the grid to the horizon
  double least_ahead_ = 0;       ///< up to this time ahead, the size of the grid is not limited
  glm::dvec2 low_{0}, high_{0};  ///< corners of the grid
  std::size_t cells_ = 0;
  std::size_t changes_ = 0;  ///< edges that changed since the grid was made
  double effort_ = 1;        ///< multiplies the limit of candidate pairs in a grid
  CellGrid edge_grid_, corner_grid_;
  std::size_t most_entries_ = 0;  ///< number of entries above which the grid is made anew
  /// Comparisons after events since the grid was made, and their limit.
  std::size_t comparisons_nearby_ = 0, most_nearby_ = 0;
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint32_t> edge_mark_, corner_mark_;  ///< equal to mark_: is in seen_
  std::uint32_t mark_ = 0;

  // Used by settle().
  std::vector<std::uint32_t> touched_;  ///< edges changed since the last round
  /// Open ends by node, each as 2 * edge, plus 1 if the edge starts there.
  std::map<std::uint32_t, std::set<std::uint32_t>> ends_;
  std::map<std::uint32_t, std::vector<Joint>> joints_;  ///< joints, indexed by node
  std::set<std::uint32_t> changed_nodes_, closing_nodes_;
  /// Edges with two open ends, by their two nodes, the lower first.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<std::uint32_t>> spans_;
};

}  // namespace seedmesh

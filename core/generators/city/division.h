#pragma once
/// The division of one block into lots. A cut is refused if one of its pieces would be too small, too narrow or too
/// pointed, or would have too short a frontage. Every lot therefore has access to a street.
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/plan.h"
#include "core/generators/city/ribbons.h"
#include "core/generators/city/shape.h"

namespace seedmesh {
struct CityLots;
}

namespace seedmesh::city {

/// An edge of a division, shared by the pieces on both sides, with the corners that cuts add to it.
struct SharedEdge {
  CmPoint a, b;
  std::uint32_t street = no_index, sidewalk = no_index;
  std::vector<CmPoint> added;

  /// Appends the added corners strictly between two points of the edge to a ring, in the order from `from` to `to`.
  void append_between(const CmPoint& from, const CmPoint& to, CmRing& ring) const;
};

/// A piece of a block. `edges[i]` is the index into Division::edges() of the edge from corner i to the next corner.
struct Piece {
  CmRing ring;
  std::vector<std::uint32_t> edges;
  std::uint64_t key = 0;
  bool is_inner = false;  ///< the method of division leaves the piece without frontage
};

constexpr double least_block_angle = 12.5;  // degrees

class Division {
 public:
  Division(const BlockOutline& outline, const CityLots& lots, std::uint64_t key, Rng rng);

  /// Whether the block has space for lots.
  bool holds_lots() const;

  /// Cuts the block by the method of the request.
  void cut(const Job& job);

  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<SharedEdge>& edges() const { return edges_; }
  const Piece& whole() const { return whole_; }

  /// Returns the outline of a piece. It includes the corners that cuts in neighbouring pieces have added to its
  /// edges.
  CmRing outline(const Piece& piece) const;
  /// Returns the outline of the piece with this index, after cut(). Moves the outline out of the division, so it
  /// may be called once for each piece.
  CmRing take_outline(std::size_t piece);
  /// Moves the corners of the piece with this index out of the division. Call it after take_outline().
  CmRing take_corners(std::size_t piece) { return std::move(pieces_[piece].ring); }

  /// Returns the length of a piece along streets, in centimetres.
  double frontage(const Piece& piece) const;
  /// Whether a piece has at least the least area, frontage and side of the request. It must also have no corner
  /// sharper than `angle` (degrees), and an aspect ratio (long side divided by short side) of at most `aspect`.
  bool is_fit(const Piece& piece, double angle, double aspect) const;

 private:
  friend class Strips;
  /// A position where a line meets a piece: at a corner, or within the edge from this corner to the next one.
  struct Meeting {
    std::size_t corner = 0;
    bool is_corner = false;
    CmPoint at{};
  };
  /// A piece with its box.
  struct Cut {
    Piece piece;
    LeastBox box;
  };
  void cut(Cut whole, int depth);
  void reset();
  bool has_size(const Piece& piece) const;  ///< its least area and frontage
  double least_width() const;               ///< centimetres, with a margin for rounding
  bool is_partition();
  std::size_t long_pieces() const;
  bool is_large(const Piece& piece, const LeastBox& box, Rng& draw) const;
  bool find_cut(const Cut& whole, Rng& draw, Cut& left, Cut& right);
  bool find_cut_across_front(const Piece& piece, Rng& draw, Cut& left, Cut& right);
  bool try_cut(const Piece& piece, const glm::dvec2& origin, const glm::dvec2& direction, Cut& left,
               Cut& right);
  static bool keep_chord(std::vector<Meeting>& meetings, const glm::dvec2& origin,
                         const glm::dvec2& direction);
  void find_meetings(const Piece& piece, const glm::dvec2& origin, const glm::dvec2& direction);
  template <class Visit>
  static void each_edge(const Piece& piece, const Meeting& from, const Meeting& to, const Visit& visit);
  bool has_side_area(const Piece& piece, const Meeting& from, const Meeting& to) const;
  bool has_side_frontage(const Piece& piece, const Meeting& from, const Meeting& to) const;
  void set_side(const Piece& piece, const Meeting& from, const Meeting& to, Piece& side);
  bool has_shape(const Piece& piece, double most_cosine, double aspect, LeastBox& box) const;
  std::uint32_t inner_edge();

  const CityLots& lots_;
  Rng rng_;
  Piece whole_;
  std::vector<SharedEdge> edges_;
  std::vector<Piece> pieces_;
  std::vector<CmRing> outlines_;  ///< outlines of the pieces, if is_partition() ran after the last cut
  std::uint32_t inner_ = no_index;
  double cut_aspect_ = 0;  ///< greatest aspect that a piece may have after the cut that is being searched
  // These members exist only so that their memory is reused: offsets of the corners from a cut, and the positions
  // where the cut meets the outline.
  std::vector<double> offsets_;
  std::vector<Meeting> meetings_;
};

/// Returns the pieces along the streets of a block by its straight skeleton (Vanegas et al. 2012). If `depth` (cm) is
/// finite, also returns the courts that are farther than `depth` from all streets. Pieces without space for a lot are joined
/// with a neighbour. Adds the edges between pieces to the division. Returns an empty list if the skeleton does not
/// give valid pieces.
std::vector<Piece> strips_of(Division& division, double depth, const Job& job);

}  // namespace seedmesh::city

#pragma once
/// Readers for the braces of an operation (cells of a split, selectors of a component split), for its axis and for surplus
/// arguments.
#include "core/generators/building/operations.h"
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// Reads cells: `size : successor | { ... }* | ...`, or, if the successors follow in a second pair of braces
/// (notation of 2006), `3.5, 1r, { 2, 1r }*`.
void parse_cells(Parser& p, std::vector<Part>& out, bool have_bodies);
/// Assigns the successors of a second pair of braces to the cells in order. `next` is the index of the next
/// successor and is advanced.
void assign_bodies(Parser& p, std::vector<Part>& cells, const std::vector<std::uint32_t>& bodies,
                   std::size_t& next);

/// Reads one selector and the separator after it: front :, world.up =, isTagged("a") && top =:
Part parse_selector(Parser& p);
/// Returns the ComponentKind that a word names: f, e, v, fe, fv, g, m or h. Others are an error.
std::uint8_t read_component(Parser& p, const lang::Token& token);

/// Reads selectors: `front : A | side = B | 3 : C`.
void parse_selectors(Parser& p, std::vector<Part>& out);
/// Makes the selector of Comp("sidefaces") or Comp("edge", 3), in the notation of 2006.
void parse_selectors_2006(Parser& p, Step& step, const std::vector<Argument>& list, std::vector<Part>& out);

/// Reads the leading words of an operation: an axis of a split (x, "X", "YS" with snap lines, u, v), axes of
/// center (xz), a kind of component (f), adjust or noAdjust.
void read_axis(Parser& p, const OperationRow& row, Step& step, const std::vector<Argument>& list);

/// Skips arguments that an operation does not have, up to the bracket `close`. They are an error, and a warning in
/// a rule file of CityEngine. For an operation that is not supported, its own message says enough.
void report_surplus(Parser& p, const OperationRow& row, std::size_t close);

}  // namespace seedmesh::building

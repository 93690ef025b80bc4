#pragma once
/// Values of expressions for one shape of a derivation.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Selects the shape whose attributes and parameters the next expressions read. `state` is the state of the
/// shape after the steps of the successor so far. It has to exist until these expressions are evaluated.
void look_at(Derivation& d, const ShapeState& state, std::uint32_t shape);

/// Stores the values of that shape that expressions read in the slots. evaluate() calls this before it needs
/// them.
void fill_slots(Derivation& d);

/// Returns the value of an expression. Takes random numbers from d.random and computes queries about
/// other shapes.
lang::TaggedValue evaluate(Derivation& d, const Value& value);
/// Returns the value of a node of an expression (syntax.h).
lang::TaggedValue evaluate_tree(Derivation& d, std::uint32_t node);
/// Returns the result of a query about other shapes, for the shape that look_at() selected.
lang::TaggedValue answer_of(Derivation& d, const Query& query);
/// Whether a condition is true: its value is a text, or a number other than 0.
bool holds(Derivation& d, const Value& condition);
/// Returns a finite number of at most 10,000 km; everything else is rejected at the expression. If a text is
/// the value of an attribute of the request, the error points to that attribute.
double number_of(Derivation& d, const Value& value);
/// Returns a length in metres. A relative argument is multiplied by `whole`.
double length_of(Derivation& d, const Argument& argument, double whole);
/// Returns a text, or its number in the table of texts; a number is rejected.
std::uint32_t text_id_of(Derivation& d, const Argument& argument);
const std::string& text_of(Derivation& d, const Argument& argument);
/// Returns the value of an argument of a rule, of an attribute or of `set`: a text, or a number as number_of()
/// returns it.
lang::TaggedValue number_or_text(Derivation& d, const Value& value);

/// Evaluates all attributes for the first shape, those that others need first. Each has random numbers of its
/// own.
void evaluate_attributes(Derivation& d, const ShapeState& first);

}  // namespace seedmesh::building

#pragma once
/// Values of expressions for one shape of a derivation.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Chooses the shape whose attributes and parameters the next expressions read. `state` has to outlive them:
/// it is where the steps of the successor have brought the shape so far.
void look_at(Derivation& d, const ShapeState& state, std::uint32_t shape);

/// Puts what expressions read of that shape into the slots; evaluate() does so before it needs them.
void fill_slots(Derivation& d);

/// Returns the value of an expression. Draws random numbers from d.random. Answers of queries to other shapes are
/// computed here.
lang::TaggedValue evaluate(Derivation& d, const Value& value);
/// Returns the value of a node of an expression (syntax.h).
lang::TaggedValue evaluate_tree(Derivation& d, std::uint32_t node);
/// Returns the answer of a query to other shapes, for the shape that the derivation looks at.
lang::TaggedValue answer_of(Derivation& d, const Query& query);
/// Whether a condition holds: its value is a text, or a number other than 0.
bool holds(Derivation& d, const Value& condition);
/// Returns a finite number of at most 10,000 km; everything else is rejected at the expression. A text that an
/// attribute of the request brought is rejected at that attribute.
double number_of(Derivation& d, const Value& value);
/// Returns a number of metres; of a relative argument, which is a share of `whole`, as well.
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

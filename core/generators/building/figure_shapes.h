#pragma once
/// A derived figure of a shape grammar as shapes, so that it is drawn and listed as the shapes of rules are.
#include "core/generators/building/shape_grammar/shape_grammar.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// Returns the symbols of these shapes: picture, line, the kinds of solids and the labels of markers.
Grammar grammar_of_names(const FigureGrammar& figures);

/// Returns one inactive shape "picture" with a child for each element: a bar for a line, the solid itself, and a
/// sphere for a marker if marker_size is above 0. A bar is longer than its line by its width, so that corners
/// are filled.
Shapes shapes_of_figure(const FigureGrammar& figures, const DerivedFigure& derived,
                        const BuildingShapeGrammar& given, Job& job);

}  // namespace seedmesh::building

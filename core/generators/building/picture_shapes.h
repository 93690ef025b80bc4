#pragma once
/// A derived picture as shapes, so that it is drawn, listed and merged as those of rules are.
#include "core/generators/building/shape_grammar/shape_grammar.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// The symbols of these shapes: picture, line, the kinds of solids, and the labels of markers.
Grammar grammar_of_names(const PictureGrammar& pictures);

/// Below one inactive shape "picture": a bar for each line, each solid, and a ball for each marker where
/// marker_size says so. Bars are as much longer than their lines as they are wide, so that corners are
/// filled.
Shapes shapes_of_picture(const PictureGrammar& pictures, const DerivedPicture& derived,
                         const BuildingShapeGrammar& given, Job& job);

}  // namespace seedmesh::building

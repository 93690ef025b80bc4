#pragma once
/// The flow of light to the foot of a tree and of vigour from there to its buds (Palubicki et al., 2009, section 4.2:
/// the extended Borchert-Honda model and the priority model).
#include "core/generators/tree/grown_plant.h"

namespace seedmesh::tree {

/// Sums the light of buds, and counts internodes, from the tips to the feet. Internodes that grew in the year
/// `first_young` or later count as young.
void gather_light(GrownPlant& plant, int first_young);

/// Returns the parameter lambda of divide_by_lambda() in a year: `lambda` until the first of `lambda_years`, and
/// `lambda_old` from the second on. Between them it changes linearly.
double lambda_in(const TreeGrown& grown, double year);

/// Divides the vigour alpha * light of each tree among its branches and buds. Let m be the light of the axis
/// at a node, and s that of its side branches. The axis then gets the share lambda m / (lambda m + (1 -
/// lambda) s) of the vigour. Side branches share the rest by their light.
void divide_by_lambda(GrownPlant& plant, double alpha, double lambda);

/// Divides the vigour along each axis among its side branches, its side buds and the bud at its end. They
/// are ranked by their mean light, the brightest first. Their weights decrease linearly from 1 to `priority_least` over
/// the first `priority_share` of the ranks, and then stay. Each gets vigour in proportion to light times weight.
void divide_by_priority(GrownPlant& plant, const TreeGrown& grown, Job& job);

}  // namespace seedmesh::tree

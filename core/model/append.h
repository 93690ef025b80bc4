#pragma once
/// Appends one model to another.
#include "core/model/model.h"

namespace seedmesh {

/// Appends everything of `other` to `model`, under a new node with the transform `at` below the node `parent` (-1: the
/// new node is a root). Nodes with a skin stay roots. Animations of the same name are joined, so that they play
/// together. Warnings are appended too; extras and variants are not.
void append(Model& model, Model other, int parent, const Transform& at);

}  // namespace seedmesh

#pragma once
/// Models put together.
#include "core/model/model.h"

namespace seedmesh {

/// Puts everything of `other` at the end of `model`, under a new node with the transform `at` below the node
/// `parent` (-1: a root). Animations of one name become one, so that they play together. Warnings come along,
/// extras and variants do not.
void append(Model& model, Model other, int parent, const Transform& at);

}  // namespace seedmesh

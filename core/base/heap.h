#pragma once

namespace seedmesh {

/// Returns unused pages of the heap to the system. Cost: about 0.1 ms for each MB of the heap.
void return_unused_heap();

}  // namespace seedmesh

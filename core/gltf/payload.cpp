#include "core/gltf/payload.h"

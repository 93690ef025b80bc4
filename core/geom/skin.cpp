#include "core/geom/skin.h"

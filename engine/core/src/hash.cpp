#include "argil/core/vec3.h"

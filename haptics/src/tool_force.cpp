#include "argil/haptics/tool_force.h"

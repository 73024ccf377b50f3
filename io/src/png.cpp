#include "argil/io/png.h"

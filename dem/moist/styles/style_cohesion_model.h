// LIGGGHTS's headers read this list of their cohesion models; its build makes it, Debian leaves it
// out. Here: ours. Read several times, hence no include guard.
#include "dem/moist/cohesion_model_moist.h"

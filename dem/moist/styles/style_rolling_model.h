// LIGGGHTS's headers read this list of their rolling models; its build makes it, Debian leaves it
// out. Here: the one that the contact law of the dig uses. Read several times, hence no include
// guard.
#include "rolling_model_epsd2.h"

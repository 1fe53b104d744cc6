// LIGGGHTS's headers read this list of their normal models; its build makes it, Debian leaves it
// out. Here: the one that the contact law of the dig uses. Read several times, hence no include
// guard.
#include "normal_model_hooke_stiffness.h"

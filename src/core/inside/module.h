/* Modules with libraries, and the program in which they are.
 *
 *     base/module.h   A module is loaded once, when it is first needed.
 *     base/program.h  The file of this program, and the folders beside it.
 *     base/ceiling.h  How many bytes the process may hold.
 *     base/machine.h  What the processor and the control group allow.
 */
#pragma once

#include "base/ceiling.h"
#include "base/machine.h"
#include "base/module.h"
#include "base/program.h"

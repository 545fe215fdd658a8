/* The program, its modules and its machine.
 *
 *   base/module.h    a module is loaded when it is first needed, from one of three known places
 *   base/program.h   the file of the running program
 *   base/ceiling.h   the bytes that a run may hold, with its caches
 *   base/machine.h   the processors and the memory that this process may use
 */
#pragma once

#include "base/ceiling.h"
#include "base/machine.h"
#include "base/module.h"
#include "base/program.h"

/* The file of the running program. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* The path of the program: /proc/self/exe, or if /proc is not mounted, the path by which it was
 * started. */
const char *cs_program_path(void);
/* Where the modules of an installed program lie, from its folder; ended by NULL. */
extern const char *const cs_program_libraries[];
/* The folder that contains the program, without the final slash; false: unknown, or longer than
 * size - 1. */
bool cs_program_folder(char *out, size_t size);

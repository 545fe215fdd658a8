/* The temporary files of output/file.h, as seen by those who come after: `.NAME.XXXX.part`, locked
 * as long as the process that writes it lives.
 */
#ifndef CS_OUTPUT_PART_H
#define CS_OUTPUT_PART_H

#include <stdbool.h>
#include <stddef.h>

/* Claims a temporary file that was just opened. false: somebody swept it away at that moment. */
bool cs_part_claim(int descriptor);
/* Removes the temporary files, in the folder of `pattern`, of names for which `matches` is true and
 * whose writers are gone. What cannot be removed stays. */
void cs_part_sweep(const char *pattern, bool (*matches)(const char *pattern, const char *name));

#endif

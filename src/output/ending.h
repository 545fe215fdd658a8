/* The ending of a file's name, which says its format where nothing else does. */
#ifndef CS_OUTPUT_ENDING_H
#define CS_OUTPUT_ENDING_H

/* What follows the last dot in the last part of the path; "" where there is no dot. Points into the
 * path. */
const char *cs_ending_of(const char *path);

#endif

/* Files of lines that are only added to, each line in one write where the system can: records that a run that was
 * stopped leaves readable, whatever it was doing.
 *
 * INVARIANT  A line is added whole or is the last and cut off; whoever adds the next one ends it
 * first.
 */
#ifndef CS_CLI_LINES_H
#define CS_CLI_LINES_H

#include <stdbool.h>

/* Makes the folders that a path names, one after the other. The path is the same afterwards. false:
 * errno says why. */
bool cs_lines_make_folders(char *path);
/* The same for a path that may not be touched. */
bool cs_lines_make_folders_for(const char *path);
/* Opens a file for reading and adding; it is made when it is missing. -1: errno says why. */
int cs_lines_open(const char *path);
/* Writes a text at the end. false: errno says why. */
bool cs_lines_add(int descriptor, const char *text);
/* Ends the last line of a file that is not empty if it was cut off. false: errno says why. */
bool cs_lines_end_last(int descriptor);

#endif

/* Journals: files to which lines are appended, if possible with one write for each line. They stay
 * readable however the run ends.
 *
 * INVARIANT  All lines are complete except perhaps the last; who appends the next one terminates it
 * first.
 */
#pragma once

#include <stdbool.h>

/* Creates the folders in a path. The path is modified in between and restored. false: errno has the
 * reason. */
bool cs_journal_make_folders(char *path);
/* The same for a constant path. */
bool cs_journal_make_folders_for(const char *path);
/* Opens a file for reading and appending; it is created if missing. -1: errno has the reason. */
int cs_journal_open(const char *path);
/* Appends a text. false: errno has the reason. */
bool cs_journal_add(int descriptor, const char *text);
/* Terminates the last line of a file that is not empty. false: errno has the reason. */
bool cs_journal_end_last(int descriptor);

/* Lists of frames and the names of their files: one grammar for Lua and the command line.
 *
 *   list     element {"," element}        spaces are allowed around elements
 *   element  n | a-b | a-b:step           inclusive; numbers may be negative; step not 0, and
 *                                         below 0 for ranges that go down
 *            2.5s | 2s-4s | 2s-4s:step    of a film: the frame that is seen then; those that begin
 *                                         at 2 seconds or later, and before 4
 *            name                         of a film: from this mark to the frame before the next
 *   pattern  shot.####.png or shot.%04d.png: the last run of # in the name, or one %d; padded with
 *            zeros, growing past its width when the number needs it
 *
 * INVARIANT: a sequence that was read has the order of its list, and no frame twice.
 */
#pragma once

#include "base/context.h"
#include "frames/film/film.h"

typedef struct cs_sequence {
  int64_t *frames; /* owned */
  size_t count, capacity;
  cs_memory *memory; /* borrowed from the context; NULL: there are no frames */
} cs_sequence;

/* film: its times and marks may occur in the list; NULL: the list has numbers alone. out: new, for
 * cs_sequence_finish. Errors: BAD_ARGUMENT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sequence_parse(celspan_context *context, const char *list,
                                                 const cs_film_info *film, cs_sequence *out);
/* The frames first, first + 1, ... of a whole film. Otherwise as above. */
CELSPAN_CHECKED celspan_status cs_sequence_count(celspan_context *context, int64_t first,
                                                 int64_t count, cs_sequence *out);
void cs_sequence_finish(cs_sequence *sequence);
/* Whether each frame is the one after the frame before it in the list. */
bool cs_sequence_is_run(const cs_sequence *sequence);
/* BAD_ARGUMENT, naming the frame, when one is outside first .. first + count - 1. */
CELSPAN_CHECKED celspan_status cs_sequence_within(celspan_context *context,
                                                  const cs_sequence *sequence, int64_t first,
                                                  int64_t count);

/* The frame of a film that is seen at a time such as "2s". false: the text is no time, or one after
 * the film. */
bool cs_sequence_at_time(const cs_film_info *film, const char *time, int64_t *out);

/* Whether the pattern has a place for a number. */
bool cs_sequence_has_number(const char *pattern);
/* Where a part of the name can be added, in the pattern and in each name: before the number, or
 * before the ending where there is none. */
size_t cs_sequence_place(const char *pattern);
/* Whether a name could belong to a frame of the pattern; both are without their folder. */
bool cs_sequence_matches(const char *pattern, const char *name);
/* The numbers of the existing files of a pattern, ascending. out: new, perhaps empty. Errors: INPUT
 * when the folder cannot be read, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_sequence_list(celspan_context *context, const char *pattern,
                                                cs_sequence *out);
/* Writes the file name of a frame. BAD_ARGUMENT when it does not fit into `size` bytes. */
CELSPAN_CHECKED celspan_status cs_sequence_name(celspan_context *context, const char *pattern,
                                                int64_t frame, char *name, size_t size);

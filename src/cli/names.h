/* The names that a film's values have: collected frame by frame, printed one a line.
 *
 *   named cel 24 hand (shot.lua:12)     a cel named hand is in 24 frames; the first one was made there
 *
 * Invariant: a name is listed once for each kind of value that has it, in the order of its first
 * frame; of more than CS_NAMES_MOST, the rest are only counted.
 */
#ifndef CS_CLI_NAMES_H
#define CS_CLI_NAMES_H

#include "scene/scene.h"

#define CS_NAMES_MOST 1000

typedef struct cs_name {
  cs_hash key; /* of the kind and the name */
  const char *kind;
  cs_mark mark; /* a reference */
  int64_t frames, last_frame;
} cs_name;

typedef struct cs_names {
  celspan_context *context;
  cs_name *names; /* owned */
  size_t count, capacity;
  bool has_more;
} cs_names;

/* Adds the names of a frame. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_names_add(cs_names *names, const celspan_exposure *exposures,
                                            size_t count, int64_t frame);
void cs_names_print(const cs_names *names);
void cs_names_finish(cs_names *names);

#endif

/* The most memory that a run may hold: the script, the scene, rendering and the caches together.
 *
 *   |<-- memory that the process may use: its control group's, the machine's, or what is given -->|
 *   | used by others | what may be held: three quarters of the rest |  room                       |
 *
 * The room is for what is not counted: the program and its libraries, gaps between allocations,
 * stacks, decoders of pictures, and the program that encodes a video. As it may not be enough for
 * them, a control group is also asked now and then how much it holds. An allocation that would fill
 * it is refused, so that the run ends with a sentence; the kernel would end it without one.
 */
#pragma once

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/control_group.h"

typedef struct cs_ceiling {
  size_t most;         /* bytes that may be held; SIZE_MAX: any */
  uint64_t whole;      /* the memory that the process may use, of which this is a part */
  const char *whose;   /* the name of this memory in sentences */
  uint64_t limit;      /* the limit of the control group; 0: it has none */
  int usage, stat;     /* files of the group, or -1: see cs_control_group_used */
  atomic_size_t asked; /* until this many bytes are held, the group is not asked again */
} cs_ceiling;

/* machine: the memory of the machine; given: the user's limit for the process, whatever other
 * processes use; 0: unknown. The least of these counts. */
void cs_ceiling_init(cs_ceiling *ceiling, const cs_control_group *group, uint64_t machine,
                     uint64_t given);
/* From now on there is no limit. */
void cs_ceiling_finish(cs_ceiling *ceiling);

typedef enum cs_refusal {
  CS_REFUSAL_NONE,
  CS_REFUSAL_RENDERING, /* the limit of rendering */
  CS_REFUSAL_HELD,      /* more bytes than may be held */
  CS_REFUSAL_GROUP      /* the group is full, no matter which process holds the memory */
} cs_refusal;

/* Whether `more` bytes may be held in addition to the bytes held now. Any thread. */
cs_refusal cs_ceiling_refuses(cs_ceiling *ceiling, size_t held, size_t more);
/* Why the allocation is refused, as the end of a sentence. */
void cs_ceiling_tell(const cs_ceiling *ceiling, cs_refusal refusal, char *text, size_t size);

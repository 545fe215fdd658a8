/* Spares: memory that was freed, kept for the arrays of the next frame.
 *
 * A C library gives large allocations back to the system, which maps and clears each of their pages
 * when they are used again. This takes longer than a frame of a few milliseconds takes otherwise.
 * So memory of 4 KiB to 16 MiB is kept when it is freed, by classes of size, and allocated again.
 * For 4 MiB and more the system is asked for huge pages, of which there are fewer.
 *
 *     class        0        1        2             12
 *     bytes    4 KiB    8 KiB   16 KiB   ...   16 MiB      a request uses the next larger class
 *     kept    [x x -  ][x - -  ][- - -  ] ...  [x - -  ]   CS_SPARES_SLOTS of each, at most
 *
 * Invariant: an allocation of more than half the smallest class, and at most the largest one, is at
 * least as large as its class. At most CS_SPARES_MOST bytes are kept. Threads exchange single
 * slots, so none waits for another one.
 */
#pragma once

#include <stdatomic.h>
#include <stddef.h>

enum { CS_SPARES_CLASSES = 13, CS_SPARES_SLOTS = 8 };

#define CS_SPARES_SMALLEST ((size_t)4 << 10)
#define CS_SPARES_LARGEST (CS_SPARES_SMALLEST << (CS_SPARES_CLASSES - 1))

#define CS_SPARES_MOST ((size_t)64 << 20)

/* Sanitizers of memory have to see what was requested, and when it is freed: then nothing has a
 * class. */
#if defined __SANITIZE_ADDRESS__
#define CS_SPARES_ARE_KEPT 0
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define CS_SPARES_ARE_KEPT 0
#endif
#endif
#ifndef CS_SPARES_ARE_KEPT
#define CS_SPARES_ARE_KEPT 1
#endif

/* All zero: nothing is kept. */
typedef struct cs_spares {
  atomic_size_t bytes; /* of what is kept; from CS_SPARES_MOST on nothing more is */
  _Atomic(void *) kept[CS_SPARES_CLASSES][CS_SPARES_SLOTS]; /* from malloc; NULL: free slots */
} cs_spares;

/* A celspan_resize on the C library's functions. user: a cs_spares. old_size must be what was
 * requested. Shrinking never fails. Any thread. */
void *cs_spares_resize(void *user, void *storage, size_t old_size, size_t new_size);
/* Frees everything that is kept. Any thread. */
void cs_spares_trim(cs_spares *spares);
/* The same, and nothing is kept any more. Any thread. */
void cs_spares_close(cs_spares *spares);

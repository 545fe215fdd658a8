/* Spares: memory that was freed, kept for the arrays of the next frame.
 *
 * A C library gives large allocations back to the system, which maps and clears each of their pages
 * when they are used again. This takes longer than a frame of a few milliseconds takes otherwise.
 * So memory of 4 KiB to 16 MiB is kept when it is freed, by classes of size, and allocated again.
 * For 2 MiB and more the system is asked for huge pages, of which there are fewer.
 *
 *     class     0      1      2      3      4      5            48
 *     KiB       4      5      6      7      8     10   ...   16384   four from each power of two to
 *               |      |             |             |           |     the next; a request uses the
 *     kept      x      x             x             x           x     next larger class
 *               |                    |             |
 *               x                    x             x                 the latest one is used first
 *
 * Invariant: an allocation of more than half the smallest class, and at most the largest one, is at
 * least as large as its class. At most `most` bytes are kept, CS_SPARES_MOST if nobody sets
 * less before other threads use them.
 */
#pragma once

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

#define CS_SPARES_SMALLEST ((size_t)4 << 10)
#define CS_SPARES_LARGEST ((size_t)16 << 20)
#define CS_SPARES_MOST ((size_t)64 << 20)

enum { CS_SPARES_CLASSES = 4 * 12 + 1 };

/* Sanitizers of memory must see which sizes are requested, and when blocks are freed: with them no
 * size has a class. */
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

typedef struct cs_spare cs_spare;

typedef struct cs_spares {
  pthread_mutex_t lock;
  bool is_closed;                    /* nothing is kept from now on */
  size_t bytes, most;                /* bytes of the kept memory: now, and at most */
  cs_spare *kept[CS_SPARES_CLASSES]; /* blocks of malloc */
} cs_spares;

/* False: the system has no lock left. */
bool cs_spares_init(cs_spares *spares);
/* For any thread, like the next two functions. A celspan_resize that uses the functions of the C
 * library. user: a cs_spares. old_size must be the requested size. Shrinking never fails. */
void *cs_spares_resize(void *user, void *storage, size_t old_size, size_t new_size);
/* Frees all kept memory. */
void cs_spares_trim(cs_spares *spares);
/* The same; from now on nothing is kept. */
void cs_spares_close(cs_spares *spares);
/* The same at the end, when no other thread uses the spares. Only memory without a class may be
 * freed afterwards. */
void cs_spares_finish(cs_spares *spares);

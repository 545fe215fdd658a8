/* Ordered work: numbered items made by several workers, delivered in order by the thread that
 * owns the pipeline.
 *
 *   add (owner, in order) --> make (any worker) --> deliver (owner, in order)
 *
 *      0 .. d-1        d   ..   c-1           c  ..  a-1         a .. end-1       end .. count-1
 *   +-------------+----------------------+------------------+------------------+-----------------+
 *   |  delivered  |  made or being made  |  to be claimed   |   to be added    |   not wanted    |
 *   +-------------+----------------------+------------------+------------------+-----------------+
 *                 ^ delivered            ^ claimed          ^ added            ^ end
 *                 |<----------- at most `slots` items ----->|
 *
 * What an item needs while it is on its way belongs to the user, in a ring: item i uses the slot
 * i % slots, which is free for item i + slots once item i has been delivered.
 *
 * INVARIANTS
 *   delivered <= claimed <= added <= delivered + slots, and none of them goes back; `end` only goes
 *   down. The owner alone moves `delivered` and `added`. Cursors move under the pipeline's lock,
 *   except `end`, which is atomic.
 *   Workers claim items in order, so every item before a claimed one has been claimed as well or is
 *   left to the owner. An item that is at or after `end` is not claimed any more, and one that is
 *   being made may ask whether it is still wanted.
 *   An item that fails moves `end` to the one after it. All items before it are still made, so the
 *   failure that is delivered first has the lowest number, whatever the number of workers.
 *   Functions of the user run without the lock. `make` runs at most once an item, in the owner's
 *   thread (worker 0) or another; all other functions run in the owner's thread.
 *   With fewer threads than were wanted, or none, the same items are delivered in the same order.
 */
#pragma once

#include "base/context.h"

typedef struct cs_pipeline cs_pipeline;

/* Who makes an item. */
typedef enum cs_pipeline_step {
  CS_PIPELINE_ANYWHERE = 0, /* any worker */
  CS_PIPELINE_HERE,         /* the owner, at once */
  CS_PIPELINE_IN_ORDER,     /* the owner, after all items before it have been delivered */
  CS_PIPELINE_NOTHING       /* nobody: the item is complete already */
} cs_pipeline_step;

typedef struct cs_pipeline_desc {
  size_t count; /* the number of items that may be added in all */
  size_t slots; /* at least 1 */
  int threads;  /* in addition to the owner's */
  /* The owner also makes items while it waits for one; otherwise it makes only the items that are
   * left to it. */
  bool owner_claims;
  bool keeps_going; /* later items are made even if one has failed */
  void *user;
  /* worker: 0 for the owner, up to `threads` for the others, each with a context of its own. The
   * sentence of a failure is expected in the context. */
  celspan_status (*make)(void *user, celspan_context *context, int worker, size_t item);
  /* status: of the item; its sentence is in the context, which is the owner's. cs_pipeline_deliver
   * returns this function's status; unless it is OK, the item counts as not delivered. */
  celspan_status (*deliver)(void *user, celspan_context *context, size_t item,
                            celspan_status status);
  /* Called whenever the owner has waited for a tenth of a second. A status other than OK ends the
   * waiting. NULL: the owner waits without a limit. */
  celspan_status (*idle)(void *user, celspan_context *context);
  /* Called when another thread than the owner's has made an item, by that thread and under the
   * lock: it may only wake the owner, which waits elsewhere. NULL: nobody is woken. */
  void (*tell)(void *user);
} cs_pipeline_desc;

/* Starts the threads. desc: copied. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_pipeline_create(celspan_context *context,
                                                  const cs_pipeline_desc *desc, cs_pipeline **out);
/* Cancels all items that are left, and returns when all threads have ended. NULL is ignored. */
void cs_pipeline_destroy(cs_pipeline *pipeline);

/* Only the owner may call the functions below, with its context. */

/* The number of threads in addition to the owner's. */
int cs_pipeline_threads(const cs_pipeline *pipeline);
/* Whether another item may be added: there is one that is wanted, and a slot for it. */
bool cs_pipeline_has_room(const cs_pipeline *pipeline);
/* Adds the next item; there must be a free slot, which has been filled. With a status other than OK
 * the item has failed already: its sentence is in the context, and nobody makes it. */
void cs_pipeline_add(cs_pipeline *pipeline, celspan_context *context, cs_pipeline_step step,
                     celspan_status status);
/* Whether the next item to be delivered is complete or left to the owner, so that
 * cs_pipeline_deliver does not have to wait. */
bool cs_pipeline_is_ready(cs_pipeline *pipeline);
/* Delivers items until at most `left` of the added items are not delivered. Errors: those of
 * deliver and of idle. */
CELSPAN_CHECKED celspan_status cs_pipeline_deliver(cs_pipeline *pipeline, celspan_context *context,
                                                   size_t left);

/* Items from this one on are not wanted. Any thread. */
void cs_pipeline_end_at(cs_pipeline *pipeline, size_t item);
/* Any thread. */
bool cs_pipeline_is_wanted(const cs_pipeline *pipeline, size_t item);

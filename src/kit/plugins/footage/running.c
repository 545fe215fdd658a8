/* The movies that have a worker. */
#include "plugins/footage/decode.h"

enum { RUNNING = 64 /* workers at a time, of all movies */ };

static struct {
  pthread_mutex_t lock;
  cs_decode *list; /* with workers, the latest first */
  size_t count;
} all = {.lock = PTHREAD_MUTEX_INITIALIZER};

/* Ends the worker. The caller has locked both locks. */
static void end_worker(cs_decode *d) {
  cs_decode **link = &all.list;
  while (*link && *link != d)
    link = &(*link)->running;
  if (*link) {
    *link = d->running;
    all.count--;
  }
  cs_media_close(&d->media);
  d->is_running = false;
}

void cs_decode_stop(cs_decode *d) {
  if (!d->is_running)
    return;
  pthread_mutex_lock(&all.lock);
  end_worker(d);
  pthread_mutex_unlock(&all.lock);
}

void cs_decode_note(cs_decode *d) {
  cs_decode *oldest = NULL;
  pthread_mutex_lock(&all.lock);
  for (cs_decode *at = all.list; at && all.count >= RUNNING; at = at->running) {
    if (pthread_mutex_trylock(&at->lock) != 0)
      continue;
    if (oldest)
      pthread_mutex_unlock(&oldest->lock);
    oldest = at;
  }
  if (oldest) {
    end_worker(oldest);
    pthread_mutex_unlock(&oldest->lock);
  }
  d->running = all.list;
  all.list = d;
  all.count++;
  d->is_running = true;
  pthread_mutex_unlock(&all.lock);
}

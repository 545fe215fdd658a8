#include "cli/decoder/refusal.h"

#include <pthread.h>

typedef struct refusal {
  cs_refusal_key key;
  cs_picture_failure failure;
} refusal;

static struct {
  pthread_mutex_t lock;
  refusal items[CS_REFUSALS_MOST]; /* the next one takes the place count % CS_REFUSALS_MOST */
  uint64_t count;
} known = {.lock = PTHREAD_MUTEX_INITIALIZER};

cs_refusal_key cs_refusal_key_of(const struct stat *file) {
  return (cs_refusal_key){.device = (uint64_t)file->st_dev,
                          .number = (uint64_t)file->st_ino,
                          .size = (int64_t)file->st_size,
                          .time =
                              (int64_t)file->st_mtim.tv_sec * 1000000000 + file->st_mtim.tv_nsec};
}

bool cs_refusal_is_same(const cs_refusal_key *a, const cs_refusal_key *b) {
  return a->device == b->device && a->number == b->number && a->size == b->size &&
         a->time == b->time;
}

void cs_refusal_add(const cs_refusal_key *key, const cs_picture_failure *failure) {
  pthread_mutex_lock(&known.lock);
  known.items[known.count++ % CS_REFUSALS_MOST] = (refusal){*key, *failure};
  pthread_mutex_unlock(&known.lock);
}

bool cs_refusal_find(const cs_refusal_key *key, cs_picture_failure *failure) {
  bool is_known = false;
  pthread_mutex_lock(&known.lock);
  for (uint64_t i = 0; i < known.count && i < CS_REFUSALS_MOST && !is_known; i++)
    if (cs_refusal_is_same(&known.items[i].key, key)) {
      *failure = known.items[i].failure;
      is_known = true;
    }
  pthread_mutex_unlock(&known.lock);
  return is_known;
}

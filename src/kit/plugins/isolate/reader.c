#include "plugins/isolate/reader.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "plugins/isolate/worker.h"

#define PIXEL (4 * sizeof(float))
#define KEPT ((size_t)8 << 20) /* bytes of shared memory that a worker keeps between reads */

enum { REFUSALS_MOST = 64 };

/* ---------------------------------------------------------------- refusals */

/* Pictures that ended a worker are not tried again until the file changes. The last REFUSALS_MOST
 * of them are remembered. Any thread. */

/* Identifies a file, as long as it does not change. */
typedef struct file_key {
  uint64_t device, number;
  int64_t size, time; /* nanoseconds */
} file_key;

typedef struct refusal {
  file_key key;
  cs_picture_failure failure;
} refusal;

static struct {
  pthread_mutex_t lock;
  refusal items[REFUSALS_MOST]; /* the next index is count % REFUSALS_MOST */
  uint64_t count;
} known = {.lock = PTHREAD_MUTEX_INITIALIZER};

static file_key key_of(const struct stat *file) {
  return (file_key){.device = (uint64_t)file->st_dev,
                    .number = (uint64_t)file->st_ino,
                    .size = (int64_t)file->st_size,
                    .time = (int64_t)file->st_mtim.tv_sec * 1000000000 + file->st_mtim.tv_nsec};
}

static bool is_same_file(const file_key *a, const file_key *b) {
  return a->device == b->device && a->number == b->number && a->size == b->size &&
         a->time == b->time;
}

static void add_refusal(const file_key *key, const cs_picture_failure *failure) {
  pthread_mutex_lock(&known.lock);
  known.items[known.count++ % REFUSALS_MOST] = (refusal){*key, *failure};
  pthread_mutex_unlock(&known.lock);
}

static bool find_refusal(const file_key *key, cs_picture_failure *failure) {
  bool is_known = false;
  pthread_mutex_lock(&known.lock);
  for (uint64_t i = 0; i < known.count && i < REFUSALS_MOST && !is_known; i++)
    if (is_same_file(&known.items[i].key, key)) {
      *failure = known.items[i].failure;
      is_known = true;
    }
  pthread_mutex_unlock(&known.lock);
  return is_known;
}

struct cs_picture_reader {
  char *file, *layer, *space; /* layer and space: may be NULL */
  int subimage;
  file_key key;      /* the key of the file that was opened */
  cs_worker *worker; /* NULL: none; a worker may have ended */
  uint32_t number;   /* the number of the reader in the worker */
};

/* ---------------------------------------------------------------- failures */

static celspan_status fail(const cs_picture_reader *reader, celspan_status status, const char *text,
                           cs_picture_failure *failure) {
  return cs_worker_fail(failure, status, reader->file, text);
}

/* A worker opens files through its descriptors, and libraries put the names of these into messages.
 * Replaces them by the name of the file. */
static celspan_status fail_with_name(const cs_picture_reader *reader, celspan_status status,
                                     const char *text, cs_picture_failure *failure) {
  static const char opened[] = "/proc/self/fd/";
  cs_picture_failure named = {status, ""};
  const char *at = strstr(text, opened);
  if (!at)
    return fail(reader, status, text, failure);
  const char *end = at + strlen(opened);
  end += strspn(end, "0123456789");
  int length = snprintf(named.text, sizeof named.text, "%.*s%s%s", (int)(at - text), text,
                        reader->file, end);
  return fail(reader, status, length < 0 ? text : named.text, failure);
}

/* The outcome of the worker as a failure of the picture. *is_worn: the worker ran out of memory
 * after it had served other readers, and was ended; a new worker may succeed. The caller has locked
 * the worker. */
static celspan_status judge(const cs_picture_reader *reader, cs_worker_outcome outcome,
                            const cs_message *answer, bool *is_worn, cs_picture_failure *failure) {
  cs_picture_failure reason;
  bool has_answered = outcome == CS_WORKER_ANSWERED;
  *is_worn = false;
  if (has_answered && answer->status == CELSPAN_OK)
    return CELSPAN_OK;
  if (has_answered && answer->status != CELSPAN_NO_MEMORY)
    return fail_with_name(reader, (celspan_status)answer->status, answer->text, failure);
  *is_worn = has_answered && cs_worker_retire(reader->worker);
  celspan_status status = cs_worker_explain(reader->worker, outcome, CELSPAN_INPUT, &reason);
  if (!has_answered && outcome != CS_WORKER_STOPPED)
    add_refusal(&reader->key, &reason);
  return fail(reader, status, reason.text, failure);
}

/* ---------------------------------------------------------------- opening in a worker */

/* Takes a worker that has not ended, and locks it. */
static celspan_status take(cs_picture_reader *reader, bool is_fresh, cs_picture_failure *failure) {
  cs_picture_failure reason;
  for (;;) {
    celspan_status status = cs_worker_take(CS_WORKER_READS, is_fresh, &reader->worker, &reason);
    if (status != CELSPAN_OK)
      return fail(reader, status, reason.text, failure);
    cs_worker_lock(reader->worker);
    if (reader->worker->socket >= 0)
      return CELSPAN_OK;
    cs_worker_unlock(reader->worker);
    cs_worker_leave(reader->worker);
  }
}

static void leave(cs_picture_reader *reader) {
  cs_worker_unlock(reader->worker);
  cs_worker_leave(reader->worker);
  reader->worker = NULL;
}

static celspan_status ask_to_open(cs_picture_reader *reader, int descriptor,
                                  cs_picture_header *header, bool *is_worn,
                                  cs_picture_failure *failure) {
  const char *const texts[] = {reader->layer, reader->space};
  cs_message message = {.kind = CS_MESSAGE_OPEN,
                        .open = {.subimage = reader->subimage,
                                 .has_layer = reader->layer != NULL,
                                 .has_space = reader->space != NULL}};
  *is_worn = false;
  if (!cs_worker_put_texts(reader->worker, texts, 2))
    return fail(reader, CELSPAN_BAD_ARGUMENT, "the name of its layer is too long", failure);
  cs_worker_outcome outcome =
      cs_worker_ask(reader->worker, &(cs_worker_request){&message, descriptor, NULL, NULL});
  if (outcome == CS_WORKER_ANSWERED && message.status == CELSPAN_OK &&
      !cs_message_header_of(&message, header)) {
    cs_worker_end(reader->worker);
    outcome = CS_WORKER_INVALID;
  }
  reader->number = message.number;
  return judge(reader, outcome, &message, is_worn, failure);
}

/* Opens the file in a worker, or in a new one if that worker had no memory left; keeps the worker
 * locked. */
static celspan_status attach(cs_picture_reader *reader, int descriptor, bool is_fresh,
                             cs_picture_header *header, cs_picture_failure *failure) {
  bool is_worn = false;
  celspan_status status = CELSPAN_OK;
  do {
    status = take(reader, is_fresh || is_worn, failure);
    if (status != CELSPAN_OK)
      break;
    status = ask_to_open(reader, descriptor, header, &is_worn, failure);
    if (status != CELSPAN_OK)
      leave(reader);
  } while (is_worn);
  if (status != CELSPAN_OK)
    reader->worker = NULL;
  return status;
}

/* ---------------------------------------------------------------- opening */

static char *copy_text(const char *text, bool *is_good) {
  char *copy = text ? strdup(text) : NULL;
  *is_good = *is_good && (copy || !text);
  return copy;
}

static void destroy(cs_picture_reader *reader) {
  free(reader->file);
  free(reader->layer);
  free(reader->space);
  free(reader);
}

static cs_picture_reader *create(const cs_picture_request *request) {
  cs_picture_reader *reader = calloc(1, sizeof *reader);
  bool is_good = true;
  if (!reader)
    return NULL;
  reader->file = copy_text(request->file, &is_good);
  reader->layer = copy_text(request->layer, &is_good);
  reader->space = copy_text(request->space, &is_good);
  reader->subimage = request->subimage;
  if (is_good)
    return reader;
  destroy(reader);
  return NULL;
}

/* Opens the file; -1: failed. NONBLOCK: opening a pipe without a writer must not wait. The module
 * refuses pipes and devices. */
static int open_file(cs_picture_reader *reader, file_key *key, celspan_status *status,
                     cs_picture_failure *failure) {
  struct stat found;
  char text[256];
  int descriptor = open(reader->file, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor >= 0 && fstat(descriptor, &found) == 0) {
    *key = key_of(&found);
    return descriptor;
  }
  snprintf(text, sizeof text, "cannot be opened: %s", strerror(errno));
  if (descriptor >= 0)
    close(descriptor);
  *status = fail(reader, CELSPAN_INPUT, text, failure);
  return -1;
}

static celspan_status open_first(cs_picture_reader *reader, cs_picture_header *header,
                                 cs_picture_failure *failure) {
  celspan_status status = CELSPAN_OK;
  cs_picture_failure reason;
  int descriptor = open_file(reader, &reader->key, &status, failure);
  if (descriptor < 0)
    return status;
  if (find_refusal(&reader->key, &reason)) {
    status = fail(reader, reason.status, reason.text, failure);
  } else {
    status = attach(reader, descriptor, false, header, failure);
    if (status == CELSPAN_OK)
      cs_worker_unlock(reader->worker);
  }
  close(descriptor);
  return status;
}

celspan_status cs_reader_open(const cs_picture_request *request, cs_picture_reader **out,
                              cs_picture_header *header, cs_picture_failure *failure) {
  cs_picture_reader *reader = create(request);
  if (!reader)
    return cs_worker_fail(failure, CELSPAN_NO_MEMORY, request->file, "out of memory");
  celspan_status status = open_first(reader, header, failure);
  return CS_GIVE(status, reader, destroy, out);
}

void cs_reader_close(cs_picture_reader *reader) {
  const cs_message message = {.kind = CS_MESSAGE_CLOSE, .number = reader->number};
  if (reader->worker) {
    cs_worker_lock(reader->worker);
    /* If the worker cannot receive it, the worker has died; the next request notices this. */
    if (reader->worker->socket >= 0)
      (void)!cs_message_send(reader->worker->socket, &message, -1);
    leave(reader);
  }
  destroy(reader);
}

/* ---------------------------------------------------------------- opening again */

static celspan_status fail_changed(const cs_picture_reader *reader, cs_picture_failure *failure) {
  return fail(reader, CELSPAN_INPUT, "changed while it was in use", failure);
}

static celspan_status open_again(cs_picture_reader *reader, bool is_fresh,
                                 cs_picture_failure *failure) {
  cs_picture_header header;
  file_key key;
  cs_picture_failure reason;
  celspan_status status = CELSPAN_OK;
  int descriptor = open_file(reader, &key, &status, failure);
  if (descriptor < 0)
    return status;
  if (!is_same_file(&key, &reader->key))
    status = fail_changed(reader, failure);
  else if (find_refusal(&key, &reason))
    status = fail(reader, reason.status, reason.text, failure);
  else
    status = attach(reader, descriptor, is_fresh, &header, failure);
  close(descriptor);
  return status;
}

/* Makes sure that a worker has the picture open, and keeps it locked. */
static celspan_status return_to_worker(cs_picture_reader *reader, bool is_fresh,
                                       cs_picture_failure *failure) {
  struct stat found;
  if (stat(reader->file, &found) != 0)
    return fail_changed(reader, failure);
  const file_key key = key_of(&found);
  if (!is_same_file(&key, &reader->key))
    return fail_changed(reader, failure);
  if (reader->worker) {
    cs_worker_lock(reader->worker);
    if (reader->worker->socket >= 0)
      return CELSPAN_OK;
    leave(reader);
  }
  return open_again(reader, is_fresh, failure);
}

/* ---------------------------------------------------------------- reading */

static celspan_status read_once(cs_picture_reader *reader, const celspan_rectangle *at, float *rgba,
                                bool *is_worn, cs_picture_failure *failure) {
  cs_message message = {.kind = CS_MESSAGE_READ, .number = reader->number, .rectangle = *at};
  size_t size = (size_t)at->width * (size_t)at->height * PIXEL;
  cs_worker *worker = reader->worker;
  cs_worker_outcome outcome = cs_worker_ask(worker, &(cs_worker_request){&message, -1, NULL, NULL});
  celspan_status status = judge(reader, outcome, &message, is_worn, failure);
  if (status == CELSPAN_OK)
    memcpy(rgba, worker->shared, size);
  if (size > KEPT)
    madvise(worker->shared, CS_SHARED, MADV_REMOVE);
  cs_worker_unlock(worker);
  return status;
}

static celspan_status read_rows(cs_picture_reader *reader, const celspan_rectangle *at, float *rgba,
                                cs_picture_failure *failure) {
  bool is_worn = false;
  celspan_status status;
  do {
    status = return_to_worker(reader, is_worn, failure);
    if (status == CELSPAN_OK)
      status = read_once(reader, at, rgba, &is_worn, failure);
    else
      is_worn = false;
  } while (is_worn);
  return status;
}

celspan_status cs_reader_read(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                              int32_t height, float *rgba, cs_picture_failure *failure) {
  size_t row = (size_t)width * PIXEL;
  int32_t most = (int32_t)(CS_SHARED / row); /* at least 4 of the longest row */
  celspan_status status = CELSPAN_OK;
  for (int32_t done = 0; done < height && status == CELSPAN_OK; done += most) {
    const celspan_rectangle part = {x, y + done, width,
                                    height - done < most ? height - done : most};
    status = read_rows(reader, &part, rgba + (size_t)done * 4 * (size_t)width, failure);
  }
  return status;
}

/* ---------------------------------------------------------------- listing */

typedef struct listener {
  bool (*put)(void *user, const cs_picture_part *part);
  void *user;
} listener;

static bool put_part(void *user, const cs_message *message) {
  const listener *to = user;
  const cs_picture_part part = cs_message_part_of(message);
  return message->kind == CS_MESSAGE_PART && to->put(to->user, &part);
}

celspan_status cs_reader_list(cs_picture_reader *reader,
                              bool (*put)(void *user, const cs_picture_part *part), void *user,
                              cs_picture_failure *failure) {
  listener to = {put, user};
  bool is_worn;
  celspan_status status = return_to_worker(reader, false, failure);
  if (status != CELSPAN_OK)
    return status;
  cs_message message = {.kind = CS_MESSAGE_LIST, .number = reader->number};
  cs_worker_outcome outcome =
      cs_worker_ask(reader->worker, &(cs_worker_request){&message, -1, put_part, &to});
  status = judge(reader, outcome, &message, &is_worn, failure);
  cs_worker_unlock(reader->worker);
  return status;
}

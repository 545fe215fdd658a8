#include "cli/decoder/decoder.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/decoder/keeping.h"
#include "cli/decoder/server.h"
#include "cli/interrupt.h"
#include "cli/progress.h"

enum { LOADING_PARTS = 10 }; /* the module may take as long to load as so many parts to decode */

static struct {
  pthread_mutex_t lock;
  cs_decoder_limits limits;
  cs_decoder *list; /* those that live */
} all = {.lock = PTHREAD_MUTEX_INITIALIZER};

void cs_decoder_limit(const cs_decoder_limits *limits) { all.limits = *limits; }

void cs_decoder_lock(cs_decoder *decoder) { pthread_mutex_lock(&decoder->asking); }

void cs_decoder_unlock(cs_decoder *decoder) { pthread_mutex_unlock(&decoder->asking); }

/* ---------------------------------------------------------------- one decoder */

static void destroy(cs_decoder *decoder) {
  if (decoder->shared)
    munmap(decoder->shared, CS_SHARED);
  if (decoder->socket >= 0)
    close(decoder->socket);
  pthread_mutex_destroy(&decoder->asking);
  free(decoder);
}

/* Memory whose size neither side can change: what is cut off could not be read any more. A
 * descriptor, or -1 and errno. */
static int share_memory(cs_decoder *decoder) {
  int memory = memfd_create("celspan pictures", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (memory < 0)
    return -1;
  void *shared = MAP_FAILED;
  if (ftruncate(memory, (off_t)CS_SHARED) == 0 &&
      fcntl(memory, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0)
    shared = mmap(NULL, CS_SHARED, PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
  if (shared != MAP_FAILED) {
    decoder->shared = shared;
    return memory;
  }
  int error = errno;
  close(memory);
  errno = error;
  return -1;
}

static celspan_status fail(cs_picture_failure *failure, celspan_status status, const char *text) {
  failure->status = status;
  snprintf(failure->text, sizeof failure->text, "%s", text);
  return status;
}

static celspan_status start(cs_decoder *decoder, cs_picture_failure *failure) {
  const cs_message_start desc = {.memory = decoder->is_writer ? 0 : all.limits.memory,
                                 .loading = LOADING_PARTS * all.limits.seconds,
                                 .is_writer = decoder->is_writer};
  int memory = share_memory(decoder);
  if (memory < 0)
    return cs_keeping_refuse(errno, decoder->is_writer ? CELSPAN_OUTPUT : CELSPAN_INPUT, failure);
  celspan_status status =
      cs_keeping_start(&desc, memory, &decoder->socket, &decoder->number, failure);
  close(memory);
  return status;
}

static celspan_status create(bool is_writer, cs_decoder **out, cs_picture_failure *failure) {
  cs_decoder *decoder = calloc(1, sizeof *decoder);
  if (!decoder)
    return fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  decoder->is_writer = is_writer;
  decoder->socket = -1;
  pthread_mutex_init(&decoder->asking, NULL);
  celspan_status status = start(decoder, failure);
  if (status == CELSPAN_OK)
    *out = decoder;
  else
    destroy(decoder);
  return status;
}

/* ---------------------------------------------------------------- all of them */

static int most_decoders(void) {
  long processors = sysconf(_SC_NPROCESSORS_ONLN);
  return processors < 1 ? 1 : processors > CS_DECODERS_MOST ? CS_DECODERS_MOST : (int)processors;
}

/* The one with the fewest users, if another one is not better; else NULL. The lock is held. */
static cs_decoder *choose(bool is_writer) {
  cs_decoder *best = NULL;
  int count = 0;
  for (cs_decoder *at = all.list; at; at = at->next)
    if (at->is_writer == is_writer) {
      best = !best || at->users < best->users ? at : best;
      count++;
    }
  bool is_good = best && (best->users == 0 || (!is_writer && count >= most_decoders()));
  return is_good ? best : NULL;
}

celspan_status cs_decoder_take(bool is_writer, bool is_fresh, cs_decoder **out,
                               cs_picture_failure *failure) {
  celspan_status status = CELSPAN_OK;
  pthread_mutex_lock(&all.lock);
  cs_decoder *decoder = is_fresh ? NULL : choose(is_writer);
  if (decoder) {
    decoder->has_served = true;
  } else {
    status = create(is_writer, &decoder, failure);
    if (status == CELSPAN_OK) {
      decoder->next = all.list;
      all.list = decoder;
    }
  }
  if (status == CELSPAN_OK) {
    decoder->users++;
    *out = decoder;
  }
  pthread_mutex_unlock(&all.lock);
  return status;
}

void cs_decoder_leave(cs_decoder *decoder) {
  pthread_mutex_lock(&all.lock);
  bool is_last = --decoder->users == 0 && decoder->socket < 0;
  pthread_mutex_unlock(&all.lock);
  if (is_last)
    destroy(decoder);
}

void cs_decoder_end(cs_decoder *decoder) {
  int ending = cs_keeping_end(decoder->number);
  pthread_mutex_lock(&all.lock);
  cs_decoder **link = &all.list;
  while (*link != decoder)
    link = &(*link)->next;
  *link = decoder->next;
  close(decoder->socket);
  decoder->socket = -1;
  decoder->ending = ending;
  pthread_mutex_unlock(&all.lock);
}

bool cs_decoder_retire(cs_decoder *decoder) {
  pthread_mutex_lock(&all.lock);
  bool is_worn = decoder->has_served;
  pthread_mutex_unlock(&all.lock);
  if (is_worn)
    cs_decoder_end(decoder);
  return is_worn;
}

void cs_decoder_finish(void) {
  for (cs_decoder *at = all.list, *next; at; at = next) {
    next = at->next;
    destroy(at);
  }
  all.list = NULL;
  cs_keeping_finish();
}

/* ---------------------------------------------------------------- asking */

bool cs_decoder_put_texts(const cs_decoder *decoder, const char *const *texts, size_t count) {
  size_t at = 0;
  for (size_t i = 0; i < count; i++) {
    const char *text = texts[i] ? texts[i] : "";
    size_t size = strlen(text) + 1;
    if (size > CS_SHARED_PUT - at)
      return false;
    memcpy(decoder->shared + at, text, size);
    at += size;
  }
  return true;
}

/* What came before the answer. Whether it was allowed, and answered. */
static bool take_part(const cs_decoder *decoder, const cs_decoder_request *request) {
  cs_message *message = request->message;
  bool is_known = message->kind == CS_MESSAGE_PART || message->kind == CS_MESSAGE_PUT;
  if (!is_known || !request->put)
    return false;
  bool goes_on = request->put(request->user, message);
  const cs_message reply = {.kind = message->kind,
                            .status = goes_on ? CELSPAN_OK : CELSPAN_CANCELLED};
  return cs_message_send(decoder->socket, &reply, -1);
}

static cs_decoder_outcome wait_for_answer(const cs_decoder *decoder,
                                          const cs_decoder_request *request) {
  double start = cs_progress_clock(), most = decoder->is_writer ? 0 : all.limits.seconds;
  for (;;) {
    cs_message_arrival arrival = cs_message_receive(decoder->socket, request->message, NULL);
    bool has_arrived = arrival == CS_MESSAGE_ARRIVED;
    if (has_arrived && request->message->kind == CS_MESSAGE_DONE)
      return CS_DECODER_ANSWERED;
    if (arrival == CS_MESSAGE_OVER)
      return CS_DECODER_DIED;
    if (arrival == CS_MESSAGE_BAD || (has_arrived && !take_part(decoder, request)))
      return CS_DECODER_ASTRAY;
    if (cs_interrupt_signal())
      return CS_DECODER_STOPPED;
    if (most > 0 && cs_progress_clock() - start > most)
      return CS_DECODER_LATE;
  }
}

cs_decoder_outcome cs_decoder_ask(cs_decoder *decoder, const cs_decoder_request *request) {
  cs_decoder_outcome outcome = CS_DECODER_DIED;
  if (cs_message_send(decoder->socket, request->message, request->descriptor))
    outcome = wait_for_answer(decoder, request);
  if (outcome != CS_DECODER_ANSWERED)
    cs_decoder_end(decoder);
  return outcome;
}

/* ---------------------------------------------------------------- explaining */

celspan_status cs_decoder_fail(cs_picture_failure *failure, celspan_status status, const char *file,
                               const char *reason) {
  failure->status = status;
  if (snprintf(failure->text, sizeof failure->text, "%s: %s", file, reason) < 0)
    failure->text[0] = '\0';
  return status;
}

static celspan_status explain_memory(const cs_decoder *decoder, cs_picture_failure *failure) {
  if (decoder->is_writer || !all.limits.memory)
    return fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  failure->status = CELSPAN_NO_MEMORY;
  snprintf(failure->text, sizeof failure->text,
           "out of memory: decoding it needs more than %llu MiB, or than the system has "
           "(--limit picture-memory=SIZE)",
           (unsigned long long)(all.limits.memory >> 20));
  return CELSPAN_NO_MEMORY;
}

static celspan_status explain_death(const cs_decoder *decoder, celspan_status other,
                                    cs_picture_failure *failure) {
  int ending = decoder->ending;
  if (ending == -1)
    return fail(failure, CELSPAN_NO_MEMORY,
                "the decoder of pictures was ended: the memory of the system may be full");
  if (cs_server_is_starved(ending))
    return explain_memory(decoder, failure);
  failure->status = other;
  if (WIFSIGNALED(ending))
    snprintf(failure->text, sizeof failure->text, "%s ended its decoder by signal %d (%s)%s",
             decoder->is_writer ? "writing it" : "it", WTERMSIG(ending),
             strsignal(WTERMSIG(ending)),
             decoder->is_writer ? "" : "; it is damaged, or made to do harm");
  else
    snprintf(failure->text, sizeof failure->text, "%s ended its decoder with exit code %d",
             decoder->is_writer ? "writing it" : "it", WEXITSTATUS(ending));
  return other;
}

celspan_status cs_decoder_explain(const cs_decoder *decoder, cs_decoder_outcome outcome,
                                  celspan_status other, cs_picture_failure *failure) {
  if (outcome == CS_DECODER_STOPPED)
    return fail(failure, CELSPAN_CANCELLED, "a signal asked to stop");
  if (outcome == CS_DECODER_ANSWERED)
    return explain_memory(decoder, failure);
  if (outcome == CS_DECODER_DIED)
    return explain_death(decoder, other, failure);
  if (outcome == CS_DECODER_ASTRAY)
    return fail(failure, other,
                "its decoder answered what cannot be; it is damaged, or made to do harm");
  failure->status = CELSPAN_LIMIT;
  snprintf(failure->text, sizeof failure->text,
           "decoding a part of it took more than %g seconds, and was given up (--limit "
           "picture-time=SECONDS)",
           all.limits.seconds);
  return CELSPAN_LIMIT;
}

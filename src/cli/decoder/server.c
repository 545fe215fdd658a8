#include "cli/decoder/server.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sandbox/strict.h"

enum {
  READERS = 1024, /* open at a time: many times what the store keeps open */
  REFUSED = 6,    /* the exit code where the kernel cannot confine */
  FAULT_STACK = 1 << 16,
  PUT_BYTES = 4 << 20
};

typedef struct server {
  const cs_picture_module *module;
  int socket;
  unsigned char *shared;
  cs_picture_reader *readers[READERS];
  int descriptors[READERS]; /* of the files of readers */
  cs_picture_writer *writer;
} server;

/* ---------------------------------------------------------------- faults */

/* A failed allocation leaves its mark in errno, also where the library went on with no memory until
 * it fell, or ended itself by an exception that nobody caught. */
static void end_by_fault(int number) {
  if (errno == ENOMEM)
    _exit(CS_SERVER_NO_MEMORY);
  signal(number, SIG_DFL);
  raise(number);
}

static bool is_serving; /* pictures; else libraries may be loaded that pictures need */

/* Keepers and decoders leave by _exit alone. A library that calls exit while it is loaded, before
 * there is a picture, has no memory to begin with, whatever is in errno after its last words. */
static void end_by_library(void) {
  if (!is_serving || errno == ENOMEM)
    _exit(CS_SERVER_NO_MEMORY);
}

bool cs_server_is_starved(int ending) {
  if (WIFSIGNALED(ending))
    return WTERMSIG(ending) == SIGKILL || WTERMSIG(ending) == SIGTRAP;
  return WIFEXITED(ending) && (WEXITSTATUS(ending) == CS_SERVER_NO_MEMORY ||
                               WEXITSTATUS(ending) == CS_SERVER_NOT_LOADED);
}

void cs_server_watch_faults(void) {
  if (atexit(end_by_library) != 0)
    _exit(CS_SERVER_NO_MEMORY);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  static char stack[FAULT_STACK];
  static const int faults[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM};
  const stack_t apart = {.ss_sp = stack, .ss_size = sizeof stack};
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = end_by_fault;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  sigaltstack(&apart, NULL);
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++)
    sigaction(faults[i], &action, NULL);
#endif
}

/* ---------------------------------------------------------------- confinement */

static void limit(int resource, rlim_t most) {
  const struct rlimit both = {most, most};
  if (setrlimit(resource, &both) != 0)
    _exit(REFUSED);
}

/* Bytes of data that this process has; 0: not known. */
static uint64_t data_bytes(void) {
  unsigned long pages = 0;
  FILE *file = fopen("/proc/self/statm", "re");
  if (file && fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages) != 1)
    pages = 0;
  if (file)
    fclose(file);
  return (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

/* Programs that check themselves need memory of their own, by the terabyte, and tell what they find. */
static void limit_memory_and_files(uint64_t memory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  (void)memory, (void)data_bytes;
#else
  if (memory)
    limit(RLIMIT_DATA, (rlim_t)(data_bytes() + memory));
  limit(RLIMIT_FSIZE, 0);
#endif
}

static void confine(const cs_server_desc *desc) {
  cs_roots none = {.count = 0}, all = {.count = 0};
  limit_memory_and_files(desc->start.memory);
  limit(RLIMIT_CORE, 0);
  bool is_known = desc->roots || cs_roots_add(&all, "/");
  const char *refusal = is_known ? cs_strict_enter(desc->roots ? desc->roots : &all, &none) : "";
  cs_roots_finish(&all);
  if (refusal && desc->roots)
    _exit(REFUSED);
}

/* ---------------------------------------------------------------- answers */

static void answer(const server *s, const cs_message *message) {
  if (!cs_message_send(s->socket, message, -1))
    _exit(0);
}

static cs_message receive(const server *s, int *descriptor) {
  cs_message message;
  cs_message_arrival arrival;
  do
    arrival = cs_message_receive(s->socket, &message, descriptor);
  while (arrival == CS_MESSAGE_LATE);
  if (arrival != CS_MESSAGE_ARRIVED)
    _exit(0);
  return message;
}

/* Sends a message that is to be answered. Whether the work goes on. */
static bool ask(const server *s, const cs_message *message) {
  answer(s, message);
  return receive(s, NULL).status == CELSPAN_OK;
}

/* The sentence without the name under which the file was opened here. */
static const char *sentence_of(const char *name, const char *text) {
  size_t size = strlen(name);
  bool has_name = strncmp(text, name, size) == 0 && strncmp(text + size, ": ", 2) == 0;
  return text + (has_name ? size + 2 : 0);
}

/* Answers a message that was worked on. name: under which the module knows the file. */
static void conclude(const server *s, cs_message *message, celspan_status status, const char *name,
                     const cs_picture_failure *failure) {
  bool is_starved = status != CELSPAN_OK && errno == ENOMEM;
  message->kind = CS_MESSAGE_DONE;
  message->status = is_starved ? CELSPAN_NO_MEMORY : status;
  snprintf(message->text, sizeof message->text, "%s",
           status == CELSPAN_OK ? ""
           : is_starved         ? "out of memory"
                                : sentence_of(name, failure->text));
  answer(s, message);
}

static void refuse(const server *s, cs_message *message) {
  const cs_picture_failure failure = {CELSPAN_INTERNAL,
                                      "the decoder was asked for what it has not"};
  errno = 0;
  conclude(s, message, CELSPAN_INTERNAL, "", &failure);
}

/* ---------------------------------------------------------------- reading */

static void name_file(int descriptor, char out[32]) {
  snprintf(out, 32, "/proc/self/fd/%d", descriptor);
}

static void open_reader(server *s, cs_message *message, int descriptor) {
  const char *layer = (const char *)s->shared, *space = layer + strlen(layer) + 1;
  cs_picture_failure failure = {CELSPAN_OK, ""};
  cs_picture_header header;
  uint32_t number = 0;
  char name[32];
  while (number < READERS && s->readers[number])
    number++;
  if (number == READERS || descriptor < 0) {
    refuse(s, message);
    return;
  }
  name_file(descriptor, name);
  const cs_picture_request request = {.file = name,
                                      .layer = message->open.has_layer ? layer : NULL,
                                      .subimage = message->open.subimage,
                                      .space = message->open.has_space ? space : NULL};
  celspan_status status = s->module->open(&request, &s->readers[number], &header, &failure);
  s->descriptors[number] = descriptor;
  message->number = number;
  if (status == CELSPAN_OK)
    cs_message_set_header(message, &header);
  conclude(s, message, status, name, &failure);
  if (status == CELSPAN_OK)
    return;
  s->readers[number] = NULL;
  close(descriptor);
}

static void read_rectangle(server *s, cs_message *message) {
  const celspan_rectangle *at = &message->rectangle;
  cs_picture_failure failure = {CELSPAN_OK, ""};
  char name[32];
  name_file(s->descriptors[message->number], name);
  celspan_status status = s->module->read(s->readers[message->number], at->x, at->y, at->width,
                                          at->height, (float *)(void *)s->shared, &failure);
  conclude(s, message, status, name, &failure);
}

static bool put_part(void *user, const cs_picture_part *part) {
  const cs_message message = {.kind = CS_MESSAGE_PART, .part = *part};
  return ask(user, &message);
}

static void list_parts(server *s, cs_message *message) {
  cs_picture_failure failure = {CELSPAN_OK, ""};
  char name[32];
  name_file(s->descriptors[message->number], name);
  celspan_status status = s->module->list(s->readers[message->number], put_part, s, &failure);
  conclude(s, message, status, name, &failure);
}

static void close_reader(server *s, uint32_t number) {
  s->module->close(s->readers[number]);
  close(s->descriptors[number]);
  s->readers[number] = NULL;
}

/* ---------------------------------------------------------------- writing */

static bool put_bytes(void *user, uint64_t offset, const void *bytes, size_t size) {
  const server *s = user;
  bool goes_on = true;
  for (size_t done = 0; done < size && goes_on; done += PUT_BYTES) {
    size_t count = size - done < PUT_BYTES ? size - done : PUT_BYTES;
    memcpy(s->shared + CS_SHARED_PUT, (const char *)bytes + done, count);
    const cs_message message = {.kind = CS_MESSAGE_PUT, .put = {offset + done, count}};
    goes_on = ask(s, &message);
  }
  return goes_on;
}

static void open_writer(server *s, cs_message *message) {
  const cs_message_output *from = &message->output;
  const char *name = (const char *)s->shared, *format = name + strlen(name) + 1;
  const char *title = format + strlen(format) + 1, *names[CS_PICTURE_CHANNELS];
  for (int i = 0; from->has_names && i < from->channels; i++)
    names[i] = i ? names[i - 1] + strlen(names[i - 1]) + 1 : title + strlen(title) + 1;
  cs_picture_failure failure = {CELSPAN_OK, ""};
  const cs_picture_output output = {.put = put_bytes,
                                    .user = s,
                                    .name = name,
                                    .format = format,
                                    .width = from->width,
                                    .height = from->height,
                                    .channels = from->channels,
                                    .names = from->has_names ? names : NULL,
                                    .depth = (celspan_depth)from->depth,
                                    .bits = from->bits,
                                    .is_straight = from->is_straight != 0,
                                    .transfer = (celspan_transfer)from->transfer,
                                    .title = from->has_title ? title : NULL,
                                    .frames_second = from->frames_second,
                                    .frame = from->frame};
  celspan_status status = s->module->write_open(&output, &s->writer, &failure);
  if (status != CELSPAN_OK)
    s->writer = NULL;
  conclude(s, message, status, "", &failure);
}

static void write_rows(server *s, cs_message *message) {
  cs_picture_failure failure = {CELSPAN_OK, ""};
  celspan_status status = s->module->write_rows(s->writer, message->rows.first, message->rows.count,
                                                s->shared, &failure);
  conclude(s, message, status, "", &failure);
}

static void complete_writer(server *s, cs_message *message) {
  cs_picture_failure failure = {CELSPAN_OK, ""};
  celspan_status status = s->module->write_close(s->writer, &failure);
  s->writer = NULL;
  conclude(s, message, status, "", &failure);
}

/* ---------------------------------------------------------------- serving */

static void serve_reader(server *s, cs_message *message) {
  if (message->number >= READERS || !s->readers[message->number])
    refuse(s, message);
  else if (message->kind == CS_MESSAGE_READ)
    read_rectangle(s, message);
  else if (message->kind == CS_MESSAGE_LIST)
    list_parts(s, message);
  else
    close_reader(s, message->number);
}

static void serve_writer(server *s, cs_message *message) {
  if (!s->writer)
    refuse(s, message);
  else if (message->kind == CS_MESSAGE_ROWS)
    write_rows(s, message);
  else
    complete_writer(s, message);
}

static void serve(server *s) {
  int descriptor;
  cs_message message = receive(s, &descriptor);
  errno = 0;
  if (message.kind == CS_MESSAGE_OPEN)
    open_reader(s, &message, descriptor);
  else if (message.kind == CS_MESSAGE_WRITE)
    open_writer(s, &message);
  else if (message.kind >= CS_MESSAGE_READ && message.kind <= CS_MESSAGE_CLOSE)
    serve_reader(s, &message);
  else
    serve_writer(s, &message);
}

void cs_server_run(const cs_server_desc *desc) {
  server *s = calloc(1, sizeof *s);
  void *shared = mmap(NULL, CS_SHARED, PROT_READ | PROT_WRITE, MAP_SHARED, desc->memory, 0);
  if (!s || shared == MAP_FAILED)
    _exit(CS_SERVER_NO_MEMORY);
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != desc->keeper)
    _exit(0);
  close(desc->memory);
  s->module = desc->module;
  s->socket = desc->socket;
  s->shared = shared;
  confine(desc);
  s->module->watch_memory();
  is_serving = true;
  for (;;)
    serve(s);
}

#include "plugins/isolate/worker_loop.h"

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

enum {
  READERS = 1024, /* open at the same time: many more than the store keeps open */
  REFUSED = 6,    /* the exit code if the kernel cannot confine the process */
  FAULT_STACK = 1 << 16,
  PUT_BYTES = 4 << 20
};

typedef struct worker_loop {
  const cs_picture_module *module; /* NULL: the worker samples colour profiles */
  const cs_colour_module *colour;
  int socket;
  unsigned char *shared;
  cs_picture_reader *readers[READERS];
  int descriptors[READERS]; /* the descriptors of the files of readers */
  cs_picture_writer *writer;
} worker_loop;

/* Sanitizers report faults themselves, reserve terabytes of memory, and write reports. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED true
#else
#define IS_SANITIZED false
#endif

/* ---------------------------------------------------------------- faults */

/* A failed allocation sets errno. errno remains set if the library continues without the memory and
 * then crashes, or ends the process by an uncaught exception. A thread that the limit of processes
 * forbids sets errno, too. */
static bool is_without_means(void) { return errno == ENOMEM || errno == EAGAIN; }

static void end_by_fault(int number) {
  if (is_without_means())
    _exit(CS_WORKER_NO_MEMORY);
  signal(number, SIG_DFL);
  raise(number);
}

static bool is_serving; /* false while libraries are loaded */

/* The zygote and workers end only by _exit, so if exit is called, a library has called it. While
 * libraries are loaded, the reason is a lack of memory, whatever the value of errno is. */
static void end_by_library(void) {
  if (!is_serving || is_without_means())
    _exit(CS_WORKER_NO_MEMORY);
}

bool cs_worker_loop_is_starved(int ending) {
  if (WIFSIGNALED(ending))
    return WTERMSIG(ending) == SIGKILL || WTERMSIG(ending) == SIGTRAP;
  return WIFEXITED(ending) && (WEXITSTATUS(ending) == CS_WORKER_NO_MEMORY ||
                               WEXITSTATUS(ending) == CS_WORKER_NOT_LOADED);
}

void cs_worker_loop_watch_faults(void) {
  if (atexit(end_by_library) != 0)
    _exit(CS_WORKER_NO_MEMORY);
  if (IS_SANITIZED)
    return;
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
}

/* ---------------------------------------------------------------- confinement */

static void limit(int resource, rlim_t most) {
  const struct rlimit both = {most, most};
  if (setrlimit(resource, &both) != 0)
    _exit(REFUSED);
}

/* Bytes of data in this process; 0: unknown. */
static uint64_t data_bytes(void) {
  unsigned long pages = 0;
  FILE *file = fopen("/proc/self/statm", "re");
  if (file && fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages) != 1)
    pages = 0;
  if (file)
    fclose(file);
  return (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

static void limit_memory_and_files(uint64_t memory) {
  if (IS_SANITIZED)
    return;
  if (memory)
    limit(RLIMIT_DATA, (rlim_t)(data_bytes() + memory));
  limit(RLIMIT_FSIZE, 0);
}

void cs_worker_loop_confine(const cs_worker_desc *desc, const cs_strict_rights *rights) {
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != desc->zygote)
    _exit(0);
  limit_memory_and_files(desc->start.memory);
  limit(RLIMIT_CORE, 0);
  if (cs_strict_enter(rights) && desc->roots)
    _exit(REFUSED);
}

static void confine(const cs_worker_desc *desc) {
  cs_roots all = {.count = 0};
  if (!desc->roots && !cs_roots_add(&all, "/"))
    _exit(CS_WORKER_NO_MEMORY);
  cs_worker_loop_confine(desc, &(cs_strict_rights){.read = desc->roots ? desc->roots : &all});
  cs_roots_finish(&all);
}

/* ---------------------------------------------------------------- answers */

static void answer(const worker_loop *loop, const cs_message *message) {
  if (!cs_message_send(loop->socket, message, -1))
    _exit(0);
}

static cs_message receive(const worker_loop *loop, int *descriptor) {
  cs_message message;
  if (cs_message_wait(loop->socket, CS_MESSAGE_PATIENCE, &message, descriptor) !=
      CS_MESSAGE_ARRIVED)
    _exit(0);
  return message;
}

/* Sends a message and waits for its answer. Returns whether to continue. */
static bool ask(const worker_loop *loop, const cs_message *message) {
  answer(loop, message);
  return receive(loop, NULL).status == CELSPAN_OK;
}

/* The sentence, without the name under which this process opened the file. */
static const char *sentence_of(const char *name, const char *text) {
  size_t size = strlen(name);
  bool has_name = strncmp(text, name, size) == 0 && strncmp(text + size, ": ", 2) == 0;
  return text + (has_name ? size + 2 : 0);
}

/* Answers a request that was handled. name: the name of the file in the module. */
static void conclude(const worker_loop *loop, cs_message *message, celspan_status status,
                     const char *name, const cs_picture_failure *failure) {
  bool is_starved = status != CELSPAN_OK && errno == ENOMEM;
  message->kind = CS_MESSAGE_DONE;
  message->status = is_starved ? CELSPAN_NO_MEMORY : status;
  snprintf(message->text, sizeof message->text, "%s",
           status == CELSPAN_OK ? ""
           : is_starved         ? "out of memory"
                                : sentence_of(name, failure->text));
  answer(loop, message);
}

static void refuse(const worker_loop *loop, cs_message *message) {
  const cs_picture_failure failure = {CELSPAN_INTERNAL, "the decoder received an invalid request"};
  errno = 0;
  conclude(loop, message, CELSPAN_INTERNAL, "", &failure);
}

/* ---------------------------------------------------------------- reading */

static void name_file(int descriptor, char out[32]) {
  snprintf(out, 32, "/proc/self/fd/%d", descriptor);
}

static void open_reader(worker_loop *loop, cs_message *message, int descriptor) {
  const char *layer = (const char *)loop->shared, *space = layer + strlen(layer) + 1;
  cs_picture_failure failure = {CELSPAN_OK, ""};
  cs_picture_header header;
  uint32_t number = 0;
  char name[32];
  while (number < READERS && loop->readers[number])
    number++;
  if (number == READERS || descriptor < 0) {
    refuse(loop, message);
    return;
  }
  name_file(descriptor, name);
  const cs_picture_request request = {.file = name,
                                      .layer = message->open.has_layer ? layer : NULL,
                                      .subimage = message->open.subimage,
                                      .space = message->open.has_space ? space : NULL};
  celspan_status status = loop->module->open(&request, &loop->readers[number], &header, &failure);
  loop->descriptors[number] = descriptor;
  message->number = number;
  if (status == CELSPAN_OK)
    cs_message_set_header(message, &header);
  conclude(loop, message, status, name, &failure);
  if (status == CELSPAN_OK)
    return;
  loop->readers[number] = NULL;
  close(descriptor);
}

static void read_rectangle(worker_loop *loop, cs_message *message) {
  const celspan_rectangle *at = &message->rectangle;
  cs_picture_failure failure = {CELSPAN_OK, ""};
  char name[32];
  name_file(loop->descriptors[message->number], name);
  celspan_status status =
      loop->module->read(loop->readers[message->number], at->x, at->y, at->width, at->height,
                         (float *)(void *)loop->shared, &failure);
  conclude(loop, message, status, name, &failure);
}

static bool put_part(void *user, const cs_picture_part *part) {
  const cs_message message = {.kind = CS_MESSAGE_PART, .part = *part};
  return ask(user, &message);
}

static void list_parts(worker_loop *loop, cs_message *message) {
  cs_picture_failure failure = {CELSPAN_OK, ""};
  char name[32];
  name_file(loop->descriptors[message->number], name);
  celspan_status status =
      loop->module->list(loop->readers[message->number], put_part, loop, &failure);
  conclude(loop, message, status, name, &failure);
}

static void close_reader(worker_loop *loop, uint32_t number) {
  loop->module->close(loop->readers[number]);
  close(loop->descriptors[number]);
  loop->readers[number] = NULL;
}

/* ---------------------------------------------------------------- writing */

static bool put_bytes(void *user, uint64_t offset, const void *bytes, size_t size) {
  const worker_loop *loop = user;
  bool continues = true;
  for (size_t done = 0; done < size && continues; done += PUT_BYTES) {
    size_t count = size - done < PUT_BYTES ? size - done : PUT_BYTES;
    memcpy(loop->shared + CS_SHARED_PUT, (const char *)bytes + done, count);
    const cs_message message = {.kind = CS_MESSAGE_PUT, .put = {offset + done, count}};
    continues = ask(loop, &message);
  }
  return continues;
}

static void open_writer(worker_loop *loop, cs_message *message) {
  const cs_message_output *from = &message->output;
  const char *name = (const char *)loop->shared, *format = name + strlen(name) + 1;
  const char *colour = format + strlen(format) + 1, *title = colour + strlen(colour) + 1;
  const char *names[CS_PICTURE_CHANNELS];
  for (int i = 0; from->has_names && i < from->channels; i++)
    names[i] = i ? names[i - 1] + strlen(names[i - 1]) + 1 : title + strlen(title) + 1;
  cs_picture_failure failure = {CELSPAN_OK, ""};
  cs_picture_output output = {.put = put_bytes,
                              .user = loop,
                              .name = name,
                              .format = format,
                              .width = from->width,
                              .height = from->height,
                              .channels = from->channels,
                              .names = from->has_names ? names : NULL,
                              .depth = (celspan_depth)from->depth,
                              .bits = from->bits,
                              .is_straight = from->is_straight != 0,
                              .colour = colour,
                              .title = from->has_title ? title : NULL,
                              .has_primaries = from->has_primaries != 0,
                              .frames_second = from->frames_second,
                              .frame = from->frame,
                              .moving = from->moving};
  memcpy(output.software, from->software, sizeof output.software);
  memcpy(output.primaries, from->primaries, sizeof output.primaries);
  celspan_status status = loop->module->write_open(&output, &loop->writer, &failure);
  if (status != CELSPAN_OK)
    loop->writer = NULL;
  conclude(loop, message, status, "", &failure);
}

static void write_rows(worker_loop *loop, cs_message *message) {
  cs_picture_failure failure = {CELSPAN_OK, ""};
  celspan_status status = loop->module->write_rows(loop->writer, message->rows.first,
                                                   message->rows.count, loop->shared, &failure);
  conclude(loop, message, status, "", &failure);
}

static void complete_writer(worker_loop *loop, cs_message *message) {
  cs_picture_failure failure = {CELSPAN_OK, ""};
  celspan_status status = loop->module->write_close(loop->writer, &failure);
  loop->writer = NULL;
  conclude(loop, message, status, "", &failure);
}

/* ---------------------------------------------------------------- colour profiles */

static void sample_profile(worker_loop *loop, cs_message *message) {
  const cs_message_profile *from = &message->profile;
  cs_picture_failure failure = {CELSPAN_OK, ""};
  cs_colour_request request = {.bytes = from->size > 0 ? loop->shared : NULL,
                               .size = from->size,
                               .power = from->power,
                               .has_places = from->has_places != 0};
  memcpy(request.places, from->places, sizeof request.places);
  celspan_status status = loop->colour->sample(
      &request, (cs_colour_table *)(void *)(loop->shared + CS_SHARED_PUT), &failure);
  conclude(loop, message, status, "", &failure);
}

/* ---------------------------------------------------------------- serving */

static void serve_reader(worker_loop *loop, cs_message *message) {
  if (message->number >= READERS || !loop->readers[message->number])
    refuse(loop, message);
  else if (message->kind == CS_MESSAGE_READ)
    read_rectangle(loop, message);
  else if (message->kind == CS_MESSAGE_LIST)
    list_parts(loop, message);
  else
    close_reader(loop, message->number);
}

static void serve_writer(worker_loop *loop, cs_message *message) {
  if (!loop->writer)
    refuse(loop, message);
  else if (message->kind == CS_MESSAGE_ROWS)
    write_rows(loop, message);
  else
    complete_writer(loop, message);
}

static void serve(worker_loop *loop) {
  int descriptor;
  cs_message message = receive(loop, &descriptor);
  errno = 0;
  if ((message.kind == CS_MESSAGE_PROFILE) != !loop->module)
    refuse(loop, &message);
  else if (message.kind == CS_MESSAGE_PROFILE)
    sample_profile(loop, &message);
  else if (message.kind == CS_MESSAGE_OPEN)
    open_reader(loop, &message, descriptor);
  else if (message.kind == CS_MESSAGE_WRITE)
    open_writer(loop, &message);
  else if (message.kind >= CS_MESSAGE_READ && message.kind <= CS_MESSAGE_CLOSE)
    serve_reader(loop, &message);
  else
    serve_writer(loop, &message);
}

void cs_worker_loop_run(const cs_worker_desc *desc) {
  worker_loop *loop = calloc(1, sizeof *loop);
  void *shared = mmap(NULL, CS_SHARED, PROT_READ | PROT_WRITE, MAP_SHARED, desc->memory, 0);
  if (!loop || shared == MAP_FAILED)
    _exit(CS_WORKER_NO_MEMORY);
  close(desc->memory);
  loop->module = desc->start.task == CS_WORKER_SAMPLES ? NULL : desc->module;
  loop->colour = desc->colour;
  loop->socket = desc->socket;
  loop->shared = shared;
  confine(desc);
  if (loop->module)
    loop->module->watch_memory();
  is_serving = true;
  for (;;)
    serve(loop);
}

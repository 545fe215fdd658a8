#include "program/report/log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { HOST = 256, LINE = 5 * 8192 + 512 /* a visible sentence, with its time and host */ };

static int log_file = -1;

/* A pipe without a reader is refused, as waiting for one would take for ever. One that is full
 * stops the run until it is read: no line is lost. */
bool cs_log_open(const char *path) {
  log_file = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666);
  if (log_file < 0 || fcntl(log_file, F_SETFL, O_APPEND) == 0)
    return log_file >= 0;
  const int reason = errno; /* for the caller's message */
  close(log_file);
  log_file = -1;
  errno = reason;
  return false;
}

void cs_log_time(char out[CS_LOG_TIME]) {
  struct timespec now = {0};
  struct tm parts = {0};
  clock_gettime(CLOCK_REALTIME, &now);
  gmtime_r(&now.tv_sec, &parts);
  size_t size = strftime(out, CS_LOG_TIME, "%Y-%m-%dT%H:%M:%S", &parts);
  snprintf(out + size, CS_LOG_TIME - size, ".%03dZ", (int)(now.tv_nsec / 1000000));
}

const char *cs_log_host(void) {
  static char host[HOST];
  if (!host[0] && (gethostname(host, sizeof host - 1) != 0 || !host[0]))
    snprintf(host, sizeof host, "localhost");
  return host;
}

/* A file system may take a part of a line when it is nearly full. */
static bool write_all(const char *text, size_t size) {
  while (size > 0) {
    ssize_t done = write(log_file, text, size);
    if (done < 0 && errno != EINTR)
      return false;
    if (done > 0) {
      text += done;
      size -= (size_t)done;
    }
  }
  return true;
}

bool cs_log_add(cs_log_kind kind, const char *text) {
  char line[LINE], now[CS_LOG_TIME];
  if (log_file < 0)
    return true;
  cs_log_time(now);
  int size = snprintf(line, sizeof line, "%s %s celspan[%ld] %s: %s\n", now, cs_log_host(),
                      (long)getpid(), kind == CS_LOG_ERROR ? "error" : "note", text);
  size_t kept = size < 0 ? 0 : (size_t)size < sizeof line ? (size_t)size : sizeof line - 1;
  if (write_all(line, kept))
    return true;
  int problem = errno;
  close(log_file);
  log_file = -1;
  errno = problem;
  return false;
}

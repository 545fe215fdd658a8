/* Runs a program and tells what it took together with every process that it started, itself or through
 * others:
 *
 *   peak SECONDS PROGRAM ARGUMENT...
 *
 * Its last line on standard error is `peak BYTES processor S`. S: seconds of processor time of them all.
 * BYTES: the sum, over all those processes, of the most memory that each held at a time, so the program
 * and all of its own never held more at once; pages that two of them share are counted twice. It is
 * looked at every few milliseconds, and once more when a process has ended: of the largest one nothing
 * is missed. After SECONDS, everything that was started is killed. It ends as the program did.
 *
 * Linux alone: processes whose parents end become children of this one (PR_SET_CHILD_SUBREAPER).
 */
#include <ctype.h>
#include <dirent.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { PROCESSES = 4096, PAUSE = 3 /* milliseconds */ };

typedef struct process {
  pid_t number;
  long most; /* bytes held at a time, as far as they were seen */
} process;

static process seen[PROCESSES]; /* the first is this one */
static int count;

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The number behind a name in /proc/NUMBER/status; 0: there is none. */
static long status_of(pid_t number, const char *name) {
  char path[64], line[256];
  long found = 0;
  size_t length = strlen(name);
  snprintf(path, sizeof path, "/proc/%d/status", (int)number);
  FILE *file = fopen(path, "r");
  while (file && found == 0 && fgets(line, sizeof line, file))
    if (strncmp(line, name, length) == 0)
      found = strtol(line + length, NULL, 10);
  if (file)
    fclose(file);
  return found;
}

static process *find(pid_t number) {
  for (int i = 0; i < count; i++)
    if (seen[i].number == number)
      return &seen[i];
  return NULL;
}

/* Parents have lower numbers than their children, or are met in the next look. */
static void look_at(pid_t number) {
  process *one = find(number);
  if (!one && count < PROCESSES && find((pid_t)status_of(number, "PPid:"))) {
    one = &seen[count++];
    *one = (process){.number = number};
  }
  long most = one ? 1024 * status_of(number, "VmHWM:") : 0;
  if (one && most > one->most)
    one->most = most;
}

static void look(void) {
  DIR *folder = opendir("/proc");
  for (struct dirent *entry; folder && (entry = readdir(folder));)
    if (isdigit((unsigned char)entry->d_name[0]))
      look_at((pid_t)atoi(entry->d_name));
  if (folder)
    closedir(folder);
}

/* What all processes held, the largest as the system tells it of those that have ended. */
static long sum(void) {
  struct rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  long largest = 0, all = 0;
  for (int i = 1; i < count; i++) {
    all += seen[i].most;
    largest = seen[i].most > largest ? seen[i].most : largest;
  }
  long told = 1024 * usage.ru_maxrss;
  return all + (told > largest ? told - largest : 0);
}

static double processor(void) {
  struct rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

static void kill_all(void) {
  for (int i = 1; i < count; i++)
    if (status_of(seen[i].number, "PPid:") > 0)
      kill(seen[i].number, SIGKILL);
}

/* Watches until nothing is left that was started. The answer is how the program ended. */
static int watch(pid_t program, double limit) {
  int ending = 0, state;
  double start = seconds();
  for (pid_t ended; (ended = waitpid(-1, &state, WNOHANG)) >= 0;) {
    if (ended == program)
      ending = state;
    if (ended > 0)
      continue;
    look();
    if (seconds() - start > limit)
      kill_all();
    usleep(1000 * PAUSE);
  }
  return ending;
}

int main(int argument_count, char **arguments) {
  if (argument_count < 3 || prctl(PR_SET_CHILD_SUBREAPER, 1) != 0)
    return 2;
  seen[count++] = (process){.number = getpid()};
  pid_t program = fork();
  if (program == 0) {
    execvp(arguments[2], arguments + 2);
    _exit(127);
  }
  if (program < 0)
    return 2;
  int ending = watch(program, strtod(arguments[1], NULL));
  fprintf(stderr, "peak %ld processor %.3f\n", sum(), processor());
  return WIFEXITED(ending) ? WEXITSTATUS(ending) : 128 + WTERMSIG(ending);
}

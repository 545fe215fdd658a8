/* Runs a program and reports the resources that it used together with every process that it
 * started, directly or indirectly:
 *
 *   peak SECONDS PROGRAM ARGUMENT...
 *
 * Its last line on standard error is `peak BYTES processor S`. S: seconds of processor time of them
 * all. BYTES: the largest sum, over the processes that live at one time, of each one's peak memory,
 * so that a process that replaces another is not added to it; pages shared by two of them count
 * twice. It is sampled every few milliseconds, and once more when a process has ended: the peak of
 * the largest one is never missed. After SECONDS, everything that was started is killed. It ends
 * with the exit status of the program.
 *
 * Linux only: processes whose parents end become children of this one (PR_SET_CHILD_SUBREAPER).
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

static pid_t seen[PROCESSES]; /* the first one is this process */
static int count;
static long together,
    largest; /* the most bytes of all processes that lived at the same time, and of one process */

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The number after a name in /proc/NUMBER/status; 0: there is none. */
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

static bool is_known(pid_t number) {
  for (int i = 0; i < count; i++)
    if (seen[i] == number)
      return true;
  return false;
}

/* The peak of a process that was started from here; 0 for other processes. Parents have lower
 * numbers than their children, or are found in the next round. */
static long look_at(pid_t number) {
  if (!is_known(number) && count < PROCESSES && is_known((pid_t)status_of(number, "PPid:")))
    seen[count++] = number;
  return number != seen[0] && is_known(number) ? 1024 * status_of(number, "VmHWM:") : 0;
}

static void look(void) {
  long all = 0;
  DIR *folder = opendir("/proc");
  for (struct dirent *entry; folder && (entry = readdir(folder));)
    if (isdigit((unsigned char)entry->d_name[0])) {
      long most = look_at((pid_t)atoi(entry->d_name));
      largest = most > largest ? most : largest;
      all += most;
    }
  if (folder)
    closedir(folder);
  together = all > together ? all : together;
}

/* The peak so far, including the peak that the system reports for the largest process that has
 * ended. */
static long held(void) {
  struct rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  long ended = 1024 * usage.ru_maxrss;
  return together + (ended > largest ? ended - largest : 0);
}

static double processor(void) {
  struct rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

static void kill_all(void) {
  for (int i = 1; i < count; i++)
    if (status_of(seen[i], "PPid:") > 0)
      kill(seen[i], SIGKILL);
}

/* Watches until all processes that were started have ended. Returns how the program ended. */
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
  seen[count++] = getpid();
  pid_t program = fork();
  if (program == 0) {
    execvp(arguments[2], arguments + 2);
    _exit(127);
  }
  if (program < 0)
    return 2;
  int ending = watch(program, strtod(arguments[1], NULL));
  fprintf(stderr, "peak %ld processor %.3f\n", held(), processor());
  return WIFEXITED(ending) ? WEXITSTATUS(ending) : 128 + WTERMSIG(ending);
}

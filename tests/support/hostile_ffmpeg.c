/* A program in the place of ffmpeg for tests of the code that decodes sounds: it does what the word
 * after the first eight bytes of the sound says.
 *
 *   try      tries what the kernel should not allow, and names on standard error what it could do
 *   hang     sends nothing, and never ends
 *   starve   sends the form of the samples and some of them, and then hangs
 *   fork     starts a process that leaves the group and outlives it, and ends
 *   eat      uses memory until none is left
 *   babble   sends bytes that are no samples
 *   shout    writes to standard error without end
 *   wide     sends a form with more channels than there may be
 *   slow     sends a form with another rate than it was asked for
 *   odd      sends infinite samples and a part of one, and ends well
 *   long     sends samples without end
 *   trickle  in the place of ffprobe: lists a picture now and then, without end
 *   flood    lists more pictures than a movie may have
 *
 * Started by a test itself, with the word as argument, it does the same without confinement.
 */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SOUND = 3, PIECE = 1 << 20 };

/* ---------------------------------------------------------------- tries */

static int can_open(const char *name, int flags) {
  int descriptor = open(name, flags, 0600);
  if (descriptor >= 0)
    close(descriptor);
  return descriptor >= 0;
}

static int read_script(void) { return can_open("film.lua", O_RDONLY); }
static int read_passwords(void) { return can_open("/etc/passwd", O_RDONLY); }
static int read_environment(void) { return can_open("/proc/self/environ", O_RDONLY); }
static int list_folder(void) { return can_open(".", O_RDONLY | O_DIRECTORY); }
static int write_sound(void) { return can_open("/proc/self/fd/3", O_WRONLY); }
static int make_file(void) { return can_open("made", O_WRONLY | O_CREAT) && unlink("made") == 0; }
static int make_folder(void) { return mkdir("made", 0700) == 0 && rmdir("made") == 0; }
static int rename_script(void) {
  return rename("film.lua", "moved") == 0 && rename("moved", "film.lua") == 0;
}
static int open_socket(void) { return socket(AF_INET, SOCK_STREAM, 0) >= 0; }
static int open_local_socket(void) { return socket(AF_UNIX, SOCK_STREAM, 0) >= 0; }
static int signal_parent(void) { return kill(getppid(), 0) == 0; }
static int trace_parent(void) {
  return ptrace(PTRACE_SEIZE, getppid(), NULL, NULL) == 0 || errno != EPERM;
}

/* Runs a function in a separate process. The exit code 0 means that it succeeded. */
static int could(int (*act)(void)) {
  int status = 1;
  pid_t child = fork();
  if (child == 0)
    _exit(act() ? 0 : 1);
  return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

static int exec_true(void) {
  execl("/usr/bin/true", "true", (char *)NULL);
  return 0;
}
static int start_program(void) { return could(exec_true); }
static int make_session(void) { return setsid() >= 0; }
static int leave_group(void) { return could(make_session); }

static void try_all(void) {
  static const struct {
    const char *name;
    int (*act)(void);
  } tries[] = {{"read the script", read_script},
               {"read passwords", read_passwords},
               {"read its environment", read_environment},
               {"list the folder", list_folder},
               {"write the sound", write_sound},
               {"make a file", make_file},
               {"make a folder", make_folder},
               {"rename the script", rename_script},
               {"open a socket", open_socket},
               {"open a local socket", open_local_socket},
               {"signal its parent", signal_parent},
               {"trace its parent", trace_parent},
               {"start a program", start_program},
               {"leave its group", leave_group}};
  int count = 0, all = (int)(sizeof tries / sizeof *tries);
  for (int i = 0; i < all; i++)
    if (tries[i].act()) {
      fprintf(stderr, "could %s, ", tries[i].name);
      count++;
    }
  fprintf(stderr, "%d of %d\n", count, all);
  exit(1);
}

/* ---------------------------------------------------------------- samples */

/* Sends a form with this number of channels and samples per second, and a second of samples with
 * this value. */
static void send_form(int channels, int rate, float value) {
  unsigned char head[44] = "RIFF\377\377\377\377WAVEfmt \20\0\0\0\3";
  head[22] = (unsigned char)channels;
  head[24] = (unsigned char)(rate & 0xff);
  head[25] = (unsigned char)(rate >> 8);
  head[34] = 32;
  memcpy(head + 36, "data\377\377\377\377", 8);
  fwrite(head, 1, sizeof head, stdout);
  for (int i = 0; i < rate; i++)
    fwrite(&value, sizeof value, 1, stdout);
  fflush(stdout);
}

static void send_samples(int channels, float value) { send_form(channels, 48000, value); }

static _Noreturn void wait_for_ever(void) {
  for (;;)
    pause();
}

/* ---------------------------------------------------------------- what it does */

static void fork_away(void) {
  if (fork() == 0) {
    setsid();
    close(STDOUT_FILENO);
    close(STDERR_FILENO);
    wait_for_ever();
  }
  send_samples(1, 0);
}

static void eat(void) {
  for (char *piece; (piece = malloc(PIECE));)
    memset(piece, 1, PIECE);
  fputs("Cannot allocate memory\n", stderr);
  exit(1);
}

/* Lists pictures, with a pause (microseconds) after each. */
static void list_pictures(int count, useconds_t pause) {
  for (int i = 0; i < count; i++) {
    printf("packet|stream_index=0|pts=%d|duration=1|flags=K_\n", i);
    if (pause > 0 && (fflush(stdout) != 0 || usleep(pause) != 0))
      return;
  }
  printf("stream|index=0|codec_name=h264|codec_type=video|width=2|height=2|pix_fmt=yuv420p|"
         "time_base=1/25|avg_frame_rate=25/1\n");
}

static void act(const char *word) {
  if (strcmp(word, "try") == 0)
    try_all();
  else if (strcmp(word, "hang") == 0)
    wait_for_ever();
  else if (strcmp(word, "fork") == 0)
    fork_away();
  else if (strcmp(word, "eat") == 0)
    eat();
  else if (strcmp(word, "babble") == 0)
    puts("nothing that is a sound");
  else if (strcmp(word, "trickle") == 0)
    list_pictures(1000000, 200000);
  else if (strcmp(word, "flood") == 0)
    list_pictures(4000001, 0);
  else if (strcmp(word, "wide") == 0)
    send_samples(65, 0);
  else if (strcmp(word, "slow") == 0)
    send_form(1, 8000, 0);
  else if (strcmp(word, "odd") == 0) {
    send_samples(1, INFINITY);
    fputs("\1\2\3", stdout);
  } else {
    send_samples(1, 0);
    while (strcmp(word, "shout") == 0)
      fputs("louder ", stderr);
    while (strcmp(word, "long") == 0)
      send_samples(1, 0);
    wait_for_ever();
  }
}

int main(int count, char **arguments) {
  char word[16] = "";
  ssize_t size = count == 2 ? -1 : pread(SOUND, word, sizeof word - 1, 8);
  word[size > 0 ? size : 0] = '\0';
  act(count == 2 ? arguments[1] : word);
  return 0;
}

#include "base/control_group.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/open.h"

enum {
  TEXT = 8192,                   /* bytes of a line, or of the start of a small file */
  FOLDER = CS_CONTROL_GROUP_PATH /* of a path */
};

/* ---------------------------------------------------------------- texts */

/* The start of a file as a text. false: it cannot be read. */
static bool read_descriptor(int file, char text[TEXT]) {
  ssize_t size = file < 0 ? -1 : cs_open_read_at(file, text, TEXT - 1, 0);
  text[size > 0 ? size : 0] = '\0';
  return size >= 0;
}

static bool make_path(char path[FOLDER], const char *folder, const char *name) {
  return snprintf(path, FOLDER, "%s/%s", folder, name) < FOLDER;
}

static int open_in(const char *folder, const char *name) {
  char path[FOLDER];
  return make_path(path, folder, name) ? cs_open_to_read(path) : -1;
}

static bool read_in(const char *folder, const char *name, char text[TEXT]) {
  int file = open_in(folder, name);
  bool is_read = read_descriptor(file, text);
  if (file >= 0)
    close(file);
  return is_read;
}

/* A whole number at the start of a text, with a space or the end behind it. "max", "-1", an empty
 * text, any other text and too large numbers are CS_CONTROL_GROUP_NONE. *end: behind the number. */
static uint64_t number_at(const char *text, const char **end) {
  char *after = NULL;
  *end = text;
  if (*text < '0' || *text > '9')
    return CS_CONTROL_GROUP_NONE;
  uint64_t number = strtoull(text, &after, 10);
  *end = after;
  return *after && !strchr(" \n", *after) ? CS_CONTROL_GROUP_NONE : number;
}

static uint64_t number_in(const char *folder, const char *name) {
  char text[TEXT];
  const char *end;
  return read_in(folder, name, text) ? number_at(text, &end) : CS_CONTROL_GROUP_NONE;
}

/* ---------------------------------------------------------------- lines */

typedef struct lines {
  int file;
  off_t offset; /* the offset of the file's next bytes */
  size_t begin, size;
  char bytes[TEXT];
} lines;

/* Makes room after the remaining bytes, and reads into it. false: the file has ended. */
static bool read_more(lines *l) {
  l->size -= l->begin;
  memmove(l->bytes, l->bytes + l->begin, l->size);
  l->begin = 0;
  if (l->size == TEXT) /* no line of a control group is that long */
    l->size = 0;
  ssize_t got = cs_open_read_at(l->file, l->bytes + l->size, TEXT - l->size, l->offset);
  if (got <= 0)
    return false;
  l->offset += got;
  l->size += (size_t)got;
  return true;
}

/* The next line, without its end, valid until the next call; NULL: there is none. */
static char *next_line(lines *l) {
  do {
    char *line = l->bytes + l->begin, *end = memchr(line, '\n', l->size - l->begin);
    if (end) {
      *end = '\0';
      l->begin += (size_t)(end - line) + 1;
      return line;
    }
  } while (read_more(l));
  return NULL;
}

static void each_line(const char *folder, const char *name, void (*take)(void *user, char *line),
                      void *user) {
  lines l = {.file = open_in(folder, name)};
  if (l.file < 0)
    return;
  for (char *line; (line = next_line(&l));)
    take(user, line);
  close(l.file);
}

/* ---------------------------------------------------------------- places */

typedef struct place {
  char path[FOLDER];  /* the path of the group in the hierarchy; "": the process is in none */
  char mount[FOLDER]; /* where the hierarchy is mounted; "": it is not mounted */
  char group[FOLDER]; /* the folder of the group */
  bool is_below;      /* the path of the group is below the mount's root */
} place;

/* A line of /proc/PROCESS/cgroup: NUMBER:CONTROLLERS:PATH. Version 2 has 0::PATH. */
static void take_group(void *user, char *line) {
  place *p = user;
  if (strncmp(line, "0::/", 4) == 0)
    snprintf(p->path, FOLDER, "%s", line + 3);
}

static bool is_octal(const char *at) {
  return at[0] >= '0' && at[0] <= '3' && at[1] >= '0' && at[1] <= '7' && at[2] >= '0' &&
         at[2] <= '7';
}

/* The names of mountinfo have three octal digits behind a \ for a space and other separators. */
static void decode(char *text) {
  char *out = text;
  for (const char *at = text; *at; out++)
    if (*at == '\\' && is_octal(at + 1)) {
      *out = (char)((at[1] - '0') * 64 + (at[2] - '0') * 8 + (at[3] - '0'));
      at += 4;
    } else
      *out = *at++;
  *out = '\0';
}

/* The part of a path below a root; NULL: the path is elsewhere. */
static const char *below(const char *path, const char *root) {
  size_t length = strcmp(root, "/") == 0 ? 0 : strlen(root);
  bool is_there = strncmp(path, root, length) == 0 && (!path[length] || path[length] == '/');
  return is_there && !strstr(path, "/..") ? path + length : NULL;
}

/* If the hierarchy is mounted several times, the first mount that shows the group is used. */
static void place_group(place *p, const char *root, const char *mount) {
  const char *inside = below(p->path, root);
  if (!p->path[0] || p->is_below || (p->mount[0] && !inside))
    return;
  p->is_below = inside != NULL;
  snprintf(p->mount, FOLDER, "%s", mount);
  if (!inside || strcmp(inside, "/") == 0 || !make_path(p->group, mount, inside + (*inside == '/')))
    snprintf(p->group, FOLDER, "%s", mount);
}

/* A line of /proc/PROCESS/mountinfo:
 *
 *   36 35 0:29 ROOT MOUNT rw,relatime shared:7 - cgroup2 cgroup2 rw
 */
static void take_mount(void *user, char *line) {
  enum { FIELDS = 5, ROOT = 3, MOUNT = 4 };
  char *fields[FIELDS], *kind = strstr(line, " - "), *more = NULL;
  if (!kind || strncmp(kind, " - cgroup2 ", 11) != 0)
    return;
  *kind = '\0';
  for (int i = 0; i < FIELDS; i++)
    if (!(fields[i] = strtok_r(i ? NULL : line, " ", &more)))
      return;
  decode(fields[ROOT]);
  decode(fields[MOUNT]);
  place_group(user, fields[ROOT], fields[MOUNT]);
}

/* ---------------------------------------------------------------- limits */

static void find_processors(cs_control_group *group, const char *folder) {
  char text[TEXT];
  const char *end;
  if (!read_in(folder, "cpu.max", text))
    return;
  uint64_t quota = number_at(text, &end);
  uint64_t period = *end == ' ' ? number_at(end + 1, &end) : CS_CONTROL_GROUP_NONE;
  if (quota == CS_CONTROL_GROUP_NONE || period == CS_CONTROL_GROUP_NONE || !quota || !period)
    return;
  double count = (double)quota / (double)period;
  group->processors = count < group->processors ? count : group->processors;
}

/* *room: how many bytes the limit of the group leaves. */
static void find_memory(cs_control_group *group, const char *folder, uint64_t *room) {
  uint64_t most = number_in(folder, "memory.max"), high = number_in(folder, "memory.high");
  uint64_t limit = most < high ? most : high;
  if (limit == CS_CONTROL_GROUP_NONE)
    return;
  int usage, stat;
  cs_control_group_open(folder, &usage, &stat);
  uint64_t used = cs_control_group_used(usage, stat), left = limit > used ? limit - used : 0;
  if (left < *room) {
    *room = left;
    group->memory = limit;
    snprintf(group->folder, FOLDER, "%s", folder);
  }
  if (usage >= 0)
    close(usage);
  if (stat >= 0)
    close(stat);
}

/* Goes from a group up to the mount; changes the path. */
static void walk_up(cs_control_group *group, place *p, uint64_t *room) {
  char *folder = p->group;
  size_t top = strlen(p->mount);
  for (;;) {
    find_processors(group, folder);
    find_memory(group, folder, room);
    char *slash = strrchr(folder, '/');
    if (!slash || (size_t)(slash - folder) < top)
      return;
    *slash = '\0';
  }
}

void cs_control_group_read(const char *process, const char *folder, cs_control_group *out) {
  uint64_t room = CS_CONTROL_GROUP_NONE;
  *out = (cs_control_group){.processors = HUGE_VAL, .memory = CS_CONTROL_GROUP_NONE};
  if (folder) {
    find_processors(out, folder);
    find_memory(out, folder, &room);
    return;
  }
  place *p = calloc(1, sizeof *p);
  if (!p)
    return;
  each_line(process, "cgroup", take_group, p);
  each_line(process, "mountinfo", take_mount, p);
  if (p->mount[0])
    walk_up(out, p, &room);
  free(p);
}

/* ---------------------------------------------------------------- use */

void cs_control_group_open(const char *folder, int *usage, int *stat) {
  *usage = open_in(folder, "memory.current");
  *stat = open_in(folder, "memory.stat");
}

/* A number of memory.stat; 0: there is no such name. */
static uint64_t number_of(const char *text, const char *name) {
  uint64_t found = 0;
  size_t length = strlen(name);
  for (const char *line = text; line; line = strchr(line, '\n')) {
    const char *end;
    line += *line == '\n';
    if (strncmp(line, name, length) == 0 && line[length] == ' ')
      found = number_at(line + length + 1, &end);
  }
  return found == CS_CONTROL_GROUP_NONE ? 0 : found;
}

uint64_t cs_control_group_used(int usage, int stat) {
  char text[TEXT];
  const char *end;
  uint64_t used = read_descriptor(usage, text) ? number_at(text, &end) : 0;
  if (used == CS_CONTROL_GROUP_NONE || !read_descriptor(stat, text))
    return used == CS_CONTROL_GROUP_NONE ? 0 : used;
  uint64_t cached = number_of(text, "inactive_file") + number_of(text, "active_file");
  return used > cached ? used - cached : 0;
}

/* base/control_group.c: the limits of control groups, in files that the test writes; and
 * base/ceiling.c, which asks such a group. */
#include "base/ceiling.h"
#include "base/control_group.h"

#include <stdarg.h>
#include <sys/stat.h>

#include "tests/support/check.h"

#define MIB ((uint64_t)1 << 20)

static char root[] = "/tmp/celspan-groups-XXXXXX";

/* A path in the test's folder, whose parents are made. It is valid until the next call but one. */
__attribute__((format(printf, 1, 2))) static char *place(const char *format, ...) {
  static char paths[2][CS_CONTROL_GROUP_PATH];
  static int next;
  char *path = paths[next ^= 1];
  size_t length = (size_t)snprintf(path, sizeof *paths, "%s/", root);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(path + length, sizeof *paths - length, format, arguments);
  va_end(arguments);
  for (char *slash = path + 1; (slash = strchr(slash, '/')); *slash++ = '/') {
    *slash = '\0';
    mkdir(path, 0700);
  }
  return path;
}

static void put(const char *path, const char *text) {
  FILE *file = fopen(path, "w");
  CHECK(file && fputs(text, file) >= 0);
  if (file)
    fclose(file);
}

/* In the text, @ is the test's folder. */
static void put_mounts(const char *name, const char *text) {
  FILE *file = fopen(place("%s/mountinfo", name), "w");
  CHECK(file != NULL);
  for (const char *at = text; file && *at; at++)
    if (*at == '@')
      fputs(root, file);
    else
      fputc(*at, file);
  if (file)
    fclose(file);
}

static cs_control_group read_group(const char *name) {
  cs_control_group group;
  cs_control_group_read(place("%s", name), NULL, &group);
  return group;
}

static void check_limits(void) {
  put(place("two/cgroup"), "0::/jobs/seven\n");
  put_mounts(
      "two",
      "21 1 0:5 / / rw - ext4 /dev/a rw\n36 35 0:29 / @/two/m rw shared:9 - cgroup2 cgroup2 rw\n");
  put(place("two/m/jobs/seven/memory.max"), "max\n");
  put(place("two/m/jobs/seven/cpu.max"), "max 100000\n");
  cs_control_group group = read_group("two");
  CHECK(group.memory == CS_CONTROL_GROUP_NONE && group.processors == HUGE_VAL);
  put(place("two/m/jobs/memory.max"), "209715200\n");
  put(place("two/m/jobs/cpu.max"), "150000 100000\n");
  put(place("two/m/jobs/seven/memory.max"), "314572800\n");
  put(place("two/m/jobs/seven/cpu.max"), "400000 100000\n");
  group = read_group("two");
  CHECK(group.memory == 200 * MIB && group.processors == 1.5);
  CHECK_TEXT(group.folder, place("two/m/jobs"));
  put(place("two/m/jobs/seven/memory.high"), "104857600\n");
  CHECK(read_group("two").memory == 100 * MIB);
  put(place("two/m/memory.max"), "1048576\n"); /* the mount's root counts, too */
  CHECK(read_group("two").memory == MIB);
}

/* What leaves the least room counts: the neighbours of a group fill the one above it. */
static void check_room(void) {
  put(place("room/cgroup"), "0::/pod/one\n");
  put_mounts("room", "36 35 0:29 / @/room/m rw - cgroup2 cgroup2 rw\n");
  put(place("room/m/pod/one/memory.max"), "104857600\n");
  put(place("room/m/pod/memory.max"), "209715200\n");
  put(place("room/m/pod/memory.current"), "199229440\n");
  CHECK(read_group("room").memory == 200 * MIB);
  put(place("room/m/pod/memory.stat"), "anon 5\ninactive_file 104857600\nactive_file 1\n");
  CHECK(read_group("room").memory == 100 * MIB);
}

/* Spaces and other separators of names are octal in mountinfo; not so in cgroup. */
static void check_names(void) {
  put(place("odd/cgroup"), "0::/a b:c\\x/job\n");
  put_mounts("odd", "36 35 0:29 / @/odd/the\\040mount\\134 rw - cgroup2 cgroup2 rw\n");
  put(place("odd/the mount\\/a b:c\\x/job/memory.max"), "7340032");
  CHECK(read_group("odd").memory == 7 * MIB);
}

/* A process that is also in groups of version 1, whose limits are not looked at, and that sees its
 * group by several mounts, or from outside. */
static void check_mounts(void) {
  put(place("one/cgroup"), "9:memory:/docker/ab\n4:cpu,cpuacct:/user\n0::/docker/ab\n");
  put_mounts("one", "30 1 0:1 / @/one/v1 rw shared:1 shared:2 - cgroup cgroup rw,memory,cpu\n"
                    "31 1 0:2 /other @/one/other rw - cgroup2 none rw\n"
                    "32 1 0:2 /docker @/one/m rw - cgroup2 cgroup2 rw,nsdelegate\n");
  put(place("one/v1/docker/ab/memory.max"), "1048576\n");
  put(place("one/m/ab/memory.max"), "157286400\n");
  put(place("one/m/ab/memory.current"), "104857600\n");
  put(place("one/m/ab/memory.stat"), "inactive_file 52428800\nactive_file 10485760\n");
  put(place("one/m/ab/cpu.max"), "250000 100000\n");
  cs_control_group group = read_group("one");
  CHECK(group.memory == 150 * MIB && group.processors == 2.5);
  int usage, stat;
  cs_control_group_open(group.folder, &usage, &stat);
  CHECK(cs_control_group_used(usage, stat) == 40 * MIB);
  put(place("one/other/memory.max"), "2097152\n");
  put(place("one/cgroup"), "0::/of/the/host\n"); /* the first mount's root is the group */
  CHECK(read_group("one").memory == 2 * MIB);
  put(place("one/cgroup"), "0::/../elsewhere\n");
  CHECK(read_group("one").memory == 2 * MIB);
  put(place("one/cgroup"), "9:memory:/docker/ab\n");
  CHECK(read_group("one").memory == CS_CONTROL_GROUP_NONE);
}

static void check_numbers(void) {
  static const struct {
    const char *text;
    uint64_t memory;
  } cases[] = {{"", CS_CONTROL_GROUP_NONE},
               {"\n", CS_CONTROL_GROUP_NONE},
               {"max", CS_CONTROL_GROUP_NONE},
               {"-1\n", CS_CONTROL_GROUP_NONE},
               {"12abc", CS_CONTROL_GROUP_NONE},
               {" 12", CS_CONTROL_GROUP_NONE},
               {"0\n", 0},
               {"4096", 4096},
               {"99999999999999999999999", CS_CONTROL_GROUP_NONE}};
  cs_control_group group;
  put(place("own/cpu.max"), "0 0\n");
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    put(place("own/memory.max"), cases[i].text);
    cs_control_group_read("/none", place("own"), &group);
    CHECK(group.memory == cases[i].memory && group.processors == HUGE_VAL);
  }
  static const char *const quotas[] = {"", "100000", "x 100000", "100000 0", "100000 -5", "5 max"};
  for (size_t i = 0; i < sizeof quotas / sizeof *quotas; i++) {
    put(place("own/cpu.max"), quotas[i]);
    cs_control_group_read("/none", place("own"), &group);
    CHECK(group.processors == HUGE_VAL);
  }
}

static void check_nothing(void) {
  CHECK(read_group("missing").memory == CS_CONTROL_GROUP_NONE);
  char text[40000];
  memset(text, 'x', sizeof text); /* a line that is too long, and one without its parts */
  strcpy(text + sizeof text - 40, "\n1 2 - cgroup2\n - cgroup x\n0::\n:\n");
  put(place("bad/cgroup"), text);
  put(place("bad/mountinfo"), text);
  CHECK(read_group("bad").memory == CS_CONTROL_GROUP_NONE);
}

static void check_ceiling(void) {
  cs_ceiling ceiling;
  cs_control_group group;
  put(place("full/memory.max"), "104857600\n");
  put(place("full/memory.current"), "20971520\n");
  cs_control_group_read("/none", place("full"), &group);
  cs_ceiling_init(&ceiling, &group, 1000 * MIB, 0);
  CHECK(ceiling.most == 60 * MIB);
  CHECK(cs_ceiling_refuses(&ceiling, 50 * MIB, 10 * MIB) == CS_REFUSAL_NONE);
  CHECK(cs_ceiling_refuses(&ceiling, 50 * MIB, 10 * MIB + 1) == CS_REFUSAL_HELD);
  CHECK(cs_ceiling_refuses(&ceiling, 1, SIZE_MAX) == CS_REFUSAL_HELD);
  cs_ceiling_finish(&ceiling);
  CHECK(cs_ceiling_refuses(&ceiling, 1, SIZE_MAX / 2) == CS_REFUSAL_NONE);
  cs_ceiling_init(&ceiling, &group, 1000 * MIB, 0);
  put(place("full/memory.current"), "94371840\n"); /* others have filled it since */
  CHECK(cs_ceiling_refuses(&ceiling, 0, 5 * MIB) == CS_REFUSAL_GROUP);
  CHECK(cs_ceiling_refuses(&ceiling, 0, MIB) == CS_REFUSAL_NONE);
  cs_ceiling_finish(&ceiling);
  cs_ceiling_init(&ceiling, &group, 1000 * MIB, 4 * MIB);
  CHECK(ceiling.most == 3 * MIB);
  cs_ceiling_finish(&ceiling);
  cs_ceiling_init(&ceiling, &group, 40 * MIB, 0);
  CHECK(ceiling.most == 30 * MIB && ceiling.usage < 0);
}

int main(void) {
  char command[64];
  if (!mkdtemp(root))
    return 1;
  check_limits();
  check_room();
  check_names();
  check_mounts();
  check_numbers();
  check_nothing();
  check_ceiling();
  snprintf(command, sizeof command, "rm -rf '%s'", root);
  CHECK(system(command) == 0);
  return check_done();
}

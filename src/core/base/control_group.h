/* The limits of the control groups that a process is in (cgroups of Linux, version 2), as
 * containers and batch systems set them. Groups of version 1 are not looked at.
 *
 *   /proc/self/cgroup        the path of its group in the hierarchy
 *   /proc/self/mountinfo     where the hierarchy is mounted, and which group is the mount's root
 *
 *   mount  /sys/fs/cgroup             limits of the root, if there are any
 *                /jobs                the limits of all jobs
 *                     /job.7          the limits of the group; on this way up the least counts
 *
 * Where a container sees its own group as the root of the mount, but a path from outside, the
 * mount's root is the group. What cannot be read, or makes no sense, is no limit.
 */
#pragma once

#include <stdint.h>

#define CS_CONTROL_GROUP_NONE UINT64_MAX

enum { CS_CONTROL_GROUP_PATH = 4096 };

typedef struct cs_control_group {
  double processors; /* how many its quota of processor time is; HUGE_VAL: it has none */
  /* Bytes of the limit that leaves the least room: memory.max or memory.high.
   * CS_CONTROL_GROUP_NONE: there is no limit. */
  uint64_t memory;
  char folder[CS_CONTROL_GROUP_PATH]; /* the folder of the group that has this limit; "": none */
} cs_control_group;

/* process: the folder of a process, such as "/proc/self". folder: the folder of the group, whose
 * parents are not read in this case; NULL: the group is searched for. */
void cs_control_group_read(const char *process, const char *folder, cs_control_group *out);

/* The bytes that a group holds, without those that the kernel takes back when memory is short: the
 * cached pages of files. usage, stat: descriptors of memory.current and memory.stat; -1: the file
 * does not exist. Returns 0 if the bytes are unknown. */
uint64_t cs_control_group_used(int usage, int stat);
/* Opens the files of `usage` and `stat` in the folder of a group. */
void cs_control_group_open(const char *folder, int *usage, int *stat);

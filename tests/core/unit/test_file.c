/* output/sinks/file.c: whichever call to the system fails, the file is complete afterwards, or
 * unchanged; and no temporary file is left.
 */
#include "output/sinks/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include "output/sinks/file_copy.h"
#include "output/sinks/temporary.h"
#include "tests/support/check.h"

/* ---------------------------------------------------------------- a system that fails */

static int calls_left, fault; /* fault: an errno, or SHORT_WRITE */
enum { SHORT_WRITE = -1 };

static int fails(void) {
  if (--calls_left != 0 || fault == SHORT_WRITE)
    return 0;
  errno = fault;
  return 1;
}

static int faulty_open(const char *path, int flags, mode_t mode) {
  return fails() ? -1 : open(path, flags, mode);
}
static ssize_t faulty_pwrite(int descriptor, const void *bytes, size_t size, off_t offset) {
  if (fails())
    return -1;
  return pwrite(descriptor, bytes, fault == SHORT_WRITE ? (size + 1) / 2 : size, offset);
}
static int faulty_fstat(int descriptor, struct stat *out) {
  return fails() ? -1 : fstat(descriptor, out);
}
static int faulty_fsync(int descriptor) { return fails() ? -1 : fsync(descriptor); }
static int faulty_close(int descriptor) {
  int result = close(descriptor);
  return fails() ? -1 : result;
}
static int faulty_rename(const char *from, const char *to) {
  return fails() ? -1 : rename(from, to);
}
static int faulty_unlink(const char *path) { return unlink(path); }
static int faulty_mkdir(const char *path, mode_t mode) { return fails() ? -1 : mkdir(path, mode); }

static const cs_file_system faulty = {faulty_open,  faulty_pwrite, faulty_fstat,  faulty_fsync,
                                      faulty_close, faulty_rename, faulty_unlink, faulty_mkdir};

/* ---------------------------------------------------------------- a system that takes notes */

/* A letter for each call: `w`rite, `s`ync and `c`lose of the file, `r`ename, sync of the `f`older,
 * `u`nlink. */
static char notes[64];
static int noted_folder; /* the descriptor of the last folder that was opened; -1: none */

static void note(char call) {
  size_t length = strlen(notes);
  if (length + 1 < sizeof notes && (length == 0 || notes[length - 1] != call))
    notes[length] = call;
}

static int open_plainly(const char *path, int flags, mode_t mode) {
  return open(path, flags, mode);
}

static int noting_open(const char *path, int flags, mode_t mode) {
  int descriptor = open(path, flags, mode);
  if (flags & O_DIRECTORY)
    noted_folder = descriptor;
  return descriptor;
}
static ssize_t noting_pwrite(int descriptor, const void *bytes, size_t size, off_t offset) {
  note('w');
  return pwrite(descriptor, bytes, size, offset);
}
static int noting_fsync(int descriptor) {
  note(descriptor == noted_folder ? 'f' : 's');
  return fsync(descriptor);
}
static int noting_close(int descriptor) {
  if (descriptor != noted_folder)
    note('c');
  return close(descriptor);
}
static int noting_rename(const char *from, const char *to) {
  note('r');
  return rename(from, to);
}
static int noting_unlink(const char *path) {
  note('u');
  return unlink(path);
}

static const cs_file_system noting = {noting_open,  noting_pwrite, fstat,         noting_fsync,
                                      noting_close, noting_rename, noting_unlink, mkdir};

/* Removes what was left behind in the folder of the file at the moment at which it is renamed. */
static bool any_name(const char *pattern, const char *name) { return pattern && name; }

static int swept_rename(const char *from, const char *to) {
  cs_temporary_sweep(to, any_name);
  return rename(from, to);
}

static const cs_file_system swept = {open_plainly, pwrite,       fstat,  fsync,
                                     close,        swept_rename, unlink, mkdir};

/* ---------------------------------------------------------------- helpers */

enum { CONTENT = 150000 };
static char root[] = "/tmp/celspan-test-file-XXXXXX";
static char content[CONTENT];

static void in_root(char path[256], const char *name) { snprintf(path, 256, "%s/%s", root, name); }

static celspan_status write_content(celspan_context *context, const cs_file_system *system,
                                    const char *path) {
  cs_file *file;
  celspan_status status = cs_file_create(context, system, path, &file);
  if (status != CELSPAN_OK)
    return status;
  for (size_t done = 0, part = 1; done < CONTENT && status == CELSPAN_OK; done += part) {
    part = done + 37000 < CONTENT ? 37000 : CONTENT - done;
    status = cs_file_write(file, context, content + done, part);
  }
  return cs_file_commit(file, context) == CELSPAN_OK ? status : CELSPAN_OUTPUT;
}

/* 0 absent, 1 the old file, 2 the whole new one, 3 anything else. */
static int state_of(const char *path) {
  static char bytes[CONTENT + 1];
  FILE *stream = fopen(path, "rb");
  if (!stream)
    return 0;
  size_t size = fread(bytes, 1, sizeof bytes, stream);
  fclose(stream);
  if (size == 3 && memcmp(bytes, "old", 3) == 0)
    return 1;
  return size == CONTENT && memcmp(bytes, content, CONTENT) == 0 ? 2 : 3;
}

static void put_old(const char *path) {
  FILE *stream = fopen(path, "wb");
  fputs("old", stream);
  fclose(stream);
}

static int count_entries(const char *folder) {
  int count = 0;
  DIR *entries = opendir(folder);
  while (entries && readdir(entries))
    count++;
  if (entries)
    closedir(entries);
  return count - 2;
}

/* ---------------------------------------------------------------- checks */

static void sweep(celspan_context *context, int error, bool had_old) {
  char path[256];
  in_root(path, "frame.png");
  for (int n = 1; n < 100; n++) {
    unlink(path);
    if (had_old)
      put_old(path);
    calls_left = n;
    fault = error;
    celspan_status status = write_content(context, &faulty, path);
    bool injected = calls_left <= 0;
    int state = state_of(path);
    bool folder_unsynced = state == 2 && strstr(celspan_context_error(context), "sync its folder");
    if (status == CELSPAN_OK) {
      CHECK(state == 2);
    } else {
      CHECK(status == CELSPAN_OUTPUT && (state == had_old || folder_unsynced));
      CHECK(strstr(celspan_context_error(context), path) != NULL);
      CHECK(strstr(celspan_context_error(context), strerror(error)) != NULL);
    }
    CHECK(status != CELSPAN_OK || !injected || error == EINTR || error == EINVAL ||
          error == EEXIST || error == ENOENT);
    CHECK(count_entries(root) == (state != 0));
    if (!injected) {
      CHECK(n > 6);
      break;
    }
  }
  unlink(path);
}

/* Power may fail at any moment: the bytes are on the disk before the name is, and the name before
 * the frame is reported as done. */
static void check_order(celspan_context *context) {
  char path[256];
  in_root(path, "frame.png");
  memset(notes, 0, sizeof notes);
  noted_folder = -1;
  CHECK(write_content(context, &noting, path) == CELSPAN_OK && state_of(path) == 2);
  if (!CHECK(strcmp(notes, "wscrf") == 0))
    fprintf(stderr, "  %s\n", notes);
  unlink(path);
}

static void check_interruptions(celspan_context *context) {
  char path[256];
  in_root(path, "frame.png");
  for (int n = 1; n < 12; n++) {
    calls_left = n;
    fault = EINTR;
    celspan_status status = write_content(context, &faulty, path);
    bool retried = strstr(celspan_context_error(context), "cannot write") == NULL;
    CHECK(status == CELSPAN_OK || retried);
  }
  calls_left = 0;
  fault = SHORT_WRITE;
  unlink(path);
  CHECK(write_content(context, &faulty, path) == CELSPAN_OK && state_of(path) == 2);
  unlink(path);
}

static void check_folders(celspan_context *context) {
  char path[256];
  in_root(path, "a/b//c/frame.png");
  CHECK(write_content(context, NULL, path) == CELSPAN_OK && state_of(path) == 2);
  unlink(path);
  for (const char *folder = "a/b/c\0a/b\0a\0"; *folder; folder += strlen(folder) + 1) {
    in_root(path, folder);
    CHECK(rmdir(path) == 0);
  }
  put_old((in_root(path, "file"), path));
  in_root(path, "file/frame.png");
  CHECK(write_content(context, NULL, path) == CELSPAN_OUTPUT);
  in_root(path, "file");
  unlink(path);
}

static void check_refusals(celspan_context *context) {
  char path[256];
  CHECK(write_content(context, NULL, "/dev/null") == CELSPAN_OUTPUT);
  CHECK(write_content(context, NULL, root) == CELSPAN_OUTPUT);
  in_root(path, "folder/");
  CHECK(write_content(context, NULL, path) == CELSPAN_OUTPUT);
  CHECK(count_entries(root) == 0);
}

static void check_long_name(celspan_context *context) {
  char name[256], path[600];
  memset(name, 'n', 255);
  name[255] = '\0';
  snprintf(path, sizeof path, "%s/%s", root, name);
  CHECK(write_content(context, NULL, path) == CELSPAN_OK && state_of(path) == 2);
  unlink(path);
}

static void check_discard_and_places(celspan_context *context) {
  char path[256];
  cs_file *file;
  in_root(path, "frame.png");
  put_old(path);
  CHECK(cs_file_create(context, NULL, path, &file) == CELSPAN_OK);
  CHECK(cs_file_write(file, context, content, 100) == CELSPAN_OK && cs_file_size(file) == 100);
  cs_file_discard(file, context);
  CHECK(state_of(path) == 1 && count_entries(root) == 1);
  CHECK(cs_file_create(context, NULL, path, &file) == CELSPAN_OK);
  CHECK(cs_file_write(file, context, content, 10) == CELSPAN_OK);
  CHECK(cs_file_write_at(file, context, 1000, content + 1000, CONTENT - 1000) == CELSPAN_OK);
  CHECK(cs_file_write_at(file, context, 0, content, 1000) == CELSPAN_OK);
  CHECK(cs_file_size(file) == CONTENT);
  CHECK(cs_file_commit(file, context) == CELSPAN_OK && state_of(path) == 2);
  unlink(path);
  cs_file_discard(NULL, context);
}

typedef struct compared {
  size_t done, calls_left;
  bool is_equal;
} compared;

static celspan_status compare_part(void *user, const void *bytes, size_t size) {
  compared *c = user;
  c->is_equal &= size <= CONTENT - c->done && memcmp(bytes, content + c->done, size) == 0;
  c->is_equal &= size % 3 == 0 || c->done + size == CONTENT;
  c->done += size;
  return c->calls_left-- > 0 ? CELSPAN_OK : CELSPAN_CANCELLED;
}

/* The bytes of a file that is not complete are given as they were written; what takes them may end
 * that, and a file that has lost some is reported. */
static void check_again(celspan_context *context) {
  char path[256];
  cs_file *file;
  const char *name;
  in_root(path, "again");
  CHECK(cs_file_create(context, NULL, path, &file) == CELSPAN_OK);
  CHECK(cs_file_write(file, context, content, 37000) == CELSPAN_OK);
  CHECK(cs_file_write(file, context, content + 37000, CONTENT - 37000) == CELSPAN_OK);
  compared all = {.calls_left = 100, .is_equal = true}, one = {.is_equal = true};
  CHECK(cs_file_again(file, context, compare_part, &all) == CELSPAN_OK);
  CHECK(all.is_equal && all.done == CONTENT);
  CHECK(cs_file_again(file, context, compare_part, &one) == CELSPAN_CANCELLED);
  CHECK(one.is_equal && one.done > 0 && one.done < CONTENT);
  CHECK(cs_file_temporary(file, context, &name) == CELSPAN_OK && truncate(name, 1000) == 0);
  CHECK(cs_file_again(file, context, compare_part, &all) == CELSPAN_OUTPUT);
  CHECK(strstr(celspan_context_error(context), "cannot read its temporary file back"));
  CHECK(cs_file_commit(file, context) == CELSPAN_OUTPUT && state_of(path) == 0);
}

/* The recorded digest of a file is that of the bytes written, whatever happens to the file
 * later. */
static void check_contents(celspan_context *context) {
  char path[256];
  cs_file_contents written, there;
  in_root(path, "contents");
  context->contents = &written;
  CHECK(write_content(context, NULL, path) == CELSPAN_OK);
  context->contents = NULL;
  int descriptor = open(path, O_RDWR);
  CHECK(cs_file_contents_read(descriptor, &there));
  CHECK(written.bytes == CONTENT && there.bytes == CONTENT);
  CHECK(written.hash.a == there.hash.a && written.hash.b == there.hash.b);
  CHECK(pwrite(descriptor, "x", 1, CONTENT - 1) == 1 && cs_file_contents_read(descriptor, &there));
  CHECK(written.hash.a != there.hash.a);
  close(descriptor);
  CHECK(!cs_file_contents_read(descriptor, &there));
  CHECK(write_content(context, NULL, path) == CELSPAN_OK); /* nobody wants the digest any more */
  CHECK(written.bytes == CONTENT);
  unlink(path);
}

/* Whether the file is copied completely; it is not copied if no file has that stamp any more. */
static bool is_copied(celspan_context *context, const char *from, const cs_file_stamp *stamp) {
  char to[256];
  bool is_copied;
  in_root(to, "copy");
  CHECK(cs_file_copy(context, from, stamp, to, &is_copied) == CELSPAN_OK);
  CHECK(state_of(to) == (is_copied ? 2 : 0));
  unlink(to);
  return is_copied;
}

static void check_copies(celspan_context *context) {
  char from[256], other[256];
  cs_file_stamp stamp, of_other;
  bool copied = true;
  in_root(from, "original");
  in_root(other, "other");
  CHECK(!cs_file_stamp_read(from, &stamp) && !cs_file_stamp_read(root, &stamp));
  CHECK(write_content(context, NULL, from) == CELSPAN_OK && cs_file_stamp_read(from, &stamp));
  CHECK(is_copied(context, from, &stamp));
  CHECK(cs_file_copy(context, from, &stamp, "/proc/none/copy", &copied) == CELSPAN_OUTPUT &&
        !copied);
  CHECK(write_content(context, NULL, other) == CELSPAN_OK && cs_file_stamp_read(other, &of_other));
  CHECK(!is_copied(context, from, &of_other) && !is_copied(context, root, &stamp));
  for (int what = 0; what < 4; what++) {
    cs_file_stamp wrong = stamp;
    wrong.device += what == 0;
    wrong.size += what == 1;
    wrong.changed.tv_sec += what == 2;
    wrong.changed.tv_nsec += what == 3;
    CHECK(!is_copied(context, from, &wrong));
  }
  unlink(other);
  unlink(from);
  CHECK(!is_copied(context, from, &stamp));
}

/* A file is its writer's until it has its name, also after the last of its bytes. */
static void check_swept(celspan_context *context) {
  char path[256];
  in_root(path, "swept");
  CHECK(write_content(context, &swept, path) == CELSPAN_OK && state_of(path) == 2);
  unlink(path);
}

int main(void) {
  celspan_context *context;
  if (celspan_context_create(NULL, &context) != CELSPAN_OK || !mkdtemp(root))
    return 1;
  for (int i = 0; i < CONTENT; i++)
    content[i] = (char)(i * 31 + i / 251);
  size_t before, after, peak;
  uint64_t allocations;
  celspan_context_memory(context, &before, &peak, &allocations);
  static const int errors[] = {ENOSPC, EIO, EDQUOT, EROFS, EACCES, EMFILE};
  for (int i = 0; i < 12; i++)
    sweep(context, errors[i / 2], i % 2);
  check_order(context);
  check_interruptions(context);
  check_folders(context);
  check_refusals(context);
  check_long_name(context);
  check_discard_and_places(context);
  check_swept(context);
  check_again(context);
  check_contents(context);
  check_copies(context);
  celspan_context_memory(context, &after, &peak, &allocations);
  CHECK(after == before);
  CHECK(rmdir(root) == 0);
  celspan_context_destroy(context);
  return check_done();
}

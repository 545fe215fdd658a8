#include "cli/tiles/log.h"

#include <errno.h>
#include <ftw.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/context.h"
#include "cli/lines.h"
#include "cli/progress.h"

enum {
  LINE_SIZE = 128,
  OPEN_FOLDERS = 16,
  PAUSE = 2 /* least seconds from one wait for the disk to the next */
};

static celspan_status fail(celspan_context *context, const char *path, const char *what) {
  celspan_status status = errno == ENOMEM ? CELSPAN_NO_MEMORY : CELSPAN_OUTPUT;
  return cs_fail(context, status, "%s: %s: %s", path, what, strerror(errno));
}

/* ---------------------------------------------------------------- reading */

static void write_head(const cs_tile_log *log, char line[LINE_SIZE]) {
  snprintf(line, LINE_SIZE, "celspan tiles 1 %016" PRIx64 "%016" PRIx64 "\n", log->digest.a,
           log->digest.b);
}

static celspan_status keep_row(celspan_context *context, cs_tile_log *log, cs_tile_row row) {
  CS_TRY(cs_mem_reserve(context, (void **)&log->rows, &log->capacity, log->count + 1,
                        sizeof *log->rows));
  log->rows[log->count++] = row;
  return CELSPAN_OK;
}

static celspan_status read_rows(celspan_context *context, cs_tile_log *log, FILE *file) {
  char line[LINE_SIZE], end;
  cs_tile_row row;
  while (fgets(line, sizeof line, file))
    if (sscanf(line, "row %" SCNd32 " %" SCNd32 " %" SCNd32 " %" SCNd32 "%c", &row.level, &row.row,
               &row.first, &row.end, &end) == 5 &&
        end == '\n')
      CS_TRY(keep_row(context, log, row));
  return CELSPAN_OK;
}

static bool is_there(const char *path) {
  struct stat found;
  return stat(path, &found) == 0;
}

celspan_status cs_tile_log_read(celspan_context *context, const cs_pyramid *pyramid, cs_hash digest,
                                cs_tile_log *log, cs_tile_log_state *state) {
  char head[LINE_SIZE], line[LINE_SIZE], folder[4096];
  log->digest = digest;
  log->descriptor = -1;
  size_t size = sizeof log->path;
  if (snprintf(log->path, size, "%s/%s.tiles", pyramid->folder, pyramid->name) >= (int)size ||
      !cs_pyramid_tiles_folder(pyramid, folder, sizeof folder))
    return cs_pyramid_too_long(context, pyramid);
  write_head(log, head);
  FILE *file = fopen(log->path, "r");
  if (!file && errno != ENOENT)
    return fail(context, log->path, "cannot read");
  if (!file) {
    *state = is_there(folder) ? CS_TILE_LOG_FOREIGN : CS_TILE_LOG_NEW;
    return CELSPAN_OK;
  }
  celspan_status status = CELSPAN_OK;
  *state = CS_TILE_LOG_OTHER;
  if (fgets(line, sizeof line, file) && strcmp(line, head) == 0) {
    *state = CS_TILE_LOG_SAME;
    status = read_rows(context, log, file);
    log->written = log->count;
  }
  fclose(file);
  return status;
}

bool cs_tile_log_has(const cs_tile_log *log, cs_tile_row row) {
  for (size_t i = 0; i < log->count; i++) {
    const cs_tile_row *known = &log->rows[i];
    if (known->level == row.level && known->row == row.row && known->first <= row.first &&
        known->end >= row.end)
      return true;
  }
  return false;
}

/* ---------------------------------------------------------------- one run at a time */

/* Opens the record, which is made where there is none. */
static celspan_status lock(celspan_context *context, cs_tile_log *log) {
  log->descriptor = cs_lines_open(log->path);
  if (log->descriptor < 0)
    return fail(context, log->path, "cannot write");
  if (flock(log->descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return cs_fail(context, CELSPAN_OUTPUT, "%s: another celspan is at work on these tiles",
                   log->path);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- starting over */

static int remove_one(const char *path, const struct stat *found, int kind, struct FTW *where) {
  (void)found, (void)kind, (void)where;
  return remove(path);
}

/* The record is removed last, so that --fresh works after a run that was stopped in here, too. */
celspan_status cs_tile_log_clear(celspan_context *context, const cs_pyramid *pyramid,
                                 cs_tile_log *log) {
  char folder[4096];
  log->count = log->written = 0;
  CS_TRY(lock(context, log));
  if (cs_pyramid_tiles_folder(pyramid, folder, sizeof folder) && is_there(folder) &&
      nftw(folder, remove_one, OPEN_FOLDERS, FTW_DEPTH | FTW_PHYS) != 0)
    return fail(context, folder, "cannot remove the tiles there");
  if (unlink(log->path) != 0 && errno != ENOENT)
    return fail(context, log->path, "cannot remove");
  close(log->descriptor);
  log->descriptor = -1;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- writing */

static celspan_status append(celspan_context *context, const cs_tile_log *log, const char *line) {
  return cs_lines_add(log->descriptor, line) ? CELSPAN_OK
                                             : fail(context, log->path, "cannot write");
}

celspan_status cs_tile_log_open(celspan_context *context, cs_tile_log *log) {
  char head[LINE_SIZE];
  if (!cs_lines_make_folders(log->path))
    return fail(context, log->path, "cannot make its folder");
  CS_TRY(lock(context, log));
  off_t size = lseek(log->descriptor, 0, SEEK_END);
  write_head(log, head);
  if (size <= 0)
    return append(context, log, head);
  return cs_lines_end_last(log->descriptor) ? CELSPAN_OK : fail(context, log->path, "cannot write");
}

celspan_status cs_tile_log_flush(celspan_context *context, cs_tile_log *log) {
  char line[LINE_SIZE];
  if (log->written == log->count)
    return CELSPAN_OK;
  if (syncfs(log->descriptor) != 0)
    return fail(context, log->path, "cannot sync the tiles");
  for (; log->written < log->count; log->written++) {
    const cs_tile_row *row = &log->rows[log->written];
    snprintf(line, sizeof line, "row %d %d %d %d\n", row->level, row->row, row->first, row->end);
    CS_TRY(append(context, log, line));
  }
  log->synced = cs_progress_clock();
  return CELSPAN_OK;
}

celspan_status cs_tile_log_add(celspan_context *context, cs_tile_log *log, cs_tile_row row) {
  CS_TRY(keep_row(context, log, row));
  return cs_progress_clock() - log->synced < PAUSE ? CELSPAN_OK : cs_tile_log_flush(context, log);
}

void cs_tile_log_close(celspan_context *context, cs_tile_log *log) {
  if (log->descriptor >= 0)
    close(log->descriptor);
  log->descriptor = -1;
  cs_mem_free(context->memory, log->rows, log->capacity * sizeof *log->rows);
  log->rows = NULL;
  log->count = log->written = log->capacity = 0;
}

#include "writers/tiles/log.h"

#include <errno.h>
#include <ftw.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "inside/clock.h"
#include "inside/context.h"
#include "inside/files.h"
#include "inside/pictures.h"
#include "inside/scene.h"
#include "process/journal.h"

enum {
  LINE_SIZE = 128,
  OPEN_FOLDERS = 16,
  PAUSE = 2 /* minimum of seconds between two flushes */
};

static celspan_status fail(celspan_context *context, const char *path, const char *what) {
  celspan_status status = errno == ENOMEM ? CELSPAN_NO_MEMORY : CELSPAN_OUTPUT;
  return cs_fail(context, status, "%s: %s: %s", path, what, strerror(errno));
}

/* ---------------------------------------------------------------- digest */

static void add_file_state(cs_hash *hash, const char *path) {
  struct stat found;
  memset(&found, 0, sizeof found);
  if (stat(path, &found) != 0)
    found.st_size = -1;
  cs_hash_word(hash, (uint64_t)found.st_size);
  cs_hash_word(hash, (uint64_t)found.st_mtim.tv_sec);
  cs_hash_word(hash, (uint64_t)found.st_mtim.tv_nsec);
}

static void add_file(cs_hash *hash, const char *path) {
  unsigned char bytes[4096];
  size_t size;
  FILE *file = fopen(path, "rb");
  if (!file)
    return;
  while ((size = fread(bytes, 1, sizeof bytes, file)) > 0)
    cs_hash_bytes(hash, bytes, size);
  fclose(file);
}

/* Hashes the structure of a scene, and the name, size and time of its pictures. A procedure has no
 * structure: for a scene with procedures, the script and its parameters are hashed too. */
static void add_scene(cs_hash *hash, const cs_tile_inputs *inputs) {
  const celspan_frame_desc *frame = inputs->frame;
  const celspan_exposure *exposures = frame->exposures;
  for (size_t i = 0; i < frame->exposure_count; i++) {
    if (!cs_scene_has_procedure(&exposures[i], 1))
      cs_hash_hash(hash, exposures[i].rostrum->hash);
    cs_hash_number(hash, exposures[i].weight);
  }
  cs_hash_hash(hash, cs_walk_hash_files(exposures, frame->exposure_count));
  if (!cs_scene_has_procedure(exposures, frame->exposure_count))
    return;
  add_file(hash, inputs->file);
  cs_hash_hash(hash, inputs->given);
}

static void add_shape(cs_hash *hash, const cs_pyramid *pyramid) {
  const int32_t numbers[] = {(int32_t)pyramid->layout, pyramid->width, pyramid->height,
                             pyramid->tile, pyramid->overlap};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    cs_hash_word(hash, (uint64_t)numbers[i]);
  cs_hash_text(hash, pyramid->ending);
}

static cs_hash digest_of(const cs_tile_inputs *inputs, const cs_pyramid *pyramid) {
  const celspan_frame_desc *frame = inputs->frame;
  cs_hash hash = cs_hash_begin(inputs->is_script);
  cs_hash_text(&hash, celspan_version());
  add_shape(&hash, pyramid);
  cs_hash_number(&hash, frame->film_width);
  cs_hash_number(&hash, frame->film_height);
  cs_hash_word(&hash, frame->space);
  cs_hash_word(&hash, frame->has_antialias ? 1 + (uint64_t)frame->antialias : 0);
  cs_hash_word(&hash, frame->filter ? (uint64_t)frame->filter->kernel : 0);
  cs_hash_word(&hash, frame->filter ? (uint64_t)frame->filter->rows : 0);
  cs_hash_word(&hash, inputs->skips_empty + 2 * (uint64_t)inputs->is_sparse);
  if (inputs->is_script)
    add_scene(&hash, inputs);
  else
    add_file_state(&hash, inputs->file);
  return cs_hash_end(hash);
}

/* ---------------------------------------------------------------- lines */

static void write_head(const cs_tile_log *log, char line[LINE_SIZE]) {
  snprintf(line, LINE_SIZE, "celspan tiles 2 %016" PRIx64 "%016" PRIx64 "\n", log->digest.a,
           log->digest.b);
}

/* The line of a row. `check` is the checksum of the lines before it, to which the line is added. */
static void write_row(cs_tile_row row, cs_hash *check, char line[LINE_SIZE]) {
  int length = snprintf(line, LINE_SIZE, "row %" PRId32 " %" PRId32 " %" PRId32 " %" PRId32,
                        row.level, row.row, row.first, row.end);
  cs_hash_text(check, line);
  snprintf(line + length, (size_t)(LINE_SIZE - length), " %016" PRIx64 "\n", cs_hash_end(*check).a);
}

/* Whether the text is the line of a row that continues the lines of `check`; if so, it is added to
 * them. */
static bool read_row(const char *text, cs_hash *check, cs_tile_row *row) {
  char line[LINE_SIZE];
  cs_hash added = *check;
  if (sscanf(text, "row %" SCNd32 " %" SCNd32 " %" SCNd32 " %" SCNd32, &row->level, &row->row,
             &row->first, &row->end) != 4)
    return false;
  write_row(*row, &added, line);
  if (strcmp(line, text) != 0)
    return false;
  *check = added;
  return true;
}

/* ---------------------------------------------------------------- reading */

static celspan_status keep_row(celspan_context *context, cs_tile_log *log, cs_tile_row row) {
  return CS_ARRAY_APPEND(context, log->rows, log->count, row);
}

/* Reads rows up to the first line that does not check. *trusted: the bytes before that line. */
static celspan_status read_rows(celspan_context *context, cs_tile_log *log, FILE *file,
                                off_t *trusted) {
  char line[LINE_SIZE];
  cs_tile_row row;
  *trusted = ftello(file);
  while (fgets(line, sizeof line, file) && read_row(line, &log->check, &row)) {
    CS_TRY(keep_row(context, log, row));
    *trusted = ftello(file);
  }
  log->written = log->count;
  return ferror(file) ? fail(context, log->path, "cannot read") : CELSPAN_OK;
}

static bool exists(const char *path) {
  struct stat found;
  return stat(path, &found) == 0;
}

static bool has_head(const cs_tile_log *log, FILE *file) {
  char head[LINE_SIZE], line[LINE_SIZE];
  write_head(log, head);
  return fgets(line, sizeof line, file) && strcmp(line, head) == 0;
}

celspan_status cs_tile_log_find(celspan_context *context, const cs_pyramid *pyramid,
                                const cs_tile_inputs *inputs, cs_tile_log *log,
                                cs_tile_log_state *state) {
  char folder[4096];
  log->digest = digest_of(inputs, pyramid);
  log->check = log->digest;
  log->descriptor = -1;
  size_t size = sizeof log->path;
  if (snprintf(log->path, size, "%s/%s.tiles", pyramid->folder, pyramid->name) >= (int)size ||
      !cs_pyramid_tiles_folder(pyramid, folder, sizeof folder))
    return cs_pyramid_too_long(context, pyramid);
  FILE *file = fopen(log->path, "r");
  if (!file && errno != ENOENT)
    return fail(context, log->path, "cannot read");
  if (file)
    *state = has_head(log, file) ? CS_TILE_LOG_SAME : CS_TILE_LOG_OTHER;
  else
    *state = exists(folder) ? CS_TILE_LOG_FOREIGN : CS_TILE_LOG_NEW;
  if (file)
    fclose(file);
  return CELSPAN_OK;
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

/* ---------------------------------------------------------------- locking */

/* Opens the record, or creates it, and locks it. */
static celspan_status lock(celspan_context *context, cs_tile_log *log) {
  log->descriptor = cs_journal_open(log->path);
  if (log->descriptor < 0)
    return fail(context, log->path, "cannot write");
  if (!cs_temporary_claim(log->descriptor))
    return cs_fail(context, CELSPAN_OUTPUT, "%s: another celspan is writing these tiles",
                   log->path);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- clearing */

static int remove_one(const char *path, const struct stat *found, int kind, struct FTW *where) {
  (void)found, (void)kind, (void)where;
  return remove(path);
}

/* The record is removed last, so that --fresh works even if an earlier run was stopped here. */
celspan_status cs_tile_log_clear(celspan_context *context, const cs_pyramid *pyramid,
                                 cs_tile_log *log) {
  char folder[4096];
  CS_TRY(lock(context, log));
  if (cs_pyramid_tiles_folder(pyramid, folder, sizeof folder) && exists(folder) &&
      nftw(folder, remove_one, OPEN_FOLDERS, FTW_DEPTH | FTW_PHYS) != 0)
    return fail(context, folder, "cannot remove its tiles");
  if (unlink(log->path) != 0 && errno != ENOENT)
    return fail(context, log->path, "cannot remove");
  close(log->descriptor);
  log->descriptor = -1;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- writing */

static celspan_status append(celspan_context *context, const cs_tile_log *log, const char *line) {
  return cs_journal_add(log->descriptor, line) ? CELSPAN_OK
                                               : fail(context, log->path, "cannot write");
}

/* Reads the rows of a locked record, and cuts off everything after them. */
static celspan_status read_locked(celspan_context *context, cs_tile_log *log) {
  off_t trusted = 0;
  FILE *file = fopen(log->path, "r");
  if (!file)
    return fail(context, log->path, "cannot read");
  celspan_status status =
      has_head(log, file)
          ? read_rows(context, log, file, &trusted)
          : cs_fail(context, CELSPAN_OUTPUT, "%s: another celspan has just replaced it", log->path);
  fclose(file);
  if (status == CELSPAN_OK && ftruncate(log->descriptor, trusted) != 0)
    return fail(context, log->path, "cannot write");
  return status;
}

static bool is_any(const char *pattern, const char *name) { return pattern && name; }

static void sweep(const char *folder) {
  char inside[4096];
  if (snprintf(inside, sizeof inside, "%s/", folder) < (int)sizeof inside)
    cs_temporary_sweep(inside, is_any);
}

static int sweep_folder(const char *path, const struct stat *found, int kind, struct FTW *where) {
  (void)found, (void)where;
  if (kind == FTW_D)
    sweep(path);
  return 0;
}

/* The tiles, the page, and the viewer. */
static void sweep_all(const cs_pyramid *pyramid) {
  char folder[4096];
  sweep(pyramid->folder);
  if (cs_pyramid_tiles_folder(pyramid, folder, sizeof folder))
    nftw(folder, sweep_folder, OPEN_FOLDERS, FTW_PHYS);
  if (snprintf(folder, sizeof folder, "%s/openseadragon", pyramid->folder) < (int)sizeof folder)
    sweep(folder);
}

celspan_status cs_tile_log_open(celspan_context *context, const cs_pyramid *pyramid,
                                cs_tile_log *log) {
  char head[LINE_SIZE];
  if (!cs_journal_make_folders(log->path))
    return fail(context, log->path, "cannot make its folder");
  CS_TRY(lock(context, log));
  sweep_all(pyramid);
  if (lseek(log->descriptor, 0, SEEK_END) > 0)
    return read_locked(context, log);
  write_head(log, head);
  return append(context, log, head);
}

celspan_status cs_tile_log_flush(celspan_context *context, cs_tile_log *log) {
  char line[LINE_SIZE];
  if (log->written == log->count)
    return CELSPAN_OK;
  if (syncfs(log->descriptor) != 0)
    return fail(context, log->path, "cannot sync the tiles");
  for (; log->written < log->count; log->written++) {
    write_row(log->rows[log->written], &log->check, line);
    CS_TRY(append(context, log, line));
  }
  log->synced = cs_clock_seconds();
  return CELSPAN_OK;
}

celspan_status cs_tile_log_add(celspan_context *context, cs_tile_log *log, cs_tile_row row) {
  CS_TRY(keep_row(context, log, row));
  return cs_clock_seconds() - log->synced < PAUSE ? CELSPAN_OK : cs_tile_log_flush(context, log);
}

void cs_tile_log_close(celspan_context *context, cs_tile_log *log) {
  if (log->descriptor >= 0)
    close(log->descriptor);
  log->descriptor = -1;
  CS_ARRAYS_FREE(context->memory, log, rows, rows);
  log->count = log->written = 0;
}

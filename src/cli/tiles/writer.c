#include "cli/tiles/writer.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/context.h"
#include "cli/lines.h"
#include "output/pixels.h"
#include "output/sink.h"

enum { PATH_SIZE = 4096 };

/* ---------------------------------------------------------------- what writers share */

void cs_tile_output_init(cs_tile_output *output, celspan_context *context,
                         const cs_pyramid *pyramid, const celspan_file_desc *file) {
  *output = (cs_tile_output){.context = context, .pyramid = pyramid, .file = *file};
  output->file.coding = cs_pixels_resolve(&file->coding, CELSPAN_DEPTH_8);
  cs_tile_known_init(&output->known);
}

void cs_tile_output_finish(cs_tile_output *output) {
  cs_tile_known_finish(&output->known, output->context);
}

void cs_tile_output_skip(cs_tile_output *output, const float rgba[4]) {
  output->skips_empty = true;
  cs_pixels_code(&output->file.coding, rgba, output->empty);
}

/* ---------------------------------------------------------------- links */

/* Links under a temporary name and renames that, because a link cannot replace a file. false: this
 * file system has no links, or this file has too many, so that the tile has to be written. */
static bool link_file(const char *from, char *to) {
  char temporary[PATH_SIZE + 16];
  snprintf(temporary, sizeof temporary, "%s.link.part", to);
  unlink(temporary);
  bool is_linked = link(from, temporary) == 0;
  if (!is_linked && errno == ENOENT && cs_lines_make_folders(to))
    is_linked = link(from, temporary) == 0;
  is_linked = is_linked && rename(temporary, to) == 0;
  unlink(temporary); /* renaming does nothing when both are one file already */
  return is_linked;
}

static bool link_to(const cs_pyramid *pyramid, cs_pyramid_tile tile, char *path) {
  char from[PATH_SIZE];
  return cs_pyramid_path(pyramid, tile, false, from, sizeof from) &&
         (strcmp(from, path) == 0 || link_file(from, path));
}

/* ---------------------------------------------------------------- one row of one tile */

void cs_tile_writer_init(cs_tile_writer *writer, cs_tile_output *output, cs_tile_source source) {
  *writer = (cs_tile_writer){.output = output, .source = source};
  cs_context_branch(&writer->context, output->context);
}

void cs_tile_writer_finish(cs_tile_writer *writer) {
  cs_memory *memory = writer->context.memory;
  cs_mem_free(memory, writer->starts, writer->start_capacity * sizeof *writer->starts);
  cs_mem_free(memory, writer->spans, writer->span_capacity * sizeof *writer->spans);
  cs_mem_free(memory, writer->pixels, writer->pixel_capacity);
}

celspan_status cs_tile_writer_begin(cs_tile_writer *writer, int32_t rows) {
  CS_TRY(cs_mem_reserve(&writer->context, (void **)&writer->starts, &writer->start_capacity,
                        (size_t)rows, sizeof *writer->starts));
  memset(writer->starts, 0, (size_t)rows * sizeof *writer->starts);
  return CELSPAN_OK;
}

static celspan_span cut_span(celspan_span span, int32_t x0, int32_t x1) {
  int32_t from = span.x0 > x0 ? span.x0 : x0;
  if (span.kind == CELSPAN_SPAN_ARRAY)
    span.array += 4 * (size_t)(from - span.x0);
  span.x0 = from - x0;
  span.x1 = (span.x1 < x1 ? span.x1 : x1) - x0;
  span.origin -= x0;
  return span;
}

/* Cuts the tile's part out of a row. The search for it begins where the tile to the left ended. */
static celspan_status cut_row(cs_tile_writer *writer, const cs_pyramid_box *box, int32_t y,
                              size_t *out_count) {
  size_t count, kept = 0;
  size_t *start = &writer->starts[y - box->y0];
  const celspan_span *spans = writer->source.row(writer->source.user, y, &count);
  int32_t x0 = box->x0 - writer->source.left, x1 = box->x1 - writer->source.left;
  while (*start < count && spans[*start].x1 <= x0)
    ++*start;
  size_t end = *start;
  while (end < count && spans[end].x0 < x1)
    end++;
  CS_TRY(cs_mem_reserve(&writer->context, (void **)&writer->spans, &writer->span_capacity,
                        end - *start, sizeof *writer->spans));
  for (size_t i = *start; i < end; i++)
    writer->spans[kept++] = cut_span(spans[i], x0, x1);
  *out_count = kept;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one tile */

typedef struct tile_content {
  cs_hash hash;
  bool is_empty;
} tile_content;

static bool is_all(const unsigned char *row, size_t size, const unsigned char *pixel,
                   size_t pixel_size) {
  return memcmp(row, pixel, pixel_size) == 0 &&
         memcmp(row, row + pixel_size, size - pixel_size) == 0;
}

static celspan_status read_content(cs_tile_writer *writer, const cs_pyramid_box *box,
                                   tile_content *out) {
  const cs_tile_output *output = writer->output;
  const celspan_coding *coding = &output->file.coding;
  size_t pixel_size = celspan_coding_pixel_size(coding);
  size_t size = (size_t)(box->x1 - box->x0) * pixel_size, count;
  CS_TRY(
      cs_mem_reserve(&writer->context, (void **)&writer->pixels, &writer->pixel_capacity, size, 1));
  cs_hash hash = cs_hash_begin((uint64_t)(box->x1 - box->x0));
  out->is_empty = output->skips_empty;
  for (int32_t y = box->y0; y < box->y1; y++) {
    CS_TRY(cut_row(writer, box, y, &count));
    cs_pixels_row(coding, writer->spans, count, writer->pixels);
    cs_hash_bytes(&hash, writer->pixels, size);
    out->is_empty = out->is_empty && is_all(writer->pixels, size, output->empty, pixel_size);
  }
  out->hash = cs_hash_end(hash);
  return CELSPAN_OK;
}

static celspan_status put_rows(cs_tile_writer *writer, const cs_pyramid_box *box,
                               const celspan_sink *sink) {
  size_t count;
  CS_TRY(sink->begin(sink->user, &writer->context, box->x1 - box->x0, box->y1 - box->y0));
  for (int32_t y = box->y0; y < box->y1; y++) {
    CS_TRY(cut_row(writer, box, y, &count));
    CS_TRY(sink->row(sink->user, &writer->context, y - box->y0, writer->spans, count));
  }
  return CELSPAN_OK;
}

static celspan_status write_tile(cs_tile_writer *writer, const cs_pyramid_box *box,
                                 const char *path) {
  celspan_sink sink;
  CS_TRY(cs_sink_file(&writer->context, path, &writer->output->file, &sink));
  return sink.end(sink.user, &writer->context, put_rows(writer, box, &sink));
}

static celspan_status refuse_path(cs_tile_writer *writer) {
  return cs_fail(&writer->context, CELSPAN_OUTPUT, "%.80s...: the names of its tiles are too long",
                 writer->output->pyramid->folder);
}

static celspan_status put_alias(cs_tile_writer *writer, const cs_pyramid_box *box,
                                cs_pyramid_tile tile) {
  char path[PATH_SIZE];
  const cs_pyramid *pyramid = writer->output->pyramid;
  if (!cs_pyramid_path(pyramid, tile, true, path, sizeof path) || link_to(pyramid, tile, path))
    return CELSPAN_OK;
  return write_tile(writer, box, path);
}

celspan_status cs_tile_writer_put(cs_tile_writer *writer, int32_t level, int32_t column,
                                  int32_t row) {
  cs_tile_output *output = writer->output;
  cs_pyramid_box tiles = {column, row, column + 1, row + 1};
  cs_pyramid_box box = cs_pyramid_pixels(output->pyramid, level, &tiles);
  char path[PATH_SIZE];
  tile_content content;
  cs_pyramid_tile tile = {level, column, row}, known;
  CS_TRY(read_content(writer, &box, &content));
  if (content.is_empty) {
    output->skipped++;
    return CELSPAN_OK;
  }
  if (!cs_pyramid_path(output->pyramid, tile, false, path, sizeof path))
    return refuse_path(writer);
  if (cs_tile_known_find(&output->known, content.hash, &known) &&
      link_to(output->pyramid, known, path)) {
    output->linked++;
  } else {
    CS_TRY(write_tile(writer, &box, path));
    CS_TRY(cs_tile_known_add(&output->known, &writer->context, content.hash, tile));
    output->written++;
  }
  return put_alias(writer, &box, tile);
}

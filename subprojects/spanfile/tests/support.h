/* Numbered random pictures, as files in memory. */
#pragma once

#include "common.h"
#include "spanfile.h"

static inline spanfile_source memory_source(memory_file *file) {
  return (spanfile_source){.read = memory_read, .user = file, .size = file->size};
}

/* ---------------------------------------------------------------- pictures */

typedef struct picture {
  spanfile_format format;
  uint32_t width, height;
  size_t pixel_size;
  unsigned char *pixels;
} picture;

static inline unsigned char *picture_row(const picture *p, uint32_t y) {
  return p->pixels + (size_t)y * p->width * p->pixel_size;
}

static inline void random_pixel(random_state *random, const picture *p, unsigned char *out) {
  for (size_t i = 0; i < p->pixel_size; i++)
    out[i] = (unsigned char)random_next(random);
  if (p->format == SPANFILE_HALF && random_below(random, 8) > 0) /* mostly in 0..2 */
    for (size_t c = 1; c < 8; c += 2)
      out[c] = (unsigned char)(out[c] & 0x3f);
}

static inline void repeat_pixel(const picture *p, const unsigned char *pixel, uint32_t count,
                                unsigned char *out) {
  for (uint32_t i = 0; i < count; i++)
    memcpy(out + i * p->pixel_size, pixel, p->pixel_size);
}

/* Spans of a few kinds; one seed makes the same colours at any lengths. */
static inline void random_spans(random_state *random, const picture *p, const uint32_t *ends,
                                unsigned char *row) {
  for (uint32_t x = 0, i = 0; x < p->width; x = ends[i++]) {
    unsigned char colours[16], *out = row + x * p->pixel_size;
    uint32_t kind = random_below(random, 4), count = ends[i] - x;
    random_pixel(random, p, colours);
    random_pixel(random, p, colours + p->pixel_size);
    if (kind == 0 && count > 1)
      spanfile_gradient_pixels(p->format, colours, count, 0, count, out);
    else if (kind == 1 && count < 64)
      for (uint32_t k = 0; k < count; k++)
        random_pixel(random, p, out + k * p->pixel_size);
    else
      repeat_pixel(p, colours, count, out);
  }
}

static inline void random_ends(random_state *random, uint32_t width, uint32_t *ends) {
  uint32_t longest = 1 + random_below(random, width < 40                ? width
                                              : random_below(random, 2) ? 12
                                                                        : width);
  for (uint32_t x = 0, i = 0; x < width; i++) {
    uint32_t length = 1 + random_below(random, longest);
    x = length < width - x ? x + length : width;
    ends[i] = x;
  }
}

/* Moves each end a little, but keeps their order. */
static inline void move_ends(random_state *random, uint32_t width, uint32_t *ends) {
  uint32_t reach = random_below(random, 4) ? 2 : 20, start = 0;
  for (uint32_t i = 0; ends[i] < width; i++) {
    uint32_t to = ends[i] + random_below(random, 2 * reach + 1), least = start + 1 + reach;
    to = to < least ? least : to;
    to -= reach;
    uint32_t most = ends[i + 1] - 1;
    ends[i] = to < most ? to : most > start ? most : ends[i];
    start = ends[i];
  }
}

/* Rows that are new, repeated, or with their ends moved. */
static inline picture random_picture(uint64_t seed, uint32_t most_width, uint32_t most_height) {
  random_state random = {seed};
  picture p = {.format = seed % 2 ? SPANFILE_SRGB8 : SPANFILE_HALF};
  p.width = 1 + random_below(&random, most_width);
  p.height = 1 + random_below(&random, most_height);
  p.pixel_size = spanfile_pixel_size(p.format);
  p.pixels = malloc((size_t)p.width * p.height * p.pixel_size);
  uint32_t *ends = malloc(p.width * sizeof *ends);
  random_state colours = {seed + 1};
  random_ends(&random, p.width, ends);
  for (uint32_t y = 0; y < p.height; y++) {
    uint32_t what = random_below(&random, 10);
    if (what == 0) {
      random_ends(&random, p.width, ends);
      colours.state = random_next(&random);
    } else if (what < 7) {
      move_ends(&random, p.width, ends);
    }
    random_state row_colours = colours;
    random_spans(&row_colours, &p, ends, picture_row(&p, y));
  }
  free(ends);
  return p;
}

/* ---------------------------------------------------------------- writing them */

/* file: NULL for a part of a file. */
static inline spanfile_writer_desc writer_desc(const picture *p, memory_file *file) {
  return (spanfile_writer_desc){.width = p->width,
                                .height = p->height,
                                .format = p->format,
                                .write = file ? memory_write : NULL,
                                .user = file};
}

static inline spanfile_writer *open_writer(const picture *p, memory_file *file) {
  spanfile_writer_desc desc = writer_desc(p, file);
  spanfile_writer *writer = NULL;
  CHECK(spanfile_writer_create(&desc, &writer) == SPANFILE_OK);
  return writer;
}

static inline uint64_t load_pixel(const unsigned char *at, size_t pixel_size) {
  uint64_t pixel = 0;
  for (size_t i = 0; i < pixel_size; i++)
    pixel |= (uint64_t)at[i] << 8 * i;
  return pixel;
}

/* Writes the next pixels as at most 9 runs, now and then split where nothing changes. Returns the
 * number of pixels. */
static inline uint32_t write_runs(random_state *random, spanfile_writer *writer,
                                  const unsigned char *at, uint32_t left, size_t pixel_size) {
  spanfile_run runs[9];
  uint32_t run_count = 1 + random_below(random, 9), x = 0, taken = 0;
  for (; taken < run_count && x < left; taken++) {
    uint32_t count = 1, most = left - x;
    most = random_below(random, 8) > 0 ? most : 1 + random_below(random, most);
    while (count < most &&
           memcmp(at + x * pixel_size, at + (x + count) * pixel_size, pixel_size) == 0)
      count++;
    runs[taken] = (spanfile_run){count, load_pixel(at + x * pixel_size, pixel_size)};
    x += count;
  }
  CHECK(spanfile_writer_runs(writer, runs, taken) == SPANFILE_OK);
  return x;
}

/* The row in pieces: as runs, as one run, or as arrays cut anywhere. */
static inline void write_row(random_state *random, spanfile_writer *writer, const picture *p,
                             uint32_t y) {
  const unsigned char *row = picture_row(p, y);
  for (uint32_t x = 0; x < p->width;) {
    const unsigned char *at = row + x * p->pixel_size;
    uint32_t run = 1, left = p->width - x, count = 1 + random_below(random, left);
    while (run < left && memcmp(at, at + run * p->pixel_size, p->pixel_size) == 0)
      run++;
    uint32_t way = random_below(random, run > 1 ? 4 : 2);
    if (way == 0) {
      CHECK(spanfile_writer_pixels(writer, at, count) == SPANFILE_OK);
      x += count;
    } else if (way == 1) {
      x += write_runs(random, writer, at, left, p->pixel_size);
    } else {
      CHECK(spanfile_writer_run(writer, run, load_pixel(at, p->pixel_size)) == SPANFILE_OK);
      x += run;
    }
  }
  CHECK(spanfile_writer_row(writer) == SPANFILE_OK);
}

static inline void finish_writer(spanfile_writer *writer) {
  CHECK(spanfile_writer_finish(writer) == SPANFILE_OK);
  spanfile_writer_destroy(writer);
}

static inline memory_file write_picture(const picture *p, uint64_t seed) {
  memory_file file = {0};
  random_state random = {seed};
  spanfile_writer *writer = open_writer(p, &file);
  for (uint32_t y = 0; y < p->height; y++)
    write_row(&random, writer, p, y);
  finish_writer(writer);
  return file;
}

/* A picture, its file, and a reader of the file. */
typedef struct written {
  picture p;
  memory_file file;
  spanfile_reader *reader;
} written;

static inline spanfile_reader *open_reader(memory_file *file) {
  spanfile_reader *reader = NULL;
  spanfile_source source = memory_source(file);
  CHECK(spanfile_reader_create(&source, &reader, NULL) == SPANFILE_OK);
  return reader;
}

static inline void written_open(written *w, picture p, uint64_t seed) {
  w->p = p;
  w->file = write_picture(&p, seed);
  w->reader = open_reader(&w->file);
}

static inline void written_free(written *w) {
  spanfile_reader_destroy(w->reader);
  free(w->file.bytes);
  free(w->p.pixels);
}

static inline bool has_pixels(spanfile_reader *reader, const picture *p, uint32_t y) {
  spanfile_row row;
  spanfile_fault fault;
  if (!CHECK(spanfile_reader_row(reader, y, &row, &fault) == SPANFILE_OK)) {
    fprintf(stderr, "  at %llu: %s\n", (unsigned long long)fault.offset, fault.reason);
    return false;
  }
  unsigned char *pixels = malloc(p->width * p->pixel_size);
  spanfile_row_pixels(p->format, &row, 0, p->width, pixels);
  bool is_same = memcmp(pixels, picture_row(p, y), p->width * p->pixel_size) == 0;
  free(pixels);
  return is_same;
}

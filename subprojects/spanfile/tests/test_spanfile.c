/* Written pictures are read back; truncated, altered and inconsistent files are refused; memory is
 * limited. One list of cases, long because there are many kinds of damage. */
#include "support.h"

#include "mend.h"

/* ---------------------------------------------------------------- there and back */

static void check_rows(const written *w) {
  for (uint32_t y = 0; y < w->p.height; y++)
    CHECK(has_pixels(w->reader, &w->p, y));
}

static void check_round_trip(uint64_t seed, uint32_t most_width, uint32_t most_height) {
  picture p = random_picture(seed, most_width, most_height);
  written w;
  written_open(&w, p, seed);
  spanfile_info info = spanfile_reader_info(w.reader);
  CHECK(info.width == p.width && info.height == p.height && info.format == p.format);
  check_rows(&w);
  random_state random = {seed};
  for (int i = 0; i < 20; i++)
    CHECK(has_pixels(w.reader, &p, random_below(&random, p.height)));
  spanfile_counts counts;
  CHECK(spanfile_reader_check(w.reader, &counts, NULL) == SPANFILE_OK);
  CHECK(counts.literal_rows + counts.moved_rows + counts.same_rows == p.height);
  written_free(&w);
}

static void test_round_trips(void) {
  for (uint64_t seed = 0; seed < 300; seed++)
    check_round_trip(seed, 200, 40);
  for (uint64_t seed = 300; seed < 304; seed++)
    check_round_trip(seed, 70000, 12);
  for (uint64_t seed = 304; seed < 312; seed++)
    check_round_trip(seed, 3, 3000);
}

/* Counts around the limits of a packet, in each kind of packet. */
static void test_counts(void) {
  static const uint32_t counts[] = {1,     2,     3,     127,   128,   129,
                                    32767, 32768, 32769, 65536, 65537, 1000000};
  for (int format = SPANFILE_SRGB8; format <= SPANFILE_HALF; format++)
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
      picture p = {.format = (spanfile_format)format, .width = counts[i], .height = 3};
      random_state random = {i};
      unsigned char ends[16] = {0};
      p.pixel_size = spanfile_pixel_size(p.format);
      p.pixels = malloc((size_t)p.width * p.height * p.pixel_size);
      random_pixel(&random, &p, ends);
      repeat_pixel(&p, ends, p.width, picture_row(&p, 0));
      for (uint32_t x = 0; x < p.width; x++)
        random_pixel(&random, &p, picture_row(&p, 1) + x * p.pixel_size);
      memset(ends + p.pixel_size, 0x30, p.pixel_size);
      memset(ends, 0, p.pixel_size);
      for (uint32_t x = 0; x < p.width; x += 32768) { /* one gradient a packet */
        uint32_t length = p.width - x < 32768 ? p.width - x : 32768;
        unsigned char *at = picture_row(&p, 2) + x * p.pixel_size;
        if (length == 1)
          memcpy(at, ends, p.pixel_size);
        else
          spanfile_gradient_pixels(p.format, ends, length, 0, length, at);
      }
      written w;
      written_open(&w, p, i);
      check_rows(&w);
      written_free(&w);
    }
}

/* Any part of a row equals that part of the whole row. */
static void test_parts_of_rows(void) {
  picture p = random_picture(11, 300, 30);
  written w;
  written_open(&w, p, 1);
  random_state random = {5};
  unsigned char *pixels = malloc(p.width * p.pixel_size);
  for (int i = 0; i < 500; i++) {
    uint32_t y = random_below(&random, p.height), x0 = random_below(&random, p.width);
    uint32_t x1 = x0 + random_below(&random, p.width - x0 + 1);
    spanfile_row row;
    CHECK(spanfile_reader_row(w.reader, y, &row, NULL) == SPANFILE_OK);
    spanfile_row_pixels(p.format, &row, x0, x1, pixels);
    CHECK(memcmp(pixels, picture_row(&p, y) + x0 * p.pixel_size, (x1 - x0) * p.pixel_size) == 0);
  }
  free(pixels);
  written_free(&w);
}

/* ---------------------------------------------------------------- parts of a file */

static void put_rows(spanfile_writer *writer, const picture *p, uint32_t first, uint32_t count) {
  for (uint32_t y = first; y < p->height && y < first + count; y++) {
    CHECK(spanfile_writer_pixels(writer, picture_row(p, y), p->width) == SPANFILE_OK);
    CHECK(spanfile_writer_row(writer) == SPANFILE_OK);
  }
}

static memory_file write_whole(const picture *p) {
  memory_file file = {0};
  spanfile_writer *writer = open_writer(p, &file);
  put_rows(writer, p, 0, p->height);
  finish_writer(writer);
  return file;
}

static void put_part(spanfile_writer *part, const picture *p, uint32_t first) {
  CHECK(spanfile_writer_begin_part(part, first) == SPANFILE_OK);
  put_rows(part, p, first, SPANFILE_PART_ROWS);
}

/* Packed in any order, one after the other in one writer or each in its own, parts make the file
 * that one writer makes. */
static memory_file write_parts(const picture *p, bool has_own) {
  enum { MOST = 20 };
  memory_file file = {0};
  spanfile_writer *writer = open_writer(p, &file), *parts[MOST] = {NULL};
  spanfile_writer_desc desc = writer_desc(p, NULL);
  uint32_t count = (p->height - 1) / SPANFILE_PART_ROWS + 1;
  for (uint32_t i = count; i-- > 0 && has_own;) {
    CHECK(spanfile_writer_create_part(&desc, &parts[i]) == SPANFILE_OK);
    put_part(parts[i], p, i * SPANFILE_PART_ROWS);
  }
  for (uint32_t i = 0; i < count; i++) {
    spanfile_writer *part = parts[has_own ? i : 0];
    if (!part)
      CHECK(spanfile_writer_create_part(&desc, &part) == SPANFILE_OK);
    parts[has_own ? i : 0] = part;
    if (!has_own)
      put_part(part, p, i * SPANFILE_PART_ROWS);
    CHECK(spanfile_writer_join(writer, part) == SPANFILE_OK);
  }
  finish_writer(writer);
  for (uint32_t i = 0; i < count; i++)
    spanfile_writer_destroy(parts[i]);
  return file;
}

static void check_parts(const picture *p) {
  memory_file whole = write_whole(p);
  for (int i = 0; i < 2; i++) {
    memory_file joined = write_parts(p, i == 1);
    CHECK(memory_is_same(&whole, &joined));
    free(joined.bytes);
  }
  free(whole.bytes);
}

/* Pictures of one part and of many; rows of many bytes, so that parts have key rows of their
 * own. */
static void test_parts(void) {
  for (uint64_t seed = 40; seed < 52; seed++) {
    picture p = random_picture(seed, seed % 3 == 0 ? 4000 : 60, seed % 4 == 0 ? 100 : 3000);
    check_parts(&p);
    free(p.pixels);
  }
}

static void test_parts_misuse(void) {
  memory_file file = {0};
  picture p = random_picture(44, 60, 3000);
  spanfile_writer_desc desc = writer_desc(&p, NULL);
  spanfile_writer *writer = open_writer(&p, &file), *part;
  CHECK(p.height > SPANFILE_PART_ROWS);
  CHECK(spanfile_writer_create_part(&desc, &part) == SPANFILE_OK);
  CHECK(spanfile_writer_begin_part(part, 1) == SPANFILE_BAD_ARGUMENT);
  CHECK(spanfile_writer_begin_part(writer, 0) == SPANFILE_BAD_ARGUMENT);
  spanfile_writer_destroy(writer);
  free(file.bytes);
  file = (memory_file){0};
  writer = open_writer(&p, &file);
  put_part(part, &p, SPANFILE_PART_ROWS);
  CHECK(spanfile_writer_run(part, 1, 0) == SPANFILE_BAD_ARGUMENT); /* it is complete */
  CHECK(spanfile_writer_join(writer, part) == SPANFILE_BAD_ARGUMENT);
  put_part(part, &p, 0);
  CHECK(spanfile_writer_finish(part) == SPANFILE_BAD_ARGUMENT);
  CHECK(spanfile_writer_join(writer, part) == SPANFILE_BAD_ARGUMENT); /* errors stick */
  spanfile_writer_destroy(part);
  spanfile_writer_destroy(writer);
  free(file.bytes);
  free(p.pixels);
}

/* ---------------------------------------------------------------- what it costs */

/* Spans of one picture-wide pattern, its inner ends moved by y * slope. */
static memory_file write_slanted(uint32_t width, uint32_t height, uint32_t spans, double slope) {
  memory_file file = {0};
  picture p = {.format = SPANFILE_SRGB8, .width = width, .height = height, .pixel_size = 4};
  spanfile_writer *writer = open_writer(&p, &file);
  for (uint32_t y = 0; y < height; y++) {
    uint32_t start = 0;
    for (uint32_t i = 1; i <= spans; i++) {
      uint32_t end = i < spans ? width / 2 / spans * i + (uint32_t)(y * slope) : width;
      CHECK(spanfile_writer_run(writer, end - start, 0xff000000 + i) == SPANFILE_OK);
      start = end;
    }
    CHECK(spanfile_writer_row(writer) == SPANFILE_OK);
  }
  finish_writer(writer);
  return file;
}

static void test_costs(void) {
  memory_file one = write_slanted(1000000, 1, 41, 0), same = write_slanted(1000000, 101, 41, 0);
  memory_file moved = write_slanted(1000000, 101, 41, 2.7);
  CHECK(same.size - one.size == 100 * 6);
  CHECK(moved.size - one.size < 100 * 17 + 41);
  free(one.bytes);
  free(same.bytes);
  free(moved.bytes);
}

/* ---------------------------------------------------------------- cut, altered, lying */

/* The sum of all pixels, or the refusal. */
static spanfile_status read_all(memory_file *file, spanfile_fault *fault) {
  spanfile_source source = memory_source(file);
  spanfile_reader *reader = NULL;
  spanfile_status status = spanfile_reader_create(&source, &reader, fault);
  if (status == SPANFILE_OK)
    status = spanfile_reader_check(reader, NULL, fault);
  if (reader)
    spanfile_reader_destroy(reader);
  return status;
}

static bool is_refused(memory_file *file) {
  spanfile_fault fault = {UINT64_MAX, ""};
  return read_all(file, &fault) == SPANFILE_BAD_FILE && fault.offset <= file->size &&
         fault.reason[0] != '\0';
}

static void test_cut(const memory_file *whole) {
  for (size_t size = 0; size < whole->size; size++) {
    memory_file cut = {malloc(size + 1), size, size};
    memcpy(cut.bytes, whole->bytes, size);
    CHECK(is_refused(&cut));
    free(cut.bytes);
  }
}

static void test_altered(const memory_file *whole) {
  memory_file altered = {malloc(whole->size), whole->size, whole->size};
  memcpy(altered.bytes, whole->bytes, whole->size);
  for (size_t i = 0; i < whole->size; i++)
    for (int bit = 0; bit < 8; bit++) {
      altered.bytes[i] ^= (unsigned char)(1 << bit);
      CHECK(is_refused(&altered));
      altered.bytes[i] = whole->bytes[i];
    }
  free(altered.bytes);
}

static bool is_a_row(const spanfile_row *row, uint32_t width) {
  uint32_t start = 0;
  for (size_t i = 0; i < row->count; start = row->spans[i++].end)
    if (row->spans[i].end <= start || row->spans[i].kind > SPANFILE_GRADIENT)
      return false;
  return start == width;
}

/* Random bytes are changed and the checksums corrected: a row that is read then is still valid. */
static void test_lying(void) {
  for (uint64_t seed = 0; seed < 4000; seed++) {
    picture p = random_picture(seed % 40, 30, 12);
    memory_file file = write_picture(&p, seed);
    random_state random = {seed};
    size_t first = random_below(&random, 8) ? SF_HEADER_BYTES : 26;
    for (uint32_t i = 0; i <= seed % 3; i++) {
      size_t at = first + random_below(&random, (uint32_t)(file.size - first));
      file.bytes[at] = (unsigned char)random_next(&random);
    }
    mend_sums(&file, p.height);
    spanfile_source source = memory_source(&file);
    spanfile_reader *reader = NULL;
    spanfile_row row;
    if (spanfile_reader_create(&source, &reader, NULL) == SPANFILE_OK) {
      spanfile_info info = spanfile_reader_info(reader);
      for (uint32_t i = 0; i < 40; i++)
        if (spanfile_reader_row(reader, random_below(&random, info.height), &row, NULL) ==
            SPANFILE_OK)
          CHECK(is_a_row(&row, info.width));
      spanfile_reader_destroy(reader);
    }
    free(file.bytes);
    free(p.pixels);
  }
}

static void test_bad_files(void) {
  picture p = random_picture(7, 30, 12);
  memory_file file = write_picture(&p, 3);
  test_cut(&file);
  test_altered(&file);
  memory_write(&file, "", 1);
  CHECK(is_refused(&file));
  free(file.bytes);
  free(p.pixels);
  test_lying();
}

/* After a refused row the others can still be read. */
static void test_goes_on(void) {
  memory_file file = write_slanted(100000, 2000, 20, 1.5);
  picture p = {.format = SPANFILE_SRGB8, .width = 100000, .height = 2000, .pixel_size = 4};
  spanfile_reader *reader = open_reader(&file);
  spanfile_row row;
  spanfile_fault fault = {0};
  file.bytes[file.size / 2] ^= 1;
  uint32_t refused = 0;
  for (uint32_t y = 0; y < p.height; y++)
    refused += spanfile_reader_row(reader, y, &row, &fault) != SPANFILE_OK;
  CHECK(refused > 0 && refused <= SF_KEY_ROWS);
  CHECK(strstr(fault.reason, "row ") && strstr(fault.reason, "checksum"));
  CHECK(spanfile_reader_row(reader, p.height, &row, &fault) == SPANFILE_BAD_ARGUMENT);
  spanfile_reader_destroy(reader);
  free(file.bytes);
}

/* ---------------------------------------------------------------- the index */

/* More key rows than a node has entries, and rows of more bytes than lie between key rows. */
static void test_tall(void) {
  memory_file file = {0};
  picture p = {.format = SPANFILE_SRGB8, .width = 40000, .height = 300000, .pixel_size = 4};
  spanfile_writer *writer = open_writer(&p, &file);
  for (uint32_t y = 0; y < p.height; y++) {
    spanfile_writer_run(writer, 10000 + y % 9000, 0xff0000ff);
    spanfile_writer_run(writer, 30000 - y % 9000, 0xff00ff00 + y / 100000);
    spanfile_writer_row(writer);
  }
  finish_writer(writer);
  spanfile_reader *reader = open_reader(&file);
  spanfile_row row;
  random_state random = {1};
  for (int i = 0; i < 3000; i++) {
    uint32_t y = i < 2 ? (uint32_t)i * (p.height - 1) : random_below(&random, p.height);
    CHECK(spanfile_reader_row(reader, y, &row, NULL) == SPANFILE_OK && row.count == 2 &&
          row.spans[0].end == 10000 + y % 9000 && row.spans[1].pixel == 0xff00ff00 + y / 100000);
  }
  CHECK(spanfile_reader_check(reader, NULL, NULL) == SPANFILE_OK);
  spanfile_reader_destroy(reader);
  free(file.bytes);
}

static void test_wide(void) {
  picture p = {.format = SPANFILE_HALF, .width = 20000, .height = 40, .pixel_size = 8};
  random_state random = {3};
  p.pixels = malloc((size_t)p.width * p.height * 8);
  for (size_t i = 0; i < (size_t)p.width * p.height; i++)
    random_pixel(&random, &p, p.pixels + 8 * i);
  written w;
  written_open(&w, p, 1);
  for (uint32_t y = p.height; y-- > 0;)
    CHECK(has_pixels(w.reader, &p, y));
  written_free(&w);
}

/* ---------------------------------------------------------------- memory, misuse, failing calls */

static spanfile_status write_metered(const picture *p, memory_file *file, meter *m) {
  spanfile_writer_desc desc = writer_desc(p, file);
  desc.resize = metered;
  desc.resize_user = m;
  spanfile_writer *writer = NULL;
  spanfile_status status = spanfile_writer_create(&desc, &writer);
  for (uint32_t y = 0; y < p->height && status == SPANFILE_OK; y++) {
    status = spanfile_writer_pixels(writer, picture_row(p, y), p->width);
    if (status == SPANFILE_OK)
      status = spanfile_writer_row(writer);
  }
  if (status == SPANFILE_OK)
    status = spanfile_writer_finish(writer);
  spanfile_writer_destroy(writer);
  return status;
}

static spanfile_status read_metered(memory_file *file, meter *m) {
  spanfile_source source = memory_source(file);
  source.resize = metered;
  source.resize_user = m;
  spanfile_reader *reader = NULL;
  spanfile_status status = spanfile_reader_create(&source, &reader, NULL);
  if (status == SPANFILE_OK)
    status = spanfile_reader_check(reader, NULL, NULL);
  if (reader)
    spanfile_reader_destroy(reader);
  return status;
}

static void test_memory(void) {
  picture p = random_picture(21, 400, 60);
  memory_file file = {0};
  meter m = {0};
  CHECK(write_metered(&p, &file, &m) == SPANFILE_OK);
  CHECK(m.bytes == 0 && m.peak < 1024 * 1024);
  size_t row = (size_t)p.width * (sizeof(spanfile_span) + sizeof(int64_t) + p.pixel_size);
  m.peak = 0;
  CHECK(read_metered(&file, &m) == SPANFILE_OK);
  CHECK(m.bytes == 0 && m.peak < 80 * 1024 + 2 * row);
  for (int fail_at = 1;; fail_at++) {
    memory_file again = {0};
    m = (meter){.fail_at = fail_at};
    spanfile_status status = write_metered(&p, &again, &m);
    bool is_same = memory_is_same(&again, &file);
    free(again.bytes);
    CHECK(m.bytes == 0);
    if (status == SPANFILE_OK) {
      CHECK(is_same && fail_at > 6);
      break;
    }
    CHECK(status == SPANFILE_NO_MEMORY);
  }
  for (int fail_at = 1;; fail_at++) {
    m = (meter){.fail_at = fail_at};
    spanfile_status status = read_metered(&file, &m);
    CHECK(m.bytes == 0);
    if (status == SPANFILE_OK)
      break;
    CHECK(status == SPANFILE_NO_MEMORY);
  }
  free(file.bytes);
  free(p.pixels);
}

/* ---------------------------------------------------------------- strips */

static memory_file write_strip(const picture *p, uint32_t first, uint32_t count) {
  memory_file file = {0};
  spanfile_writer_desc desc = writer_desc(p, &file);
  desc.height = p->height - first < count ? p->height - first : count;
  desc.strip_row = first;
  desc.strip_height = p->height;
  spanfile_writer *writer;
  CHECK(spanfile_writer_create(&desc, &writer) == SPANFILE_OK);
  put_rows(writer, p, first, desc.height);
  finish_writer(writer);
  return file;
}

typedef struct joined {
  memory_file file;
  meter meter;
  spanfile_status status;
} joined;

static joined join_strips(const picture *p, memory_file *strips, uint32_t count, int fail_at) {
  joined out = {.meter = {.fail_at = fail_at}};
  spanfile_writer_desc desc = writer_desc(p, &out.file);
  spanfile_joiner *joiner = NULL;
  desc.resize = metered;
  desc.resize_user = &out.meter;
  out.status = spanfile_joiner_create(&desc, &joiner);
  for (uint32_t i = 0; i < count && out.status == SPANFILE_OK; i++) {
    spanfile_source source = memory_source(&strips[i]);
    source.resize = metered;
    source.resize_user = &out.meter;
    out.status = spanfile_joiner_add(joiner, &source, NULL);
  }
  if (out.status == SPANFILE_OK)
    out.status = spanfile_joiner_finish(joiner);
  spanfile_joiner_destroy(joiner);
  CHECK(out.meter.bytes == 0);
  return out;
}

static void check_join(const picture *p, memory_file *strips, uint32_t count, memory_file whole) {
  joined made = join_strips(p, strips, count, 0);
  CHECK(made.status == SPANFILE_OK && made.meter.peak < 1024 * 1024);
  CHECK(memory_is_same(&made.file, &whole));
  free(made.file.bytes);
  for (int fail_at = 1; fail_at <= 3; fail_at++) {
    made = join_strips(p, strips, 1, fail_at);
    CHECK(made.status == SPANFILE_NO_MEMORY);
    free(made.file.bytes);
  }
}

/* Every byte of a strip matters: a changed byte, or a truncated file, is refused or does not change
 * the result; and memory use stays the same. */
static void check_damage(const picture *p, memory_file *strips, uint32_t count, memory_file whole) {
  random_state random = {77};
  for (int i = 0; i < 400; i++) {
    uint32_t which = random_below(&random, count);
    size_t at = random_below(&random, (uint32_t)strips[which].size), size = strips[which].size;
    unsigned char *byte = &strips[which].bytes[at], was = *byte;
    *byte ^= (unsigned char)(1 + random_below(&random, 255));
    if (i % 4 == 0)
      strips[which].size = at;
    joined made = join_strips(p, strips, count, 0);
    bool is_same = memory_is_same(&made.file, &whole);
    CHECK(made.status == SPANFILE_BAD_FILE || (made.status == SPANFILE_OK && is_same));
    CHECK(made.meter.peak < 1024 * 1024);
    free(made.file.bytes);
    *byte = was;
    strips[which].size = size;
  }
}

static void check_strips(uint64_t seed, uint32_t rows) {
  picture p = random_picture(seed, seed % 3 == 0 ? 4000 : 60, 3000);
  memory_file strips[12] = {{0}}, whole = write_whole(&p);
  uint32_t count = 0;
  for (uint32_t y = 0; y < p.height; y += rows)
    strips[count++] = write_strip(&p, y, rows);
  check_join(&p, strips, count, whole);
  check_damage(&p, strips, count, whole);
  if (count > 1) {
    joined made = join_strips(&p, strips, count - 1, 0);
    CHECK(made.status == SPANFILE_BAD_ARGUMENT);
    free(made.file.bytes);
    made = join_strips(&p, strips + 1, 1, 0);
    CHECK(made.status == SPANFILE_BAD_FILE);
    free(made.file.bytes);
  }
  joined made = join_strips(&p, &whole, 1, 0);
  CHECK(made.status == SPANFILE_BAD_FILE);
  free(made.file.bytes);
  while (count > 0)
    free(strips[--count].bytes);
  free(whole.bytes);
  free(p.pixels);
}

static void test_strips(void) {
  for (uint64_t seed = 60; seed < 66; seed++)
    check_strips(seed, seed % 2 == 0 ? 256 : 1024);
  spanfile_writer_desc desc = {
      .width = 1, .height = 300, .format = SPANFILE_SRGB8, .write = memory_write};
  spanfile_writer *writer;
  desc.strip_row = 100;
  CHECK(spanfile_writer_create(&desc, &writer) == SPANFILE_BAD_ARGUMENT); /* no strip */
  desc.strip_height = 1000;
  CHECK(spanfile_writer_create(&desc, &writer) == SPANFILE_BAD_ARGUMENT); /* not at 256 */
  desc.strip_row = 256;
  CHECK(spanfile_writer_create(&desc, &writer) == SPANFILE_BAD_ARGUMENT); /* ends at 556 */
}

/* A few bytes that declare millions of pixels do not make the reader allocate memory for them. */
static void test_claims(void) {
  memory_file file = write_slanted(4000000000u, 2, 3, 1);
  meter m = {0};
  CHECK(read_metered(&file, &m) == SPANFILE_OK);
  size_t packets = 4000000000u / 32768; /* the packets of its two rows */
  CHECK(m.peak < 200 * 1024 + 2 * packets * 7 && file.size < 200000 + packets * 14);
  memset(file.bytes + 26, 0xff, 8);
  mend_sums(&file, UINT32_MAX);
  CHECK(is_refused(&file));
  free(file.bytes);
}

static bool refuse_read(void *user, uint64_t offset, void *bytes, size_t size) {
  (void)user, (void)offset, (void)bytes, (void)size;
  return false;
}

static void test_misuse(void) {
  memory_file file = {0};
  picture p = {.format = SPANFILE_SRGB8, .width = 10, .height = 2, .pixel_size = 4};
  unsigned char pixels[44] = {0};
  spanfile_writer *writer = open_writer(&p, &file);
  CHECK(spanfile_writer_pixels(writer, pixels, 11) == SPANFILE_BAD_ARGUMENT);
  CHECK(spanfile_writer_run(writer, 10, 0) == SPANFILE_BAD_ARGUMENT); /* it sticks */
  spanfile_writer_destroy(writer);
  writer = open_writer(&p, &file);
  const spanfile_run runs[3] = {{9, 0}, {2, 1}, {0, 2}};
  CHECK(spanfile_writer_runs(writer, runs, 2) == SPANFILE_BAD_ARGUMENT);
  spanfile_writer_destroy(writer);
  writer = open_writer(&p, &file);
  CHECK(spanfile_writer_runs(writer, runs + 1, 2) == SPANFILE_BAD_ARGUMENT); /* an empty one */
  spanfile_writer_destroy(writer);
  writer = open_writer(&p, &file);
  CHECK(spanfile_writer_run(writer, 0, 0) == SPANFILE_OK);
  CHECK(spanfile_writer_run(writer, 9, 0) == SPANFILE_OK);
  CHECK(spanfile_writer_row(writer) == SPANFILE_BAD_ARGUMENT);
  spanfile_writer_destroy(writer);
  writer = open_writer(&p, &file);
  CHECK(spanfile_writer_finish(writer) == SPANFILE_BAD_ARGUMENT);
  spanfile_writer_destroy(writer);
  spanfile_writer_desc desc = {
      .width = 0, .height = 1, .format = SPANFILE_HALF, .write = memory_write, .user = &file};
  CHECK(spanfile_writer_create(&desc, &writer) == SPANFILE_BAD_ARGUMENT);
  free(file.bytes);
}

static void test_failing_calls(void) {
  size_t left = 100;
  spanfile_writer_desc desc = {
      .width = 5, .height = 1, .format = SPANFILE_SRGB8, .write = failing_write, .user = &left};
  spanfile_writer *writer = NULL;
  CHECK(spanfile_writer_create(&desc, &writer) == SPANFILE_OK);
  CHECK(spanfile_writer_run(writer, 5, 1) == SPANFILE_OK);
  CHECK(spanfile_writer_row(writer) == SPANFILE_OK);
  CHECK(spanfile_writer_finish(writer) == SPANFILE_WRITE_FAILED);
  spanfile_writer_destroy(writer);
  spanfile_source source = {.read = refuse_read, .size = 1000};
  spanfile_reader *reader = NULL;
  CHECK(spanfile_reader_create(&source, &reader, NULL) == SPANFILE_READ_FAILED && !reader);
}

/* ---------------------------------------------------------------- small parts */

static void test_sums(void) {
  unsigned char bytes[100];
  random_state random = {9};
  for (size_t i = 0; i < sizeof bytes; i++)
    bytes[i] = (unsigned char)random_next(&random);
  CHECK(sf_crc32c(0, "123456789", 9) == 0xe3069283);
  for (size_t size = 0; size <= sizeof bytes; size++)
    CHECK(sf_crc32c(0, bytes, size) == sf_crc32c_by_tables(0, bytes, size));
}

static void test_numbers(void) {
  static const int64_t numbers[] = {0, 1, -1, 63, -64, 64, 4294967295, -4294967296, 8589934591};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    unsigned char bytes[10];
    uint64_t code;
    size_t size = sf_store_varint(bytes, sf_zigzag(numbers[i]));
    CHECK(sf_load_varint(bytes, 5, &code) == size && sf_unzigzag(code) == numbers[i]);
  }
}

static void test_gradients(void) {
  static const unsigned char ends[8] = {0, 255, 10, 255, 255, 0, 13, 255};
  unsigned char out[4 * 4];
  spanfile_gradient_pixels(SPANFILE_SRGB8, ends, 4, 0, 4, out);
  static const unsigned char line[16] = {0,   255, 10, 255, 85,  170, 11, 255,
                                         170, 85,  12, 255, 255, 0,   13, 255};
  CHECK(memcmp(out, line, sizeof line) == 0);
  /* 0, 1/2, 1 in red; the least number above 0 halved to even in green. */
  static const unsigned char halves[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0x3c, 1, 0, 3, 0, 0, 0};
  unsigned char middle[8];
  spanfile_gradient_pixels(SPANFILE_HALF, halves, 3, 1, 1, middle);
  CHECK(middle[0] == 0 && middle[1] == 0x38);
  CHECK(middle[2] == 0 && middle[3] == 0 && middle[4] == 2 && middle[5] == 0);
}

/* Halves pass unchanged through the arithmetic of gradients. */
static void test_halves(void) {
  for (uint32_t half = 0; half < 65536; half++) {
    if ((half & 0x7c00) == 0x7c00 || half == 0x8000)
      continue;
    unsigned char ends[16] = {0}, out[8];
    ends[0] = ends[8] = (unsigned char)half;
    ends[1] = ends[9] = (unsigned char)(half >> 8);
    spanfile_gradient_pixels(SPANFILE_HALF, ends, 4, 1, 1, out);
    if (!CHECK((out[0] | (uint32_t)out[1] << 8) == half))
      return;
  }
}

int main(void) {
  test_sums();
  test_numbers();
  test_gradients();
  test_halves();
  test_round_trips();
  test_counts();
  test_parts_of_rows();
  test_parts();
  test_parts_misuse();
  test_costs();
  test_bad_files();
  test_goes_on();
  test_tall();
  test_wide();
  test_memory();
  test_strips();
  test_claims();
  test_misuse();
  test_failing_calls();
  return check_done();
}

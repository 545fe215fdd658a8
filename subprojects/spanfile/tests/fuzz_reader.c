/* Any bytes as a span file: no fault, memory in proportion to the bytes, valid rows, and small
 * pictures that are the same after they are written again.
 *
 * The first byte decides whether the rest is read unchanged, or with corrected checksums (1) and
 * ends (2). With clang's -fsanitize=fuzzer this is a fuzz target; with REPLAY_MAIN its own main
 * runs the files of a folder.
 */
#include "fuzz.h"
#include "mend.h"

static void check_row(const spanfile_row *row, spanfile_info info) {
  uint32_t start = 0;
  for (size_t i = 0; i < row->count; start = row->spans[i++].end) {
    const spanfile_span *span = &row->spans[i], *before = i > 0 ? span - 1 : NULL;
    demand(span->end > start && span->end <= info.width, "a span is empty or too long");
    demand(span->kind <= SPANFILE_GRADIENT, "a span is of an unknown kind");
    if (before && span->kind == before->kind && span->kind != SPANFILE_GRADIENT)
      demand(span->kind == SPANFILE_RUN && span->pixel != before->pixel, "spans are not joined");
  }
  demand(start == info.width, "the row has another width");
}

/* Two parts of the row are equal to those of the whole. */
static void check_pixels(const spanfile_row *row, spanfile_info info) {
  unsigned char whole[64 * 8], parts[64 * 8];
  size_t pixel_size = spanfile_pixel_size(info.format);
  uint32_t width = info.width < 64 ? info.width : 64, x0 = info.width - width, cut = x0 + width / 3;
  spanfile_row_pixels(info.format, row, x0, info.width, whole);
  spanfile_row_pixels(info.format, row, x0, cut, parts);
  spanfile_row_pixels(info.format, row, cut, info.width, parts + (cut - x0) * pixel_size);
  demand(memcmp(whole, parts, width * pixel_size) == 0, "parts differ from the whole");
}

static void read_rows(spanfile_reader *reader, size_t size) {
  spanfile_info info = spanfile_reader_info(reader);
  for (uint32_t i = 0; i < 12; i++) {
    spanfile_row row;
    spanfile_fault fault = {0};
    uint32_t y = i < 4 ? i % info.height : (uint32_t)(i * 2654435761u % info.height);
    if (spanfile_reader_row(reader, y, &row, &fault) == SPANFILE_OK) {
      check_row(&row, info);
      check_pixels(&row, info);
    } else {
      demand(fault.offset <= size && fault.reason[0] != '\0', "a refusal without a reason");
    }
  }
}

/* Reading and writing twice gives the same bytes. */
static void write_again(spanfile_reader *reader) {
  spanfile_info info = spanfile_reader_info(reader);
  if ((uint64_t)info.width * info.height > 2048)
    return;
  picture p = {info.format, info.width, info.height, spanfile_pixel_size(info.format), NULL};
  p.pixels = malloc((size_t)p.width * p.height * p.pixel_size);
  for (uint32_t y = 0; y < p.height; y++) {
    spanfile_row row;
    demand(spanfile_reader_row(reader, y, &row, NULL) == SPANFILE_OK, "a row cannot be read again");
    spanfile_row_pixels(p.format, &row, 0, p.width, picture_row(&p, y));
  }
  written again;
  written_open(&again, p, p.width);
  demand(again.reader != NULL, "own file refused");
  for (uint32_t y = p.height; y-- > 0;)
    demand(has_pixels(again.reader, &p, y), "other pixels");
  written_free(&again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  memory_file file = {malloc(size), size - 1, size};
  memcpy(file.bytes, data + 1, size - 1);
  if ((data[0] & 2) && file.size >= SF_HEADER_BYTES + SF_END_BYTES)
    mend_ends(&file);
  if ((data[0] & 1) && file.size >= SF_HEADER_BYTES + SF_END_BYTES)
    mend_sums(&file, sf_load_32(file.bytes + 30));
  meter m = {0};
  spanfile_source source = memory_source(&file);
  source.resize = metered;
  source.resize_user = &m;
  spanfile_reader *reader = NULL;
  if (spanfile_reader_create(&source, &reader, NULL) == SPANFILE_OK) {
    read_rows(reader, file.size);
    if (spanfile_reader_check(reader, NULL, NULL) == SPANFILE_OK)
      write_again(reader);
    spanfile_reader_destroy(reader);
  }
  demand(m.bytes == 0 && m.peak <= 128 * 1024 + 16 * file.size, "memory that nothing pays for");
  demand(check_failures == 0, "a call of the writer failed");
  free(file.bytes);
  return 0;
}

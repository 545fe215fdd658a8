/* Any bytes as a plane file: no fault, memory in proportion to the bytes, valid bands, crops that
 * are the same as the whole, and the same plane after it is written again.
 *
 * The first byte decides whether the rest is read unchanged, or with corrected checksums (1), and
 * which frame is read (its upper bits). With
 * clang's -fsanitize=fuzzer this is a fuzz target; with REPLAY_MAIN its own main runs the files of
 * a folder.
 */
#include "../../spanfile/tests/fuzz.h"
#include "mend.h"

static void check_piece(const planefile_band *band, const planefile_piece *piece) {
  demand(piece->degree >= 1 && piece->degree <= 3, "a piece of another degree");
  demand((uint64_t)piece->point + piece->degree < band->point_count, "a piece without points");
  for (int i = 0; i <= piece->degree; i++) {
    const planefile_point *at = &band->points[piece->point + (uint32_t)i];
    demand(at->x >= -PLANEFILE_FAR && at->x <= PLANEFILE_FAR, "a point is too far away");
    demand(at->w >= PLANEFILE_WEIGHT / 16, "a weight is too small");
  }
}

static void check_band(const planefile_band *band) {
  for (uint32_t i = 0; i < band->piece_count; i++)
    check_piece(band, &band->pieces[i]);
  for (uint32_t i = 0; i < band->border_count; i++) {
    const planefile_border *b = &band->borders[i];
    demand(b->chain < band->chain_count && b->left < band->cell_count &&
               b->right < band->cell_count && b->left != b->right,
           "a border without sides");
    demand(b->top >= band->top && b->top < b->foot && b->foot <= band->foot, "a border outside");
    const planefile_border *before = i > 0 ? b - 1 : NULL;
    demand(!before || before->chain < b->chain ||
               (before->chain == b->chain && before->foot <= b->top),
           "borders are not in order");
  }
}

/* A crop of the whole is what is drawn of that crop. */
static void check_crop(const planefile_plane *plane, uint32_t size, planefile_sampling sampling) {
  planefile_view whole = {size, size, 0, 0, size, size, sampling};
  planefile_view crop = {size, size, size / 3, size / 4, size / 2, size / 2, sampling};
  planefile_cell *all = draw_view(plane, whole), *part = draw_view(plane, crop);
  for (uint32_t y = 0; y < crop.rows; y++)
    demand(memcmp(part + y * crop.columns, all + (y + crop.y) * size + crop.x,
                  crop.columns * sizeof *part) == 0,
           "a crop is not a part of the whole");
  free(all);
  free(part);
}

/* Any crop of a frame far too large to be drawn as a whole. */
static void draw_deep(const planefile_plane *plane, uint32_t seed) {
  random_state random = {seed};
  uint32_t x = random_below(&random, (1 << 24) - 16), y = random_below(&random, (1 << 20) - 16);
  planefile_view view = {1 << 24, 1 << 20, x, y, 16, 16, PLANEFILE_AREA};
  free(draw_view(plane, view));
}

/* The parts of a border that do not depend on the numbers of chains and cells. */
typedef struct edge {
  int32_t top, foot;
  planefile_cell left, right;
} edge;

static int compare_edges(const void *first, const void *second) {
  return memcmp(first, second, sizeof(edge));
}

/* The borders of a band in an order of their own. */
static edge *sort_borders(const planefile_band *band) {
  edge *out = calloc((size_t)band->border_count + 1, sizeof *out);
  demand(out != NULL, "no memory");
  for (uint32_t i = 0; i < band->border_count; i++) {
    const planefile_border *b = &band->borders[i];
    out[i] = (edge){b->top, b->foot, band->cells[b->left], band->cells[b->right]};
  }
  qsort(out, band->border_count, sizeof *out, compare_edges);
  return out;
}

static void compare_borders(const planefile_band *band, const planefile_band *other) {
  demand(band->border_count == other->border_count, "another number of borders");
  edge *edges = sort_borders(band), *others = sort_borders(other);
  demand(memcmp(edges, others, band->border_count * sizeof *edges) == 0, "other borders");
  free(edges);
  free(others);
}

/* What was read can be written, and is then read again as it was, except the order of chains: the
 * writer sorts them by the ends of the pieces that it keeps (pack.c), and of a frame written alone
 * it keeps fewer than of a frame of a film, whose chains have all of them. */
static void write_again(const planefile_plane *plane) {
  if (planefile_plane_info(plane).band_count > 1 || planefile_plane_info(plane).picture_count > 0)
    return;
  const planefile_band *band = planefile_plane_band(plane, 0);
  memory_file file = write_plane(band);
  planefile_plane *again = read_plane(&file);
  compare_borders(band, planefile_plane_band(again, 0));
  demand(draws_same(plane, again, (planefile_view){24, 24, 0, 0, 24, 24, PLANEFILE_AREA}),
         "other pixels");
  planefile_plane_destroy(again);
  free(file.bytes);
}

static void use_plane(const planefile_plane *plane, uint32_t seed) {
  for (uint32_t i = 0; i < planefile_plane_info(plane).band_count; i++)
    check_band(planefile_plane_band(plane, i));
  check_crop(plane, 24, PLANEFILE_AREA);
  check_crop(plane, 33, PLANEFILE_NONE);
  draw_deep(plane, seed);
  write_again(plane);
}

/* Frames one after the other, which may have a base in common. */
static void read_on(const planefile_source *source, uint32_t frame) {
  planefile_plane *plane = NULL;
  for (uint32_t i = 0; i < 3; i++)
    if (planefile_read_next(source, frame + i, &plane, NULL) == PLANEFILE_OK)
      check_crop(plane, 24, PLANEFILE_AREA);
  planefile_plane_destroy(plane);
}

/* The planes in a nest, which are parts of the file behind its head; each may be anything. */
static void use_inner(const memory_file *file, const planefile_plane *outer) {
  uint64_t offset, size, before = PF_NEST_BYTES;
  for (uint32_t i = 0; i < planefile_plane_info(outer).inner_count; i++) {
    planefile_plane *plane = NULL;
    planefile_plane_inner(outer, i, &offset, &size);
    demand(offset >= before && size <= file->size - offset, "a plane outside the file");
    before = offset + size;
    memory_file part = {.bytes = file->bytes + offset, .size = (size_t)size};
    planefile_source source = memory_source(&part);
    if (planefile_read(&source, 0, PLANEFILE_SIDE, &plane, NULL) == PLANEFILE_OK)
      check_crop(plane, 24, PLANEFILE_AREA);
    planefile_plane_destroy(plane);
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  memory_file file = {malloc(size), size - 1, size};
  memcpy(file.bytes, data + 1, size - 1);
  if (data[0] & 1)
    mend_sums(&file);
  meter m = {0};
  planefile_source source = memory_source(&file);
  source.resize = metered;
  source.resize_user = &m;
  planefile_plane *plane = NULL;
  planefile_fault fault = {0};
  if (planefile_read_frame(&source, data[0] >> 2, 0, PLANEFILE_SIDE, &plane, &fault) ==
      PLANEFILE_OK) {
    demand(m.peak <= 128 * 1024 + 600 * file.size, "memory that nothing pays for");
    use_plane(plane, pf_crc32c(0, data, size));
    use_inner(&file, plane);
    planefile_plane_destroy(plane);
  } else {
    demand(fault.offset <= file.size && fault.reason[0] != '\0', "a refusal without a reason");
    demand(m.peak <= 128 * 1024 + 600 * file.size, "memory that nothing pays for");
  }
  read_on(&source, data[0] >> 2);
  demand(m.bytes == 0, "memory is not freed");
  demand(check_failures == 0, "a call failed");
  free(file.bytes);
  return 0;
}

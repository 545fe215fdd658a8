/* Writes random planes: `make_random FOLDER COUNT COLUMNS ROWS` makes 0.plane, 0.pixels, ... there,
 * to compare decoders with: the channels of the pixels as 32-bit integers; 0.codes, ..., the same
 * as 8-bit codes; film.plane, whose frames are all of these planes; and the codes of their pictures
 * of a name. With one more argument cells are 8-bit codes. Without a size the plane
 * files alone, and some films, beginning with a byte of 0 to 3, like the fuzzer's inputs. */
#include "support.h"

static void put_drawn(const char *folder, int number, const planefile_plane *plane,
                      uint32_t columns, uint32_t rows) {
  planefile_view view = {.width = columns, .height = rows, .columns = columns, .rows = rows};
  planefile_cell *pixels = draw_view(plane, view);
  size_t count = (size_t)columns * rows;
  unsigned char *codes = malloc(4 * count);
  put_numbered(folder, number, ".pixels", -1, pixels, count * sizeof *pixels);
  for (size_t i = 0; CHECK(codes != NULL) && i < count; i++)
    planefile_srgb8(plane, pixels[i], codes + 4 * i);
  put_numbered(folder, number, ".codes", -1, codes, 4 * count);
  free(codes);
  free(pixels);
}

static const planefile_grid coarse = {1920, 1081}; /* where cells are codes */

/* The drawing of a number; each third one is made from the one before. */
static drawing make(int number, bool is_coded) {
  int from = number % 3 == 2 ? number - 1 : number;
  random_state random = {(uint64_t)number};
  drawing d = random_drawing((uint64_t)from, 4 + (uint32_t)(from % 12), from % 2 ? VARIED : FLAT);
  if (from < number)
    alter_drawing(&d, &random, from % 3 == 0);
  if (is_coded)
    coarsen_drawing(&d, coarse);
  return d;
}

static memory_file make_film(int from, int end, bool is_coded) {
  memory_file file = {0};
  planefile_writer_desc desc = writer_desc(&file, 12);
  desc.is_coded = is_coded;
  if (is_coded)
    desc.grid = coarse;
  planefile_writer *writer = NULL;
  CHECK(planefile_writer_create(&desc, &writer) == PLANEFILE_OK);
  for (int i = from; i < end; i++) {
    drawing d = make(i, is_coded);
    CHECK(planefile_writer_frame(writer, &d.plane) == PLANEFILE_OK);
    drawing_free(&d);
  }
  CHECK(planefile_writer_end(writer) == PLANEFILE_OK);
  planefile_writer_destroy(writer);
  return file;
}

/* One in five inputs is a film. */
static void put_input(const char *folder, int number) {
  drawing d = make(number, number % 2);
  memory_file file = number % 5 == 4 ? make_film(number - 3, number, number % 2)
                                     : write_coded(&d.plane, number % 8 == 1);
  put_numbered(folder, number, "", number % 4, file.bytes, file.size);
  free(file.bytes);
  drawing_free(&d);
}

static void put_plane(const char *folder, int number, uint32_t columns, uint32_t rows,
                      bool is_coded) {
  written w = written_new(make(number, is_coded), is_coded);
  put_numbered(folder, number, ".plane", -1, w.file.bytes, w.file.size);
  put_drawn(folder, number, w.plane, columns, rows);
  written_free(&w);
}

static void put_pictures(const char *folder) {
  unsigned char codes[4 * PICTURE_SIDE * PICTURE_SIDE];
  for (size_t i = 0; i < PICTURES; i++) {
    const planefile_picture *picture = &test_pictures()[i];
    size_t row = (size_t)4 * picture->width;
    if (picture->kind != PLANEFILE_NAMED)
      continue;
    for (uint32_t y = 0; y < picture->height; y++)
      picture_row(picture->user, y, codes + row * y);
    put_file(folder, picture->name, -1, codes, row * picture->height);
  }
}

int main(int count, char **arguments) {
  if (count != 3 && count != 5 && count != 6)
    return 2;
  bool is_coded = count == 6;
  int planes = atoi(arguments[2]);
  for (int i = 0; i < planes; i++)
    if (count == 3)
      put_input(arguments[1], i);
    else
      put_plane(arguments[1], i, (uint32_t)atoi(arguments[3]), (uint32_t)atoi(arguments[4]),
                is_coded);
  if (count > 3) {
    memory_file film = make_film(0, planes, is_coded);
    put_file(arguments[1], "film.plane", -1, film.bytes, film.size);
    free(film.bytes);
    put_pictures(arguments[1]);
  }
  return check_done();
}

/* Writes random planes: `make_random FOLDER COUNT COLUMNS ROWS` makes 0.plane, 0.pixels, ... there,
 * to compare decoders with: the channels of the pixels as 32-bit integers; and 0.codes, ..., the
 * same as 8-bit codes. Without a size the plane files alone, beginning with a byte of 0 to 3, like
 * the fuzzer's inputs. */
#include "support.h"

static void put_file(const char *folder, int number, const char *ending, int first,
                     const void *bytes, size_t size) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%d%s", folder, number, ending);
  FILE *file = fopen(path, "wb");
  if (!CHECK(file != NULL))
    return;
  if (first >= 0)
    fputc(first, file);
  CHECK(fwrite(bytes, 1, size, file) == size);
  CHECK(fclose(file) == 0);
}

static void put_drawn(const char *folder, int number, memory_file *file, uint32_t columns,
                      uint32_t rows) {
  planefile_plane *plane = read_plane(file);
  planefile_view view = {.width = columns, .height = rows, .columns = columns, .rows = rows};
  planefile_cell *pixels = draw_view(plane, view);
  size_t count = (size_t)columns * rows;
  unsigned char *codes = malloc(4 * count);
  put_file(folder, number, ".pixels", -1, pixels, count * sizeof *pixels);
  for (size_t i = 0; CHECK(codes != NULL) && i < count; i++)
    planefile_srgb8(plane, pixels[i], codes + 4 * i);
  put_file(folder, number, ".codes", -1, codes, 4 * count);
  free(codes);
  free(pixels);
  planefile_plane_destroy(plane);
}

int main(int count, char **arguments) {
  if (count != 3 && count != 5)
    return 2;
  bool is_corpus = count == 3;
  for (int i = 0; i < atoi(arguments[2]); i++) {
    drawing d = random_drawing((uint64_t)i, (uint32_t)(i % 12), i % 2 ? VARIED : FLAT);
    memory_file file = write_plane(&d.plane);
    put_file(arguments[1], i, is_corpus ? "" : ".plane", is_corpus ? i % 4 : -1, file.bytes,
             file.size);
    if (!is_corpus)
      put_drawn(arguments[1], i, &file, (uint32_t)atoi(arguments[3]), (uint32_t)atoi(arguments[4]));
    free(file.bytes);
    drawing_free(&d);
  }
  return check_done();
}

/* Writes random pictures: `make_random FOLDER COUNT` makes 0.span, 0.pixels, ... there, to compare
 * decoders with. With a third argument the span files begin with a byte of 0 to 3, like the
 * fuzzer's inputs. */
#include "support.h"

static void put_file(const char *folder, int number, const char *ending, int first,
                     const void *bytes, size_t size) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%d.%s", folder, number, ending);
  FILE *file = fopen(path, "wb");
  if (!CHECK(file != NULL))
    return;
  if (first >= 0)
    fputc(first, file);
  CHECK(fwrite(bytes, 1, size, file) == size);
  CHECK(fclose(file) == 0);
}

int main(int count, char **arguments) {
  if (count < 3)
    return 2;
  bool is_corpus = count > 3;
  for (int i = 0; i < atoi(arguments[2]); i++) {
    bool is_wide = i % 50 == 49 && !is_corpus;
    picture p = random_picture((uint64_t)i, is_wide ? 100000 : 60,
                               is_wide        ? 5
                               : i % 50 == 48 ? 700
                                              : 20);
    memory_file file = write_picture(&p, (uint64_t)i);
    put_file(arguments[1], i, "span", is_corpus ? i % 4 : -1, file.bytes, file.size);
    if (!is_corpus)
      put_file(arguments[1], i, "pixels", -1, p.pixels, (size_t)p.width * p.height * p.pixel_size);
    free(file.bytes);
    free(p.pixels);
  }
  return check_done();
}

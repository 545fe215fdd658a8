/* Writes random pictures: `make_random FOLDER COUNT` makes 0.span, 0.pixels, ... there, to compare
 * decoders with. With a third argument the span files begin with a byte of 0 to 3, like the
 * fuzzer's inputs. */
#include "support.h"

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
    put_numbered(arguments[1], i, ".span", is_corpus ? i % 4 : -1, file.bytes, file.size);
    if (!is_corpus)
      put_numbered(arguments[1], i, ".pixels", -1, p.pixels,
                   (size_t)p.width * p.height * p.pixel_size);
    free(file.bytes);
    free(p.pixels);
  }
  return check_done();
}

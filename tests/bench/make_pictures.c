/* Writes the pictures of the raster jobs, for renderers that read files: `bench_pictures FOLDER`.
 */
#include "measure.h"
#include "pictures.h"

int main(int argc, char **argv) {
  if (argc != 2)
    bench_stop("usage: make_pictures FOLDER");
  bench_pictures_write(argv[1]);
  return 0;
}

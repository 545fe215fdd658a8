/* The pixels of a PNG as one number, read row by row with zlib and no code of celspan: 8 bits of
 * RGB or RGBA, of any size.
 *
 *   png_sums FILE      prints width, height, channels and the CRC-32 of the unfiltered rows
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { PIECE = 1 << 16 };

typedef struct png {
  FILE *file;
  z_stream stream;
  uint32_t width, height, channels, left; /* left: bytes of the chunk of image data */
  unsigned char piece[PIECE];
} png;

static void die(const char *why) {
  fprintf(stderr, "png_sums: %s\n", why);
  exit(1);
}

static uint32_t read_32(FILE *file) {
  unsigned char b[4];
  if (fread(b, 1, 4, file) != 4)
    die("cut");
  return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* The next chunk; its data follows in the file. */
static uint32_t next_chunk(png *p, char type[5]) {
  uint32_t size = read_32(p->file);
  if (fread(type, 1, 4, p->file) != 4)
    die("cut");
  return size;
}

static void open_png(png *p, const char *path) {
  unsigned char head[8], more[5];
  char type[5] = "";
  p->file = fopen(path, "rb");
  if (!p->file || fread(head, 1, 8, p->file) != 8 || memcmp(head, "\x89PNG\r\n\x1a\n", 8) != 0)
    die("not a PNG");
  next_chunk(p, type);
  p->width = read_32(p->file);
  p->height = read_32(p->file);
  if (fread(more, 1, 5, p->file) != 5 || more[0] != 8 || (more[1] != 2 && more[1] != 6))
    die("not 8 bits of RGB or RGBA");
  p->channels = more[1] == 6 ? 4 : 3;
  read_32(p->file);
  if (inflateInit(&p->stream) != Z_OK)
    die("no memory");
}

/* Reads more of the stream; chunks that are not image data are skipped. */
static void refill(png *p) {
  char type[5] = "";
  while (p->left == 0) {
    uint32_t size = next_chunk(p, type);
    if (memcmp(type, "IEND", 4) == 0)
      die("the image data ends too early");
    if (memcmp(type, "IDAT", 4) == 0)
      p->left = size;
    else if (fseek(p->file, (long)size + 4, SEEK_CUR) != 0)
      die("cut");
  }
  uint32_t count = p->left < PIECE ? p->left : PIECE;
  if (fread(p->piece, 1, count, p->file) != count)
    die("cut");
  p->stream.next_in = p->piece;
  p->stream.avail_in = count;
  p->left -= count;
  if (p->left == 0)
    read_32(p->file);
}

/* `size` bytes of the stream. Returns whether it ends after them. */
static int inflate_bytes(png *p, unsigned char *out, uint32_t size) {
  p->stream.next_out = out;
  p->stream.avail_out = size;
  int status = Z_OK;
  while (p->stream.avail_out > 0 && status == Z_OK) {
    if (p->stream.avail_in == 0)
      refill(p);
    status = inflate(&p->stream, Z_NO_FLUSH);
  }
  if (p->stream.avail_out > 0)
    die("the stream is wrong");
  return status == Z_STREAM_END;
}

static int paeth(int a, int b, int c) {
  int p = a + b - c, from_a = abs(p - a), from_b = abs(p - b), from_c = abs(p - c);
  return from_a <= from_b && from_a <= from_c ? a : from_b <= from_c ? b : c;
}

static void unfilter(unsigned char *row, const unsigned char *above, uint32_t size, uint32_t pixel,
                     int filter) {
  for (uint32_t i = 0; i < size && filter > 0; i++) {
    int a = i >= pixel ? row[i - pixel] : 0, b = above[i], c = i >= pixel ? above[i - pixel] : 0;
    int guess = filter == 1 ? a : filter == 2 ? b : filter == 3 ? (a + b) / 2 : paeth(a, b, c);
    row[i] = (unsigned char)(row[i] + guess);
  }
}

int main(int count, char **arguments) {
  png p = {0};
  unsigned char beyond[1];
  if (count != 2)
    die("one file is needed");
  open_png(&p, arguments[1]);
  uint32_t size = p.width * p.channels;
  unsigned char *row = calloc(size + 1, 1), *above = calloc(size + 1, 1);
  if (!row || !above)
    die("no memory");
  uLong sum = 0;
  for (uint32_t y = 0; y < p.height; y++) {
    inflate_bytes(&p, row, size + 1);
    if (row[0] > 4)
      die("there is no such filter");
    unfilter(row + 1, above + 1, size, p.channels, row[0]);
    sum = crc32(sum, row + 1, size);
    unsigned char *other = above;
    above = row;
    row = other;
  }
  p.stream.next_out = beyond;
  p.stream.avail_out = 1;
  while (p.stream.avail_in > 0 || p.left > 0) {
    if (p.stream.avail_in == 0)
      refill(&p);
    int status = inflate(&p.stream, Z_FINISH);
    if (status == Z_STREAM_END)
      break;
    if (p.stream.avail_in > 0 || p.stream.avail_out == 0)
      die("the stream does not end with its rows, or its checksum is wrong");
  }
  printf("%u x %u, %u channels, %08lx\n", p.width, p.height, p.channels, sum);
  return 0;
}

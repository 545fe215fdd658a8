/* Rectangles of pixels, as RGBA floats. */
#include <algorithm>
#include <cstring>

#include "plugins/oiio/reader.h"

using OIIO::ImageSpec;
using OIIO::TypeDesc;

/* Bytes of decoded pixels in memory at a time. */
static const size_t BATCH = size_t(4) << 20;

namespace {

/* Whole rows of the chosen channels as they are stored. Asked for another type, the library would
 * take memory for 256 rows at least, however wide they are, and convert them from there. */
bool read_stored(Opened &reader, int y0, int y1) {
  const ImageSpec &spec = reader.spec;
  reader.stored.resize(size_t(spec.width) * spec.pixel_bytes(reader.first, reader.last, true) *
                       size_t(y1 - y0));
  return reader.input->read_scanlines(reader.subimage, 0, spec.y + y0, spec.y + y1, spec.z,
                                      reader.first, reader.last, TypeDesc::UNKNOWN,
                                      reader.stored.data());
}

/* Columns of stored rows of bytes as floats: what OpenImageIO makes of them, in a third of the
 * time. */
void convert_bytes(const Opened &reader, int x0, int x1, float *out) {
  size_t channels = size_t(reader.last - reader.first), row = size_t(reader.spec.width) * channels;
  size_t count = size_t(x1 - x0) * channels;
  for (size_t at = size_t(x0) * channels; at < reader.stored.size(); at += row, out += count)
    for (size_t i = 0; i < count; i++)
      out[i] = float(reader.stored[at + i]) * (1.0f / 255);
}

/* Columns of stored rows as floats. Channels may each have a type of their own. */
bool convert_stored(const Opened &reader, int x0, int x1, int rows, float *out) {
  const ImageSpec &spec = reader.spec;
  bool is_mixed = !spec.channelformats.empty(), is_good = true;
  if (spec.format == TypeDesc::UINT8 && !is_mixed) {
    convert_bytes(reader, x0, x1, out);
    return true;
  }
  int channels = reader.last - reader.first, together = is_mixed ? 1 : channels;
  auto pixel = OIIO::stride_t(spec.pixel_bytes(reader.first, reader.last, true));
  const unsigned char *from = reader.stored.data() + x0 * pixel;
  for (int c = 0; c < channels && is_good; c += together) {
    TypeDesc type = spec.channelformat(reader.first + c);
    is_good = OIIO::convert_image(together, x1 - x0, rows, 1, from, type, pixel, pixel * spec.width,
                                  OIIO::AutoStride, out + c, TypeDesc::FLOAT,
                                  OIIO::stride_t(sizeof(float)) * channels, OIIO::AutoStride,
                                  OIIO::AutoStride);
    from += type.size();
  }
  return is_good;
}

/* Rows [y0, y1) and columns [x0, x1) of the data window, the chosen channels, into `out`. */
void read_rows(Opened &reader, int x0, int x1, int y0, int y1, float *out) {
  const ImageSpec &spec = reader.spec;
  bool is_good = spec.tile_width > 0
                     ? reader.input->read_tiles(reader.subimage, 0, spec.x + x0, spec.x + x1,
                                                spec.y + y0, spec.y + y1, spec.z, spec.z + 1,
                                                reader.first, reader.last, TypeDesc::FLOAT, out)
                     : read_stored(reader, y0, y1) && convert_stored(reader, x0, x1, y1 - y0, out);
  if (!is_good)
    fail_input("is corrupt or truncated", reader.input->geterror());
}

/* Extends a range to whole tiles, because the library reads nothing else. */
void align(int size, int tile, int *low, int *high) {
  *low = *low / tile * tile;
  *high = int(std::min<int64_t>(size, (int64_t(*high) + tile - 1) / tile * tile));
}

struct Target {
  float *rgba;
  int64_t at, step_x, step_y; /* pixels: of stored pixel (0, 0), and to its neighbours */
};

/* Where the stored pixel (sx, sy) goes in the rectangle asked for, by the orientation. */
Target make_target(const Opened &reader, int32_t x, int32_t y, int32_t width, float *rgba) {
  int64_t right = reader.stored_width - 1, bottom = reader.stored_height - 1;
  struct {
    int64_t x0, y0, xx, xy, yx, yy; /* display = (x0 + xx sx + xy sy, y0 + yx sx + yy sy) */
  } const maps[8] = {
      {0, 0, 1, 0, 0, 1},
      {right, 0, -1, 0, 0, 1},
      {right, bottom, -1, 0, 0, -1},
      {0, bottom, 1, 0, 0, -1},
      {0, 0, 0, 1, 1, 0},
      {bottom, 0, 0, -1, 1, 0},
      {bottom, right, 0, -1, -1, 0},
      {0, right, 0, 1, -1, 0},
  };
  auto map = maps[reader.orientation - 1];
  return {rgba, (map.y0 - y) * width + (map.x0 - x), map.yx * width + map.xx,
          map.yy * width + map.xy};
}

/* The rectangle of stored pixels, inside the data window, that fills the one asked for. */
struct Rectangle {
  int x0, x1, y0, y1; /* of the data window */
};

Rectangle make_rectangle(const Opened &reader, int32_t x, int32_t y, int32_t width,
                         int32_t height) {
  int64_t w = reader.stored_width, h = reader.stored_height;
  int64_t x0 = x, x1 = int64_t(x) + width, y0 = y, y1 = int64_t(y) + height;
  if (is_transposed(reader)) {
    std::swap(x0, y0);
    std::swap(x1, y1);
  }
  int o = reader.orientation;
  if (o == 2 || o == 3 || o == 7 || o == 8) {
    int64_t low = w - x1;
    x1 = w - x0;
    x0 = low;
  }
  if (o == 3 || o == 4 || o == 6 || o == 7) {
    int64_t low = h - y1;
    y1 = h - y0;
    y0 = low;
  }
  auto clamp = [](int64_t v, int64_t high) { return int(std::max<int64_t>(0, std::min(v, high))); };
  const ImageSpec &spec = reader.spec;
  return {clamp(x0 - reader.data_x, spec.width), clamp(x1 - reader.data_x, spec.width),
          clamp(y0 - reader.data_y, spec.height), clamp(y1 - reader.data_y, spec.height)};
}

void scatter(const Opened &reader, const Rectangle &wanted, const Rectangle &read,
             const Target &target) {
  size_t channels = size_t(reader.last - reader.first);
  int alpha = reader.channel[3] - reader.first;
  int red = reader.channel[0] - reader.first, green = reader.channel[1] - reader.first,
      blue = reader.channel[2] - reader.first;
  for (int y = std::max(wanted.y0, read.y0); y < std::min(wanted.y1, read.y1); y++) {
    const float *from =
        reader.batch.data() +
        (size_t(y - read.y0) * size_t(read.x1 - read.x0) + size_t(wanted.x0 - read.x0)) * channels;
    int64_t at = target.at + (wanted.x0 + reader.data_x) * target.step_x +
                 (y + reader.data_y) * target.step_y;
    for (int x = wanted.x0; x < wanted.x1; x++, from += channels, at += target.step_x) {
      float *to = target.rgba + 4 * at;
      to[0] = from[red];
      to[1] = from[green];
      to[2] = from[blue];
      to[3] = reader.channel[3] >= 0 ? from[alpha] : 1.0f;
    }
  }
}

/* To linear light by OpenColorIO, which needs straight colour; then premultiplied. */
void apply_space(const Opened &reader, float *rgba, int32_t width, int32_t height) {
  bool is_coded = is_multiplied(reader);
  for (int64_t i = 0; i < int64_t(width) * height; i++)
    if (is_coded && rgba[4 * i + 3] > 0)
      for (int c = 0; c < 3; c++)
        rgba[4 * i + c] /= rgba[4 * i + 3];
#ifndef CELSPAN_WITHOUT_SPACES
  apply_conversion(reader.conversion, rgba, size_t(width) * size_t(height));
#endif
  for (int64_t i = 0; i < int64_t(width) * height; i++)
    for (int c = 0; c < 3; c++)
      rgba[4 * i + c] *= rgba[4 * i + 3];
}

} // namespace

void read_rectangle(Opened &reader, int32_t x, int32_t y, int32_t width, int32_t height,
                    float *rgba) {
  if (!reader.source->is_unchanged())
    throw Failure(CELSPAN_INPUT, "changed while it was in use");
  reader.source->forgive();
  Rectangle wanted = make_rectangle(reader, x, y, width, height);
  if (int64_t(wanted.x1 - wanted.x0) * (wanted.y1 - wanted.y0) < int64_t(width) * height)
    memset(rgba, 0, size_t(width) * size_t(height) * 4 * sizeof(float));
  if (wanted.x0 >= wanted.x1 || wanted.y0 >= wanted.y1)
    return;
  Target target = make_target(reader, x, y, width, rgba);
  const ImageSpec &spec = reader.spec;
  Rectangle read = wanted;
  int step_multiple = 1;
  if (spec.tile_width > 0) {
    align(spec.width, spec.tile_width, &read.x0, &read.x1);
    align(spec.height, spec.tile_height, &read.y0, &read.y1);
    step_multiple = spec.tile_height;
  }
  size_t row_values = size_t(read.x1 - read.x0) * size_t(reader.last - reader.first);
  size_t wide =
      spec.tile_width > 0 ? row_values : size_t(spec.width) * size_t(reader.last - reader.first);
  int64_t step =
      std::max<int64_t>(1, int64_t(BATCH / (wide * sizeof(float))) / step_multiple) * step_multiple;
  if (reader.kind.is_sequential && read.y0 < reader.next_row)
    open_input(reader);
  int end = read.y1;
  for (int64_t row = read.y0; row < end; row += step) {
    read.y0 = int(row);
    read.y1 = int(std::min<int64_t>(end, row + step));
    reader.batch.resize(row_values * size_t(read.y1 - read.y0));
    read_rows(reader, read.x0, read.x1, read.y0, read.y1, reader.batch.data());
    reader.next_row = read.y1;
    scatter(reader, wanted, read, target);
  }
  if (reader.has_space)
    apply_space(reader, rgba, width, height);
}

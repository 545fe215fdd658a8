#include "frames/parcels/plot_text.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/open.h"
#include "output/sinks/sink.h"

enum { TEXT = 256, NUMBER = 48, DIGITS_MOST = 9 };

/* ---------------------------------------------------------------- numbers */

static void put_bytes(cs_plot_text *out, const char *bytes, size_t size) {
  if (out->status == CELSPAN_OK)
    out->status = cs_file_write(out->file, out->context, bytes, size);
}

void cs_plot_put(cs_plot_text *out, const char *format, ...) {
  char text[TEXT];
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (length > 0)
    put_bytes(out, text, (size_t)length < sizeof text ? (size_t)length : sizeof text - 1);
}

static int64_t power_of_ten(int digits) {
  int64_t power = 1;
  for (int i = 0; i < digits; i++)
    power *= 10;
  return power;
}

/* Steps of a grid as a number, without a zero before the point. */
static void put_steps(cs_plot_text *out, int64_t steps, int digits) {
  char text[NUMBER];
  const int64_t grid = power_of_ten(digits);
  uint64_t size = steps < 0 ? -(uint64_t)steps : (uint64_t)steps;
  uint64_t whole = size / (uint64_t)grid, part = size % (uint64_t)grid;
  int length = snprintf(text, sizeof text, "%s", steps < 0 ? "-" : "");
  if (whole > 0 || part == 0)
    length += snprintf(text + length, sizeof text - (size_t)length, "%" PRIu64, whole);
  if (part > 0)
    length += snprintf(text + length, sizeof text - (size_t)length, ".%0*" PRIu64, digits, part);
  while (part > 0 && text[length - 1] == '0')
    length--;
  put_bytes(out, text, (size_t)length);
}

static int64_t round_to(double number, double grid) {
  const double most = 9e18;
  double steps = number * grid;
  return llround(steps > most ? most : steps > -most ? steps : -most);
}

void cs_plot_put_number(cs_plot_text *out, double number, int digits) {
  digits = digits < DIGITS_MOST ? digits : DIGITS_MOST;
  put_steps(out, round_to(number, (double)power_of_ten(digits)), digits);
}

int64_t cs_plot_round(const cs_plot_text *out, double coordinate) {
  return round_to(coordinate, out->grid);
}

/* ---------------------------------------------------------------- paths */

void cs_plot_begin_path(cs_plot_text *out) {
  out->grid = (double)power_of_ten(out->precision);
  out->x = out->y = 0;
  out->command = 0;
}

/* A letter, unless it is that of the command before; then numbers. */
static void put_command(cs_plot_text *out, char command, const int64_t *steps, int count) {
  for (int i = 0; i < count; i++) {
    if (i == 0 && command != out->command)
      cs_plot_put(out, "%c", command);
    else if (steps[i] >= 0)
      put_bytes(out, " ", 1);
    put_steps(out, steps[i], out->precision);
  }
  out->command = command;
}

void cs_plot_move(cs_plot_text *out, celspan_point to) {
  const int64_t x = cs_plot_round(out, to.x), y = cs_plot_round(out, to.y);
  out->command = 0;
  put_command(out, 'm', (const int64_t[2]){x - out->x, y - out->y}, 2);
  out->x = x;
  out->y = y;
}

void cs_plot_line(cs_plot_text *out, celspan_point to) {
  const int64_t x = cs_plot_round(out, to.x), y = cs_plot_round(out, to.y);
  const int64_t by[2] = {x - out->x, y - out->y};
  if (by[0] == 0 && by[1] == 0)
    return;
  if (by[1] == 0)
    put_command(out, 'h', by, 1);
  else if (by[0] == 0)
    put_command(out, 'v', by + 1, 1);
  else
    put_command(out, 'l', by, 2);
  out->x = x;
  out->y = y;
}

static void put_curve(cs_plot_text *out, const celspan_point points[4], bool is_up) {
  int64_t by[6];
  for (int i = 1; i < 4; i++) {
    const celspan_point *p = &points[is_up ? 3 - i : i];
    by[2 * i - 2] = cs_plot_round(out, p->x) - out->x;
    by[2 * i - 1] = cs_plot_round(out, p->y) - out->y;
  }
  if (by[4] == 0 && by[5] == 0)
    return;
  put_command(out, 'c', by, 6);
  out->x += by[4];
  out->y += by[5];
}

void cs_plot_arc(cs_plot_text *out, const cs_parcels *parcels, cs_parcel_walk walk) {
  const cs_parcel_arc *arc = &parcels->arcs[walk.arc];
  for (size_t i = 0; i < arc->curve_count; i++) {
    size_t at = walk.is_up ? arc->curve_count - 1 - i : i;
    const cs_parcel_curve *curve = &parcels->curves[arc->curve + at];
    if (curve->is_line)
      cs_plot_line(out, curve->points[walk.is_up ? 0 : 3]);
    else
      put_curve(out, curve->points, walk.is_up);
  }
}

void cs_plot_loops(cs_plot_text *out, const cs_parcels *parcels, size_t first, size_t count) {
  for (size_t i = first; i < first + count; i++) {
    const cs_parcel_loop *loop = &parcels->loops[i];
    const cs_parcel_walk *walks = &parcels->walks[loop->walk];
    celspan_point begin = cs_parcel_begin(parcels, walks[0]);
    cs_plot_move(out, begin);
    for (size_t k = 0; k < loop->walk_count; k++) {
      cs_plot_line(out, cs_parcel_begin(parcels, walks[k]));
      cs_plot_arc(out, parcels, walks[k]);
    }
    put_bytes(out, "z", 1);
    out->x = cs_plot_round(out, begin.x);
    out->y = cs_plot_round(out, begin.y);
    out->command = 0;
  }
}

/* ---------------------------------------------------------------- pictures */

static celspan_status draw_png(const cs_plot_text *out, const cs_plot_picture *picture,
                               cs_file *into) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coding = CELSPAN_CODING;
  celspan_sink sink;
  coding.depth = CELSPAN_DEPTH_8;
  file.format = "png";
  file.coding = &coding;
  file.is_opaque = picture->is_opaque;
  CS_TRY(cs_sink_png_part(out->context, out->path, into, &file, &sink));
  return picture->draw(picture, out->context, &sink);
}

static void put_base64(cs_plot_text *out, const unsigned char *bytes, size_t size) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < size; i += 3) {
    uint32_t group = 0;
    char text[4];
    for (size_t k = 0; k < 3; k++)
      group = group << 8 | (i + k < size ? bytes[i + k] : 0);
    for (size_t k = 0; k < 4; k++)
      text[k] = i + k <= size ? digits[group >> (18 - 6 * k) & 63] : '=';
    put_bytes(out, text, 4);
  }
}

/* The bytes of a file that is being written. */
static celspan_status put_file(cs_plot_text *out, cs_file *from) {
  unsigned char bytes[3 * 1024];
  const char *name;
  CS_TRY(cs_file_temporary(from, out->context, &name));
  int descriptor = cs_open_to_read(name);
  ssize_t got = descriptor < 0 ? -1 : 0;
  for (off_t at = 0; descriptor >= 0 && out->status == CELSPAN_OK; at += got) {
    got = cs_open_read_at(descriptor, bytes, sizeof bytes, at);
    if (got <= 0)
      break;
    put_base64(out, bytes, (size_t)got);
  }
  int error = errno;
  if (descriptor >= 0)
    close(descriptor);
  return got < 0 ? cs_fail(out->context, CELSPAN_OUTPUT, "%s: %s", out->path, strerror(error))
                 : out->status;
}

static celspan_status put_png(cs_plot_text *out, const cs_plot_picture *picture) {
  cs_file *png;
  CS_TRY(cs_file_create(out->context, NULL, out->path, &png));
  celspan_status status = draw_png(out, picture, png);
  if (status == CELSPAN_OK)
    status = put_file(out, png);
  cs_file_discard(png, out->context);
  return status;
}

static void put_attribute(cs_plot_text *out, const char *name, double number) {
  cs_plot_put(out, " %s=\"", name);
  cs_plot_put_number(out, number, out->precision + 3);
  cs_plot_put(out, "\"");
}

void cs_plot_put_picture(cs_plot_text *out, const cs_plot_picture *picture, double film_width,
                         double film_height) {
  double x = film_width / picture->width, y = film_height / picture->height;
  cs_plot_put(out, "<image");
  put_attribute(out, "x", picture->x * x);
  put_attribute(out, "y", picture->y * y);
  put_attribute(out, "width", picture->columns * x);
  put_attribute(out, "height", picture->rows * y);
  cs_plot_put(out, " preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,");
  if (out->status == CELSPAN_OK)
    out->status = put_png(out, picture);
  cs_plot_put(out, "\"/>\n");
}

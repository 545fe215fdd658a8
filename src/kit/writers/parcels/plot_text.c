#include "writers/parcels/plot_text.h"

#include <math.h>
#include <stdarg.h>

#include "common/address.h"
#include "common/steps.h"

enum { TEXT = 256, DIGITS_MOST = 9 };

/* ---------------------------------------------------------------- numbers */

void cs_plot_put_bytes(cs_plot_text *out, const void *bytes, size_t size) {
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
    cs_plot_put_bytes(out, text, (size_t)length < sizeof text ? (size_t)length : sizeof text - 1);
}

static double power_of_ten(int digits) {
  double power = 1;
  for (int i = 0; i < digits; i++)
    power *= 10;
  return power;
}

static void put_steps(cs_plot_text *out, int64_t steps, int digits) {
  char text[CS_STEPS_SIZE];
  cs_plot_put_bytes(out, text, cs_steps_put(text, steps, digits, false));
}

static int64_t round_to(double number, double grid) {
  const double most = 9e18;
  double steps = number * grid;
  return llround(steps > most ? most : steps > -most ? steps : -most);
}

void cs_plot_put_number(cs_plot_text *out, double number, int digits) {
  digits = digits < DIGITS_MOST ? digits : DIGITS_MOST;
  put_steps(out, round_to(number, power_of_ten(digits)), digits);
}

int64_t cs_plot_round(const cs_plot_text *out, double coordinate) {
  return round_to(coordinate, out->grid);
}

/* ---------------------------------------------------------------- paths */

void cs_plot_begin_path(cs_plot_text *out) {
  out->grid = power_of_ten(out->precision);
  out->x = out->y = 0;
  out->command = 0;
}

/* A letter, unless it is that of the command before; then numbers. */
static void put_command(cs_plot_text *out, char command, const int64_t *steps, int count) {
  for (int i = 0; i < count; i++) {
    if (i == 0 && command != out->command)
      cs_plot_put(out, "%c", command);
    else if (steps[i] >= 0)
      cs_plot_put_bytes(out, " ", 1);
    put_steps(out, steps[i], out->precision);
  }
  out->command = command;
}

void cs_plot_move(cs_plot_text *out, celspan_point to) {
  const int64_t x = cs_plot_round(out, to.x), y = cs_plot_round(out, to.y);
  out->command = 0;
  put_command(out, 'm', (const int64_t[2]){x - out->x, y - out->y}, 2);
  out->x = out->begin_x = x;
  out->y = out->begin_y = y;
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

void cs_plot_curve(cs_plot_text *out, const celspan_point points[3]) {
  int64_t by[6];
  for (int i = 0; i < 3; i++) {
    by[2 * i] = cs_plot_round(out, points[i].x) - out->x;
    by[2 * i + 1] = cs_plot_round(out, points[i].y) - out->y;
  }
  if (by[4] == 0 && by[5] == 0)
    return;
  put_command(out, 'c', by, 6);
  out->x += by[4];
  out->y += by[5];
}

void cs_plot_close(cs_plot_text *out) {
  cs_plot_put_bytes(out, "z", 1);
  out->x = out->begin_x;
  out->y = out->begin_y;
  out->command = 0;
}

/* ---------------------------------------------------------------- bytes */

void cs_plot_put_base64(cs_plot_text *out, const unsigned char *bytes, size_t size) {
  enum { PART = 192 };
  char text[PART / 3 * 4];
  for (size_t i = 0; i < size; i += PART) {
    size_t part = size - i < PART ? size - i : PART;
    cs_address_digits(bytes + i, part, text);
    cs_plot_put_bytes(out, text, (part + 2) / 3 * 4);
  }
}

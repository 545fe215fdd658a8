/* Writes transfer_tables.h at build time; power.h says what the tables of powers mean. It runs on
 * the machine that builds, and its bits are those of base/elementary.c, the same on every machine.
 */
#include <math.h>
#include <stdio.h>

#include "base/elementary.h"
#include "model/colour/power.h"

static void print_numbers(const char *name, const double *numbers, int count) {
  printf("  .%s = {", name);
  for (int i = 0; i < count; i++)
    printf("%a,%s", numbers[i], i % 4 == 3 ? "\n    " : " ");
  printf("},\n");
}

/* x^exponent = octave[e] * point[i] * (1 + r)^exponent where x = 2^e c (1 + r), c the middle of the
 * i-th of 64 equal intervals of 1..2. */
static void print_power(const char *storage, const char *name, double exponent) {
  double point[CS_POWER_POINTS], series[CS_POWER_SERIES], octave[2 * CS_POWER_OCTAVES + 1];
  for (int i = 0; i < CS_POWER_POINTS; i++)
    point[i] = cs_elementary_pow(1 + (i + 0.5) / CS_POWER_POINTS, exponent);
  series[0] = 1;
  for (int i = 1; i < CS_POWER_SERIES; i++)
    series[i] = series[i - 1] * (exponent - (i - 1)) / i;
  for (int e = -CS_POWER_OCTAVES; e <= CS_POWER_OCTAVES; e++)
    octave[e + CS_POWER_OCTAVES] = cs_elementary_pow(2, e * exponent);
  printf("%sconst cs_power %s = {\n  .exponent = %a,\n", storage, name, exponent);
  print_numbers("point", point, CS_POWER_POINTS);
  print_numbers("series", series, CS_POWER_SERIES);
  print_numbers("octave", octave, 2 * CS_POWER_OCTAVES + 1);
  printf("};\n");
}

static double srgb_to_linear(double coded) {
  return cs_power_srgb_decoded(coded, cs_elementary_pow(cs_power_srgb_base(coded), 2.4));
}

/* srgb8_step[k]: the least float whose code is at least k; [256] is greater than every float in
 * 0..1. */
static void print_steps(void) {
  printf("static const float srgb8_step[257] = {0,");
  for (int code = 1; code <= 255; code++) {
    double exact = srgb_to_linear((code - 0.5) / 255);
    float step = (float)exact;
    if (step < exact)
      step = nextafterf(step, 2);
    printf(" %af,%s", (double)step, code % 4 == 3 ? "\n  " : "");
  }
  printf(" 2};\n");
}

/* srgb8_first[i]: the code at the low end of interval i; every octave from 2^-13 on has 128
 * intervals. */
static void print_first_codes(void) {
  printf("static const unsigned char srgb8_first[13 * 128] = {");
  for (int i = 0; i < 13 * 128; i++) {
    double low = ldexp(1 + i % 128 / 128.0, i / 128 - 13);
    int code = 0;
    while (code < 255 && srgb_to_linear((code + 0.5) / 255) <= low)
      code++;
    printf("%d,%s", code, i % 16 == 15 ? "\n  " : " ");
  }
  printf("};\n");
}

int main(void) {
  printf("/* Made by make_transfer_tables.c. */\n");
  print_power("", "cs_power_srgb_encoding", 1 / 2.4);
  print_power("", "cs_power_srgb_decoding", 2.4);
  print_power("static ", "rec709_encoding", 0.45);
  print_power("static ", "rec709_decoding", 1 / 0.45);
  print_steps();
  print_first_codes();
  return ferror(stdout) || fflush(stdout) != 0;
}

#include "svg/stops.h"

#include <math.h>

#include "base/number.h"
#include "colour/transfer.h"

/* Stops in place of one stretch between two, at most; 64 are enough from black to white. */
#define PIECES 64
/* How far what is shown may be from what a browser shows, in coded values. */
#define TOLERANCE (0.5 / 255)

static cs_svg_colour mixed(const cs_svg_colour *a, const cs_svg_colour *b, double u) {
  cs_svg_colour mix = {.alpha = a->alpha + u * (b->alpha - a->alpha)};
  for (int c = 0; c < 3; c++)
    mix.rgb[c] = a->rgb[c] + u * (b->rgb[c] - a->rgb[c]);
  return mix;
}

static double decode(const cs_svg_reading *reading, double coded) {
  return reading->is_coded ? coded
                           : (double)cs_transfer_decode(CELSPAN_TRANSFER_SRGB, (float)coded);
}

static double encode(const cs_svg_reading *reading, double light) {
  return reading->is_coded ? light
                           : (double)cs_transfer_encode(CELSPAN_TRANSFER_SRGB, (float)light);
}

/* Whether the linear mix of two stops, premultiplied light, is near enough to their coded mix at
 * the share u of the way. */
static bool is_near(const cs_svg_reading *reading, const cs_svg_colour *a, const cs_svg_colour *b,
                    double u) {
  const cs_svg_colour exact = mixed(a, b, u);
  if (!(exact.alpha > 0))
    return true;
  for (int c = 0; c < 3; c++) {
    double light =
        (1 - u) * a->alpha * decode(reading, a->rgb[c]) + u * b->alpha * decode(reading, b->rgb[c]);
    double shown = encode(reading, light / exact.alpha);
    if (fabs(shown - exact.rgb[c]) * exact.alpha > TOLERANCE)
      return false;
  }
  return true;
}

/* Into how many equal pieces a stretch is cut so that each is near enough. */
static int count_pieces(const cs_svg_reading *reading, const cs_svg_colour *a,
                        const cs_svg_colour *b) {
  int count = 1;
  for (bool is_enough = false; !is_enough && count < PIECES; count += !is_enough ? count : 0) {
    is_enough = true;
    for (int i = 0; i < count && is_enough; i++) {
      const cs_svg_colour from = mixed(a, b, (double)i / count);
      const cs_svg_colour to = mixed(a, b, (double)(i + 1) / count);
      is_enough = is_near(reading, &from, &to, 0.25) && is_near(reading, &from, &to, 0.5) &&
                  is_near(reading, &from, &to, 0.75);
    }
  }
  return count;
}

static celspan_status append(cs_svg_reading *reading, double at, const cs_svg_colour *colour,
                             double opacity, cs_svg_stops *out) {
  CS_TRY(cs_mem_reserve(reading->context, (void **)&out->items, &out->capacity, out->count + 1,
                        sizeof *out->items));
  out->items[out->count++] = (celspan_stop){at, cs_svg_paint_of(reading, colour, opacity)};
  return CELSPAN_OK;
}

/* The stops after `last` up to and with `next`. */
static celspan_status append_stretch(cs_svg_reading *reading, const cs_svg_stop *last,
                                     const cs_svg_stop *next, double opacity, cs_svg_stops *out) {
  int pieces = next->at > last->at ? count_pieces(reading, &last->colour, &next->colour) : 1;
  for (int i = 1; i < pieces; i++) {
    double u = (double)i / pieces;
    const cs_svg_colour colour = mixed(&last->colour, &next->colour, u);
    CS_TRY(append(reading, last->at + u * (next->at - last->at), &colour, opacity, out));
  }
  return append(reading, next->at, &next->colour, opacity, out);
}

/* A number or a percentage, held to 0..1. */
static double offset_of(const cs_svg_node *stop) {
  const char *value = cs_svg_node_value(stop, CS_SVG_OFFSET);
  double offset;
  value = cs_svg_skip_space(value ? value : "");
  if (!cs_svg_take_number(&value, &offset))
    return 0;
  if (*value == '%') {
    offset /= 100;
    value++;
  }
  return *cs_svg_skip_space(value) ? 0 : cs_number_clamp(offset, 0, 1);
}

celspan_status cs_svg_stops_read(cs_svg_reading *reading, const cs_svg_node *owner, double opacity,
                                 cs_svg_stops *out) {
  cs_svg_style above, style;
  cs_svg_stop last = {0};
  CS_TRY(cs_svg_style_in_file(reading, owner, &above));
  for (const cs_svg_node *node = owner->first; node; node = node->next) {
    if (node->element != CS_SVG_ELEMENT_STOP)
      continue;
    CS_TRY(cs_svg_style_resolve(reading->context, reading->document, node, &above, &reading->tests,
                                &style));
    const cs_svg_stop next = {fmax(last.at, offset_of(node)), style.stop_colour};
    CS_TRY(out->count > 0 ? append_stretch(reading, &last, &next, opacity, out)
                          : append(reading, next.at, &next.colour, opacity, out));
    last = next;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- spreading */

celspan_status cs_svg_stops_spread(cs_svg_reading *reading, cs_svg_spread spread, int first,
                                   int last, cs_svg_stops *stops) {
  cs_svg_stops whole = {0};
  whole.capacity = stops->count * (size_t)(last - first);
  whole.items = cs_mem_array(reading->context->memory, whole.capacity, sizeof *whole.items);
  if (!whole.items)
    return cs_fail_memory(reading->context);
  for (int period = first; period < last; period++) {
    bool is_turned = spread == CS_SVG_SPREAD_REFLECT && (period & 1) != 0;
    for (size_t i = 0; i < stops->count; i++) {
      const celspan_stop *stop = &stops->items[is_turned ? stops->count - 1 - i : i];
      double at = is_turned ? 1 - stop->at : stop->at;
      whole.items[whole.count++] = (celspan_stop){
          cs_number_clamp((period - first + at) / (last - first), 0, 1), stop->paint};
    }
  }
  cs_svg_stops_finish(stops, reading->context->memory);
  *stops = whole;
  return CELSPAN_OK;
}

void cs_svg_stops_finish(cs_svg_stops *stops, cs_memory *memory) {
  cs_mem_free(memory, stops->items, stops->capacity * sizeof *stops->items);
  *stops = (cs_svg_stops){0};
}

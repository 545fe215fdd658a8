/* Drawings as the text of SVG. */
#include "common/markup.h"
#include "writers/parcels/plot_text.h"

enum { CODE_DIGITS = 4, STOP_DIGITS = 6, SPARE_DIGITS = 3, MATRIX_DIGITS = 9 };

/* ---------------------------------------------------------------- attributes */

static void put_digits(cs_plot_text *to, const char *name, double number, int digits) {
  cs_plot_put(to, " %s=\"", name);
  cs_plot_put_number(to, number, digits);
  cs_plot_put(to, "\"");
}

static void put_attribute(cs_plot_text *to, const char *name, double number) {
  put_digits(to, name, number, to->precision + SPARE_DIGITS);
}

static void put_code(cs_plot_text *to, const char *name, const unsigned char code[4]) {
  cs_plot_put(to, " %s=\"#%02x%02x%02x\"", name, code[0], code[1], code[2]);
}

static void put_alpha(cs_plot_text *to, const char *name, const unsigned char code[4]) {
  if (code[3] < 255)
    put_digits(to, name, code[3] / 255.0, CODE_DIGITS);
}

/* ---------------------------------------------------------------- gradients */

static void put_stops(cs_plot_text *to, const cs_fill_stop *stops, size_t count) {
  for (size_t i = 0; i < count; i++) {
    cs_plot_put(to, "<stop");
    put_digits(to, "offset", stops[i].at, STOP_DIGITS);
    put_code(to, "stop-color", stops[i].code);
    put_alpha(to, "stop-opacity", stops[i].code);
    cs_plot_put(to, "/>");
  }
}

static void put_linear(cs_plot_text *to, const cs_fill *fill) {
  put_attribute(to, "x1", fill->from.x);
  put_attribute(to, "y1", fill->from.y);
  put_attribute(to, "x2", fill->to.x);
  put_attribute(to, "y2", fill->to.y);
}

static void put_radial(cs_plot_text *to, const cs_fill *fill) {
  static const int columns[6] = {0, 3, 1, 4, 2, 5};
  put_digits(to, "cx", fill->centre, MATRIX_DIGITS);
  cs_plot_put(to, " cy=\"0\"");
  put_digits(to, "r", fill->radius, MATRIX_DIGITS);
  cs_plot_put(to, " fx=\"0\" fy=\"0\" gradientTransform=\"matrix(");
  for (int i = 0; i < 6; i++) {
    cs_plot_put(to, i > 0 ? " " : "");
    cs_plot_put_number(to, fill->matrix[columns[i]], MATRIX_DIGITS);
  }
  cs_plot_put(to, ")\"");
}

static void put_gradient(cs_plot_text *to, const cs_parcels *parcels, size_t number) {
  const cs_fill *fill = &parcels->fills[number];
  const char *name = fill->kind == CS_FILL_LINEAR ? "linearGradient" : "radialGradient";
  cs_plot_put(to, "<%s id=\"g%zu\" gradientUnits=\"userSpaceOnUse\"", name, number);
  if (fill->kind == CS_FILL_LINEAR)
    put_linear(to, fill);
  else
    put_radial(to, fill);
  cs_plot_put(to, ">");
  put_stops(to, &parcels->stops[fill->stop], fill->stop_count);
  cs_plot_put(to, "</%s>\n", name);
}

static void gradients(void *user, const cs_parcels *parcels) {
  bool has_one = false;
  for (size_t i = 0; i < parcels->fill_count; i++) {
    cs_fill_kind kind = parcels->fills[i].kind;
    if (kind != CS_FILL_LINEAR && kind != CS_FILL_RADIAL)
      continue;
    cs_plot_put(user, has_one ? "" : "<defs>\n");
    has_one = true;
    put_gradient(user, parcels, i);
  }
  cs_plot_put(user, has_one ? "</defs>\n" : "");
}

/* ---------------------------------------------------------------- groups and paths */

static void begin_group(void *user, const cs_plotter_group *group) {
  cs_plot_text *to = user;
  const bool has_areas = group->stroke == 0 && !group->clip;
  cs_plot_put(to, "<g%s", has_areas ? " fill-rule=\"evenodd\"" : "");
  if (group->stroke > 0)
    cs_plot_put(to, " fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
  if (group->clip)
    cs_plot_put(to, " clip-path=\"url(#%s)\"", group->clip);
  if (group->stroke > 0)
    put_attribute(to, "stroke-width", group->stroke);
  cs_plot_put(to, ">\n");
}

static void end_group(void *user, const cs_plotter_group *group) {
  (void)group;
  cs_plot_put(user, "</g>\n");
}

/* name: fill or stroke. */
static void put_paint(cs_plot_text *to, const char *name, const cs_plotter_path *path) {
  if (path->fill->kind == CS_FILL_FLAT)
    put_code(to, name, path->fill->code);
  else
    cs_plot_put(to, " %s=\"url(#g%u)\"", name, (unsigned)path->number);
}

static void begin_path(void *user, const cs_plotter_path *path) {
  cs_plot_text *to = user;
  const bool is_area = path->kind == CS_PLOTTER_AREA;
  if (path->kind == CS_PLOTTER_CLIP) {
    cs_plot_put(to, "<clipPath id=\"%s\"><path clip-rule=\"evenodd\"", path->name);
  } else {
    cs_plot_put(to, "<path");
    put_paint(to, is_area ? "fill" : "stroke", path);
    if (is_area && path->fill->kind == CS_FILL_FLAT)
      put_alpha(to, "fill-opacity", path->fill->code);
  }
  cs_plot_put(to, " d=\"");
  cs_plot_begin_path(to);
}

static void move(void *user, celspan_point to) { cs_plot_move(user, to); }

static void line(void *user, celspan_point to) { cs_plot_line(user, to); }

static void curve(void *user, const celspan_point points[3]) { cs_plot_curve(user, points); }

static void close_path(void *user) { cs_plot_close(user); }

static void end_path(void *user, const cs_plotter_path *path) {
  cs_plot_put(user, "\"/>%s\n", path->kind == CS_PLOTTER_CLIP ? "</clipPath>" : "");
}

/* ---------------------------------------------------------------- pictures */

static void begin_picture(void *user, const cs_plotter_picture *picture) {
  cs_plot_put(user, "<image");
  put_attribute(user, "x", picture->x);
  put_attribute(user, "y", picture->y);
  put_attribute(user, "width", picture->width);
  put_attribute(user, "height", picture->height);
  cs_plot_put(user, " preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,");
}

static void bytes(void *user, const unsigned char *bytes, size_t size) {
  cs_plot_put_base64(user, bytes, size);
}

static void end_picture(void *user) { cs_plot_put(user, "\"/>\n"); }

/* ---------------------------------------------------------------- the page */

static void put_title(cs_plot_text *to) {
  if (!to->title)
    return;
  char room[2];
  cs_plot_put(to, "<title>");
  for (const char *at = to->title; *at; at++)
    cs_plot_put(to, "%s", cs_markup_of(*at, room));
  cs_plot_put(to, "</title>\n");
}

static void begin_page(void *user, const cs_plotter_page *page) {
  cs_plot_put(user, "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                    "xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 ");
  cs_plot_put_number(user, page->width, MATRIX_DIGITS);
  cs_plot_put(user, " ");
  cs_plot_put_number(user, page->height, MATRIX_DIGITS);
  cs_plot_put(user, "\"");
  put_digits(user, "width", page->across, MATRIX_DIGITS);
  put_digits(user, "height", page->down, MATRIX_DIGITS);
  cs_plot_put(user, " preserveAspectRatio=\"none\">\n");
  put_title(user);
}

/* The text keeps the failure itself. */
static celspan_status end_page(void *user, const char **reason) {
  (void)reason;
  cs_plot_put(user, "</svg>\n");
  return CELSPAN_OK;
}

static celspan_status close_file(void *user, const char **reason) {
  (void)user, (void)reason;
  return CELSPAN_OK;
}

void cs_plot_svg_open(cs_plot_text *text, cs_plotter *out) { *out = CS_PLOTTER(text); }

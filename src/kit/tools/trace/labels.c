#include "tools/trace/labels.h"

#include <string.h>

enum { ASKED_BITS = 16, MIXED = 254, UNKNOWN = 253 };
#define ASKED_SIZE (sizeof(uint32_t) << ASKED_BITS)
/* The distance of a plain pixel from its colour is less than this share of the distance to the next
 * colour. */
#define PLAIN 0.2f
/* The distance of a mixture of two colours from the line between them is this much smaller than
 * that to any third colour. */
#define NEARER 0.5f
/* How much better two colours that are not near a pixel must explain it than others. */
#define STRANGE 4.0f

typedef struct work {
  const cs_scan *scan;
  const cs_colours *colours;
  cs_labels *labels;
  float plain[CS_COLOURS_MOST + 1]; /* by label: the greatest distance of plain pixels, squared */
  /* codes that have been looked up, at places given by a hash, with their labels in the lowest
   * bits */
  uint32_t *asked;
} work;

static float apart(const cs_light4 *a, const cs_light4 *b) {
  float sum = 0;
  for (int c = 0; c < 4; c++)
    sum += (a->c[c] - b->c[c]) * (a->c[c] - b->c[c]);
  return sum;
}

/* The colours, and the label for nothing if the picture has clear parts. */
static size_t label_count(const work *w) { return w->colours->count + w->scan->has_clear; }

static void measure_plain(work *w) {
  for (size_t i = 0; i < label_count(w); i++) {
    float least = 1e30f;
    for (size_t k = 0; k < label_count(w); k++) {
      float way = apart(&w->colours->list[i].light, &w->colours->list[k].light);
      least = k != i && way < least ? way : least;
    }
    w->plain[i] = PLAIN * PLAIN * least;
  }
}

/* ---------------------------------------------------------------- plain pixels */

static unsigned char nearest(const cs_colours *colours, const cs_light4 *light) {
  cs_oklab lab = cs_oklab_of(light->c);
  size_t best = 0;
  for (size_t i = 1; i < colours->count; i++)
    if (cs_oklab_apart(lab, colours->list[i].lab) < cs_oklab_apart(lab, colours->list[best].lab))
      best = i;
  return (unsigned char)best;
}

static unsigned char plain_label(const work *w, const cs_light4 *light) {
  unsigned char label = nearest(w->colours, light);
  return apart(light, &w->colours->list[label].light) <= w->plain[label] ? label : MIXED;
}

static unsigned char label_of(const work *w, int32_t x, int32_t y) {
  const unsigned char *code = cs_scan_at(w->scan, x, y);
  if (code[3] == 0)
    return (unsigned char)w->colours->count;
  if (code[3] < 255)
    return MIXED;
  uint32_t own = (uint32_t)code[0] << 24 | (uint32_t)code[1] << 16 | (uint32_t)code[2] << 8;
  uint32_t *asked = &w->asked[own * 2654435769u >> (32 - ASKED_BITS)];
  if ((*asked & 255) == UNKNOWN || (*asked & ~255u) != own) {
    cs_light4 light = cs_scan_light(w->scan, x, y);
    *asked = own | plain_label(w, &light);
  }
  return (unsigned char)*asked;
}

/* Most pixels equal the pixel before them. */
static void label_plain(const work *w) {
  for (int32_t y = 0; y < w->scan->height; y++) {
    unsigned char *row = cs_labels_at(w->labels, 0, y);
    const unsigned char *codes = cs_scan_at(w->scan, 0, y);
    for (int32_t x = 0; x < w->scan->width; x++, codes += 4)
      row[x] = x > 0 && memcmp(codes, codes - 4, 4) == 0 ? row[x - 1] : label_of(w, x, y);
  }
}

/* ---------------------------------------------------------------- mixtures */

typedef struct mixture {
  cs_light4 light;
  bool is_about[256]; /* the labels of plain pixels around it */
  float error;        /* the error of the best explanation so far, squared */
  unsigned char label;
} mixture;

/* Explains the pixel as a mixture of two colours. */
static void explain(const work *w, mixture *m, size_t a, size_t b) {
  const cs_light4 *from = &w->colours->list[a].light, *to = &w->colours->list[b].light;
  cs_light4 line;
  float share = cs_labels_share(&m->light, from, to);
  for (int c = 0; c < 4; c++)
    line.c[c] = from->c[c] + share * (to->c[c] - from->c[c]);
  float error = apart(&m->light, &line) + 1e-6f;
  error *= m->is_about[a] && m->is_about[b] ? 1 : STRANGE;
  if (error >= m->error)
    return;
  m->error = error;
  m->label = (unsigned char)(share > 0.5f ? b : a);
}

static void note_about(const cs_labels *labels, int32_t x, int32_t y, bool is_about[256]) {
  for (int32_t row = y - 2; row <= y + 2; row++)
    for (int32_t column = x - 2; column <= x + 2; column++)
      if (row >= 0 && row < labels->height && column >= 0 && column < labels->width)
        is_about[*cs_labels_at(labels, column, row)] = true;
}

static unsigned char resolve(const work *w, int32_t x, int32_t y) {
  mixture m = {.light = cs_scan_light(w->scan, x, y), .error = 1e30f};
  size_t count = label_count(w);
  note_about(w->labels, x, y, m.is_about);
  if (count < 2)
    return nearest(w->colours, &m.light);
  bool knows_one = false;
  for (size_t a = 0; a < count; a++)
    knows_one = knows_one || m.is_about[a];
  /* If a colour around the pixel can be used, mixtures of two colours that are not around it are
   * not tried. */
  for (size_t a = 0; a < count; a++)
    for (size_t b = a + 1; b < count; b++)
      if (!knows_one || m.is_about[a] || m.is_about[b])
        explain(w, &m, a, b);
  return m.label;
}

/* Whether a plain pixel belongs to a thin line, which is no wider than edges are. */
static bool is_thin(const cs_labels *labels, int32_t x, int32_t y) {
  const unsigned char *at = cs_labels_at(labels, x, y);
  size_t s = labels->stride;
  unsigned char label = *at;
  if (at[-1] == label && at[1] == label)
    return at[-(ptrdiff_t)s] != label && at[s] != label;
  return at[-1] != label && at[1] != label;
}

/* The label of a plain pixel of a thin line: the label that it would have as a mixture of two other
 * colours around it, if these explain it. */
static unsigned char resolve_thin(const work *w, int32_t x, int32_t y) {
  unsigned char own = *cs_labels_at(w->labels, x, y);
  mixture m = {.light = cs_scan_light(w->scan, x, y)};
  m.error = NEARER * NEARER * w->plain[own] + 1e-5f;
  m.label = own;
  note_about(w->labels, x, y, m.is_about);
  for (size_t a = 0; a < label_count(w); a++)
    for (size_t b = a + 1; b < label_count(w); b++)
      if (a != own && b != own && m.is_about[a] && m.is_about[b])
        explain(w, &m, a, b);
  return m.label;
}

/* New labels are written into a separate plane, so that they depend only on plain pixels. */
static void label_mixed(const work *w, unsigned char *into) {
  const cs_labels *labels = w->labels;
  bool asks_thin = label_count(w) > 2;
  for (int32_t y = 0; y < labels->height; y++) {
    const unsigned char *row = cs_labels_at(labels, 0, y);
    unsigned char *out = into + (size_t)y * (size_t)labels->width;
    for (int32_t x = 0; x < labels->width; x++)
      out[x] = row[x] == MIXED                      ? resolve(w, x, y)
               : asks_thin && is_thin(labels, x, y) ? resolve_thin(w, x, y)
                                                    : row[x];
  }
}

/* ---------------------------------------------------------------- the plane */

static size_t plane_size(const cs_labels *labels) {
  return labels->stride * ((size_t)labels->height + 2);
}

static void label_all(const work *w, unsigned char *resolved) {
  cs_labels *labels = w->labels;
  memset(w->asked, UNKNOWN, ASKED_SIZE);
  label_plain(w);
  label_mixed(w, resolved);
  for (int32_t y = 0; y < labels->height; y++)
    memcpy(cs_labels_at(labels, 0, y), resolved + (size_t)y * (size_t)labels->width,
           (size_t)labels->width);
}

celspan_status cs_labels_make(celspan_context *context, const cs_scan *scan,
                              const cs_colours *colours, cs_labels *out) {
  cs_memory *memory = context->memory;
  size_t pixels = (size_t)scan->width * (size_t)scan->height;
  *out = (cs_labels){scan->width, scan->height, (size_t)scan->width + 2, NULL};
  out->plane = cs_mem_resize(memory, NULL, 0, plane_size(out));
  unsigned char *resolved = cs_mem_resize(memory, NULL, 0, pixels);
  work w = {scan, colours, out, {0}, cs_mem_resize(memory, NULL, 0, ASKED_SIZE)};
  bool is_made = out->plane && resolved && w.asked;
  if (is_made) {
    memset(out->plane, CS_LABEL_OUTSIDE, plane_size(out));
    measure_plain(&w);
    label_all(&w, resolved);
  }
  cs_mem_free(memory, resolved, pixels);
  cs_mem_free(memory, w.asked, ASKED_SIZE);
  if (!is_made)
    cs_labels_finish(out, context);
  return is_made ? CELSPAN_OK : cs_fail_memory(context);
}

void cs_labels_finish(cs_labels *labels, celspan_context *context) {
  cs_mem_free(context->memory, labels->plane, plane_size(labels));
  labels->plane = NULL;
}

/* ---------------------------------------------------------------- material */

/* The share of b in the four pixels. */
static float share_about(const cs_material *material, int32_t x, int32_t y, size_t a, size_t b) {
  float sum = 0;
  for (int i = 0; i < 4; i++) {
    cs_light4 light = cs_scan_light(material->scan, x - 1 + i % 2, y - 1 + i / 2);
    sum += cs_labels_share(&light, &material->colours->list[a].light,
                           &material->colours->list[b].light);
  }
  return sum;
}

/* Whether b is in the minority among the 4 x 4 pixels around the corner; a line more often is than
 * the ground. If both have the same number, the later colour. */
static bool is_minority(const cs_labels *labels, int32_t x, int32_t y, unsigned char a,
                        unsigned char b) {
  int excess = 0;
  for (int32_t row = y - 2; row < y + 2; row++)
    for (int32_t column = x - 2; column < x + 2; column++) {
      if (row < 0 || row >= labels->height || column < 0 || column >= labels->width)
        continue;
      unsigned char label = *cs_labels_at(labels, column, row);
      excess += (label == b) - (label == a);
    }
  return excess != 0 ? excess < 0 : b > a;
}

cs_join cs_material_join(const cs_material *material, int32_t x, int32_t y) {
  const cs_labels *labels = material->labels;
  unsigned char a = *cs_labels_at(labels, x - 1, y - 1), b = *cs_labels_at(labels, x, y - 1);
  unsigned char c = *cs_labels_at(labels, x - 1, y), d = *cs_labels_at(labels, x, y);
  if (a != d || b != c)
    return a == d ? CS_JOIN_NW_SE : b == c ? CS_JOIN_NE_SW : CS_JOIN_NONE;
  float share = share_about(material, x, y, a, b);
  if (share > 2.05f || share < 1.95f)
    return share > 2 ? CS_JOIN_NE_SW : CS_JOIN_NW_SE;
  return is_minority(labels, x, y, a, b) ? CS_JOIN_NE_SW : CS_JOIN_NW_SE;
}

/* Style sheets: as much of CSS as drawings use.
 *
 *   g.sleeve > path#cuff, .red { fill: #a00; stroke: none !important }
 *   '---------selector--------'  '------------declarations-----------'
 *
 * A selector is a chain of compounds. The last compound is the element itself: element, classes and
 * id and attributes, joined by descent or by being a child. Selectors with other parts
 * (pseudo-classes except :root, siblings, attributes without a meaning here), rules inside of rules
 * and at-rules are left out, and set `omitted`.
 */
#pragma once

#include "inside/context.h"
#include "readers/svg/words/names.h"

#define CS_CSS_RULES 65536

/* The destination for the texts of style sheets. */
typedef struct cs_css_place {
  celspan_context *context;
  cs_arena *arena;
  /* properties that are not read, and values that are ignored because of this */
  cs_svg_unread *unread;
  uint32_t line; /* the line of the text */
} cs_css_place;

/* A copy of [begin, end) without space at its ends. NULL if there is no memory. */
char *cs_css_copy(const cs_css_place *place, const char *begin, const char *end);

typedef struct cs_css_declaration {
  cs_svg_name name;   /* a property; CS_SVG_NAME_COUNT: a variable */
  const char *custom; /* the variable's name, with its hyphens; NULL: no variable */
  bool is_important;
  bool has_variable; /* the value refers to variables */
  const char *value; /* without space at its ends */
} cs_css_declaration;

typedef struct cs_css_declarations {
  const cs_css_declaration *items;
  size_t count;
  bool has_geometry; /* some of them are of CS_SVG_USE_GEOMETRY */
  bool has_motion;   /* one of them names animations */
  bool has_nested;   /* rules between the braces were left out */
} cs_css_declarations;

/* [name] or [name=value]. With a sign before the '=', the value matches: ~ one of its words, | the
 * whole value or its beginning up to a hyphen, ^ its beginning, $ its end, * any part of it. */
typedef struct cs_css_condition {
  cs_svg_name name;
  /* 0: the attribute must exist; '=': the attribute must have the value; otherwise the sign
   * before the '=' */
  char comparison;
  const char *value;
} cs_css_condition;

typedef struct cs_css_compound {
  const char *element, *id; /* NULL: any */
  bool is_root;             /* the outermost element: ":root" */
  const char **classes;     /* all of them must match */
  size_t class_count;
  cs_css_condition *conditions; /* all of them must match */
  size_t condition_count;
  bool is_child; /* a child of the element of the compound before it; otherwise anywhere below it */
} cs_css_compound;

typedef struct cs_css_rule {
  cs_css_compound *compounds;
  size_t compound_count;
  uint32_t specificity;
  uint32_t order;
  cs_css_declarations declarations;
} cs_css_rule;

/* A rule of @keyframes: a share of the time, 0..1, and what holds there. */
typedef struct cs_css_frame {
  double at;
  cs_css_declarations declarations;
} cs_css_frame;

typedef struct cs_css_frames {
  const char *name;
  cs_css_frame *items; /* in the order of the file */
  size_t count, size;  /* size: frames, their declarations, and the bytes of timing functions */
} cs_css_frames;

typedef struct cs_css_sheet {
  CS_ARRAY(cs_css_rule, rules);    /* in ascending order of weight: later ones win */
  CS_ARRAY(cs_css_frames, frames); /* a later one replaces one of the same name */
  size_t count, frames_count;
  bool omitted;
  bool has_geometry; /* in one of the rules */
  bool has_motion;   /* there are rules with names of animations */
} cs_css_sheet;

/* Parses the contents of a `style` attribute. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_css_declarations_parse(const cs_css_place *place,
                                                         const char *text,
                                                         cs_css_declarations *out);
/* Parses a style sheet. *out must be finished even after a failure. Errors: NO_MEMORY; LIMIT for
 * more than CS_CSS_RULES rules. */
CELSPAN_CHECKED celspan_status cs_css_sheet_parse(const cs_css_place *place, const char *text,
                                                  cs_css_sheet *out);
void cs_css_sheet_finish(cs_css_sheet *sheet, celspan_context *context);

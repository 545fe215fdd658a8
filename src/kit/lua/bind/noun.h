/* The values that Lua scripts make, as data.
 *
 *   noun    what a constructor makes ("circle"), or a table of options ("camera")
 *   field   a named field of its table: how it is read, and what people need to know about it
 *   kind    what can be done with a value ("object"): one metatable each
 *
 * Everything that is known about a field is in its row: cs_fields_read fills the description of the
 * core from the rows, messages and :with use them, and cs_describe_push gives them to the Lua
 * module that prints `celspan help lua` and the annotations for editors, celspan.d.lua.
 */
#pragma once

#include <lauxlib.h>
#include <stddef.h>

#include "celspan/celspan.h"
#include "inside/number.h"

struct cs_userdata;
struct cs_form;

typedef struct cs_kind {
  const char *name; /* the name of the metatable, "celspan.object" */
  void (*unref)(void *handle);
  /* The name of a value, and the line that made it; NULL: values of this kind have none. */
  celspan_status (*named)(celspan_context *context, void *handle, const char *name, void **out);
  const char *(*name_of)(const void *handle);
  celspan_origin (*origin_of)(const void *handle);
  /* NULL: values of this kind have no place. */
  celspan_status (*transform)(celspan_context *context, void *handle, const celspan_matrix *matrix,
                              void **out);
  celspan_status (*fade)(celspan_context *context, void *handle, double k, void **out);
  celspan_status (*bounds)(celspan_context *context, const void *handle, bool *is_there,
                           celspan_box *out);
  bool (*contains)(const void *handle, celspan_point point);
  celspan_blend (*mode)(const void *handle);
  /* NULL: the mode of such values is a field. */
  celspan_status (*blend)(celspan_context *context, void *handle, celspan_blend mode, void **out);
  const luaL_Reg *methods, *operators; /* operators NULL: none */
  const struct cs_written *written;    /* methods in Lua; NULL: none */
  /* bytes of data that each value has: for example a paint's numbers, a frame's seed */
  size_t own_size;
  int kept; /* how many user values a value has in addition to the first one, its fields */
} cs_kind;

/* The type of a field in the description that it is read into. */
typedef enum cs_type {
  CS_TYPE_OWN,     /* the noun reads it itself */
  CS_TYPE_NUMBER,  /* double */
  CS_TYPE_WHOLE,   /* int */
  CS_TYPE_FLAG,    /* bool */
  CS_TYPE_CHOICE,  /* an enum: the index of a word among the choices */
  CS_TYPE_TEXT,    /* const char *, borrowed from a value that is left on the stack */
  CS_TYPE_NUMBERS, /* `count` doubles: an array, a celspan_point, a celspan_box */
  CS_TYPE_PIXELS,  /* `count` int32_t */
  CS_TYPE_TEXTURE  /* celspan_texture *, borrowed from a value that is left on the stack */
} cs_type;

typedef struct cs_field {
  const char *name;
  cs_type type;
  bool is_required;
  bool is_above;      /* the range does not include its least value */
  uint16_t at;        /* offset in the description */
  uint16_t has;       /* offset of a bool that is set if the field is given; 0: there is none */
  uint16_t count;     /* NUMBERS and PIXELS: how many */
  double least, most; /* the range; equal: any number within 1e12 */
  /* the value that scripts read if the field was left out, a number or a word; NULL: nil */
  const char *preset;
  const char *const *choices; /* CHOICE: the words, ended by NULL; the first one is the default */
  const char *shape;          /* NUMBERS: "a point {x, y}"; NULL: "an array of 9 numbers" */
  const char *written;        /* the field's type in annotations; NULL: by `type` */
  /* its type when it is read from a value, if it always exists there but differs from the given
   * one */
  const char *read;
  const char *about; /* a description for users, without range and default; NULL: none */
  /* for users: the value that is used if the field is left out and has no preset */
  const char *fallback;
  /* in the row without a name, which ends the fields: further fields, which several nouns share;
   * NULL: none */
  const struct cs_field *more;
} cs_field;

/* The fields of a noun: for (field = noun->fields; field->name; field = cs_field_next(field)) */
static inline const cs_field *cs_field_next(const cs_field *field) {
  return field[1].name || !field[1].more ? field + 1 : field[1].more;
}

/* The offset of a member, which must have this type. */
#define CS_MEMBER(desc, member, type)                                                              \
  (offsetof(desc, member) + 0 * sizeof(_Generic(((desc *)0)->member, type : 0)))
#define CS_NUMBER(desc, member) .type = CS_TYPE_NUMBER, .at = CS_MEMBER(desc, member, double)
#define CS_WHOLE(desc, member) .type = CS_TYPE_WHOLE, .at = CS_MEMBER(desc, member, int)
#define CS_FLAG(desc, member) .type = CS_TYPE_FLAG, .at = CS_MEMBER(desc, member, bool)
#define CS_CHOICE(desc, member, words)                                                             \
  .type = CS_TYPE_CHOICE, .at = offsetof(desc, member), .choices = (words)
#define CS_TEXT(desc, member) .type = CS_TYPE_TEXT, .at = CS_MEMBER(desc, member, const char *)
#define CS_NUMBERS(desc, member)                                                                   \
  .type = CS_TYPE_NUMBERS, .at = offsetof(desc, member),                                           \
  .count = sizeof(((desc *)0)->member) / sizeof(double)
#define CS_POINT(desc, member)                                                                     \
  CS_NUMBERS(desc, member), .shape = "a point {x, y}", .written = "celspan.point"
#define CS_SIZE(desc, member) CS_NUMBERS(desc, member), .shape = "a size {w, h}"
#define CS_BOX(desc, member) CS_NUMBERS(desc, member), .shape = "a box {x, y, w, h}"
#define CS_PIXELS(desc, member)                                                                    \
  .type = CS_TYPE_PIXELS, .at = offsetof(desc, member),                                            \
  .count = sizeof(((desc *)0)->member) / sizeof(int32_t)
#define CS_SURFACE(desc, member)                                                                   \
  .type = CS_TYPE_TEXTURE, .at = CS_MEMBER(desc, member, celspan_texture *)
#define CS_TEXTURE(desc, member) "texture", CS_SURFACE(desc, member), .preset = "#000000"
#define CS_OWN(type) .written = (type)
#define CS_FROM(low) .least = (low), .most = CS_NUMBER_LIMIT
#define CS_ABOVE_0 .is_above = true, .most = CS_NUMBER_LIMIT
#define CS_HAS(desc, member) .has = CS_MEMBER(desc, member, bool)

/* The contents of the table's array part. */
typedef enum cs_list {
  CS_LIST_NONE,
  CS_LIST_TUPLE, /* a fixed number of values: :with changes them one by one */
  CS_LIST_ITEMS  /* any number of items: :with{a, b} replaces them all */
} cs_list;

/* A field that may be given by values of the list. */
typedef struct cs_place {
  const char *field;
  int count; /* how many values */
} cs_place;

typedef struct cs_noun {
  const char *name;
  const char *about;   /* a sentence about its value */
  const char *table;   /* the name of its table in annotations; NULL: "celspan.NAME.fields" */
  const cs_kind *kind; /* NULL: a table of options, not a value */
  cs_list list;
  const char *item;         /* "object": one of them; NULL without a list */
  const char *item_written; /* the type of an item in annotations */
  const char *item_about;   /* a description of the items, for people; NULL: none */
  const cs_field *fields;   /* ended by a row without a name */
  bool has_gaps;            /* ITEMS: items that are nil or false are left out */
  const char *places;       /* "{x, y, w, h}" for messages; NULL: its values have no names */
  /* fields whose values may be in the list, one after another, of a TUPLE after its first value;
   * ended by NULL; NULL: none */
  const cs_place *by_place;
  const char *either[2]; /* fields of which only one may be given; NULL: none */
  /* fields that may only be given with either[1], ended by NULL; NULL: none */
  const char *const *second;
  void (*create)(const struct cs_form *form, struct cs_userdata *value);
  /* Adds fields whose values follow from others; NULL: none. */
  void (*complete)(lua_State *L, int fields);
} cs_noun;

/* The list of a noun with any number of items, with gaps. */
#define CS_ITEMS(name, type)                                                                       \
  .list = CS_LIST_ITEMS, .has_gaps = true, .item = (name), .item_written = (type)
/* The options of a function that makes an object from an object; WORD_rows are their fields, and
 * create_WORD makes the object. */
#define CS_FROM_OBJECT(word, sentence)                                                             \
  .name = #word, .about = (sentence), .table = "celspan." #word ".options",                        \
  .kind = &cs_kind_object, .list = CS_LIST_TUPLE, .item = "object", .fields = word##_rows,         \
  .create = create_##word

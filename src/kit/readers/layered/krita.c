/* Krita documents: an archive of layers in tiles and maindoc.xml, which describes their order and
 * places. Layers whose pixels Krita computes (filters, fills, vectors, clones, files) are noted.
 *
 * An animated layer names a member with its keys, and becomes a group of its drawings, rearmost the
 * first, of which the first is visible:
 *
 *   frame     0         3              8            12
 *   content   layer3    layer3.f1      layer3.f2    layer3.f1    the same drawing again: a clone
 *   drawing   "1"       "2"            "3"          "2"
 */
#include "readers/layered/document.h"

#include <stdio.h>
#include <string.h>

#include "common/blend_names.h"
#include "inside/number.h"
#include "readers/layered/krita_tiles.h"

static bool is(const char *text, const char *word) { return text && strcmp(text, word) == 0; }

/* ---------------------------------------------------------------- layers */

static celspan_status read_common(cs_document *document, cs_contents_layer *layer) {
  double opacity = 255;
  const char *blend = cs_document_text(document, "compositeop");
  layer->is_visible = !is(cs_document_text(document, "visible"), "0");
  CS_TRY(cs_document_number(document, "opacity", 0, 255, &opacity));
  layer->opacity = opacity / 255;
  if (blend)
    cs_blend_word_of_openraster(blend, layer->blend);
  if (is(cs_document_text(document, "passthrough"), "1") && layer->is_group)
    strcpy(layer->blend, "pass-through");
  CS_TRY(cs_document_whole(document, "x", &layer->x));
  return cs_document_whole(document, "y", &layer->y);
}

/* The channels that a layer changes, with alpha last: "1110" does not change the alpha of the
 * layers below. */
static celspan_status read_channels(cs_document *document) {
  const char *flags = cs_document_text(document, "channelflags");
  const char *off = flags ? strchr(flags, '0') : NULL;
  if (!off)
    return CELSPAN_OK;
  if (off[1])
    return CS_DOCUMENT_NOTE(document, "some channels are switched off: it is shown whole");
  document->painting->layers[cs_contents_last(document->painting)].is_within = true;
  return cs_contents_note_own(document->context, document->painting,
                              "alpha is inherited from the layers below: it is shown whole");
}

/* Finds the folder of the layers, whose names begin with "folder/layers/". The folder normally has
 * the image's name. If there is no such folder, the first folder that contains "layers/" is
 * used. */
static void find_folder(cs_document *document, const char *name) {
  static const char between[] = "/layers/";
  const cs_zip *zip = document->zip;
  char start[320];
  snprintf(document->folder, sizeof document->folder, "%s", name);
  snprintf(start, sizeof start, "%s%s", document->folder, between);
  size_t place = cs_zip_place(zip, start);
  bool is_there =
      place < zip->count && strncmp(zip->members[place].name, start, strlen(start)) == 0;
  for (size_t i = 0; i < zip->count && !is_there; i++) {
    const char *other = zip->members[i].name, *end = strstr(other, between);
    is_there = end && (size_t)(end - other) < sizeof document->folder;
    if (is_there)
      snprintf(document->folder, (size_t)(end - other) + 1, "%s", other);
  }
}

/* The member of a layer whose name has this ending. */
static const cs_zip_member *find_member(const cs_document *document, const char *name,
                                        const char *ending) {
  char path[640];
  snprintf(path, sizeof path, "%s/layers/%.300s%s", document->folder, name, ending);
  return cs_zip_find(document->zip, path);
}

/* ---------------------------------------------------------------- colour profiles */

/* The embedded profile; if there is none, the profile that is named; if there is neither, *out does
 * not change. */
static celspan_status read_profile(cs_document *document, const cs_zip_member *member,
                                   cs_profile *out) {
  const char *name = cs_document_text(document, "profile");
  unsigned char *bytes;
  size_t size;
  if (!member && name)
    cs_profile_of_name(name, out);
  if (!member)
    return CELSPAN_OK;
  CS_TRY(cs_zip_load(document->context, document->input, member, CS_PROFILE_BYTES, &bytes, &size));
  celspan_status status = cs_profile_read(document->context, document->input, document->painting,
                                          &(cs_colour_request){.bytes = bytes, .size = size}, out);
  cs_mem_free(document->context->memory, bytes, size + 1);
  CS_TRY(status);
  return cs_document_scan(document, (int64_t)size);
}

static celspan_status start_image(cs_document *document) {
  const char *name = cs_document_text(document, "name");
  char path[320];
  CS_TRY(cs_document_size(document, "width", "height"));
  find_folder(document, name ? name : "");
  snprintf(path, sizeof path, "%s/annotations/icc", document->folder);
  CS_TRY(read_profile(document, cs_zip_find(document->zip, path), &document->profile));
  return cs_profile_note(document->context, document->painting, CS_CONTENTS_NONE,
                         &document->profile);
}

/* The profile of a layer's pixels; adds a note if it differs from the profile of the image. */
static celspan_status read_layer_profile(cs_document *document, const char *name,
                                         cs_contents_layer *layer) {
  cs_profile profile = document->profile;
  CS_TRY(read_profile(document, find_member(document, name, ".icc"), &profile));
  cs_profile_apply(&profile, layer);
  if (strcmp(profile.name, document->profile.name) == 0)
    return CELSPAN_OK;
  return cs_profile_note(document->context, document->painting,
                         cs_contents_last(document->painting), &profile);
}

/* ---------------------------------------------------------------- pixels */

/* The pixel that Krita uses where there is no tile. */
static celspan_status read_default(cs_document *document, const char *name,
                                   cs_krita_tiles_form *form) {
  unsigned char *bytes;
  size_t size;
  const cs_zip_member *member = find_member(document, name, ".defaultpixel");
  if (!member)
    return CELSPAN_OK;
  CS_TRY(cs_zip_load(document->context, document->input, member, 64, &bytes, &size));
  if (size == (size_t)form->pixel_size)
    memcpy(form->beyond, bytes, size);
  cs_mem_free(document->context->memory, bytes, size + 1);
  return CELSPAN_OK;
}

/* The pixels of the layer added last, of which x and y are the offset. name: of the member in the
 * archive; profile: what its colour profile is named after. */
static celspan_status read_member(cs_document *document, const cs_zip_member *member,
                                  const char *name, const char *profile, cs_contents_layer *layer) {
  const char *space = cs_document_text(document, "colorspacename");
  cs_krita_tiles_form form = {.width = document->painting->width,
                              .height = document->painting->height};
  if (!cs_krita_tiles_form_of(space ? space : "RGBA", &form))
    return CS_DOCUMENT_NOTE(document, "pixels in the colour space %.40s: it is empty", space);
  CS_TRY(read_default(document, name, &form));
  int32_t x = layer->x, y = layer->y;
  form.x = -x;
  form.y = -y;
  cs_rows_source *source = NULL;
  CS_TRY(read_layer_profile(document, profile, layer));
  CS_TRY(cs_krita_tiles_create(document->context, document->input, member, &form, &source));
  if (source)
    cs_contents_set_pixels(layer, x + form.x, y + form.y, source);
  CS_TRY(cs_document_scan(document, form.scanned));
  if (!source)
    return CELSPAN_OK;
  return cs_contents_check_corner(document->context, document->input, "a layer", layer->x,
                                  layer->y);
}

/* The member that an attribute names, in the folder of the layers. */
static celspan_status named_member(cs_document *document, const char *attribute,
                                   const cs_zip_member **out) {
  const char *name = cs_document_text(document, attribute);
  if (!name || !cs_document_is_inside(name) || strchr(name, '/'))
    return cs_document_fail(document, CELSPAN_INPUT,
                            "%s is \"%.200s\"; it must name a layer of the archive", attribute,
                            name ? name : "");
  *out = find_member(document, name, "");
  return *out ? CELSPAN_OK
              : cs_document_fail(document, CELSPAN_INPUT,
                                 "%s is \"%.200s\", which is not in the archive", attribute, name);
}

static celspan_status read_pixels(cs_document *document, cs_contents_layer *layer) {
  const cs_zip_member *member;
  CS_TRY(named_member(document, "filename", &member));
  const char *name = cs_document_text(document, "filename");
  return read_member(document, member, name, name, layer);
}

/* ---------------------------------------------------------------- keys */

static celspan_status read_opacity(cs_document *document, celspan_painting_key *key) {
  static const char *const ways[] = {"constant", "linear", "bezier"};
  const char *between = cs_document_text(document, "interpolation");
  key->is_opacity = true;
  for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
    if (is(between, ways[i]))
      key->between = ways[i];
  key->opacity = document->opaque;
  CS_TRY(cs_document_number(document, "value", 0, document->opaque, &key->opacity));
  key->opacity /= document->opaque;
  return CELSPAN_OK;
}

/* The last key of the layer added last: of its opacity, or of its drawings. NULL: there is none. */
static const celspan_painting_key *last_key(const celspan_painting *painting, bool is_opacity) {
  for (size_t i = painting->key_count; i-- > 0;) {
    const celspan_painting_key *key = &painting->keys[i].fields;
    if (key->layer != cs_contents_last(painting))
      return NULL;
    if (key->is_opacity == is_opacity)
      return key;
  }
  return NULL;
}

static celspan_status start_key(cs_document *document) {
  bool is_opacity = document->channel == 'o';
  const celspan_painting_key *last = last_key(document->painting, is_opacity);
  int64_t before = last ? last->frame : INT64_MIN;
  cs_contents_key *key;
  CS_TRY(cs_contents_add_key(document->context, document->input, document->painting, &key));
  CS_TRY(cs_document_whole(document, "time", &key->fields.frame));
  CS_TRY(cs_document_whole(document, "color-label", &key->fields.colour));
  if (before >= key->fields.frame)
    return cs_document_fail(document, CELSPAN_INPUT, "the key of frame %d follows that of frame %d",
                            (int)key->fields.frame, (int)before);
  return is_opacity ? read_opacity(document, &key->fields)
                    : named_member(document, "frame", &key->member);
}

static celspan_status read_handle(cs_document *document, double handle[2]) {
  double farthest = (double)CS_CONTENTS_FARTHEST;
  CS_TRY(cs_document_number(document, "x", -farthest, farthest, &handle[0]));
  CS_TRY(cs_document_number(document, "y", -farthest, farthest, &handle[1]));
  handle[1] /= document->opaque;
  return CELSPAN_OK;
}

static celspan_status start_in_keys(cs_document *document, const char *name) {
  celspan_painting *painting = document->painting;
  if (is(name, "channel")) {
    const char *channel = cs_document_text(document, "name");
    document->channel = is(channel, "content") || is(channel, "opacity") ? channel[0] : 0;
  }
  if (document->channel && is(name, "keyframe"))
    return start_key(document);
  if (!document->channel || painting->key_count == 0)
    return CELSPAN_OK;
  cs_contents_key *key = &painting->keys[painting->key_count - 1];
  if (key->fields.layer != cs_contents_last(painting))
    return CELSPAN_OK; /* the layer has no key yet */
  if (is(name, "offset")) {
    CS_TRY(cs_document_whole(document, "x", &key->x));
    return cs_document_whole(document, "y", &key->y);
  }
  if (is(name, "leftTangent"))
    return read_handle(document, key->fields.in);
  return is(name, "rightTangent") ? read_handle(document, key->fields.out) : CELSPAN_OK;
}

/* Adds the drawing of a key to the open group. number: what it is called. */
static celspan_status add_drawing(cs_document *document, size_t place, size_t number) {
  celspan_painting *painting = document->painting;
  cs_contents_key key = painting->keys[place];
  cs_contents_layer *drawing;
  char text[24];
  int size = snprintf(text, sizeof text, "%zu", number);
  CS_TRY(
      cs_contents_add(document->context, document->input, painting, text, (size_t)size, &drawing));
  drawing->parent = document->group;
  drawing->is_visible = number == 1;
  drawing->x = key.x;
  drawing->y = key.y;
  return read_member(document, key.member, strrchr(key.member->name, '/') + 1,
                     cs_document_text(document, "filename"), drawing);
}

/* Adds the drawings of the layer's keys from `first` on, the last one first. */
static celspan_status add_drawings(cs_document *document, size_t first) {
  celspan_painting *painting = document->painting;
  cs_document_shown *known = document->shown;
  const cs_zip_member *members = document->zip->members;
  size_t number = 0;
  for (size_t i = first; i < painting->key_count; i++)
    if (painting->keys[i].member && known[painting->keys[i].member - members].key <= first) {
      known[painting->keys[i].member - members].key = i + 1;
      number++;
    }
  for (size_t i = painting->key_count; i-- > first;)
    if (painting->keys[i].member && known[painting->keys[i].member - members].key == i + 1) {
      CS_TRY(add_drawing(document, i, number--));
      known[painting->keys[i].member - members].drawing = cs_contents_last(painting);
    }
  for (size_t i = first; i < painting->key_count; i++)
    if (painting->keys[i].member)
      painting->keys[i].fields.drawing = known[painting->keys[i].member - members].drawing;
  return CELSPAN_OK;
}

/* Reads the keys of the layer added last. */
static celspan_status read_keys(cs_document *document) {
  static const cs_document_format format = {.start = start_in_keys};
  const cs_zip_member *member;
  CS_TRY(named_member(document, "keyframes", &member));
  return cs_document_read_member(document, member, &format);
}

/* Whether one of the keys shows a drawing. */
static bool has_drawings(const celspan_painting *painting, size_t first) {
  for (size_t i = first; i < painting->key_count; i++)
    if (painting->keys[i].member)
      return true;
  return false;
}

/* The drawings of the open layer, whose keys begin at `first`, in place of its pixels. */
static celspan_status make_drawings(cs_document *document, size_t first) {
  cs_contents_layer *layer = &document->painting->layers[document->group];
  if (!document->shown)
    CS_TRY(CS_MAKE(document->context, document->shown, document->zip->count));
  layer->is_group = true;
  layer->x = layer->y = 0;
  return add_drawings(document, first);
}

/* Removes the keys of drawings from `first` on, of a layer that has no drawings. */
static void drop_drawings(celspan_painting *painting, size_t first) {
  size_t count = first;
  for (size_t i = first; i < painting->key_count; i++)
    if (!painting->keys[i].member)
      painting->keys[count++] = painting->keys[i];
  painting->key_count = count;
}

/* ---------------------------------------------------------------- elements */

static celspan_status start_layer(cs_document *document) {
  const char *type = cs_document_text(document, "nodetype");
  cs_contents_layer *layer;
  bool is_group = is(type, "grouplayer"), is_paint = !type || is(type, "paintlayer");
  /* it may have masks, so it is closed with its element */
  CS_TRY(cs_document_add(document, true, &layer));
  layer->is_group = is_group;
  CS_TRY(read_common(document, layer));
  CS_TRY(read_channels(document));
  size_t first = document->painting->key_count;
  if (cs_document_text(document, "keyframes"))
    CS_TRY(read_keys(document));
  if (!is_paint)
    drop_drawings(document->painting, first);
  if (is_group) {
    layer->x = layer->y = 0;
    return CELSPAN_OK;
  }
  if (!is_paint)
    return CS_DOCUMENT_NOTE(document, "is a \"%.60s\": it is empty", type);
  return has_drawings(document->painting, first) ? make_drawings(document, first)
                                                 : read_pixels(document, layer);
}

/* <framerate value="24"/> <range from="0" to="100"/>, in <animation> */
static celspan_status start_clip(cs_document *document, const char *name) {
  celspan_painting *painting = document->painting;
  if (is(name, "framerate"))
    return cs_document_number(document, "value", 1e-3, 1000, &painting->rate);
  CS_TRY(cs_document_whole(document, "from", &painting->from));
  CS_TRY(cs_document_whole(document, "to", &painting->to));
  return painting->from <= painting->to
             ? CELSPAN_OK
             : cs_document_fail(document, CELSPAN_INPUT, "the range from %d to %d has no frames",
                                (int)painting->from, (int)painting->to);
}

static celspan_status start_mask(cs_document *document) {
  const char *type = cs_document_text(document, "nodetype");
  if (document->group == CS_CONTENTS_NONE)
    return CELSPAN_OK; /* this is a selection for the whole painting */
  return cs_contents_note(document->context, document->painting, document->group,
                          "has a \"%.60s\": it changes nothing here", type ? type : "mask");
}

/* Since version 5 the keys of opacities are per cent; layers have codes as before. */
static celspan_status start_document(cs_document *document) {
  const char *version = cs_document_text(document, "kritaVersion");
  double major = 0;
  if (version)
    cs_decimal_read(version, &major);
  document->opaque = major >= 5 ? 100 : 255;
  return CELSPAN_OK;
}

static celspan_status start(cs_document *document, const char *name) {
  if (is(name, "DOC"))
    return start_document(document);
  if (is(name, "IMAGE"))
    return start_image(document);
  if (is(name, "layer"))
    return document->has_size
               ? start_layer(document)
               : cs_document_fail(document, CELSPAN_INPUT, "a layer comes before the image");
  if (is(name, "mask"))
    return start_mask(document);
  return is(name, "framerate") || is(name, "range") ? start_clip(document, name) : CELSPAN_OK;
}

static celspan_status end(cs_document *document, const char *name) {
  if (is(name, "layer"))
    cs_document_close_group(document);
  return CELSPAN_OK;
}

/* A group is a layer that contains a list. */
const cs_document_format cs_krita_format = {"maindoc.xml", "reading Krita files", start, end,
                                            2 * CS_CONTENTS_DEPTH + 16};

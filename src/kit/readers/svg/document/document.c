#include "readers/svg/document/document.h"

#include <string.h>

#include "readers/svg/words/forms.h"
#include "readers/svg/words/silent.h"
#include "readers/svg/words/values.h"
#include "readers/type/xml.h"

#define SVG_NAMESPACE "http://www.w3.org/2000/svg"
#define LINK_NAMESPACE "http://www.w3.org/1999/xlink"
#define INKSCAPE_NAMESPACE "http://www.inkscape.org/namespaces/inkscape"
#define XML_NAMESPACE "http://www.w3.org/XML/1998/namespace"
#define PAGE_NAMESPACE "http://www.w3.org/1999/xhtml"
#define FORMULA_NAMESPACE "http://www.w3.org/1998/Math/MathML"

typedef struct reader {
  celspan_context *context;
  const char *name;
  cs_svg_document *document;
  cs_svg_node *open; /* the innermost element that is open; NULL: none */
  /* the number of open elements of other namespaces, and of open elements inside these */
  uint32_t foreign_depth;
  char *css; /* the texts of the style elements so far */
  size_t css_size, css_capacity;
  char *characters; /* the characters of the open text, since its last element */
  size_t character_size, character_capacity;
  uint64_t character_line; /* the line where they begin */
  celspan_status failure;
} reader;

/* ---------------------------------------------------------------- names */

static bool has_prefix(const char *text, const char *prefix) {
  return strncmp(text, prefix, strlen(prefix)) == 0;
}

/* The local part of a name of SVG, or NULL. Files without namespaces count as SVG. */
static const char *svg_name(const char *name) {
  const char *blank = strchr(name, ' ');
  if (!blank)
    return name;
  return has_prefix(name, SVG_NAMESPACE " ") ? blank + 1 : NULL;
}

static cs_svg_name attribute_name(const char *name) {
  if (strcmp(name, LINK_NAMESPACE " href") == 0)
    return CS_SVG_HREF;
  if (strcmp(name, INKSCAPE_NAMESPACE " label") == 0)
    return CS_SVG_LABEL;
  if (strcmp(name, XML_NAMESPACE " space") == 0)
    return CS_SVG_SPACE;
  cs_svg_name found = strchr(name, ' ') ? CS_SVG_NAME_COUNT : cs_svg_name_of(name);
  return found == CS_SVG_LABEL || found == CS_SVG_SPACE ? CS_SVG_NAME_COUNT : found;
}

/* ---------------------------------------------------------------- elements */

static const char *copy_text(reader *r, const char *text) {
  size_t size = strlen(text) + 1;
  char *copy = cs_arena_take(r->context, &r->document->arena, size);
  return copy ? memcpy(copy, text, size) : NULL;
}

/* The place of a name in the list, or its end. */
static size_t place_of(const cs_svg_attribute *list, size_t count, cs_svg_name name) {
  size_t i = 0;
  while (i < count && list[i].name != name)
    i++;
  return i;
}

static cs_css_place css_place(reader *r, uint64_t line) {
  return (cs_css_place){r->context, &r->document->arena, &r->document->unread, (uint32_t)line};
}

/* Whether an attribute that is not read changes nothing: an attribute of another namespace, or a
 * name that has a meaning only in a namespace. */
static bool is_silent(const char *const *attribute) {
  return strchr(attribute[0], ' ') || cs_svg_name_of(attribute[0]) != CS_SVG_NAME_COUNT ||
         cs_svg_name_is_silent(attribute[0], attribute[1]);
}

/* Notes an attribute that is not read, or a value that is not read. */
static celspan_status note_attribute(reader *r, const cs_svg_node *node, cs_svg_name name,
                                     const char *const *attribute) {
  bool is_quiet = name != CS_SVG_NAME_COUNT ? cs_svg_value_is_read(name, attribute[1], false)
                                            : is_silent(attribute);
  if (is_quiet || !cs_svg_element_is_drawn(node->element))
    return CELSPAN_OK;
  return cs_svg_unread_add(&r->document->unread, r->context, &r->document->arena, node->line,
                           attribute[0], attribute[1]);
}

/* Adds an attribute to the list. An attribute without a namespace wins over one of the same name in
 * the namespace of links, in either order. */
static celspan_status take_attribute(reader *r, cs_svg_node *node, const char *const *attribute,
                                     cs_svg_attribute *list, size_t *count) {
  cs_svg_name name = attribute_name(attribute[0]);
  CS_TRY(note_attribute(r, node, name, attribute));
  if (name == CS_SVG_NAME_COUNT)
    return CELSPAN_OK;
  size_t place = place_of(list, *count, name);
  bool is_weaker = name == CS_SVG_HREF && strchr(attribute[0], ' ');
  if (place < *count && is_weaker)
    return CELSPAN_OK;
  const char *value = copy_text(r, attribute[1]);
  if (!value)
    return CELSPAN_NO_MEMORY;
  list[place] = (cs_svg_attribute){name, cs_svg_has_variable(value), value};
  *count += place == *count;
  const cs_css_place css = css_place(r, node->line);
  if (name == CS_SVG_STYLE)
    CS_TRY(cs_css_declarations_parse(&css, value, &node->style));
  r->document->has_geometry = r->document->has_geometry || node->style.has_geometry;
  r->document->has_motion = r->document->has_motion || node->style.has_motion;
  return CELSPAN_OK;
}

static celspan_status read_attributes(reader *r, cs_svg_node *node, const char *const *attributes) {
  cs_svg_attribute list[CS_SVG_NAME_COUNT];
  size_t count = 0;
  for (; *attributes; attributes += 2)
    CS_TRY(take_attribute(r, node, attributes, list, &count));
  cs_svg_attribute *copy = cs_arena_take(r->context, &r->document->arena, count * sizeof *copy);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  memcpy(copy, list, count * sizeof *copy);
  node->attributes = copy;
  node->attribute_count = count;
  return CELSPAN_OK;
}

static cs_hash hash_id(const char *id, size_t size) {
  cs_hash hash = cs_hash_begin(0x737667u);
  cs_hash_bytes(&hash, id, size);
  return cs_hash_end(hash);
}

static celspan_status remember_id(reader *r, cs_svg_node *node) {
  cs_svg_document *document = r->document;
  const char *id = cs_svg_node_value(node, CS_SVG_ID);
  size_t there;
  if (!id || !*id || cs_hash_table_find(&document->ids, hash_id(id, strlen(id)), &there))
    return CELSPAN_OK;
  CS_TRY(
      CS_RESERVE(r->context, document->named, document->named_capacity, document->named_count + 1));
  document->named[document->named_count] = node;
  return cs_hash_table_add(&document->ids, r->context, hash_id(id, strlen(id)),
                           document->named_count++);
}

static void append_child(reader *r, cs_svg_node *node) {
  cs_svg_node *parent = r->open;
  node->parent = parent;
  if (!parent)
    r->document->root = node;
  else if (parent->last)
    parent->last = parent->last->next = node;
  else
    parent->first = parent->last = node;
}

static celspan_status count_element(reader *r, uint64_t line) {
  if (++r->document->element_count <= CS_SVG_ELEMENTS)
    return CELSPAN_OK;
  return cs_fail(r->context, CELSPAN_LIMIT, "%s:%u: there are more than %d elements", r->name,
                 (unsigned)line, CS_SVG_ELEMENTS);
}

/* Whether an element in `parent` is never seen, or is replaced by another one. */
static bool is_apart(const cs_svg_node *parent) {
  for (; parent; parent = parent->parent)
    if (parent->element == CS_SVG_ELEMENT_SWITCH || !cs_svg_element_is_drawn(parent->element))
      return true;
  return false;
}

/* Notes an element that is not in the list of names. */
static celspan_status note_element(reader *r, const cs_svg_node *node, uint64_t line) {
  if (node->element != CS_SVG_ELEMENT_OTHER || is_apart(r->open))
    return CELSPAN_OK;
  return cs_svg_unread_add(&r->document->unread, r->context, &r->document->arena, (uint32_t)line,
                           node->tag, NULL);
}

/* Notes an element of HTML or MathML. */
static celspan_status note_foreign(reader *r, const char *name, uint64_t line) {
  bool is_seen = has_prefix(name, PAGE_NAMESPACE " ") || has_prefix(name, FORMULA_NAMESPACE " ");
  if (!is_seen || is_apart(r->open))
    return CELSPAN_OK;
  return cs_svg_unread_add(&r->document->unread, r->context, &r->document->arena, (uint32_t)line,
                           strchr(name, ' ') + 1, NULL);
}

static celspan_status add_element(reader *r, const char *tag, const char *const *attributes,
                                  uint64_t line) {
  CS_TRY(count_element(r, line));
  cs_svg_node *node = cs_arena_take(r->context, &r->document->arena, sizeof *node);
  if (!node)
    return CELSPAN_NO_MEMORY;
  *node = (cs_svg_node){.line = (uint32_t)line,
                        .number = (uint32_t)r->document->element_count - 1,
                        .element = cs_svg_element_named(tag)};
  if (!r->open && node->element != CS_SVG_ELEMENT_SVG)
    return cs_fail(r->context, CELSPAN_INPUT,
                   "%s:%u: the document is \"%.100s\"; a drawing begins with svg", r->name,
                   (unsigned)line, tag);
  node->tag = copy_text(r, tag);
  if (!node->tag)
    return CELSPAN_NO_MEMORY;
  CS_TRY(note_element(r, node, line));
  CS_TRY(read_attributes(r, node, attributes));
  CS_TRY(remember_id(r, node));
  r->document->animation_count += cs_svg_element_animates(node->element);
  append_child(r, node);
  r->open = node;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- characters */

/* Whether characters in the open element are part of a text. */
static bool is_in_text(const cs_svg_node *node) {
  while (node && (node->element == CS_SVG_ELEMENT_TSPAN || node->element == CS_SVG_ELEMENT_A ||
                  node->element == CS_SVG_ELEMENT_TEXT_PATH))
    node = node->parent;
  return node && node->element == CS_SVG_ELEMENT_TEXT;
}

/* Appends to a text that grows, and ends it with a zero. */
static celspan_status append_bytes(reader *r, char **text, size_t *size, size_t *capacity,
                                   const char *bytes, size_t count) {
  CS_TRY(CS_RESERVE(r->context, *text, *capacity, *size + count + 1));
  memcpy(*text + *size, bytes, count);
  *size += count;
  (*text)[*size] = 0;
  return CELSPAN_OK;
}

/* Makes a node of the characters since the last beginning or end of an element. */
static celspan_status end_characters(reader *r) {
  if (r->character_size == 0)
    return CELSPAN_OK;
  CS_TRY(count_element(r, r->character_line));
  cs_svg_node *node = cs_arena_take(r->context, &r->document->arena, sizeof *node);
  if (!node)
    return CELSPAN_NO_MEMORY;
  *node = (cs_svg_node){.line = (uint32_t)r->character_line,
                        .element = CS_SVG_ELEMENT_CHARACTERS,
                        .tag = r->open->tag};
  node->text = copy_text(r, r->characters);
  if (!node->text)
    return CELSPAN_NO_MEMORY;
  append_child(r, node);
  r->character_size = 0;
  return CELSPAN_OK;
}

static bool on_start(void *user, const char *name, const char *const *attributes, uint64_t line) {
  reader *r = user;
  const char *tag = svg_name(name);
  if (r->foreign_depth > 0 || (!tag && r->open)) {
    if (r->foreign_depth++ == 0)
      r->failure = note_foreign(r, name, line);
    return r->failure == CELSPAN_OK;
  }
  r->failure = end_characters(r);
  if (r->failure == CELSPAN_OK)
    r->failure = add_element(r, tag ? tag : name, attributes, line);
  return r->failure == CELSPAN_OK;
}

static bool on_end(void *user, const char *name, uint64_t line) {
  (void)name, (void)line;
  reader *r = user;
  if (r->foreign_depth > 0) {
    r->foreign_depth--;
    return true;
  }
  r->failure = end_characters(r);
  r->open = r->open->parent;
  return r->failure == CELSPAN_OK;
}

/* ---------------------------------------------------------------- texts of elements */

/* Whether a style element is for screens, too, not only for paper or speech. */
static bool is_for_screens(const cs_svg_node *node) {
  const char *media = cs_svg_node_value(node, CS_SVG_MEDIA);
  return !media || !*cs_svg_skip_space(media) || strstr(media, "all") || strstr(media, "screen");
}

static bool is_style_sheet(const cs_svg_node *node) {
  const char *type = node ? cs_svg_node_value(node, CS_SVG_TYPE) : NULL;
  return node && node->element == CS_SVG_ELEMENT_STYLE &&
         (!type || !*type || strcmp(type, "text/css") == 0) && is_for_screens(node);
}

static bool on_text(void *user, const char *bytes, size_t size, uint64_t line) {
  reader *r = user;
  if (r->foreign_depth > 0)
    return true;
  if (is_in_text(r->open)) {
    if (r->character_size == 0)
      r->character_line = line;
    r->failure =
        append_bytes(r, &r->characters, &r->character_size, &r->character_capacity, bytes, size);
  } else if (is_style_sheet(r->open)) {
    if (r->document->sheet_line == 0)
      r->document->sheet_line = (uint32_t)line;
    r->failure = append_bytes(r, &r->css, &r->css_size, &r->css_capacity, bytes, size);
  }
  return r->failure == CELSPAN_OK;
}

/* Notes a style sheet in a separate file, which an instruction before the document names. */
static celspan_status note_other_sheet(reader *r, const char *bytes, size_t size) {
  static const char instruction[] = "<?xml-stylesheet";
  return memmem(bytes, size, instruction, sizeof instruction - 1)
             ? cs_svg_unread_add(&r->document->unread, r->context, &r->document->arena, 1,
                                 "xml-stylesheet", NULL)
             : CELSPAN_OK;
}

static cs_hash key_of(const char *bytes, size_t size) {
  cs_hash hash = cs_hash_begin(0x737667u);
  cs_hash_bytes(&hash, bytes, size);
  return cs_hash_end(hash);
}

celspan_status cs_svg_document_read(celspan_context *context, const char *name, const char *bytes,
                                    size_t size, cs_svg_document *out) {
  *out = (cs_svg_document){0};
  cs_arena_init(&out->arena);
  out->variables = (cs_svg_variables){context, &out->arena, 0};
  reader r = {.context = context, .name = name, .document = out};
  const cs_xml_handler handler = {on_start, on_end, on_text, &r, CS_SVG_DEPTH};
  celspan_status status =
      cs_xml_parse(context, name, "reading SVG", bytes, size, &handler, &r.failure);
  if (status == CELSPAN_OK)
    status = note_other_sheet(&r, bytes, size);
  const cs_css_place place = css_place(&r, out->sheet_line);
  if (status == CELSPAN_OK && r.css)
    status = cs_css_sheet_parse(&place, r.css, &out->sheet);
  out->has_geometry = out->has_geometry || out->sheet.has_geometry;
  out->has_motion = out->has_motion || out->sheet.has_motion;
  if (out->animation_count > 0 || out->has_motion)
    out->key = key_of(bytes, size);
  cs_mem_free(context->memory, r.css, r.css_capacity);
  cs_mem_free(context->memory, r.characters, r.character_capacity);
  return status;
}

void cs_svg_document_finish(cs_svg_document *document, celspan_context *context) {
  cs_css_sheet_finish(&document->sheet, context);
  cs_svg_unread_finish(&document->unread, context);
  cs_hash_table_finish(&document->ids, context);
  cs_mem_free(context->memory, document->named, document->named_capacity * sizeof(cs_svg_node *));
  cs_arena_finish(&document->arena, context->memory);
  *document = (cs_svg_document){0};
}

/* ---------------------------------------------------------------- questions */

const cs_svg_node *cs_svg_document_find(const cs_svg_document *document, const char *id,
                                        size_t size) {
  size_t place;
  return cs_hash_table_find(&document->ids, hash_id(id, size), &place) ? document->named[place]
                                                                       : NULL;
}

const char *cs_svg_node_value(const cs_svg_node *node, cs_svg_name name) {
  for (size_t i = 0; i < node->attribute_count; i++)
    if (node->attributes[i].name == name)
      return node->attributes[i].value;
  return NULL;
}

bool cs_svg_node_says(const cs_svg_node *node, cs_svg_name name, const char *word) {
  return cs_svg_is_word(cs_svg_node_value(node, name), word);
}

#include "readers/svg/motion/motion.h"

#include <string.h>

#include "inside/number.h"
#include "readers/svg/words/silent.h"

/* The animation elements of a document while they are listed. */
typedef struct list {
  cs_svg_reading *reading;
  cs_svg_animation *items;
  size_t count;
} list;

/* The name that attributeName gives. */
static cs_svg_name name_of(const cs_svg_node *node) {
  const char *text = cs_svg_node_value(node, CS_SVG_ATTRIBUTE_NAME);
  if (!text || node->element == CS_SVG_ELEMENT_ANIMATE_MOTION)
    return CS_SVG_NAME_COUNT;
  cs_svg_name name = cs_svg_name_of(strcmp(text, "xlink:href") == 0 ? "href" : text);
  bool is_transform = name == CS_SVG_TRANSFORM || name == CS_SVG_GRADIENT_TRANSFORM ||
                      name == CS_SVG_PATTERN_TRANSFORM;
  bool is_wrong = is_transform != (node->element == CS_SVG_ELEMENT_ANIMATE_TRANSFORM);
  return is_wrong || name == CS_SVG_ID || name == CS_SVG_STYLE ? CS_SVG_NAME_COUNT : name;
}

static celspan_status note_unknown(list *all, const cs_svg_animation *it) {
  const char *text = cs_svg_node_value(it->node, CS_SVG_ATTRIBUTE_NAME);
  if (it->node->element == CS_SVG_ELEMENT_ANIMATE_MOTION || it->name != CS_SVG_NAME_COUNT ||
      !text || cs_svg_name_is_silent(text, ""))
    return CELSPAN_OK;
  return cs_svg_skip(all->reading, it->node, "%.40s of %.40s", it->node->tag, text);
}

/* Recursion: the depth of the document. */
static celspan_status collect(list *all, cs_svg_node *node) {
  for (; node; node = node->next) {
    if (cs_svg_element_animates(node->element)) {
      const cs_svg_node *named = cs_svg_linked(all->reading, node);
      bool has_href = cs_svg_node_value(node, CS_SVG_HREF);
      cs_svg_animation *it = &all->items[all->count++];
      *it = (cs_svg_animation){.node = node,
                               .target = has_href ? (cs_svg_node *)(size_t)named : node->parent,
                               .name = name_of(node)};
      CS_TRY(note_unknown(all, it));
    }
    CS_TRY(collect(all, node->first));
  }
  return CELSPAN_OK;
}

celspan_status cs_svg_move(cs_svg_reading *reading, double *seconds) {
  cs_svg_document *document = reading->document;
  list all = {.reading = reading};
  *seconds = 0;
  if (!reading->clock || (document->animation_count == 0 && !document->has_motion))
    return CELSPAN_OK;
  all.items = cs_arena_take(reading->context, &document->arena,
                            (document->animation_count + 1) * sizeof *all.items);
  if (!all.items)
    return CELSPAN_NO_MEMORY;
  CS_TRY(collect(&all, document->root));
  cs_svg_mover mover = {.reading = reading, .animations = all.items, .count = all.count};
  CS_TRY(reading->clock->run(reading->clock->user, &mover, seconds));
  if (!cs_number_is_sane(*seconds))
    *seconds = 1e12;
  return CELSPAN_OK;
}

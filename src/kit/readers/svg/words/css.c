/* One file, because rules, selectors and declarations are read by one parser. */
#include "readers/svg/words/css.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "inside/sort.h"
#include "readers/svg/words/forms.h"
#include "readers/svg/words/silent.h"
#include "readers/svg/words/values.h"

/* Compounds of one selector and classes of one compound; a selector with more is left out. */
#define COMPOUNDS 32
#define CLASSES 16
#define CONDITIONS 16
/* Weights of the parts of a compound. Source: CSS Selectors Level 3, 9. */
#define ID_WEIGHT 65536u
#define CLASS_WEIGHT 256u

static bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || (unsigned char)c >= 128;
}

char *cs_css_copy(const cs_css_place *place, const char *begin, const char *end) {
  while (begin < end && cs_svg_is_space(*begin))
    begin++;
  while (begin < end && cs_svg_is_space(end[-1]))
    end--;
  size_t size = (size_t)(end - begin);
  char *copy = cs_arena_take(place->context, place->arena, size + 1);
  if (!copy)
    return NULL;
  memcpy(copy, begin, size);
  copy[size] = 0;
  return copy;
}

/* A copy with a blank in place of each comment, and of the marks of an XML comment around the
 * text. */
static char *copy_without_comments(const cs_css_place *place, const char *text) {
  char *copy = cs_arena_take(place->context, place->arena, strlen(text) + 1), *to = copy;
  if (!copy)
    return NULL;
  while (*text) {
    size_t skipped = strncmp(text, "<!--", 4) == 0 ? 4 : strncmp(text, "-->", 3) == 0 ? 3 : 0;
    if (strncmp(text, "/*", 2) == 0) {
      const char *end = strstr(text + 2, "*/");
      skipped = end ? (size_t)(end + 2 - text) : strlen(text);
    }
    *to++ = skipped > 0 ? ' ' : *text;
    text += skipped > 0 ? skipped : 1;
  }
  *to = 0;
  return copy;
}

/* ---------------------------------------------------------------- declarations */

/* The quote that is open after `c`, if `quote` was open before it; 0: none. A string ends with its
 * line at the latest. */
static char open_quote(char quote, char c) {
  if (quote)
    return c == quote || c == '\n' ? 0 : quote;
  return c == '"' || c == '\'' ? c : 0;
}

/* The end of a declaration's value: the next ';' or '{' outside of strings and parentheses. */
static const char *value_end(const char *text, const char *end) {
  char quote = 0;
  int depth = 0;
  for (; text < end; text++) {
    quote = open_quote(quote, *text);
    if (quote)
      continue;
    depth += (*text == '(') - (*text == ')');
    if ((*text == ';' && depth <= 0) || *text == '{')
      break;
  }
  return text;
}

/* The text after the block that begins with '{', or the end. */
static const char *braces_end(const char *text, const char *end) {
  char quote = 0;
  int depth = 0;
  for (; text < end; text++) {
    quote = open_quote(quote, *text);
    depth += quote ? 0 : (*text == '{') - (*text == '}');
    if (depth == 0)
      return text + 1;
  }
  return end;
}

/* Cuts off "!important" at the end. */
static bool cut_important(const char *begin, const char **end) {
  const char *mark = *end;
  while (mark > begin && *mark != '!')
    mark--;
  if (*mark != '!' || strncasecmp(cs_svg_skip_space(mark + 1), "important", 9) != 0)
    return false;
  *end = mark;
  return true;
}

/* The name without its prefix, if browsers treat both as the same property. */
static const char *unprefixed(const char *name) {
  static const char prefix[] = "-webkit-";
  static const char aliases[] = "clip-path|filter|mask|mask-image|opacity|transform|"
                                "transform-origin|animation|animation-delay|animation-direction|"
                                "animation-duration|animation-fill-mode|animation-iteration-count|"
                                "animation-name|animation-play-state|animation-timing-function";
  if (strncmp(name, prefix, sizeof prefix - 1) != 0)
    return name;
  const char *rest = name + sizeof prefix - 1;
  return cs_svg_words_have(aliases, rest) ? rest : name;
}

/* Checks a declaration with this name. *counts: false if it is not read; then a note is made,
 * unless it could not change the drawing. */
static celspan_status judge(const cs_css_place *place, const char *name, cs_css_declaration *it,
                            bool *counts) {
  const char *property = unprefixed(name);
  it->name = cs_svg_name_of(property);
  it->custom = strncmp(name, "--", 2) == 0 ? name : NULL;
  it->has_variable = cs_svg_has_variable(it->value);
  *counts = it->custom;
  if (it->custom)
    return CELSPAN_OK;
  bool is_known = it->name != CS_SVG_NAME_COUNT && cs_svg_is_property(it->name);
  *counts = is_known && cs_svg_value_is_read(it->name, it->value, true);
  if (*counts || (!is_known && cs_svg_name_is_silent(property, it->value)))
    return CELSPAN_OK;
  return cs_svg_unread_add(place->unread, place->context, place->arena, place->line, name,
                           it->value);
}

/* name: value, as text. */
static celspan_status parse_declaration(const cs_css_place *place, const char *begin,
                                        const char *end, cs_css_declaration *out, bool *counts) {
  *counts = false;
  begin = begin < end ? cs_svg_skip_space(begin) : begin;
  const char *name_end = begin;
  while (name_end < end && is_name(*name_end))
    name_end++;
  const char *colon = name_end < end ? cs_svg_skip_space(name_end) : end;
  if (colon >= end || *colon != ':' || name_end == begin)
    return CELSPAN_OK;
  char *name = cs_css_copy(place, begin, name_end);
  out->is_important = cut_important(colon, &end);
  out->value = cs_css_copy(place, colon + 1, end);
  if (!name || !out->value)
    return CELSPAN_NO_MEMORY;
  for (char *at = name; *at && strncmp(name, "--", 2) != 0; at++)
    *at = *at >= 'A' && *at <= 'Z' ? (char)(*at - 'A' + 'a') : *at;
  return judge(place, name, out, counts);
}

static celspan_status parse_declarations(const cs_css_place *place, const char *begin,
                                         const char *end, cs_css_declarations *out) {
  size_t most = 1, count = 0;
  for (const char *at = begin; at < end; at++)
    most += *at == ';';
  cs_css_declaration *items = cs_arena_take(place->context, place->arena, most * sizeof *items);
  *out = (cs_css_declarations){.items = items};
  if (!items)
    return CELSPAN_NO_MEMORY;
  while (begin < end) {
    const char *stop = value_end(begin, end);
    bool is_nested = stop < end && *stop == '{', counts = false;
    if (!is_nested)
      CS_TRY(parse_declaration(place, begin, stop, &items[count], &counts));
    out->has_geometry =
        out->has_geometry || (counts && !items[count].custom &&
                              cs_svg_name_facts_of(items[count].name)->use == CS_SVG_USE_GEOMETRY);
    out->has_motion = out->has_motion || (counts && (items[count].name == CS_SVG_ANIMATION ||
                                                     items[count].name == CS_SVG_ANIMATION_NAME));
    out->has_nested = out->has_nested || is_nested;
    count += counts;
    begin = is_nested ? braces_end(stop, end) : stop + 1;
  }
  out->count = count;
  return CELSPAN_OK;
}

celspan_status cs_css_declarations_parse(const cs_css_place *place, const char *text,
                                         cs_css_declarations *out) {
  const char *plain = strstr(text, "/*") ? copy_without_comments(place, text) : text;
  if (!plain)
    return CELSPAN_NO_MEMORY;
  return parse_declarations(place, plain, plain + strlen(plain), out);
}

/* ---------------------------------------------------------------- selectors */

typedef struct parser {
  const cs_css_place *place;
  cs_css_sheet *sheet;
} parser;

/* The name at the beginning of *text, which is moved after it. NULL if there is no memory; "" if
 * there is no name. */
static const char *take_name(parser *p, const char **text) {
  const char *begin = *text;
  while (is_name(**text))
    ++*text;
  return cs_css_copy(p->place, begin, *text);
}

/* The value of a condition, quoted or a name; *text is moved to its end. NULL if there is no
 * memory. */
static const char *take_condition_value(parser *p, const char **text) {
  char quote = **text == '"' || **text == '\'' ? *(*text)++ : 0;
  if (!quote)
    return take_name(p, text);
  const char *begin = *text;
  while (**text && **text != quote)
    ++*text;
  const char *value = cs_css_copy(p->place, begin, *text);
  *text += **text == quote;
  return value;
}

/* A condition, from after its '[' to after its ']'; *is_simple: it was understood. */
static celspan_status parse_condition(parser *p, const char **text, cs_css_condition *out,
                                      bool *is_simple) {
  const char *at = cs_svg_skip_space(*text), *name = take_name(p, &at);
  if (!name)
    return CELSPAN_NO_MEMORY;
  *out = (cs_css_condition){.name = cs_svg_name_of(name), .value = ""};
  at = cs_svg_skip_space(at);
  if (*at && strchr("~|^$*", *at) && at[1] == '=')
    out->comparison = *at++;
  if (*at == '=') {
    out->comparison = out->comparison ? out->comparison : '=';
    at = cs_svg_skip_space(at + 1);
    if (!(out->value = take_condition_value(p, &at)))
      return CELSPAN_NO_MEMORY;
    at = cs_svg_skip_space(at);
  }
  *is_simple = *is_simple && out->name != CS_SVG_NAME_COUNT && *at == ']';
  *text = at + (*at == ']');
  return CELSPAN_OK;
}

/* A copy in the arena; NULL: there is no memory. */
static void *keep(const parser *p, const void *items, size_t size) {
  void *kept = cs_arena_take(p->place->context, p->place->arena, size);
  return kept ? memcpy(kept, items, size) : NULL;
}

/* The conditions that follow one another. */
static celspan_status parse_conditions(parser *p, const char **text, cs_css_compound *out,
                                       uint32_t *specificity, bool *is_simple) {
  cs_css_condition conditions[CONDITIONS];
  while (*is_simple && **text == '[') {
    ++*text;
    *is_simple = out->condition_count < CONDITIONS;
    if (*is_simple)
      CS_TRY(parse_condition(p, text, &conditions[out->condition_count], is_simple));
    out->condition_count += *is_simple;
    *specificity += CLASS_WEIGHT;
  }
  out->conditions = keep(p, conditions, out->condition_count * sizeof *conditions);
  return out->conditions ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

/* A compound; *is_simple: the whole compound was understood. */
static celspan_status parse_compound(parser *p, const char **text, cs_css_compound *out,
                                     uint32_t *specificity, bool *is_simple) {
  const char *classes[CLASSES], *name;
  const char *begin = *text;
  if (**text == '*') {
    ++*text;
  } else if (is_name(**text)) {
    if (!(out->element = take_name(p, text)))
      return CELSPAN_NO_MEMORY;
    ++*specificity;
  }
  while (**text == '.' || **text == '#' || strncmp(*text, ":root", 5) == 0) {
    bool is_id = **text == '#';
    if (*(*text)++ == ':') {
      *text += 4;
      out->is_root = true;
      *specificity += CLASS_WEIGHT;
      continue;
    }
    if (!(name = take_name(p, text)))
      return CELSPAN_NO_MEMORY;
    *is_simple = *is_simple && *name && (is_id ? !out->id : out->class_count < CLASSES);
    if (is_id)
      out->id = name;
    else if (*is_simple)
      classes[out->class_count++] = name;
    *specificity += is_id ? ID_WEIGHT : CLASS_WEIGHT;
  }
  CS_TRY(parse_conditions(p, text, out, specificity, is_simple));
  *is_simple = *is_simple && *text > begin;
  out->classes = keep(p, classes, out->class_count * sizeof *classes);
  return out->classes ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

/* The chain of a selector, which ends at `end`. */
static celspan_status parse_selector(parser *p, const char *text, const char *end,
                                     cs_css_rule *rule, bool *is_simple) {
  cs_css_compound compounds[COMPOUNDS];
  *is_simple = true;
  rule->compound_count = 0;
  rule->specificity = 0;
  text = cs_svg_skip_space(text);
  while (*is_simple && text < end) {
    cs_css_compound *compound = &compounds[rule->compound_count];
    *compound = (cs_css_compound){.is_child = *text == '>'};
    if (compound->is_child)
      text = cs_svg_skip_space(text + 1);
    CS_TRY(parse_compound(p, &text, compound, &rule->specificity, is_simple));
    const char *after = cs_svg_skip_space(text);
    *is_simple = *is_simple && (after > text || after >= end || *after == '>') &&
                 ++rule->compound_count < COMPOUNDS;
    text = after;
  }
  *is_simple = *is_simple && rule->compound_count > 0 && !compounds[0].is_child;
  rule->compounds = keep(p, compounds, rule->compound_count * sizeof *compounds);
  return rule->compounds ? CELSPAN_OK : CELSPAN_NO_MEMORY;
}

/* ---------------------------------------------------------------- sheets */

static celspan_status add_rule(parser *p, cs_css_rule *rule) {
  cs_css_sheet *sheet = p->sheet;
  if (sheet->count >= CS_CSS_RULES)
    return cs_fail(p->place->context, CELSPAN_LIMIT, "the style sheets have more than %d rules",
                   CS_CSS_RULES);
  CS_TRY(CS_ARRAY_RESERVE(p->place->context, sheet->rules, sheet->count + 1));
  rule->order = (uint32_t)sheet->count;
  sheet->rules[sheet->count++] = *rule;
  return CELSPAN_OK;
}

/* Adds a rule for each selector of the list [text, brace). */
static celspan_status add_selectors(parser *p, const char *text, const char *brace,
                                    cs_css_declarations declarations) {
  while (text < brace) {
    const char *comma = memchr(text, ',', (size_t)(brace - text)), *end = comma ? comma : brace;
    cs_css_rule rule = {.declarations = declarations};
    bool is_simple;
    while (end > text && cs_svg_is_space(end[-1]))
      end--;
    CS_TRY(parse_selector(p, text, end, &rule, &is_simple));
    if (is_simple)
      CS_TRY(add_rule(p, &rule));
    p->sheet->omitted = p->sheet->omitted || !is_simple;
    text = comma ? comma + 1 : brace;
  }
  return CELSPAN_OK;
}

/* The text after an at-rule, which ends with a block or with a semicolon. */
static const char *skip_at_rule(const char *text) {
  int depth = 0;
  for (; *text; text++) {
    depth += (*text == '{') - (*text == '}');
    if ((*text == ';' && depth == 0) || (*text == '}' && depth <= 0))
      return text + 1;
  }
  return text;
}

/* ---------------------------------------------------------------- keyframes */

/* How much is read of declarations: names, and bytes of timing functions, which may be lists. */
static size_t cost_of(const cs_css_declarations *declarations) {
  size_t cost = 1 + declarations->count;
  for (size_t i = 0; i < declarations->count; i++)
    if (declarations->items[i].name == CS_SVG_ANIMATION_TIMING_FUNCTION)
      cost += strlen(declarations->items[i].value);
  return cost;
}

/* The shares of the time that a selector of @keyframes lists, each a frame with the same
 * declarations: "from, 50%". What is no share is left out. */
static void add_frames(const char *text, const char *brace, const cs_css_declarations *declarations,
                       cs_css_frames *out) {
  const size_t cost = cost_of(declarations);
  while (text < brace) {
    double at = -1;
    text = cs_svg_skip_space(text);
    if (cs_svg_take_word(&text, "from"))
      at = 0;
    else if (cs_svg_take_word(&text, "to"))
      at = 1;
    else if (cs_svg_take_number(&text, &at))
      at = *text == '%' ? at / 100 : -1;
    if (at >= 0 && at <= 1) {
      out->items[out->count++] = (cs_css_frame){at, *declarations};
      out->size += cost;
    }
    while (text < brace && *text++ != ',')
      ;
  }
}

/* The frames between the braces of the rule, [text, end). */
static celspan_status parse_frames(parser *p, const char *text, const char *end,
                                   cs_css_frames *out) {
  size_t most = 0;
  for (const char *at = text; at < end; at++)
    most += *at == ',' || *at == '{';
  out->items = cs_arena_take(p->place->context, p->place->arena, most * sizeof *out->items);
  if (!out->items)
    return CELSPAN_NO_MEMORY;
  while (text < end) {
    const char *brace = memchr(text, '{', (size_t)(end - text));
    if (!brace)
      break;
    const char *after = braces_end(brace, end);
    cs_css_declarations declarations;
    CS_TRY(parse_declarations(p->place, brace + 1, after - (after[-1] == '}'), &declarations));
    p->sheet->has_geometry = p->sheet->has_geometry || declarations.has_geometry;
    add_frames(text, brace, &declarations, out);
    text = after;
  }
  return CELSPAN_OK;
}

/* The name of a rule that begins with @keyframes; NULL: it is another rule. */
static const char *frames_name(const char *text) {
  static const char *const words[] = {"@keyframes", "@-webkit-keyframes"};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    size_t size = strlen(words[i]);
    if (strncasecmp(text, words[i], size) == 0 && cs_svg_is_space(text[size]))
      return cs_svg_skip_space(text + size);
  }
  return NULL;
}

/* The rule at *text, whose name is at `name`; *text is moved after it. */
static celspan_status parse_keyframes(parser *p, const char *name, const char **text) {
  const char *brace = strchr(name, '{');
  *text = brace ? braces_end(brace, brace + strlen(brace)) : name + strlen(name);
  if (!brace)
    return CELSPAN_OK;
  const char quote = *name == '"' || *name == '\'' ? *name : 0, *end = brace;
  while (end > name && cs_svg_is_space(end[-1]))
    end--;
  const bool is_quoted = quote && end > name + 1 && end[-1] == quote;
  cs_css_frames frames = {.name = cs_css_copy(p->place, name + is_quoted, end - is_quoted)};
  if (!frames.name)
    return CELSPAN_NO_MEMORY;
  CS_TRY(parse_frames(p, brace + 1, *text - ((*text)[-1] == '}'), &frames));
  return CS_ARRAY_APPEND(p->place->context, p->sheet->frames, p->sheet->frames_count, frames);
}

/* ---------------------------------------------------------------- the whole sheet */

static int compare_rules(const void *a, const void *b) {
  const cs_css_rule *first = a, *second = b;
  int order = CS_SORT_ORDER(first->specificity, second->specificity);
  return order ? order : CS_SORT_ORDER(first->order, second->order);
}

static celspan_status parse_sheet(parser *p, const char *text) {
  for (text = cs_svg_skip_space(text); *text; text = cs_svg_skip_space(text)) {
    const char *keyframes = frames_name(text);
    if (keyframes) {
      CS_TRY(parse_keyframes(p, keyframes, &text));
      continue;
    }
    if (*text == '@') {
      p->sheet->omitted = true;
      text = skip_at_rule(text);
      continue;
    }
    const char *brace = strchr(text, '{');
    if (!brace)
      break;
    const char *after = braces_end(brace, brace + strlen(brace));
    const char *end = after[-1] == '}' ? after - 1 : after;
    cs_css_declarations declarations;
    CS_TRY(parse_declarations(p->place, brace + 1, end, &declarations));
    p->sheet->omitted = p->sheet->omitted || declarations.has_nested;
    p->sheet->has_geometry = p->sheet->has_geometry || declarations.has_geometry;
    p->sheet->has_motion = p->sheet->has_motion || declarations.has_motion;
    CS_TRY(add_selectors(p, text, brace, declarations));
    text = after;
  }
  return CELSPAN_OK;
}

celspan_status cs_css_sheet_parse(const cs_css_place *place, const char *text, cs_css_sheet *out) {
  parser p = {place, out};
  const char *plain = copy_without_comments(place, text);
  if (!plain)
    return CELSPAN_NO_MEMORY;
  CS_TRY(parse_sheet(&p, plain));
  if (out->count > 0)
    qsort(out->rules, out->count, sizeof *out->rules, compare_rules);
  return CELSPAN_OK;
}

void cs_css_sheet_finish(cs_css_sheet *sheet, celspan_context *context) {
  CS_ARRAYS_FREE(context->memory, sheet, rules, frames);
  *sheet = (cs_css_sheet){0};
}
